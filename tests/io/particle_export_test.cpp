#include "io/particle_export.h"

#include <cstring>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

/// A reader of binary PLY files with one element, that knows nothing but their header.
struct Ply {
    std::size_t count = 0;
    std::vector<std::pair<std::string, std::string>> properties; // type, name
    std::map<std::string, std::vector<double>> values;
};

template <class T>
double take(const std::string& bytes, std::size_t& offset)
{
    T value;
    std::memcpy(&value, bytes.substr(offset, sizeof(T)).data(), sizeof(T));
    offset += sizeof(T);
    return static_cast<double>(value);
}

Ply read_ply(const std::filesystem::path& path)
{
    const std::string bytes = test::read_bytes(path);
    const std::string end_of_header = "\nend_header\n";
    std::size_t offset = bytes.find(end_of_header) + end_of_header.size();
    EXPECT_LT(offset, bytes.size() + 1);
    std::istringstream header(bytes.substr(0, offset));

    Ply ply;
    std::string line;
    std::getline(header, line);
    EXPECT_EQ(line, "ply");
    std::getline(header, line);
    EXPECT_EQ(line, "format binary_little_endian 1.0");
    while (std::getline(header, line)) {
        std::istringstream words(line);
        std::string word, type, name;
        words >> word >> type >> name;
        if (word == "element") {
            EXPECT_EQ(type, "vertex");
            ply.count = std::stoul(name);
        } else if (word == "property") {
            ply.properties.emplace_back(type, name);
        } else {
            EXPECT_TRUE(word == "comment" || word == "end_header") << line;
        }
    }
    for (std::size_t i = 0; i < ply.count; ++i) {
        for (const auto& [type, name] : ply.properties) {
            ply.values[name].push_back(type == "float"  ? take<float>(bytes, offset)
                                       : type == "uint" ? take<std::uint32_t>(bytes, offset)
                                                        : take<std::uint8_t>(bytes, offset));
        }
    }
    EXPECT_EQ(offset, bytes.size());
    return ply;
}

ParticleSet random_particles(std::size_t count)
{
    Random random(5);
    const auto number = [&] {
        return static_cast<float>(random.uniform() * 200.0 - 100.0);
    };
    ParticleSet particles;
    particles.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        particles.id[i] = static_cast<std::uint32_t>(random.next());
        particles.attributes[i] =
            shared::pack_attributes(random.below(5), random.below(256)) | shared::FLAG_LEFT_DOMAIN;
        particles.position[i] = {number(), number(), number()};
        particles.velocity[i] = {number(), number(), number()};
        particles.density[i] = number();
        particles.pressure[i] = number();
        particles.mass[i] = number();
    }
    return particles;
}

TEST(WritePly, KeepsEveryParticle)
{
    const test::ScratchFolder folder;
    for (const std::size_t count : {0u, 1u, 4096u, 10000u}) {
        const ParticleSet particles = random_particles(count);
        write_ply(folder / "a.ply", particles);
        const Ply ply = read_ply(folder / "a.ply");
        ASSERT_EQ(ply.count, count);
        EXPECT_EQ(ply.properties.size(), 12u);
        for (std::size_t i = 0; i < count; ++i) {
            const auto value = [&](const char* name) {
                return ply.values.at(name)[i];
            };
            ASSERT_EQ(glm::vec3(value("x"), value("y"), value("z")), particles.position[i]);
            ASSERT_EQ(glm::vec3(value("vx"), value("vy"), value("vz")), particles.velocity[i]);
            ASSERT_EQ(value("density"), particles.density[i]);
            ASSERT_EQ(value("pressure"), particles.pressure[i]);
            ASSERT_EQ(value("mass"), particles.mass[i]);
            ASSERT_EQ(value("id"), particles.id[i]);
            ASSERT_EQ(value("state"), shared::particle_state(particles.attributes[i]));
            ASSERT_EQ(value("material"), shared::particle_material(particles.attributes[i]));
        }
    }
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WritePly, RefusesASetOfUnequalArrays)
{
    const test::ScratchFolder folder;
    ParticleSet particles = random_particles(10);
    particles.mass.pop_back();
    EXPECT_THROW(write_ply(folder / "a.ply", particles), Error);
    EXPECT_EQ(folder.file_count(), 0u);
}

} // namespace
} // namespace meltpoint
