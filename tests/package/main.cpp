// What an embedder writes: installed headers, the installed library, nothing of the source tree.
#include <core/log.h>
#include <core/random.h>
#include <scene/scene.h>
#include <shared/sph_params.h>

#include <fmt/format.h>

int main()
{
    const meltpoint::Scene scene;
    meltpoint::Random random(scene.seed);
    meltpoint::log_info(fmt::format("{}: seed {} draws {:.6f}, {} materials at most", scene.name, scene.seed,
                                    random.uniform(), meltpoint::shared::MAX_MATERIALS));
    return 0;
}
