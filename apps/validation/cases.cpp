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
    static constexpr std::array<Case, 5> all{{
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
