#include "io/atomic_file.h"

#include <csignal>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

using test::read_bytes;

template <class Action>
std::string failure_of(const Action& action)
{
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Runtime);
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

std::vector<std::byte> megabytes(std::size_t count)
{
    return std::vector<std::byte>(count << 20, std::byte{7});
}

/// Files of this process may not grow beyond so many bytes: a full disk.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        getrlimit(RLIMIT_FSIZE, &old_limit_);
        const rlimit limit{bytes, old_limit_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk()
    {
        setrlimit(RLIMIT_FSIZE, &old_limit_);
        std::signal(SIGXFSZ, old_handler_);
    }

private:
    rlimit old_limit_{};
    void (*old_handler_)(int);
};

TEST(AtomicFile, AppearsWholeWithCommit)
{
    const test::ScratchFolder folder;
    const auto path = folder / "a.csv";
    AtomicFile file(path);
    file.write("one\n");
    EXPECT_FALSE(std::filesystem::exists(path));
    file.write("two\n");
    file.commit();
    EXPECT_EQ(read_bytes(path), "one\ntwo\n");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, ReplacesAnOlderFile)
{
    const test::ScratchFolder folder;
    const auto path = folder / "a";
    test::write_bytes(path, "something longer");
    AtomicFile file(path);
    file.write("new");
    EXPECT_EQ(read_bytes(path), "something longer");
    file.commit();
    EXPECT_EQ(read_bytes(path), "new");
}

TEST(AtomicFile, LeavesNothingWithoutCommit)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "a", "old");
    {
        AtomicFile file(folder / "a");
        file.write("half");
    }
    EXPECT_EQ(read_bytes(folder / "a"), "old");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, HasTheUsualPermissions)
{
    const test::ScratchFolder folder;
    const mode_t old_mask = umask(0027);
    write_file_atomically(folder / "a", {});
    umask(old_mask);
    EXPECT_EQ(std::filesystem::status(folder / "a").permissions(), std::filesystem::perms{0640});
}

TEST(AtomicFile, WritesNamesOfTheGreatestLength)
{
    const test::ScratchFolder folder;
    const std::string name(255, 'n');
    write_file_atomically(folder / name, {});
    EXPECT_TRUE(std::filesystem::exists(folder / name));
}

TEST(AtomicFile, SaysWhyItCannotWrite)
{
    const test::ScratchFolder folder;
    EXPECT_EQ(failure_of([&] { write_file_atomically(folder.path(), {}); }),
              "cannot write " + folder.path().string() + ": Is a directory");
    EXPECT_EQ(failure_of([&] { write_file_atomically(folder / "none/a", {}); }),
              "cannot write " + (folder / "none/a").string() + ": No such file or directory");
    test::write_bytes(folder / "file", "");
    EXPECT_EQ(failure_of([&] { write_file_atomically(folder / "file/a", {}); }),
              "cannot write " + (folder / "file/a").string() + ": Not a directory");
    EXPECT_EQ(failure_of([&] { write_file_atomically("/dev/full", {}); }),
              "cannot write /dev/full: it is a device, a pipe or a socket, not a file");
    EXPECT_EQ(failure_of([&] { write_file_atomically("", {}); }).find("cannot write :"), 0u);
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, LeavesTheOldFileWhenTheDiskIsFull)
{
    const test::ScratchFolder folder;
    const auto path = folder / "a";
    test::write_bytes(path, "old");
    const std::string sentence = "cannot write " + path.string() + ": File too large";
    {
        const FullDisk full(4096);
        EXPECT_EQ(failure_of([&] { write_file_atomically(path, megabytes(1)); }), sentence); // while writing
        EXPECT_EQ(failure_of([&] {
                      AtomicFile file(path);
                      file.write(std::string(4000, 'x')); // still buffered
                      file.write(std::string(97, 'x'));
                      file.commit();
                  }),
                  sentence);
    }
    EXPECT_EQ(read_bytes(path), "old");
    EXPECT_EQ(folder.file_count(), 1u);
}

} // namespace
} // namespace meltpoint
