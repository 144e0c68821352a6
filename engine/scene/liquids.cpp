#include "scene/liquids.h"

#include <algorithm>
#include <array>

namespace meltpoint {

// Water, glycerin and mercury are pure, and their values those of handbooks. Oil is olive oil. Honey and lava have a
// wide range: honey of about 17 % water is meant, and hot basalt without much gas in it, which is taken to melt at one
// temperature.
std::span<const Liquid> liquids()
{
    static constexpr std::array<Liquid, 6> all{{
        {"water",
         998.2f,
         1.002e-3f,
         0.0728f,
         {0.16f, 0.45f, 0.78f},
         ThermalProperties{0.0f, 334e3f, 4186.0f, 2100.0f, 0.6f, 2.2f}},
        {"oil", 912.0f, 0.084f, 0.032f, {0.70f, 0.58f, 0.08f}, {}},
        {"glycerin",
         1261.0f,
         1.41f,
         0.0634f,
         {0.80f, 0.84f, 0.86f},
         ThermalProperties{18.0f, 200e3f, 2430.0f, 1450.0f, 0.29f, 0.29f}},
        {"honey", 1400.0f, 10.0f, 0.05f, {0.72f, 0.36f, 0.04f}, {}},
        {"lava",
         2700.0f,
         100.0f,
         0.35f,
         {0.85f, 0.16f, 0.02f},
         ThermalProperties{1100.0f, 400e3f, 1450.0f, 1150.0f, 1.5f, 1.5f}},
        {"mercury",
         13546.0f,
         1.55e-3f,
         0.485f,
         {0.55f, 0.56f, 0.58f},
         ThermalProperties{-38.8f, 11.4e3f, 139.0f, 142.0f, 8.5f, 28.0f}},
    }};
    return all;
}

const Liquid* find_liquid(std::string_view name)
{
    const auto found = std::ranges::find(liquids(), name, &Liquid::name);
    return found == liquids().end() ? nullptr : &*found;
}

void set_liquid(FluidBody& body, const Liquid& liquid)
{
    body.liquid = liquid.name;
    body.rest_density = liquid.rest_density;
    body.viscosity = liquid.viscosity;
    body.color = liquid.color;
    body.thermal = liquid.thermal.value_or(body.thermal);
}

} // namespace meltpoint
