#include "run/frame_statistics.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

shared::SphParams params()
{
    shared::SphParams result{};
    result.domain_min = {-1.0f, -2.0f, -3.0f};
    result.domain_max = {1.0f, 2.0f, 3.0f};
    result.gravity = {0.0f, -10.0f, 0.0f};
    result.rest_density[0] = 1000.0f;
    result.rest_density[1] = 500.0f;
    return result;
}

struct Particle {
    std::uint32_t attributes;
    glm::vec3 position;
    glm::vec3 velocity;
    float mass;
    float density;
};

ParticleSet particle_set(const std::vector<Particle>& particles)
{
    ParticleSet set;
    set.resize(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        set.attributes[i] = particles[i].attributes;
        set.position[i] = particles[i].position;
        set.velocity[i] = particles[i].velocity;
        set.mass[i] = particles[i].mass;
        set.density[i] = particles[i].density;
    }
    return set;
}

/// One particle of each state, two of the fluid, one of them outside.
ParticleSet one_of_each()
{
    using shared::pack_attributes;
    return particle_set({
        {pack_attributes(shared::STATE_FLUID, 0), {0.5f, 0.0f, 0.0f}, {3.0f, 4.0f, 0.0f}, 2.0f, 1100.0f},
        {pack_attributes(shared::STATE_FLUID, 1) | shared::FLAG_LEFT_DOMAIN,
         {-0.25f, 2.0f, 1.0f},
         {0.0f, 0.0f, -1.0f},
         1.0f,
         450.0f},
        {pack_attributes(shared::STATE_SOLID, 0), {0.0f, -2.0f, 0.0f}, {}, 4.0f, 5000.0f},
        {pack_attributes(shared::STATE_DUST, 0), {0.0f, -1.0f, 0.0f}, {10.0f, 0.0f, 0.0f}, 0.5f, 0.0f},
        {pack_attributes(shared::STATE_COLLIDER, 0), {1.0f, 1.0f, 1.0f}, {}, 8.0f, 0.0f},
        {pack_attributes(shared::STATE_DEAD, 0) | shared::FLAG_LEFT_DOMAIN,
         {99.0f, 99.0f, 99.0f},
         {99.0f, 99.0f, 99.0f},
         99.0f,
         9999.0f},
    });
}

TEST(FrameStatistics, SumsOverTheLivingParticles)
{
    const FrameStatistics s = measure(one_of_each(), params());
    EXPECT_EQ(s.fluid, 2u);
    EXPECT_EQ(s.solid, 1u);
    EXPECT_EQ(s.dust, 1u);
    EXPECT_EQ(s.collider, 1u);
    EXPECT_EQ(s.dead, 1u);
    EXPECT_EQ(s.mass, 15.5);
    EXPECT_EQ(s.kinetic_energy, 0.5 * (2.0 * 25.0 + 1.0 + 0.5 * 100.0));
    EXPECT_EQ(s.momentum, glm::dvec3(6.0 + 5.0, 8.0, -1.0));
    // Heights above the floor at -2: 2, 4, 0, 1 and 3 m.
    EXPECT_EQ(s.potential_energy, 10.0 * (2.0 * 2.0 + 1.0 * 4.0 + 0.5 * 1.0 + 8.0 * 3.0));
    EXPECT_EQ(s.outside, 1u) << "the dead one no longer counts";
}

TEST(FrameStatistics, FluidHasItsOwnMeasures)
{
    const FrameStatistics s = measure(one_of_each(), params());
    ASSERT_TRUE(s.fluid_part.has_value());
    EXPECT_EQ(s.fluid_part->center_of_mass, glm::dvec3(0.75, 2.0, 1.0) / 3.0);
    EXPECT_EQ(s.fluid_part->min, glm::dvec3(-0.25, 0.0, 0.0));
    EXPECT_EQ(s.fluid_part->max, glm::dvec3(0.5, 2.0, 1.0));
    EXPECT_EQ(s.fluid_part->speed_max, 5.0);
    EXPECT_NEAR(s.fluid_part->density_error_max, 0.1, 1e-12);
    EXPECT_NEAR(s.fluid_part->density_error_mean, 0.05, 1e-12) << "too thin a fluid has no error";
}

TEST(FrameStatistics, DensityErrorIsRelativeToTheParticlesOwnMaterial)
{
    const ParticleSet set = particle_set({{shared::pack_attributes(shared::STATE_FLUID, 1), {}, {}, 1.0f, 750.0f}});
    EXPECT_NEAR(measure(set, params()).fluid_part->density_error_max, 0.5, 1e-12);
}

TEST(FrameStatistics, PotentialEnergyIsZeroInTheCornerThatGravityPointsTo)
{
    shared::SphParams tilted = params();
    tilted.gravity = {3.0f, 0.0f, -4.0f};
    const std::uint32_t fluid = shared::pack_attributes(shared::STATE_FLUID, 0);
    EXPECT_EQ(measure(particle_set({{fluid, {1.0f, 0.5f, -3.0f}, {}, 2.0f, 1.0f}}), tilted).potential_energy, 0.0);
    EXPECT_EQ(measure(particle_set({{fluid, {0.0f, 0.5f, -2.0f}, {}, 2.0f, 1.0f}}), tilted).potential_energy,
              2.0 * (3.0 * 1.0 + 4.0 * 1.0));
}

TEST(FrameStatistics, MassIsSummedInDoublePrecisionInOrderOfId)
{
    std::vector<Particle> particles(1000, {shared::pack_attributes(shared::STATE_FLUID, 0), {}, {}, 0.1f, 1.0f});
    particles.front().mass = 1e8f;
    double expected = 0.0;
    for (const Particle& particle : particles) {
        expected += static_cast<double>(particle.mass);
    }
    EXPECT_EQ(measure(particle_set(particles), params()).mass, expected);
}

std::vector<std::string> split(std::string line)
{
    EXPECT_FALSE(line.empty());
    EXPECT_EQ(line.back(), '\n');
    line.pop_back();
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == ',') {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

std::string cell(const FrameStatistics& statistics, const std::string& column)
{
    const std::vector<std::string> names = split(std::string(statistics_header()));
    const std::vector<std::string> cells = split(statistics_row(statistics));
    EXPECT_EQ(names.size(), cells.size());
    const auto found = std::find(names.begin(), names.end(), column);
    EXPECT_NE(found, names.end()) << column;
    return cells.at(static_cast<std::size_t>(found - names.begin()));
}

TEST(FrameStatistics, ColumnsStayWhereTheyAre)
{
    EXPECT_EQ(
        statistics_header(),
        "frame,time,steps,dt,solid,fluid,dust,collider,dead,mass,kinetic_energy,potential_energy,momentum_x,"
        "momentum_y,momentum_z,com_x,com_y,com_z,min_x,min_y,min_z,max_x,max_y,max_z,density_error_mean,"
        "density_error_max,speed_max,outside,neighbors_mean,simulate_ms,draw_ms,iterations_density,iterations_"
        "divergence,iterations_viscosity,deposited,enthalpy,solid_volume,exposed_area,fragments,emitted,sunk,rate_melt,"
        "rate_hydraulic,rate_wind,rate_dissolve\n");
}

TEST(FrameStatistics, EveryValueStandsInItsColumn)
{
    FrameStatistics s = measure(one_of_each(), params());
    s.frame = 7;
    s.time = 0.5;
    s.steps = 1234;
    s.dt = 1e-4;
    s.neighbors_mean = 31.5;
    s.simulate_ms = 12.3456;
    s.draw_ms = 7.0;
    EXPECT_EQ(cell(s, "iterations_density") + cell(s, "iterations_divergence") + cell(s, "iterations_viscosity"), "");
    EXPECT_EQ(cell(s, "fragments"), ""); // none can break off
    s.fragments = 3;
    EXPECT_EQ(cell(s, "fragments"), "3");
    s.iterations_density = 4.5;
    s.iterations_divergence = 1.25;
    s.iterations_viscosity = 8.0;
    EXPECT_EQ(cell(s, "frame"), "7");
    EXPECT_EQ(cell(s, "time"), "0.5");
    EXPECT_EQ(cell(s, "steps"), "1234");
    EXPECT_EQ(cell(s, "dt"), "0.0001");
    EXPECT_EQ(cell(s, "solid") + cell(s, "fluid") + cell(s, "dust") + cell(s, "collider") + cell(s, "dead"), "12111");
    EXPECT_EQ(cell(s, "mass"), "15.5");
    EXPECT_EQ(cell(s, "kinetic_energy"), "50.5");
    EXPECT_EQ(cell(s, "potential_energy"), "325");
    EXPECT_EQ(cell(s, "momentum_x") + " " + cell(s, "momentum_y") + " " + cell(s, "momentum_z"), "11 8 -1");
    EXPECT_EQ(cell(s, "com_x"), "0.25");
    EXPECT_EQ(std::stod(cell(s, "com_y")), 2.0 / 3.0) << "numbers read back as themselves";
    EXPECT_EQ(cell(s, "min_x") + " " + cell(s, "min_y") + " " + cell(s, "min_z"), "-0.25 0 0");
    EXPECT_EQ(cell(s, "max_x") + " " + cell(s, "max_y") + " " + cell(s, "max_z"), "0.5 2 1");
    EXPECT_EQ(cell(s, "speed_max"), "5");
    EXPECT_EQ(cell(s, "outside"), "1");
    EXPECT_EQ(cell(s, "neighbors_mean"), "31.5");
    EXPECT_EQ(cell(s, "simulate_ms"), "12.346");
    EXPECT_EQ(cell(s, "draw_ms"), "7.000");
    EXPECT_EQ(cell(s, "iterations_density"), "4.5");
    EXPECT_EQ(cell(s, "iterations_divergence"), "1.25");
    EXPECT_EQ(cell(s, "iterations_viscosity"), "8");
    EXPECT_EQ(cell(s, "solid_volume"), "0.004"); // 4 kg of 1000 kg/m^3
    EXPECT_EQ(cell(s, "emitted") + cell(s, "sunk"), "00");
    EXPECT_EQ(cell(s, "enthalpy") + cell(s, "exposed_area") + cell(s, "rate_melt") + cell(s, "rate_hydraulic") +
                  cell(s, "rate_wind") + cell(s, "rate_dissolve"),
              "");
    s.emitted = 12;
    s.sunk = 3;
    s.enthalpy = -2.5;
    s.exposed_area = 0.125;
    s.rate_melt = 0.5;
    s.rate_dissolve = 0.25;
    EXPECT_EQ(cell(s, "emitted"), "12");
    EXPECT_EQ(cell(s, "sunk"), "3");
    EXPECT_EQ(cell(s, "enthalpy"), "-2.5");
    EXPECT_EQ(cell(s, "exposed_area"), "0.125");
    EXPECT_EQ(cell(s, "rate_melt"), "0.5");
    EXPECT_EQ(cell(s, "rate_dissolve"), "0.25");
}

TEST(FrameStatistics, KnowsWhatHasFreedASolid)
{
    ParticleSet set = one_of_each();
    EXPECT_EQ(measure(set, params()).freed_mass[shared::CAUSE_MELT], 0.0);
    set.attributes[0] = shared::freed_as(set.attributes[0], shared::STATE_FLUID, shared::CAUSE_MELT);
    set.attributes[3] = shared::freed_as(set.attributes[3], shared::STATE_DUST, shared::CAUSE_FRONT);
    set.attributes[2] = shared::freed_as(set.attributes[2], shared::STATE_SOLID, shared::CAUSE_MELT); // frozen again
    const FrameStatistics s = measure(set, params());
    EXPECT_EQ(s.freed_mass[shared::CAUSE_MELT], 2.0);
    EXPECT_EQ(s.freed_mass[shared::CAUSE_FRONT], 0.5);
}

TEST(FrameStatistics, UndefinedIsEmpty)
{
    const FrameStatistics s = measure(ParticleSet{}, params());
    for (const char* column : {"com_x", "com_y", "com_z", "min_x", "min_y", "min_z", "max_x", "max_y", "max_z",
                               "density_error_mean", "density_error_max", "speed_max", "neighbors_mean"}) {
        EXPECT_EQ(cell(s, column), "") << column;
    }
    EXPECT_EQ(cell(s, "mass"), "0");
    EXPECT_EQ(cell(s, "fluid"), "0");

    FrameStatistics broken = s;
    broken.kinetic_energy = std::numeric_limits<double>::quiet_NaN();
    broken.mass = std::numeric_limits<double>::infinity();
    EXPECT_EQ(cell(broken, "kinetic_energy"), "");
    EXPECT_EQ(cell(broken, "mass"), "");
}

} // namespace
} // namespace meltpoint
