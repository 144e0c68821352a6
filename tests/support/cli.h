#pragma once

// The program as a user meets it: run as a child process, judged by its exit code, its two streams and its files.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "support/scratch_folder.h"

namespace meltpoint::test {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

struct Result {
    int exit_code = -1; ///< 128 + signal where one ended it
    std::string out;
    std::string err;
};

/// The program, started in a folder of its own.
class Cli : public testing::Test {
protected:
    [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }

    /// For the programs started later.
    void set_environment(const std::string& name, std::string value) { environment_[name] = std::move(value); }

    pid_t start(const Arguments& arguments, const std::string& stdout_path = "") const
    {
        Arguments line{MELTPOINT_TEST_PROGRAM};
        line.insert(line.end(), arguments.begin(), arguments.end());
        return spawn(line, stdout_path);
    }

    Result run(const Arguments& arguments, const std::string& stdout_path = "") const
    {
        return finish(start(arguments, stdout_path));
    }

    /// Through a shell, where "$P" is the program.
    Result shell(const std::string& script) const
    {
        return finish(spawn({"/bin/bash", "-c", "P='" MELTPOINT_TEST_PROGRAM "'; " + script}, ""));
    }

    Result finish(pid_t child) const
    {
        int status = 0;
        EXPECT_EQ(waitpid(child, &status, 0), child);
        Result result;
        result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        result.out = read_bytes(streams_ / "out");
        result.err = read_bytes(streams_ / "err");
        return result;
    }

    /// Names of everything in a folder, sorted, hidden files included.
    [[nodiscard]] std::vector<std::string> files(const std::string& folder) const
    {
        std::vector<std::string> names;
        for (const fs::directory_entry& entry : fs::directory_iterator(path(folder))) {
            names.push_back(entry.path().filename().string());
        }
        std::sort(names.begin(), names.end());
        return names;
    }

    [[nodiscard]] std::string bytes(const std::string& file) const { return read_bytes(path(file)); }

private:
    pid_t spawn(const Arguments& line, const std::string& stdout_path) const
    {
        std::vector<char*> argv;
        for (const std::string& argument : line) {
            argv.push_back(const_cast<char*>(argument.c_str())); // NOLINT(cppcoreguidelines-pro-type-const-cast)
        }
        argv.push_back(nullptr);
        const pid_t child = fork();
        if (child != 0) {
            return child;
        }
        const std::string out = stdout_path.empty() ? (streams_ / "out").string() : stdout_path;
        const auto redirect = [](int stream, const std::string& file) {
            dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), stream);
        };
        redirect(STDOUT_FILENO, out);
        redirect(STDERR_FILENO, (streams_ / "err").string());
        for (const auto& [name, value] : environment_) {
            setenv(name.c_str(), value.c_str(), 1);
        }
        if (chdir(folder_.path().c_str()) == 0) {
            execv(argv[0], argv.data());
        }
        _exit(127);
    }

    ScratchFolder folder_;
    ScratchFolder streams_;
    std::map<std::string, std::string> environment_;
};

/// The lines of a text, without those of the progress.
inline Arguments messages(const std::string& text)
{
    Arguments lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with("frames ")) {
            lines.push_back(line);
        }
    }
    return lines;
}

/// Exit code and one sentence on stderr, nothing on stdout.
inline void expect_one_sentence(const Result& result, int exit_code, const std::string& part)
{
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(result.out, "");
    ASSERT_FALSE(messages(result.err).empty());
    const std::string last = messages(result.err).back();
    EXPECT_TRUE(last.starts_with("error: ")) << result.err;
    EXPECT_NE(last.find(part), std::string::npos) << result.err;
    const auto errors =
        std::ranges::count_if(messages(result.err), [](const std::string& line) { return line.starts_with("error"); });
    EXPECT_EQ(errors, 1) << result.err;
}

} // namespace meltpoint::test
