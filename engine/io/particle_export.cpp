// PLY, the Stanford polygon file format (Turk 1994): a text header that names the properties, then one packed row a
// vertex.
#include "io/particle_export.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"

namespace meltpoint {

namespace {

static_assert(std::endian::native == std::endian::little, "rows are copied as they lie in memory");

constexpr std::string_view HEADER = R"(ply
format binary_little_endian 1.0
comment particles of meltpoint, SI units: positions m, velocities m/s, density kg/m^3, pressure Pa, mass kg
comment state: 0 solid, 1 fluid, 2 dust, 3 collider, 4 dead
element vertex {}
property float x
property float y
property float z
property float vx
property float vy
property float vz
property float density
property float pressure
property float mass
property uint id
property uchar state
property uchar material
end_header
)";
static_assert(shared::STATE_SOLID == 0 && shared::STATE_FLUID == 1 && shared::STATE_DUST == 2 &&
              shared::STATE_COLLIDER == 3 && shared::STATE_DEAD == 4);

constexpr std::size_t ROW_BYTES = 9 * sizeof(float) + sizeof(std::uint32_t) + 2;
constexpr std::size_t ROWS_A_WRITE = 4096;

std::byte* append(std::byte* end, const auto& value)
{
    std::memcpy(end, &value, sizeof(value));
    return end + sizeof(value);
}

void encode_row(std::byte* row, const ParticleSet& particles, std::size_t i)
{
    const std::array<float, 9> floats = {particles.position[i].x, particles.position[i].y, particles.position[i].z,
                                         particles.velocity[i].x, particles.velocity[i].y, particles.velocity[i].z,
                                         particles.density[i],    particles.pressure[i],   particles.mass[i]};
    std::byte* end = append(row, floats);
    end = append(end, particles.id[i]);
    end = append(end, static_cast<std::uint8_t>(shared::particle_state(particles.attributes[i])));
    append(end, static_cast<std::uint8_t>(shared::particle_material(particles.attributes[i])));
}

void check_lengths(const std::filesystem::path& path, const ParticleSet& particles)
{
    const std::size_t count = particles.size();
    for (const std::size_t length : {particles.id.size(), particles.attributes.size(), particles.velocity.size(),
                                     particles.mass.size(), particles.density.size(), particles.pressure.size()}) {
        if (length != count) {
            throw runtime_error("cannot write {}: of {} particles, an attribute has {}", path.string(), count, length);
        }
    }
}

} // namespace

void write_ply(const std::filesystem::path& path, const ParticleSet& particles)
{
    check_lengths(path, particles);
    AtomicFile file(path);
    file.write(fmt::format(HEADER, particles.size()));

    std::vector<std::byte> rows(ROWS_A_WRITE * ROW_BYTES);
    for (std::size_t begin = 0; begin < particles.size(); begin += ROWS_A_WRITE) {
        const std::size_t count = std::min(ROWS_A_WRITE, particles.size() - begin);
        for (std::size_t i = 0; i < count; ++i) {
            encode_row(&rows[i * ROW_BYTES], particles, begin + i);
        }
        file.write(std::span(rows).first(count * ROW_BYTES));
    }
    file.commit();
}

} // namespace meltpoint
