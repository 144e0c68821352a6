#include "validation/case.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace meltpoint::validation {

void check_stop(const Host& host)
{
    if (host.stop != nullptr && host.stop->load()) {
        throw Interrupted{};
    }
}

std::string Measurement::range() const
{
    if (std::isinf(lowest)) {
        return fmt::format("at most {:g}", highest);
    }
    return std::isinf(highest) ? fmt::format("at least {:g}", lowest) : fmt::format("{:g} to {:g}", lowest, highest);
}

Measurement at_most(std::string quantity, double value, double highest)
{
    return {.quantity = std::move(quantity), .value = value, .highest = highest};
}

Measurement at_least(std::string quantity, double value, double lowest)
{
    return {.quantity = std::move(quantity), .value = value, .lowest = lowest};
}

Measurement within(std::string quantity, double value, double lowest, double highest)
{
    return {.quantity = std::move(quantity), .value = value, .lowest = lowest, .highest = highest};
}

bool Outcome::holds() const
{
    return std::ranges::all_of(measurements, &Measurement::holds);
}

std::span<const Case> cases()
{
    static constexpr std::array<Case, 15> all{{
        {"free_fall", "Free fall", "A block of water in the air against y0 - g t^2/2.", run_free_fall},
        {"momentum", "Two drops meet", "Nothing from outside acts on them: momentum and angular momentum stay.",
         run_momentum},
        {"poiseuille", "Between two plates, driven by a force",
         "The steady profile against the parabola, at a Reynolds number of 0.0125 (Morris, Fox & Zhu 1997).",
         run_poiseuille},
        {"couette", "Between two plates, one of which moves", "The steady profile against the line, likewise.",
         run_couette},
        {"taylor_green", "Taylor-Green vortices",
         "How fast they die, against exp(-8 pi^2 nu t/L^2), at a Reynolds number of 100.", run_taylor_green},
        {"column", "A column of water", "Pressure and depth at rest against rho g (h - y).", run_column},
        {"still_water", "Still water", "A column left alone for ten seconds.", run_still_water},
        {"laplace", "Pressure in a drop",
         "A drop of water at rest without weight against Laplace (1806): 2 sigma/R.",
         run_laplace},
        {"drop", "A drop swings", "The period of a drop that was drawn out against Rayleigh (1879) and Lamb (1932).",
         run_drop},
        {"contact_angle", "A drop on a floor",
         "The cap that a block of water becomes, without weight, against the contact angle that the floor has (Young "
         "1805).",
         run_contact_angle},
        {"resolution", "One scene, three resolutions",
         "A dam break whose spacing alone is halved and halved again: front and energy stay the same, nothing leaks.",
         run_resolution},
        {"dam_break", "A collapsing column of water",
         "The front against the experiment of Martin & Moyce (Phil. Trans. R. Soc. A 244, 1952), columns of 2.25 and "
         "1.125 inches.",
         run_dam_break},
        {"buoyancy", "A ball under water", "The force of still water on a fixed ball against Archimedes.",
         run_buoyancy},
        {"water", "Water, half a meter high",
         "A dam break of five seconds with the viscosity that water has: energy, volume, spacing and steps.",
         run_water},
        {"honey", "A thread of honey",
         "It buckles and coils where it falls onto the floor, a liquid rope (Barnes & Woodcock 1958).", run_honey},
    }};
    return all;
}

} // namespace meltpoint::validation
