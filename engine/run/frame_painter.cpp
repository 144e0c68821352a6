#include "run/frame_painter.h"

#include "run/frame_view.h"
#include "run/solid_splats.h"
#include "run/surface_splats.h"

namespace meltpoint {

namespace {

render::ParticleView particle_view(const sim::Simulation& simulation)
{
    const ParticleBuffers& particles = simulation.particles();
    return {.position = particles.position,
            .velocity = particles.velocity,
            .density = particles.density,
            .pressure = particles.pressure,
            .attributes = particles.attributes,
            .count = particles.count,
            .freed_at = simulation.release_time(),
            .id = &particles.id,
            .time = static_cast<float>(simulation.time())};
}

render::SolidView solid_view(const sim::Simulation& simulation)
{
    render::SolidView view{.params = simulation.params_buffer(),
                           .cell_start = simulation.cell_start(),
                           .particles = simulation.particles(),
                           .enthalpy = simulation.enthalpy_buffer(),
                           .damage = simulation.damage_buffer(),
                           .freed_at = simulation.release_time(),
                           .time = simulation.time()};
    if (const sim::Wind* wind = simulation.wind()) {
        view.sand.emplace(render::SandView{.view = wind->from_above().params(),
                                           .ground = wind->ground(),
                                           .top_id = wind->top_id(),
                                           .damage = wind->damage()});
    }
    return view;
}

} // namespace

FramePainter::FramePainter(const gpu::Context& context, const Scene& scene, const shared::SphParams& params,
                           const sim::Simulation* simulation)
    : renderer_(context, scene.render.width, scene.render.height), commands_(context),
      settings_(frame_settings(scene, params)), legend_(frame_legend(scene, settings_))
{
    const std::uint64_t limit = render::DiscBuffers::max_discs(context);
    const SurfaceSplats surfaces = make_surface_splats(scene, limit);
    first_of_solids_ = static_cast<std::uint32_t>(surfaces.normal.size());
    if (simulation != nullptr && has_solid_splats(scene)) {
        const std::uint32_t pool = simulation->particles().count;
        const std::uint64_t taken = std::uint64_t{first_of_solids_} + pool;
        const SolidSurface surface = make_solid_surface(scene, simulation->download(), limit - std::min(limit, taken));
        solids_.emplace(context, solid_splat_params(scene), surface.splats, surface.cover,
                        simulation->wind() != nullptr ? simulation->wind()->from_above().size() : glm::uvec2(0));
    }
    const std::uint32_t room = solids_ ? solids_->room() : 0;
    if (first_of_solids_ + room > 0) {
        discs_.emplace(context, surfaces.position_radius, surfaces.normal, surfaces.color, room);
    }
}

Image FramePainter::paint(const sim::Simulation* simulation)
{
    render::Frame frame{.settings = settings_, .particles = std::nullopt, .discs = std::nullopt, .sand = std::nullopt};
    commands_.begin();
    if (simulation != nullptr) {
        frame.particles.emplace(particle_view(*simulation));
        if (solids_) {
            solids_->record(commands_, solid_view(*simulation), *discs_, first_of_solids_);
            frame.particles->size = &solids_->size();
            if (solids_->sand() != nullptr) {
                frame.sand.emplace(solids_->sand()->sheet(simulation->wind()->from_above().params()));
            }
        }
    }
    if (discs_) {
        frame.discs.emplace(discs_->view());
    }
    renderer_.draw(commands_, frame);
    commands_.submit();
    commands_.wait();
    Image image = renderer_.capture();
    if (legend_) {
        render::draw_legend(image, *legend_);
    }
    return image;
}

} // namespace meltpoint
