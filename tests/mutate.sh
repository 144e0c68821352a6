#!/usr/bin/env bash
# Changes one constant, sign or barrier at a time in a scratch copy of the source, and requires that a test goes red.
#
#   tests/mutate.sh [--list] [--check] [--only N]...
#
# --check only sees whether every mutation fits the source, in a second. The scratch copy and its build are build/mutations; the source itself is never touched. A mutation fails if no test
# notices it, if its original text is not in the file exactly once, or if the mutated source does not build.
set -euo pipefail
# shellcheck source=apps/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

descriptions=() files=() originals=() replacements=() programs=() filters=()

# mutation DESCRIPTION FILE ORIGINAL REPLACEMENT PROGRAM FILTER: the test program and the tests of it (a GoogleTest filter)
# that should notice. ORIGINAL is literal text, whole lines or parts of them.
mutation() {
    descriptions+=("$1") files+=("$2") originals+=("$3") replacements+=("$4") programs+=("$5") filters+=("$6")
}

# --- the mutations: prefix scan and counting sort -----------------------------------------------------------------------

mutation "scan: inclusive instead of exclusive" \
    shaders/primitives/prefix_scan_apply.comp \
    'starts[i] = running;
        running += counts[i];' \
    'running += counts[i];
        starts[i] = running;' \
    conformance_tests '*PrefixScanElementsTest.EqualsTheStandardLibrarysForEveryKindOfData*'
mutation "scan: rounds of block sums do not carry on" \
    shaders/primitives/prefix_scan_blocks.comp \
    'carry += total' \
    'carry = total' \
    conformance_tests '*PrefixScanElementsTest.EqualsTheStandardLibrarysForEverySize*'
mutation "scan: an invocation counts itself among those before it" \
    shaders/include/workgroup_scan.glsl \
    'i < gl_LocalInvocationIndex' \
    'i <= gl_LocalInvocationIndex' \
    conformance_tests '*PrefixScanElementsTest.EqualsTheStandardLibrarysForEveryKindOfData*'
mutation "scan: no barrier between writing and reading the workgroup's values" \
    shaders/include/workgroup_scan.glsl \
    'workgroup_values[gl_LocalInvocationIndex] = value;
    barrier();' \
    'workgroup_values[gl_LocalInvocationIndex] = value;' \
    conformance_tests '*PrefixScanElementsTest*'
mutation "sort: an id counts as smaller than itself" \
    shaders/primitives/counting_sort_order.comp \
    '< id ?' \
    '<= id ?' \
    conformance_tests '*CountingSortSizeTest.RandomKeys/*'
mutation "sort: elements of a key stay in the order of the atomics" \
    shaders/primitives/counting_sort_order.comp \
    'order[place] = element' \
    'order[slot] = element' \
    conformance_tests '*CountingSortSizeTest.RandomKeys/*'
mutation "sort: slots of a key begin one too high" \
    shaders/primitives/counting_sort_scatter.comp \
    '+ left - 1u' \
    '+ left' \
    conformance_tests '*CountingSortSizeTest.RandomKeys/*'
mutation "sort: crowded keys, the lowest bit of each digit is ignored" \
    shaders/primitives/counting_sort_crowded.comp \
    '(ids[element] >> shift) & (DIGITS - 1u)' \
    '(ids[element] >> shift) & (DIGITS - 2u)' \
    conformance_tests 'CountingSortTest.CrowdedKeysWithIdsOfAnyNumberOfDigits'
mutation "sort: crowded keys, digits are summed up before all are counted" \
    shaders/primitives/counting_sort_crowded.comp \
    'barrier();

    // Scan' \
    '// Scan' \
    conformance_tests 'CountingSortTest.*Crowded*'
mutation "scan: no barrier between reading and overwriting" \
    shaders/include/workgroup_scan.glsl \
    'barrier(); // before the next call' \
    '// before the next call' \
    conformance_tests '*PrefixScan*'
mutation "dispatch: the second axis of workgroups is ignored" \
    shaders/include/invocation.glsl \
    'gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x' \
    'gl_WorkGroupID.x' \
    conformance_tests 'PrefixScanTest.MoreWorkgroups*'
mutation "sort: a key is crowded one element too early" \
    shaders/primitives/counting_sort_order.comp \
    '> CROWDED_KEY' \
    '>= CROWDED_KEY' \
    conformance_tests 'CountingSortTest.*Crowded*'
mutation "sort: the highest digit is not sorted" \
    shaders/primitives/counting_sort_crowded.comp \
    'shift < 32u' \
    'shift < 28u' \
    conformance_tests 'CountingSortTest.*'
mutation "sort: no barrier between two digits" \
    shaders/primitives/counting_sort_crowded.comp \
    'memoryBarrierBuffer();
    barrier();' \
    '' \
    conformance_tests 'CountingSortTest.*'
mutation "sort: keys out of range are counted" \
    shaders/primitives/counting_sort_count.comp \
    ' && keys[i] < params.key_count' \
    '' \
    conformance_tests 'CountingSortTest.ElementsBeyond*'

# --- two dimensions, periodic axes, shifting ----------------------------------------------------------------------------

mutation "plane: the kernel's gradient is 20 % too steep" \
    engine/particles/sph_kernel.cpp \
    '.gradient = 140.0 / (PI * h3)' \
    '.gradient = 168.0 / (PI * h3)' \
    unit_tests '*PlaneKernel.*'
mutation "plane: pressure pushes 20 % too hard, which water at rest shows" \
    engine/particles/sph_kernel.cpp \
    'static_cast<float>(scale.gradient / moments.gradient)' \
    'static_cast<float>(1.2 * scale.gradient / moments.gradient)' \
    physics_short_tests 'ShortPlaneFlows.Column*'
mutation "plane: viscosity is 20 % too large, which vortices show" \
    engine/particles/sph_kernel.cpp \
    'static_cast<float>(scale.viscosity / moments.viscosity)' \
    'static_cast<float>(1.2 * scale.viscosity / moments.viscosity)' \
    physics_short_tests 'ShortPlaneFlows.TaylorGreen*'
mutation "plane: the Laplacian of space" \
    shaders/include/sph_kernel.glsl \
    '? 3.0 - 7.0 * q2 : 1.0 - 3.0 * q2' \
    '? 3.0 - 7.0 * q2 : 3.0 - 7.0 * q2' \
    conformance_tests 'Plane.PassesAreTheTwins'
mutation "plane: walls rub like those of space" \
    shaders/include/walls.glsl \
    'if (DIMENSIONS == 2u)' \
    'if (DIMENSIONS == 1u)' \
    conformance_tests 'Plane.WallViscosityAloneIsTheTwins'
mutation "plane: volumes are cubes" \
    engine/particles/sph_kernel.cpp \
    'std::pow(spacing, dimensions)' \
    'std::pow(spacing, 3)' \
    unit_tests '*PlaneKernel.SetKernelScales*'
mutation "plane: the lattice's moments are those of space" \
    engine/particles/sph_kernel.cpp \
    'const int reach_z = dimensions == 3 ? reach : 0;' \
    'const int reach_z = reach;' \
    conformance_tests 'Plane.LatticeIsAtRestDensity'
mutation "plane: a disk is filled 5 % too densely" \
    engine/geometry/plane_sampling.cpp \
    'static_cast<double>(sites.size()) * d * d / area - 1.0' \
    'static_cast<double>(sites.size()) * d * d / area - 1.02' \
    unit_tests 'PlaneSampling.DisksHoldTheirArea'
mutation "periodic: what leaves stays outside" \
    shaders/include/periodic.glsl \
    'return x + mix' \
    'return x; return x + mix' \
    conformance_tests 'Periodic.*'
mutation "periodic: images are reflected" \
    shaders/include/image_walk.glsl \
    'image_axes(image)), vec3(1.0), periodic_axes());' \
    'image_axes(image)), vec3(1.0), bvec3(false));' \
    conformance_tests 'Periodic.PassesAreTheTwins'
mutation "periodic: images lie where mirrors would have them" \
    shaders/include/image_walk.glsl \
    'mix(reflected, shifted, periodic_axes())' \
    'reflected' \
    conformance_tests 'Periodic.PassesAreTheTwins:Periodic.MomentumCrossesTheBorder'
mutation "periodic: neighbors are counted on this side alone" \
    shaders/sim/count_neighbors.comp \
    'images |= periodic.x' \
    'images |= 0u * periodic.x' \
    conformance_tests 'Periodic.PassesAreTheTwins'
mutation "periodic: colliders end at the border" \
    engine/run/scene_colliders.cpp \
    'x[axis] -= length * std::floor' \
    'x[axis] -= 0.0f * length * std::floor' \
    unit_tests 'PeriodicScene.*'
mutation "periodic: fluid starts in what comes in from the other side" \
    engine/run/taken_space.cpp \
    'if (period[axis] > 0.0f)' \
    'if (period[axis] < 0.0f)' \
    unit_tests 'PeriodicScene.*'
mutation "shifting: towards where there are more" \
    shaders/sim/shift.comp \
    'wrapped(own[k].xyz + shift)' \
    'wrapped(own[k].xyz - shift)' \
    conformance_tests 'Plane.PassesAreTheTwins'
mutation "shifting: without a cap" \
    shaders/sim/shift.comp \
    'distance > longest ? longest / distance : 1.0' \
    '1.0' \
    conformance_tests 'Plane.ShiftsAreCapped'
mutation "lid: it drags the wrong way" \
    shaders/include/image_walk.glsl \
    'half_spaces.y * params.lid_velocity' \
    '-half_spaces.y * params.lid_velocity' \
    conformance_tests 'Plane.WallViscosityAloneIsTheTwins'
mutation "lid: not where viscosity is solved for" \
    shaders/include/viscous_walk.glsl \
    'if (VISCOUS_BLOCKS) { // the matrix' \
    'if (false) { // the matrix' \
    physics_short_tests 'ShortPlaneFlows.PoiseuilleAndCouette*'

# --- barriers, that software devices do not need: synchronization validation must see them missing ----------------------

mutation "barrier: none between a write and a read" \
    engine/gpu/commands.cpp \
    'written && !visible' \
    'false && !visible' \
    conformance_tests 'BarrierTest.*'
mutation "barrier: none between a read and a write" \
    engine/gpu/commands.cpp \
    'written || state.read_stages != 0' \
    'written' \
    conformance_tests 'BarrierTest.*'
mutation "barrier: none between a write and a write" \
    engine/gpu/commands.cpp \
    'written || state.read_stages != 0' \
    'state.read_stages != 0' \
    conformance_tests 'BarrierTest.*'
mutation "barrier: waits, but does not make the writes available" \
    engine/gpu/commands.cpp \
    'pending_.srcAccessMask |= state.write_access;' \
    '' \
    conformance_tests 'BarrierTest.*'
mutation "barrier: what one stage may read, all are taken to" \
    engine/gpu/commands.cpp \
    '(state.visible_stages & stages) == stages && (state.visible_access & access) == access' \
    'state.visible_stages != 0' \
    conformance_tests 'BarrierTest.*'
mutation "barrier: the workgroup counts of an indirect dispatch are not waited for" \
    engine/gpu/commands.cpp \
    'use(arguments, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, false);' \
    '' \
    conformance_tests 'CountingSortTest.*'
mutation "barrier: a read of texels is not one of a shader's reads" \
    engine/gpu/commands.cpp \
    'return VK_ACCESS_2_SHADER_SAMPLED_READ_BIT' \
    'return VK_ACCESS_2_SHADER_STORAGE_READ_BIT' \
    conformance_tests 'Steps.OneStepIsTheTwins'
mutation "barrier: a pass declares that it only reads what it writes" \
    engine/sim/wcsph.cpp \
    'read_write(particles.velocity), read(particles.velocity)})' \
    'read(particles.velocity), read(particles.velocity)})' \
    conformance_tests 'Steps.OneStepIsTheTwins'

# --- kernels ------------------------------------------------------------------------------------------------------------

mutation "kernels in C++: poly6 to the second power" \
    engine/particles/sph_kernel.cpp \
    'return u * u * u;' \
    'return u * u;' \
    unit_tests '*SphKernel.EveryKernelHasUnitMoment*'
mutation "kernels in C++: factor of the Wendland gradient 2 % off" \
    engine/particles/sph_kernel.cpp \
    '.gradient = 210.0' \
    '.gradient = 206.0' \
    unit_tests '*SphKernel*'
mutation "kernels in C++: pressure pushes 20 % too hard, which water at rest shows" \
    engine/particles/sph_kernel.cpp \
    'static_cast<float>(scale.gradient / moments.gradient)' \
    'static_cast<float>(1.2 * scale.gradient / moments.gradient)' \
    physics_short_tests 'ShortColumn.*'
mutation "kernels in GLSL: constant of the Wendland kernel" \
    shaders/include/sph_kernel.glsl \
    '1.0 + 4.0 * q' \
    '1.0 + 3.9 * q' \
    conformance_tests '*PassConformance.AllPasses/RandomWendland'
mutation "kernels in GLSL: spiky gradient one power too low" \
    shaders/include/sph_kernel.glsl \
    'u * u * inverse_r' \
    'u * inverse_r' \
    conformance_tests '*PassConformance.AllPasses/RandomPaper'
mutation "kernels in GLSL: constant of the color Laplacian" \
    shaders/include/sph_kernel.glsl \
    '3.0 - 7.0 * q2' \
    '3.0 - 6.9 * q2' \
    conformance_tests '*PassConformance.EachForceAlone/RandomPaper'
mutation "kernels in GLSL: coincident particles push each other" \
    shaders/include/sph_kernel.glsl \
    'return r2 > size.coincident2' \
    'return r2 >= 0.0' \
    conformance_tests '*PassConformance.EachForceAlone/NearlyCoincident*'

# --- neighbors ----------------------------------------------------------------------------------------------------------

mutation "neighbors: rows end one cell too early" \
    shaders/include/neighbor_walk.glsl \
    'high.x + reach + 1)' \
    'high.x + reach)' \
    conformance_tests '*PassConformance.AllPasses/Random*'
mutation "neighbors: candidates in overlapping rows of a tile count twice" \
    shaders/include/neighbor_walk.glsl \
    'max(cell_start[cells.x], walk.visited_end)' \
    'cell_start[cells.x]' \
    conformance_tests '*PassConformance.AllPasses/Splash*'
mutation "neighbors: the last rows of cells are not searched" \
    shaders/include/neighbor_walk.glsl \
    'lessThanEqual(walk.offset, walk.high)' \
    'lessThan(walk.offset, walk.high)' \
    conformance_tests '*PassConformance.AllPasses/Random*'
mutation "neighbors: particles of a wide tile walk together with all" \
    shaders/include/image_walk.glsl \
    'tile.walks == TOGETHER || tile.walks == int(k);' \
    'true;' \
    conformance_tests '*PassConformance.EveryTileSize/SprayAboveAFloor*'
mutation "neighbors: of a wide tile the last particle does not walk" \
    shaders/include/image_walk.glsl \
    'tile.first + uint(tile.walks) < tile.last' \
    'tile.first + uint(tile.walks) + 1u < tile.last' \
    conformance_tests '*PassConformance.EveryTileSize/SprayAboveAFloor*'
mutation "neighbors: of a box of two rows the last row's neighbors are not visited" \
    shaders/include/neighbor_walk.glsl \
    'min(extent.yz + 1,' \
    'min(ivec2(1),' \
    conformance_tests '*PassConformance.EveryTileSize/*'
mutation "neighbors: velocities are not moved into the sorted order" \
    shaders/sim/reorder.comp \
    'load_candidate(velocity, source)' \
    'load_candidate(velocity, slot)' \
    conformance_tests '*PassConformance.AllPasses/Random*'

# --- density, state equation, forces, walls, integrator -----------------------------------------------------------------

mutation "density: in terms of the rest density's mass instead of the particle's" \
    shaders/sim/density.comp \
    'load_candidate(velocity, i).w' \
    'load_candidate(velocity, tile.first).w' \
    conformance_tests 'MaterialConformance.TwoRestDensities'
mutation "state equation: Tait without its exponent in the stiffness" \
    shaders/sim/density.comp \
    'c2 * rho0 / params.gamma' \
    'c2 * rho0' \
    conformance_tests '*PassConformance.AllPasses/Random*'
mutation "state equation: never clamped" \
    shaders/sim/density.comp \
    'params.clamp_pressure != 0u ? max(p, 0.0) : p' \
    'p' \
    conformance_tests '*PassConformance.AllPasses/Splash*'
mutation "forces: pressure attracts" \
    shaders/sim/forces.comp \
    '+= pressure * offset' \
    '+= -pressure * offset' \
    conformance_tests '*PassConformance.EachForceAlone/Two*'
mutation "forces: pressure not symmetric" \
    shaders/sim/forces.comp \
    'pressure_term[k] * xj.w + pressure_term_j' \
    '(1.0 + xj.w) * pressure_term_j' \
    conformance_tests 'Steps.MomentumIsConserved'
mutation "forces: viscosity speeds up" \
    shaders/sim/forces.comp \
    'vj - v[k]' \
    'v[k] - vj' \
    conformance_tests '*PassConformance.EachForceAlone/Two*'
mutation "forces: surface tension points outward" \
    shaders/sim/forces.comp \
    'return -params.surface_tension' \
    'return params.surface_tension' \
    conformance_tests '*PassConformance.EachForceAlone/Random*'
mutation "colliders: fluid does not weigh them" \
    shaders/sim/density.comp \
    'sum[k] += xj.w *' \
    'sum[k] +=' \
    conformance_tests '*PassConformance.AllPasses/OnACollider*'
mutation "colliders: they push with the fluid's weight" \
    shaders/sim/forces.comp \
    'pressure_term[k] * xj.w +' \
    'pressure_term[k] +' \
    conformance_tests '*PassConformance.AllPasses/OnACollider*'
mutation "colliders: their friction is the fluid's viscosity" \
    shaders/sim/density.comp \
    'boundary ? params.friction[material] : params.viscosity' \
    'params.viscosity' \
    conformance_tests '*PassConformance.EachForceAlone/OnACollider*'
mutation "colliders: fluid counts in the space that they take" \
    shaders/sim/boundary_weight.comp \
    'particle_state(attributes[range.x]) == STATE_COLLIDER ? 1.0 : 0.0' \
    '1.0' \
    conformance_tests '*PassConformance.AllPasses/OnACollider*'
mutation "colliders: they fall" \
    shaders/sim/kick_drift.comp \
    'i >= params.moving_count || is_boundary(attributes[i])' \
    'i >= params.moving_count' \
    conformance_tests 'Steps.BoundaryParticlesAreNeverAtFault'
mutation "colliders: a tile with one of them has no density" \
    shaders/include/boundary.glsl \
    'count_boundary(tile) == tile.last - tile.first + 1u' \
    'count_boundary(tile) > 0u' \
    conformance_tests '*PassConformance.AllPasses/OnACollider*'
mutation "colliders: a layer has no weight, and leaks" \
    shaders/sim/boundary_weight.comp \
    '? 1.0 / (params.lattice_volume' \
    '? 0.1 / (params.lattice_volume' \
    physics_short_tests 'Collider.APlateOneParticleThickDoesNotLeak'
mutation "scenes: fluid starts where other fluid is" \
    engine/run/taken_space.cpp \
    'inside || is_near_a_point(x)' \
    'inside' \
    unit_tests 'OverlappingFluids.*'
mutation "scenes: colliders are hollow" \
    engine/run/scene_colliders.cpp \
    'if (!collider.solid)' \
    'if (collider.solid)' \
    unit_tests 'SceneColliders.*'
mutation "scenes: normals of a scan do not turn along with it" \
    engine/run/placed_mesh.cpp \
    'glm::mat3(matrix) * normal' \
    'normal' \
    unit_tests 'SceneColliders.AScanIsSampledAnewAndSolid'
mutation "scenes: a scan of a pipe counts as closed" \
    engine/geometry/cloud_solid.cpp \
    'tolerance * std::abs(volume())' \
    '2.0 * std::abs(volume())' \
    unit_tests 'SceneColliders.AClosedScanThatIsInsideOutIsWarnedOf'
mutation "scenes: scans keep their size" \
    engine/run/placed_mesh.cpp \
    'x = glm::vec3(matrix * glm::vec4(x, 1.0f));' \
    'x = x - box.center() + shape.position;' \
    unit_tests 'SceneParticles.AScan*'
mutation "scenes: a scan is measured by its box" \
    engine/run/mesh_scene.cpp \
    '.volume = CloudSolid(make_cloud_surface(cloud, name)).volume()' \
    '.volume = double(box.size().x * box.size().y * box.size().z)' \
    unit_tests 'MeshScene.AScanIsDroppedAsItsMeshIs'
mutation "scenes: blue noise is relaxed as if there were no walls" \
    engine/run/scene_particles.cpp \
    'request.relaxation.mirrors = Aabb{scene.domain.min, scene.domain.max};' \
    '' \
    unit_tests 'SceneParticles.BlueNoiseBetweenWallsStartsAtRest'
mutation "forces: gravity left out" \
    shaders/sim/forces.comp \
    'a = params.gravity + force[k]' \
    'a = force[k]' \
    conformance_tests 'Steps.FreeFallIsExact'
mutation "walls: images do not move as mirrors do" \
    shaders/sim/forces.comp \
    'v[k] *= flips' \
    'v[k] *= 1.0' \
    conformance_tests 'Steps.OneStepIsTheTwins'
mutation "walls: the force of an image is not reflected back" \
    shaders/sim/forces.comp \
    'force[k] += signs * image_force[k]' \
    'force[k] += image_force[k]' \
    conformance_tests '*PassConformance.AllPasses/LatticeOnTheFloor*'
mutation "walls: half as far to the image" \
    shaders/include/image_walk.glsl \
    '2.0 * borders.plane - x' \
    '1.5 * borders.plane - 0.5 * x' \
    conformance_tests '*PassConformance.AllPasses/LatticeOnTheFloor*'
mutation "walls: the contact spring's damping pushes" \
    shaders/sim/forces.comp \
    'spring - params.contact_damping' \
    'spring + params.contact_damping' \
    conformance_tests '*PassConformance.AllPasses/InTheCorners*'
mutation "walls: no friction" \
    shaders/sim/forces.comp \
    '0.0 : params.wall_viscosity / rho' \
    '0.0 : 0.0 * params.wall_viscosity / rho' \
    conformance_tests '*PassConformance.EachForceAlone/InTheCorners*'
mutation "integrator: a whole kick before the drift" \
    shaders/sim/kick_drift.comp \
    '0.5 * params.dt' \
    'params.dt' \
    conformance_tests 'Steps.FreeFallIsExact'
mutation "integrator: no second kick" \
    engine/sim/wcsph.cpp \
    '    record_kick(commands, fluid.kernels, fluid.params, fluid.particles);
    if (fluid.viscosity' \
    '    if (fluid.viscosity' \
    conformance_tests 'Steps.FreeFallIsExact'
mutation "faults: the largest id is reported" \
    shaders/include/watch.glsl \
    'atomicMin(status.offender' \
    'atomicMax(status.offender' \
    conformance_tests 'Steps.ANotANumberIsReportedWithTheSmallestId'

# --- forces on colliders -------------------------------------------------------------------------------------------------
mutation "forces on colliders: the weight of boundary particles is left out" \
    shaders/sim/boundary_force.comp \
    'params.dt * own[k].w * push_force[k]' \
    'params.dt * push_force[k]' \
    conformance_tests '*PassConformance.AllPasses/OnACollider*'
mutation "forces on colliders: friction of a fifth more" \
    shaders/sim/boundary_force.comp \
    'params.dt * friction[k]' \
    '1.2 * params.dt * friction[k]' \
    conformance_tests '*PassConformance.AllPasses/OnACollider*'
mutation "forces on colliders: the divergence solve is forgotten" \
    shaders/sim/boundary_impulse.comp \
    'of_solves[SOLVE_DIVERGENCE] + of_solves[SOLVE_DENSITY] / params.dt' \
    'of_solves[SOLVE_DENSITY] / params.dt' \
    conformance_tests '*PassConformance.SolvedPressure/OnACollider*'
mutation "forces on colliders: of the iterate that has not acted" \
    shaders/sim/dfsph_residual.comp \
    'warm_start[i][push.solve] = acted * unit' \
    'warm_start[i][push.solve] = max(acted + excess * params.solve_relaxation * params.gradient_scale * its_interaction.w / (params.dt * rest_volume), 0.0) * unit' \
    physics_short_tests 'ColliderForces.GiveThePlateWhatTheyTakeFromTheFluid'
mutation "forces on colliders: images push like the fluid" \
    shaders/sim/boundary_impulse.comp \
    'image_signs(image) * image_impulse[k]' \
    'image_impulse[k]' \
    conformance_tests '*PassConformance.SolvedPressure/OnACollider*'
mutation "colliders: boundary particles on the surface of solids" \
    engine/run/scene_particles.cpp \
    '(distance - 0.5 - settled) * spacing, limit' \
    '1e-3 * spacing, limit' \
    physics_short_tests 'ColliderForces.ABallUnderWaterIsLifted'
mutation "colliders: points sink through what is thin" \
    engine/geometry/sunk_samples.cpp \
    'return depth * inside / probes' \
    'return depth' \
    unit_tests 'SunkSamples.*'

# --- several fluids ------------------------------------------------------------------------------------------------------
mutation "several fluids: one let into another of the same lattice has a gap around it" \
    engine/run/taken_space.cpp \
    'return in_step ? overlapping' \
    'return !in_step ? overlapping' \
    unit_tests 'OverlappingFluids.*'
mutation "several fluids: the other one's viscosity alone" \
    shaders/include/mixed_viscosity.glsl \
    'return own > 0.0 ? 2.0 * own / (own + other) : 0.0' \
    'return 1.0' \
    conformance_tests '*PassConformance.SeveralFluids/Splash*'
mutation "several fluids: density is a sum of the neighbors' masses" \
    shaders/sim/density.comp \
    'sum[k] += xj.w * density_shape(r2, size)' \
    'sum[k] += xj.w * load_candidate(velocity, j).w / max(load_candidate(velocity, min(tile.first + k, tile.last)).w, 1e-30) * density_shape(r2, size)' \
    physics_short_tests 'Multiphase.OilRestsOnWater'
mutation "several fluids: every fluid has the scene's viscosity" \
    engine/scene/materials.h \
    'body.viscosity.value_or(scene.physics.viscosity)' \
    'scene.physics.viscosity' \
    unit_tests 'FluidSettings.FluidsHaveTheirOwnViscosityOrTheScenes'

# --- solved pressure and time steps ---------------------------------------------------------------------------------------
mutation "solve: the diagonal forgets the neighbors" \
    shaders/sim/density.comp \
    '/ mass + gradient_squares[k]' \
    '/ mass + 0.5 * gradient_squares[k]' \
    conformance_tests '*PassConformance.SolvedPressure/Splash*'
mutation "solve: corrections pull one way" \
    shaders/sim/dfsph_correct.comp \
    'pressure_term[k] * xj.w + pressure_term_j' \
    '2.0 * pressure_term_j' \
    conformance_tests '*PassConformance.SolvedPressure/Splash*'
mutation "solve: images move like the particles" \
    shaders/sim/dfsph_residual.comp \
    'v[k] *= flips' \
    'v[k] *= abs(flips)' \
    conformance_tests '*PassConformance.SolvedPressure/LatticeOnTheFloor*'
mutation "solve: pressures pull" \
    shaders/sim/dfsph_residual.comp \
    'float next = max(acted + response * excess, 0.0)' \
    'float next = acted + response * excess' \
    conformance_tests '*PassConformance.SolvedPressure/Splash*'
mutation "solve: no warm start" \
    shaders/sim/dfsph_residual.comp \
    '? WARM_START * warm_start' \
    '? 0.0 * warm_start' \
    conformance_tests '*PassConformance.SolvedPressure/Splash*'
mutation "solve: momentum of half the step" \
    shaders/sim/dfsph_residual.comp \
    'next + momentum * (next - before)' \
    'next + 0.5 * momentum * (next - before)' \
    conformance_tests '*PassConformance.SolvedPressure/Splash*'
mutation "solve: no momentum" \
    shaders/shared/solve.h \
    'return float(n) / float(n + 3u)' \
    'return 0.0f * float(n)' \
    unit_tests 'ReferenceDfsph.IterationsConvergeBelowTheEigenvalue'
mutation "solve: it never ends" \
    shaders/sim/dfsph_residual.comp \
    'ends = last || (met && push.iteration > 0u)' \
    'ends = last' \
    conformance_tests '*PassConformance.SolvedPressure/Lattice*'
mutation "pbf: corrections pull one way" \
    shaders/sim/pbf_correct.comp \
    'terms[k] * xj.w + terms_j' \
    '2.0 * terms_j' \
    conformance_tests '*PassConformance.SolvedPositions/Splash*'
mutation "pbf: masses do not count" \
    shaders/sim/pbf_correct.comp \
    'change[k] / velocity[i].w' \
    'change[k] / velocity[tile.first].w' \
    conformance_tests 'Steps.MomentumIsConserved'
mutation "pbf: pairs that were no neighbors meet" \
    shaders/include/moved_walk.glsl \
    'dot(offset, offset) < params.support_radius * params.support_radius' \
    'dot(offset, offset) < 4.0 * params.support_radius * params.support_radius' \
    conformance_tests 'Steps.RerunsAndTileSizes*'
mutation "pbf: no softness" \
    shaders/sim/pbf_residual.comp \
    '+ params.constraint_softness) / mass' \
    ') / mass' \
    conformance_tests '*PassConformance.SolvedPositions/Splash*'
mutation "pbf: artificial pressure to the second power" \
    shaders/sim/pbf_correct.comp \
    'both.y * near * near' \
    'both.y * near' \
    conformance_tests '*PassConformance.SolvedPositions/Splash*'
mutation "pbf: pressures pull" \
    shaders/sim/pbf_residual.comp \
    '? max(excess, 0.0) : excess' \
    '? excess : excess' \
    conformance_tests '*PassConformance.SolvedPositions/Splash*'
mutation "pbf: iterations end early" \
    shaders/sim/pbf_residual.comp \
    'push.iteration >= params.least_iterations' \
    'push.iteration >= 1u' \
    physics_short_tests 'PositionBased.SetIterations*'
mutation "pbf: no speed cap" \
    shaders/sim/pbf_finish.comp \
    'if (speed > limit)' \
    'if (speed > 2.0 * limit)' \
    physics_short_tests 'PositionBased.SetIterations*'
mutation "pbf: velocities do not see the moves" \
    shaders/sim/pbf_finish.comp \
    'velocity[i].xyz + its_move / params.dt' \
    'velocity[i].xyz + 0.8 * its_move / params.dt' \
    conformance_tests '*PassConformance.SolvedPositions/Splash*'
mutation "pbf: walls let moves through" \
    shaders/sim/pbf_move.comp \
    'its_move = with_contact(its_position.xyz, its_move, 1.0)' \
    'its_move = its_move' \
    conformance_tests '*PassConformance.SolvedPositions/InTheCorners*'
mutation "xsph: images move like the particles" \
    shaders/sim/xsph.comp \
    'v[k] *= flips' \
    'v[k] *= abs(flips)' \
    conformance_tests '*PassConformance.XsphAndConfinement/InTheCorners*'
mutation "xsph: the density of one" \
    shaders/sim/xsph.comp \
    '(density[k] + density_j)' \
    '(2.0 * density[k])' \
    conformance_tests '*PassConformance.XsphAndConfinement/Splash*'
mutation "vorticity: mirrors do not turn it" \
    shaders/sim/vorticity.comp \
    'float turn = signs.x * signs.y * signs.z' \
    'float turn = 1.0' \
    conformance_tests '*PassConformance.XsphAndConfinement/Splash*'
mutation "confinement: it slows vortices down" \
    shaders/sim/confinement.comp \
    'cross(n, vorticity[i].xyz)' \
    'cross(vorticity[i].xyz, n)' \
    physics_short_tests 'Vortex.Confinement*'
mutation "tension: normals are seen in mirrors" \
    shaders/include/capillarity.glsl \
    '? 1.0 : 0.0; }' \
    '? 1.0 : 1.0; }' \
    conformance_tests '*PassConformance.SurfaceTension/LatticeOnTheFloor*'
mutation "tension: curvature at the particle, not at the surface" \
    shaders/sim/capillarity.comp \
    'float surface = below / (1.0 + max(turn, -0.5))' \
    'float surface = below' \
    conformance_tests '*PassConformance.SurfaceTension/Splash*'
mutation "tension: a quarter too weak" \
    engine/scene/materials.h \
    'liquid->surface_tension : 0.0f' \
    '0.75f * liquid->surface_tension : 0.0f' \
    unit_tests 'FluidSettings.NamedLiquids*'
mutation "tension: half of it" \
    shaders/sim/capillarity.comp \
    'vec3 a = 2.0 * sigma[k]' \
    'vec3 a = sigma[k]' \
    physics_short_tests 'ShortDrop.HasLaplacesPressure'
mutation "tension: crowded pairs are not parted" \
    shaders/sim/capillarity.comp \
    'max(1.0 - r / crowding_distance, 0.0) - cling' \
    '-cling' \
    conformance_tests '*PassConformance.SurfaceTension/Random*'
mutation "tension: contact angles inside out" \
    shaders/sim/surface_normal.comp \
    'sine * inward - solid.cosine * solid.normal' \
    'sine * inward + solid.cosine * solid.normal' \
    physics_short_tests 'ShortDrop.MeetsTheFloor*'
mutation "tension: wrong layers" \
    engine/particles/sph_kernel.cpp \
    '.second = steepness[1]' \
    '.second = steepness[2]' \
    unit_tests 'ReferenceCapillarity.ConstantsOf*'
mutation "solve: numbers too small for a float" \
    shaders/sim/density.comp \
    '1.0 / (params.gradient_scale * response)' \
    '1.0 / (params.gradient_scale * params.gradient_scale * response) * params.gradient_scale' \
    physics_short_tests 'ShortDrop.HasLaplacesPressureInDfsph'
mutation "solve: too strong a relaxation" \
    engine/particles/sph_kernel.cpp \
    'std::min(0.5, relaxation / eigenvalue' \
    'std::min(0.5, 3.0 * relaxation / eigenvalue' \
    physics_short_tests 'Incompressible.DamBreak*'
mutation "solve: warm starts stay behind in the sort" \
    shaders/sim/gather.comp \
    'source[order[slot] * push.words + k]' \
    'source[slot * push.words + k]' \
    conformance_tests 'Steps.StepsWithSolvedPressureAreTheTwins'
mutation "drift: no contact with walls" \
    shaders/sim/drift.comp \
    'vec3 v = with_contact(position[i].xyz, velocity[i].xyz, params.dt)' \
    'vec3 v = velocity[i].xyz' \
    conformance_tests 'Steps.WallsHoldALoneParticle'
mutation "still particles: none of them are met" \
    shaders/include/neighbor_walk.glsl \
    'STILL && walk.table == 0' \
    'false && walk.table == 0' \
    conformance_tests '*PassConformance.StillParticles/OnACollider*'
mutation "still particles: the spare buffers know nothing of them" \
    engine/sim/neighbor_grid.cpp \
    'commands.copy(*from, *to, from->size() - first, first, first);' \
    '' \
    conformance_tests 'Steps.StepsBesideStillParticlesAreTheTwins'
mutation "partition: accelerations stay behind" \
    engine/sim/neighbor_grid.cpp \
    'commands.copy(particles.interaction, particles.acceleration, moving * sizeof(glm::vec4));' \
    '' \
    conformance_tests 'ErosionTest.WhoIsFarFromTheFreedDoesNotNotice'
mutation "solids: a front frees what it has not reached" \
    shaders/sim/front.comp \
    'time < release_time[id[i]]' \
    '1.1 * time < release_time[id[i]]' \
    conformance_tests 'ErosionTest.*'
mutation "solids: what is freed weighs nothing" \
    shaders/sim/front.comp \
    'crumbles ? velocity[i].w : abs(velocity[i].w)' \
    'velocity[i].w' \
    conformance_tests 'ErosionTest.*'
mutation "solids: viscous changes stay behind when the pool is parted" \
    engine/sim/implicit_viscosity.cpp \
    'record_gather(commands, fluid.kernels, fluid.grid.order, change_, product_, {fluid.particles.count, 4});
    std::swap(change_, product_);' \
    '' \
    conformance_tests 'ErosionTest.WhoIsFarFromTheFreedDoesNotNotice'
mutation "solids: warm starts stay behind when the pool is parted" \
    engine/sim/dfsph.cpp \
    'record_reorder(commands, fluid, fluid.particles.count);' \
    '' \
    conformance_tests 'ErosionTest.WhoIsFarFromTheFreedDoesNotNotice'
mutation "dust: fluid meets it" \
    shaders/sim/front.comp \
    'position[i].w = crumbles ? 0.0 : position[i].w;' \
    '' \
    conformance_tests 'DustTest.DriftsAsItsTwin'
mutation "dust: the eddies stay where they are" \
    shaders/sim/dust.comp \
    'vec3 carried = x - dust.wind * time;' \
    'vec3 carried = x;' \
    conformance_tests 'DustTest.DriftsAsItsTwin'
mutation "dust: it never dies" \
    shaders/sim/dust.comp \
    'if (!(inside && left > 0.0)) {' \
    'if (!inside) {' \
    conformance_tests 'DustTest.EndsWithItsLifeOrTheDomain'
mutation "dust: the dead go on moving with the others" \
    shaders/sim/partition_key.comp \
    'is_gone(attributes[i]) ? 2u * cells' \
    'false ? 2u * cells' \
    conformance_tests '*PassConformance.StillParticles/OnACollider*'
mutation "dust: eddies may go along their own waves" \
    engine/run/dust_params.cpp \
    'wave.amplitude = amplitude * glm::normalize(across);' \
    'wave.amplitude = amplitude * glm::normalize(across + 0.2 * along);' \
    unit_tests 'DustParams.*'
mutation "dust: its spheres never shrink" \
    shaders/render/sphere_look.comp \
    'params.splat_radius * pow(density[i], 1.0 / 3.0)' \
    'params.splat_radius' \
    image_tests 'FrameTest.DustShrinksWithWhatIsLeftOfIt'
mutation "solids: fronts go on where they should come from" \
    engine/run/dissolve_front.cpp \
    'way[i] - entry + ' \
    'way[i] + ' \
    unit_tests 'DissolveFront.*'
mutation "picture: what melts has its fluid's color at once" \
    shaders/render/sphere_look.comp \
    'smoothstep(0.0, params.blend_time, params.time - freed_at[id[i]])' \
    '1.0' \
    image_tests 'FrameTest.WhatWasSolidTakesOnTheColorOfItsFluid'
mutation "freezing: a front that has passed frees ice again" \
    shaders/sim/freeze.comp \
    'release_time[id[i]] = uintBitsToFloat(0x7f800000u);' \
    '' \
    conformance_tests 'MeltingTest.WaterFreezesToAColdPlateAndNowhereElse'
mutation "exposure: the sides of thin things cancel out" \
    shaders/sim/exposure.comp \
    'max(push.area_scale * size, push.faces * thinness)' \
    'push.area_scale * size' \
    conformance_tests 'ExposureTest.WhatIsThinIsExposedOnAllItsSides'
mutation "exposure: walls are open" \
    shaders/sim/exposure.comp \
    'mix(vec3(1.0), vec3(-1.0), reflects)' \
    'vec3(1.0)' \
    conformance_tests 'ExposureTest.WhatStandsAtAWallIsNotExposedThere'
mutation "exposure: as much as one side of the surface has" \
    engine/particles/sph_kernel.cpp \
    'return 1.0 / exposed;' \
    'return 0.5 / exposed;' \
    conformance_tests 'ExposureTest.LayersOfALatticeAddUpToItsFace'
mutation "visibility: the map of the farthest" \
    shaders/sim/visibility_depth.comp \
    'atomicMin(' \
    'atomicMax(' \
    conformance_tests 'VisibilityTest.*'
mutation "melting: the sun shines through solids" \
    shaders/sim/warm.comp \
    'facing * visibility[slot]' \
    'facing' \
    conformance_tests 'MeltingTest.LooksAreTheTwins'
mutation "melting: water does not cover ice" \
    shaders/sim/warm.comp \
    'float bare = 1.0 - min(filling / COVER_FILLING, 1.0);' \
    'float bare = 1.0;' \
    conformance_tests 'MeltingTest.LooksAreTheTwins'
mutation "melting: a tenth of the latent heat is spared" \
    shaders/sim/melt.comp \
    '>= heat.of[material].latent_heat' \
    '>= 0.9 * heat.of[material].latent_heat' \
    conformance_tests 'MeltingTest.TheSunMeltsWhatItsPowerAmountsTo'
mutation "melting: looks are rare" \
    engine/sim/melting.cpp \
    '0.05 * shortest_melting' \
    '0.5 * shortest_melting' \
    conformance_tests 'MeltingTest.TheSunMeltsWhatItsPowerAmountsTo'
mutation "freezing: in mid-water" \
    shaders/sim/freeze.comp \
    'if (at_still || at_loose) {' \
    'if (true) {' \
    conformance_tests 'MeltingTest.LooksAreTheTwins'
mutation "freezing: what is frozen counts as moving" \
    engine/sim/simulation.cpp \
    '- found.died - found.frozen' \
    '- found.died' \
    conformance_tests 'MeltingTest.WaterFreezesToAColdPlateAndNowhereElse'
mutation "heat: the time since the last look is twice as long" \
    engine/sim/simulation.cpp \
    'const double seconds = time - looked_at_;' \
    'const double seconds = 2.0 * (time - looked_at_);' \
    conformance_tests 'MeltingTest.LooksAreTheTwins'
# --- the mutations: fragments ------------------------------------------------------------------------------------------

mutation "fragments: who is a little farther is connected, too" \
    shaders/sim/piece_hook.comp \
    'float reach = BOND_DISTANCE * params.spacing' \
    'float reach = 1.1 * BOND_DISTANCE * params.spacing' \
    conformance_tests 'FragmentsTest.PiecesAreTheTwins'
mutation "fragments: loose pieces that touch are one" \
    shaders/sim/piece_hook.comp \
    'its_body == body || its_body == NO_BODY || body == NO_BODY' \
    'true' \
    conformance_tests 'FragmentsTest.TouchingBodiesStayApart'
mutation "fragments: pieces are looked for once" \
    engine/sim/fragments.cpp \
    'while (is_first || readback_.mapped<shared::PieceChanges>()[0].unsettled > 0)' \
    'while (is_first)' \
    conformance_tests 'FragmentsTest.LongChainsAreOnePiece'
mutation "fragments: borders of periodic axes cut pieces" \
    shaders/include/near_walk.glsl \
    'uvec3(near) * uvec3(periodic_axes())' \
    'uvec3(0u)' \
    conformance_tests 'FragmentsTest.PiecesAreTheTwins'
mutation "fragments: colliders hold nothing" \
    shaders/sim/piece_census.comp \
    'anchor == ANCHOR_ALL || touches_wall(x) || touches_collider(x)' \
    'anchor == ANCHOR_ALL || touches_wall(x)' \
    conformance_tests 'FragmentsTest.PiecesAreTheTwins'
mutation "fragments: small pieces fall, too" \
    shaders/sim/piece_loosen.comp \
    'piece.size < LEAST_PIECE' \
    'piece.size < LEAST_PIECE - 1u' \
    conformance_tests 'FragmentsTest.PiecesAreTheTwins'
mutation "fragments: a body has the velocity of its first particle" \
    engine/sim/fragments.cpp \
    '.velocity = momentum / mass' \
    '.velocity = members.front().v' \
    conformance_tests 'FragmentsTest.WhatSplitsKeepsItsMomentumAndAngularMomentum'
mutation "fragments: a body does not turn as it did" \
    engine/sim/fragments.cpp \
    'angular_momentum += each.mass * glm::cross(arm, each.v)' \
    'angular_momentum += 0.9 * each.mass * glm::cross(arm, each.v)' \
    conformance_tests 'FragmentsTest.WhatSplitsKeepsItsMomentumAndAngularMomentum'
mutation "fragments: the angular velocity of the step's begin turns a body" \
    shaders/sim/rigid_step.comp \
    'turned(before, angular_velocity, 0.5 * params.dt)' \
    'before' \
    conformance_tests 'FragmentsTest.ASpinningBodyKeepsItsEnergy:FragmentsTest.StepsAreTheTwins'
mutation "fragments: contacts have no friction" \
    shaders/sim/rigid_step.comp \
    'float most = sliding_friction * normal_now' \
    'float most = 0.0' \
    conformance_tests 'FragmentsTest.FrictionHoldsWhatIsNotTooSteep'
mutation "fragments: each contact has the whole body" \
    shaders/sim/rigid_step.comp \
    'lacking / (all_contacts * mobility' \
    'lacking / (mobility' \
    conformance_tests 'FragmentsTest.StepsAreTheTwins'
mutation "fragments: what overlaps does not part" \
    shaders/sim/rigid_step.comp \
    'return gap > 0.0 ? -gap / params.dt : parting' \
    'return gap > 0.0 ? -gap / params.dt : 0.0' \
    conformance_tests 'FragmentsTest.StepsAreTheTwins'
mutation "fragments: a light body stops a heavy one" \
    shaders/sim/rigid_touch.comp \
    'mix(mass / (own_mass + mass), 1.0, fixed_share)' \
    '1.0' \
    conformance_tests 'FragmentsTest.StepsAreTheTwins'
mutation "fragments: the force of fluid is felt again in every step" \
    shaders/sim/rigid_step.comp \
    'reactions[its_id] = Reaction(owed - impulse, vec3(0.0))' \
    'reactions[its_id].friction = vec3(0.0)' \
    physics_short_tests 'FloatingTest*'
mutation "fragments: bodies get all at once what fluid owes them" \
    shaders/sim/rigid_step.comp \
    'vec3 impulse = share * owed' \
    'vec3 impulse = owed' \
    physics_short_tests 'FloatingTest.ALightCubeRisesAndFloats'
mutation "fragments: what fluid owes a body is forgotten" \
    shaders/sim/rigid_step.comp \
    'Reaction(owed - impulse, vec3(0.0))' \
    'Reaction(vec3(0.0), vec3(0.0))' \
    physics_short_tests 'FloatingTest.ASmallCubeDisplacesItsWeight'
mutation "fragments: the longest step knows nothing of bodies" \
    shaders/sim/fastest.comp \
    '|| is_loose(attributes[i])' \
    '|| false' \
    conformance_tests 'FragmentsTest.BodiesAreSeenByTheTimeStep'
mutation "fragments: a floating piece does not melt" \
    shaders/sim/melt.comp \
    'particle_state(attributes[i]) != STATE_SOLID)' \
    'particle_state(attributes[i]) != STATE_SOLID || is_loose(attributes[i]))' \
    conformance_tests 'FragmentsTest.LooksAtLooseSolidsAreTheTwins'
mutation "fragments: a piece does not shade itself" \
    shaders/sim/exposure.comp \
    'moving && load_candidate(velocity, j).w > 0.0' \
    'moving' \
    conformance_tests 'FragmentsTest.LooksAtLooseSolidsAreTheTwins'
mutation "fragments: nothing freezes to a floating piece" \
    shaders/sim/freeze.comp \
    'body_of[id[range.x]] != NO_BODY' \
    'false' \
    conformance_tests 'FragmentsTest.LooksAtLooseSolidsAreTheTwins'
mutation "fragments: a piece covers itself like water" \
    shaders/sim/warm.comp \
    'velocity[range.x].w > 0.0 ? xj.w : 0.0' \
    'xj.w' \
    conformance_tests 'FragmentsTest.LooksAtLooseSolidsAreTheTwins'

mutation "heat: an emitter's water at its melting point is ice" \
    engine/run/heat_settings.cpp \
    'state == shared::STATE_FLUID || state == shared::STATE_DEAD' \
    'state == shared::STATE_FLUID' \
    unit_tests 'HeatSettings.*'
mutation "heat: who is born again has the heat of a former life" \
    shaders/sim/warm.comp \
    'enthalpy[slot] = vec2(melting.birth_enthalpy[material], 0.0);' \
    '' \
    conformance_tests 'MeltingTest.LooksAreTheTwins'
mutation "emitters: births are where their nozzle is, whenever in a step they came" \
    shaders/sim/birth.comp \
    'birth_position(position[i].xyz, velocity[i].xyz, release_time[id[i]], time)' \
    'position[i].xyz' \
    conformance_tests 'EmissionTest.BirthsAndSinksAreTheTwins'
mutation "emitters: one takes the slots of another" \
    shaders/sim/call_up.comp \
    'first_dead_from(emitter.first_id) + k' \
    'call.first_dead + k' \
    conformance_tests 'EmissionTest.BirthsAndSinksAreTheTwins'
mutation "emitters: births come on top of others" \
    shaders/sim/birth_place.comp \
    '(xj.w > 0.0 || comes_first)' \
    'comes_first' \
    conformance_tests 'EmissionTest.ComesNowhereNearOthers'
mutation "emitters: births come on top of each other" \
    shaders/sim/birth_place.comp \
    '(xj.w > 0.0 || comes_first)' \
    'xj.w > 0.0' \
    conformance_tests 'EmissionTest.OfTwoWhoComeAtOnceToOnePlaceTheFirstIsBorn'
mutation "emitters: periodic borders hide who is near" \
    shaders/sim/birth_place.comp \
    'shifted && has_image(image, borders)' \
    'image == 0u' \
    conformance_tests 'EmissionTest.AcrossPeriodicBorders*'
mutation "emitters: births without a slot are tried for ever" \
    engine/sim/emission.cpp \
    'next_birth_[e] = std::max(next_birth_[e], past);' \
    '' \
    conformance_tests 'EmissionTest.PausesWhenItsParticlesAreOut'
mutation "emitters: a nozzle brings a tenth too much" \
    engine/run/emission_settings.cpp \
    '(layer.area * layer.speed)' \
    '(1.1 * layer.area * layer.speed)' \
    unit_tests 'EmissionSettings.*'
mutation "emitters: rain falls in step" \
    engine/run/emission_settings.cpp \
    'emitter.jitter = 1.0f;' \
    'emitter.jitter = 0.0f;' \
    unit_tests 'EmissionSettings.RainFallsAtItsRateEverywhere'
mutation "sinks: spheres are boxes" \
    shaders/sim/sink.comp \
    'distance(x, sink.low) <= sink.high.x' \
    'all(lessThanEqual(abs(x - sink.low), vec3(sink.high.x)))' \
    conformance_tests 'EmissionTest.BirthsAndSinksAreTheTwins'
mutation "sinks: what they take is not in the books" \
    shaders/sim/sink.comp \
    'atomicAdd(ledger.sunk, 1u);' \
    '' \
    conformance_tests 'EmissionTest.EveryStepsBooksBalanceWithEverySolver'
mutation "xsph: dust has no volume to divide by" \
    shaders/sim/xsph.comp \
    'vj.w > 0.0 ? vj.w / load_candidate(interaction, j).y : 0.0' \
    'max(vj.w, 0.0) / load_candidate(interaction, j).y' \
    conformance_tests 'DustTest.NoFluidFeelsIt'
mutation "solve: all of an excess is taken away, however short the step" \
    shaders/shared/solve.h \
    'return dt < correction_time ? dt / correction_time : 1.0f' \
    'return 1.0f' \
    physics_short_tests 'Incompressible.ShortStepsDoNotBlowUpUnevenFluid'
mutation "solve: a lack of density is taken away in shares, too" \
    shaders/sim/dfsph_residual.comp \
    'compression > 1.0 ? share * (compression - 1.0) : compression - 1.0' \
    'share * (compression - 1.0)' \
    conformance_tests '*PassConformance.SolvedPressure/*'
mutation "drift: pressure without the divergence solve" \
    shaders/sim/drift.comp \
    'warm_start[i][SOLVE_DENSITY] / params.dt + warm_start[i][SOLVE_DIVERGENCE]' \
    'warm_start[i][SOLVE_DENSITY] / params.dt' \
    conformance_tests '*PassConformance.SolvedPressure/Splash*'
mutation "time step: only the last one is cut" \
    shaders/sim/time_step.comp \
    'landing_step(limit, step.remaining)' \
    'min(limit, step.remaining)' \
    conformance_tests 'TimeControl.StepsAreTheTwins'
mutation "time step: the fastest of the last step only" \
    shaders/sim/fastest.comp \
    'max(dot(v, v), dot(later, later))' \
    'dot(v, v)' \
    conformance_tests 'TimeControl.StepsAreTheTwins'
mutation "neighbor bits: none of those at the rim" \
    shaders/include/neighbor_bits.glsl \
    '* (1.0 + 1e-6);' \
    '* 0.9;' \
    conformance_tests 'NeighborBits.AreThoseOfTheNeighborsAndNoOthers'
mutation "neighbor bits: all candidates are taken for neighbors" \
    shaders/include/neighbor_bits.glsl \
    'nearest2 <= reach2 ? bit : 0u' \
    'bit' \
    conformance_tests 'NeighborBits.AreThoseOfTheNeighborsAndNoOthers'
mutation "neighbor bits: a chunk without a word forgets its last candidate" \
    shaders/include/neighbor_bits.glsl \
    '~0u >> (CHUNK - (chunk.end - chunk.first))' \
    '~0u >> (CHUNK - (chunk.end - chunk.first)) >> 1u' \
    conformance_tests 'NeighborBits.NothingDependsOnHowManyThereIsRoomFor'
mutation "neighbor bits: neighbors of the second chunk are taken from the first" \
    shaders/include/neighbor_bits.glsl \
    'chunks.first = none ? chunks.last.first : chunks.first;' \
    '' \
    conformance_tests '*PassConformance.EachForceAlone/Splash*'
mutation "neighbor bits: every chunk shares a word with the tile before" \
    shaders/include/neighbor_bits.glsl \
    '(params.moving_count + TILE - 1u) / TILE : 0u' \
    '(params.moving_count + TILE - 1u) / TILE - 1u : 0u' \
    conformance_tests 'NeighborBits.NothingDependsOnHowManyThereIsRoomFor'
mutation "time step: nothing keeps it from becoming endlessly small" \
    shaders/sim/time_step.comp \
    'limit = max(limit, params.shortest_dt);' \
    '' \
    conformance_tests 'TimeControl.StepsAreTheTwins'
mutation "time step: it grows at once" \
    shaders/sim/time_step.comp \
    'step.limit * TIME_STEP_GROWTH' \
    '10.0 * step.limit' \
    conformance_tests 'TimeControl.StepsAreTheTwins'
mutation "barriers: reads see what the same dispatch writes" \
    engine/gpu/commands.cpp \
    'write_access[i], true);' \
    'write_access[i], true);
            bindings[i].buffer->access_state().visible_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
            bindings[i].buffer->access_state().visible_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;' \
    conformance_tests 'Steps.FreeFallIsExact'

# --- a host's device ----------------------------------------------------------------------------------------------------

mutation "host: the engine does not wait for what the host has submitted" \
    engine/gpu/commands.cpp \
    '    scopes_.clear();
    if (context_->adopted()) {
        order_with_host();
    }' \
    '    scopes_.clear();' \
    conformance_tests 'HostDevice.TheEngineWrites*'
mutation "host: what the host submits does not wait for the engine" \
    engine/gpu/commands.cpp \
    '    flush_barriers();
    if (context_->adopted()) {
        order_with_host();
    }' \
    '    flush_barriers();' \
    conformance_tests 'HostDevice.TheHostSees*'
mutation "host: the queue's mutex is not locked" \
    engine/gpu/context.cpp \
    'lock = std::unique_lock(*queue_mutex_);' \
    '' \
    conformance_tests 'HostDevice.EverySubmission*'
mutation "host: features count as enabled that are not" \
    engine/gpu/device_requirements.cpp \
    'if (features.v12.*feature.member == VK_FALSE) {' \
    'if (features.v12.*feature.member == VK_FALSE && false) {' \
    conformance_tests 'HostDevice.WhatIsNotEnabledIsNamed'

# --- the yardstick of the benchmark --------------------------------------------------------------------------------------

mutation "yardstick: no images of images" \
    apps/bench/yardstick_sort.cpp \
    'const std::size_t end = ghosts_[thread].size();' \
    'const std::size_t end = begin;' \
    bench_tests 'Yardstick.DensityIsTheReferences'
mutation "yardstick: ghosts move along with what they mirror" \
    apps/bench/yardstick_sort.cpp \
    'ghost.velocity[axis] = -ghost.velocity[axis];' \
    '' \
    bench_tests 'Yardstick.StepsAreTheReferences'
mutation "yardstick: rows end one cell too early" \
    apps/bench/yardstick_kernels.cpp \
    'const std::size_t last = grid.cell_start[cell + 3];
#pragma omp simd reduction(+ : sum)' \
    'const std::size_t last = grid.cell_start[cell + 2];
#pragma omp simd reduction(+ : sum)' \
    bench_tests 'Yardstick.DensityIsTheReferences'

# --- sampling and drawing -----------------------------------------------------------------------------------------------

mutation "surface samples: the half beyond the triangle is not folded back" \
    engine/geometry/mesh_candidates.cpp \
    'u + v > 1.0' \
    'u + v > 2.0' \
    unit_tests 'SurfaceSampling.PointsAreUniformOnTheirTriangles'
mutation "surface samples: blue noise does not tell the two sides of a plate apart" \
    engine/geometry/sample_elimination.cpp \
    '< opposite' \
    '< -2.0f' \
    unit_tests 'SurfaceSampling.BothSidesOfAThinPlateAreCovered'
mutation "surface samples: the weights of sample elimination fall off slowly" \
    engine/geometry/sample_elimination.cpp \
    'see(other, fourth * fourth)' \
    'see(other, closeness)' \
    unit_tests 'SurfaceSampling.BlueNoiseKeepsItsDistance'
mutation "surface samples: all strata are the first" \
    engine/geometry/stratified_sampling.cpp \
    'stratum * per_stratum +' \
    '0 * per_stratum +' \
    unit_tests 'SurfaceSampling.StratifiedPoints*'
mutation "solids: a row's winding number changes the wrong way" \
    engine/geometry/row_crossings.cpp \
    'sum > 0.0 ? -1 : 1' \
    'sum > 0.0 ? 1 : -1' \
    unit_tests 'MeshSolid.TheMaskAgrees*'
mutation "solids: the holes of a mesh do not count" \
    engine/geometry/winding_thresholds.cpp \
    'std::ceil(0.5 + lowest - margin)' \
    'std::ceil(0.5 + highest + margin)' \
    unit_tests 'WindingThresholds.*'
mutation "relaxation: up the gradient of the density" \
    engine/geometry/relaxation.cpp \
    'result.way = away - step' \
    'result.way = away + step' \
    unit_tests 'Relaxation.EvensOut*'
mutation "relaxation: what is outside does not count" \
    engine/geometry/relaxation.cpp \
    'density += volume * cubed' \
    'density += (is_outside ? 0.0f : volume) * cubed' \
    unit_tests 'Relaxation.MeasuresALattice'
mutation "relaxation: particles may leave" \
    engine/geometry/relaxation.cpp \
    '!is_inside()) { // then' \
    'false) { // then' \
    unit_tests 'Relaxation.Nobody*'
mutation "clouds: pieces are not turned outward" \
    engine/geometry/normal_orientation.cpp \
    'return flux < 0.0;' \
    'return false;' \
    unit_tests 'CloudSurface.EveryPieceLooksOutwardByItself'
mutation "clouds: normals take no sign from their neighbors" \
    engine/geometry/normal_orientation.cpp \
    'normal = -normal;' \
    '' \
    unit_tests 'CloudSurface.NormalsOfSmoothShapes*'
mutation "clouds: planes by the largest variance" \
    engine/geometry/local_planes.cpp \
    'eigenvectors().col(0)' \
    'eigenvectors().col(1)' \
    unit_tests 'CloudSurface.NormalsOfSmoothShapes*'
mutation "clouds: rows of a scanner keep twenty neighbors" \
    engine/geometry/local_planes.cpp \
    'most_neighbors = 80' \
    'most_neighbors = 20' \
    unit_tests 'CloudSurface.RowsOfAScanner*'
mutation "clouds: cells do not end at the rim" \
    engine/geometry/cloud_cells.cpp \
    'clip_rim(polygon, scratch, directions, spacing);' \
    '' \
    unit_tests 'CloudSurface.APlaneLooksUp*'
mutation "clouds: cells end at their neighbors, not halfway" \
    engine/geometry/cloud_cells.cpp \
    '0.5 * square' \
    'square' \
    unit_tests 'CloudSurface.CellsHaveTheArea*'
mutation "clouds: points in one place are all kept" \
    engine/geometry/cloud_surface.cpp \
    'std::vector<std::uint8_t> kept(cloud.size(), 0);' \
    'std::vector<std::uint8_t> kept(cloud.size(), 1);' \
    unit_tests 'CloudSurface.PointsInOnePlaceAreOne'
mutation "sample: an unwritable place is told after the work" \
    apps/meltpoint/sample.cpp \
    'refuse_unwritable(options.out);' \
    '' \
    program_tests 'SampleCli.AnUnwritablePlace*'
mutation "clouds: files that are cut off are read" \
    engine/io/point_cloud_import.cpp \
    'if (promised && *promised !=' \
    'if (promised && *promised <' \
    unit_tests 'PointCloudImport.*'
mutation "clouds: a tilted plane is a slab" \
    engine/geometry/cloud_solid.cpp \
    'least_share = 0.25' \
    'least_share = -1.0' \
    unit_tests 'CloudSolid.WhatLiesFlat*'
mutation "clouds: all points count with the same area" \
    engine/geometry/cloud_solid.cpp \
    'std::sqrt(area * 4.0' \
    'std::sqrt(surface.area / double(surface.cloud.size()) * 4.0' \
    unit_tests 'CloudSolid.AnUnevenCloud*'
mutation "clouds: far cells are never inside" \
    engine/geometry/cloud_solid.cpp \
    'threshold > 1 :' \
    'threshold > 2 :' \
    unit_tests 'CloudSolid.TheMaskAgrees*'
mutation "cloud samples: the first corner of a cell gets all" \
    engine/geometry/cloud_candidates.cpp \
    'left < triangle' \
    'true' \
    unit_tests 'CloudSampling.PointsFillTheirCells'
mutation "splats: discs are projected along the view axis instead of intersected" \
    shaders/include/splat.glsl \
    'float t = dot(center - ray.origin, normal) / dot(ray.direction, normal);' \
    'float t = (center - ray.origin).z / ray.direction.z;' \
    image_tests 'SplatTest.*Discs*'
mutation "splats: the bound of a disc is its radius over its distance" \
    shaders/include/splat.glsl \
    'float determinant = d * d - r2 * (1.0 - m * m);' \
    'float determinant = d * d;' \
    image_tests 'SplatTest.DiscsMatchTheRayCast*'
mutation "splats: a sphere is drawn at the depth of its center" \
    shaders/include/splat.glsl \
    '(along - half_chord) * ray.direction' \
    'along * ray.direction' \
    image_tests 'SplatTest.SpheresMatchTheRayCast*'
mutation "drawing: magenta above the rest density instead of below" \
    shaders/render/sphere_look.comp \
    'density[i] < params.rest_density[material]' \
    'density[i] > params.rest_density[material]' \
    image_tests 'FrameTest.DensityBelowTheRestDensityIsMagenta'

# --- files ---------------------------------------------------------------------------------------------------------------

mutation "PLY: counts are not held against the size of the file" \
    engine/io/ply_header.cpp \
    'least > 0 && element.count > left / least' \
    'least > 0 && false' \
    unit_tests 'MeshFile.HugeCountsAreRefusedBeforeAnythingIsAllocated'
mutation "PLY: big-endian values are read as little-endian" \
    engine/io/ply_read.cpp \
    'encoding_ == PlyEncoding::BigEndian' \
    'false' \
    unit_tests '*MeshFormat.BringsBackWhatWasWritten/PlyBig'
mutation "PLY: no triangle of a strip is turned round" \
    engine/io/ply_read.cpp \
    '(i - begin) % 2 == 1' \
    'false' \
    unit_tests 'PlyFile.TriangleStrips'
mutation "glTF: buffers may lie anywhere" \
    engine/io/gltf_buffer.cpp \
    'folder_end != folder.end()' \
    'false' \
    unit_tests 'GltfFile.BuffersBesideTheFileAreReadAndNoOthers'
mutation "glTF: indices are not held against the vertices" \
    engine/io/gltf_reduce.cpp \
    'indices.highest >= positions.count' \
    'false' \
    unit_tests '*MeshFormat.UnusableMeshesAreRefused/Glb'
mutation "glTF: instances are not counted" \
    engine/io/gltf_reduce.cpp \
    'total.triangles += size.triangles' \
    'total.triangles = size.triangles' \
    unit_tests 'GltfFile.DeepTreesCyclesAndManyInstancesAreRefused'
mutation "glTF: linear colors are taken as sRGB" \
    engine/io/gltf_reduce.cpp \
    'color_byte(255.0 * srgb_from_linear(light))' \
    'color_byte(255.0 * light)' \
    unit_tests 'GltfFile.ColorsOfEveryTypeAreLinear:*MeshFormat.BringsBackTheSameColors/Gl*'
mutation "glTF: colors that are not finite are read" \
    engine/io/gltf_reduce.cpp \
    '!std::isfinite(light)' \
    'false' \
    unit_tests 'GltfFile.BrokenColorsAreRefused'
mutation "OBJ: colors are from 0 to 1 in every file" \
    engine/io/obj_reduce.cpp \
    'is_bytes ? 255.0 :' \
    'is_bytes ? 1.0 :' \
    unit_tests 'ObjFile.ColorsAreFromZeroToOneOrTo255'
mutation "meshes: parts without colors are black" \
    engine/io/mesh_import.cpp \
    'glm::u8vec3(255)' \
    'glm::u8vec3(0)' \
    unit_tests 'GltfFile.PartsWithoutColorsAreWhiteBesideOthers'
mutation "Gmsh: nodes count from zero" \
    engine/io/point_cloud_export.cpp \
    'static_cast<int>(i + 1)' \
    'static_cast<int>(i)' \
    unit_tests 'PointCloudExport.MshHasNodesPointElementsAndAViewOfTheNormals'
mutation "points: a stopped export is committed" \
    engine/io/point_cloud_export.cpp \
    'if (!format.write(file, rows, cloud)) {' \
    'if (!format.write(file, rows, cloud) && false) {' \
    unit_tests 'PointCloudExport.StoppedInTheMiddleThePathIsAsItWas'

# --- viscosity that is solved for ---------------------------------------------------------------------------------------

mutation "viscosity solve: pairs drag instead of pulling along their line" \
    shaders/include/viscous_walk.glsl \
    'along * dot(relative, offset) * offset' \
    'along * r2 * relative' \
    conformance_tests 'States/PassConformance.SolvedViscosity/RandomWendland'
mutation "viscosity solve: boundary particles pull as fluid does" \
    shaders/include/viscous_walk.glsl \
    'bool is_fluid = pj.w > 0.0;' \
    'bool is_fluid = true;' \
    conformance_tests 'States/PassConformance.SolvedViscosity/OnAColliderWendland'
mutation "viscosity solve: images are not reflected back" \
    shaders/include/viscous_walk.glsl \
    'total[k].force += signs * force[k];' \
    'total[k].force += force[k];' \
    conformance_tests 'States/PassConformance.SolvedViscosity/InTheCornersWendland'
mutation "viscosity solve: the walls do not drag" \
    shaders/include/viscous_walk.glsl \
    'total[k].force -= drag * signs * p[k];' \
    '' \
    conformance_tests 'States/PassConformance.SolvedViscosity/LatticeOnTheFloorWendland'
mutation "viscosity solve: blocks without their off-diagonal" \
    shaders/sim/viscosity_residual.comp \
    'ViscosityBlock(cofactors / determinant, off_cofactors / determinant)' \
    'ViscosityBlock(cofactors / determinant, vec3(0.0))' \
    conformance_tests 'States/PassConformance.SolvedViscosity/RandomWendland'
mutation "viscosity solve: the start is taken from the unsorted order" \
    shaders/sim/viscosity_start.comp \
    'before[order[i]]' \
    'before[i]' \
    conformance_tests 'States/PassConformance.SolvedViscosity/RandomWendland'
mutation "viscosity solve: directions are not conjugate" \
    shaders/sim/viscosity_direction.comp \
    'viscosity.turn * direction[i].xyz' \
    '0.5 * viscosity.turn * direction[i].xyz' \
    conformance_tests 'States/PassConformance.SolvedViscosity/RandomWendland'
mutation "viscosity solve: steps along the direction are 20 % short" \
    shaders/sim/viscosity_product.comp \
    'viscosity.residual / sum' \
    '0.8 * viscosity.residual / sum' \
    conformance_tests 'States/PassConformance.SolvedViscosity/RandomWendland'
mutation "viscosity solve: it ends too early" \
    shaders/include/viscosity_solve.glsl \
    'error <= params.viscosity_error' \
    'error <= 10.0 * params.viscosity_error' \
    conformance_tests 'States/PassConformance.SolvedViscosity/LatticeWendland'
mutation "viscosity solve: what it did is not kept for the next step" \
    shaders/sim/viscosity_end.comp \
    'vec4(u / params.dt, 0.0)' \
    'vec4(u, 0.0)' \
    conformance_tests 'States/PassConformance.SolvedViscosity/RandomWendland'
mutation "viscosity solve: fluid 20 % too thick" \
    engine/particles/sph_kernel.cpp \
    '{.scale = (n + 2.0) /' \
    '{.scale = (n + 3.0) /' \
    physics_short_tests 'ViscousDecay.SolvedForHasTheExactRateInStepsOfAnyLength'
mutation "viscosity solve: a lattice is the same along all directions without the taper" \
    engine/particles/sph_kernel.cpp \
    'mean.x - shear.x' \
    '0.0 * shear.x' \
    unit_tests 'ReferenceViscosity.IsThatOfTheNavierStokesEquations'
mutation "viscosity solve: colliders feel the friction of the velocities before it" \
    engine/sim/solver.cpp \
    'after_viscosity != (fluid.viscosity != nullptr)' \
    'after_viscosity' \
    physics_short_tests 'ViscousDecay.FrictionIsTheSameExplicitOrSolvedFor'
mutation "viscosity: the force stays where it is solved for" \
    shaders/sim/forces.comp \
    'SOLVED_VISCOSITY ? 0.0 : interaction_j.z' \
    'interaction_j.z' \
    conformance_tests 'States/PassConformance.SolvedViscosity/RandomWendland'

# --- wind ---------------------------------------------------------------------------------------------------------------

mutation "wind: sheltered places lose sand, too" \
    shaders/sim/wind_erode.comp \
    'share * visibility[slot] *' \
    'share *' \
    conformance_tests 'SandTest.NoSandLeavesShelteredPlaces'
mutation "wind: it takes sand below its threshold" \
    shaders/sim/wind_erode.comp \
    'stress > sand.threshold' \
    'stress > 0.0' \
    conformance_tests 'SandTest.BelowTheThresholdNothingMoves'
mutation "wind: it takes 10 % more than its flux" \
    engine/sim/wind.cpp \
    'its.pick_up = static_cast<float>(bagnold' \
    'its.pick_up = 1.1f * static_cast<float>(bagnold' \
    conformance_tests 'SandTest.AFlatBedLosesItsFluxOverTheLengthOfAHop'
mutation "wind: steep sand stays where it is" \
    shaders/include/ground.glsl \
    'length(plane) > steepest_ground' \
    'false' \
    conformance_tests 'SandTest.HeapsStandAtTheirAngleOfRepose'
mutation "wind: what has come down stays where it is too steep" \
    shaders/sim/alight.comp \
    'down.way == WAY_NONE' \
    'true' \
    conformance_tests 'SandTest.StepsAndLooksAreTheTwins'
mutation "wind: towers of sand stand" \
    shaders/include/ground.glsl \
    'slope > steepest_step ||' \
    '' \
    conformance_tests 'SandTest.StepsAndLooksAreTheTwins'
mutation "wind: a column's new top lies where the old one was" \
    shaders/include/columns.glsl \
    '(loses_top(texel) ? 0.0 : params.spacing)' \
    '0.0' \
    conformance_tests 'SandTest.StepsAndLooksAreTheTwins'
mutation "wind: a column's new top hangs over where the old one was" \
    shaders/include/columns.glsl \
    '(loses_top(texel) ? 0.0 : params.spacing)' \
    'params.spacing' \
    conformance_tests 'SandTest.StepsAndLooksAreTheTwins'
mutation "wind: all who have come down find room at once" \
    shaders/sim/land.comp \
    'if (claim[index_of(here)] != id[i]) {' \
    'if (claim[index_of(here)] == WAY_NONE) {' \
    conformance_tests 'SandTest.StepsAndLooksAreTheTwins'
mutation "wind: all who slide to a column find room at once" \
    shaders/sim/slide_apply.comp \
    '} else if (claim[index_of(there)] == id[i]) {' \
    '} else {' \
    conformance_tests 'SandTest.StepsAndLooksAreTheTwins:SandTest.HeapsStandAtTheirAngleOfRepose'
mutation "wind: grains climb walls" \
    shaders/sim/hop.comp \
    'if (blocked) {' \
    'if (false) {' \
    conformance_tests 'SandTest.StepsAndLooksAreTheTwins'
mutation "wind: what comes down on the floor never rests" \
    shaders/sim/hop.comp \
    'height_of(next) <= lowest' \
    'height_of(next) < lowest' \
    conformance_tests 'SandTest.HeapsStandAtTheirAngleOfRepose'
mutation "wind: nothing moves at first" \
    engine/sim/wind.cpp \
    'shared::random_share(id) : 0.0f' \
    '0.0f : 0.0f' \
    conformance_tests 'SandTest.TheWindHasBeenAtWorkBeforeTheStart'
mutation "wind: the ground's slope is that of one axis" \
    shaders/sim/ground.comp \
    'top * vec2(x, y)' \
    'top * vec2(x, 0.0)' \
    conformance_tests 'SandTest.StepsAndLooksAreTheTwins'
mutation "wind: hops get no drag" \
    shaders/sim/hop.comp \
    '1.0 - exp(-params.dt / sand.response_time)' \
    'params.dt / sand.response_time * 0.5' \
    conformance_tests 'SandTest.GrainsHopAsFarAsTheyAreMeantTo:SandTest.StepsAndLooksAreTheTwins'
mutation "wind: sand lost beyond the border is not counted" \
    shaders/sim/hop.comp \
    'atomicAdd(ledger.sunk, 1u)' \
    'atomicAdd(ledger.sunk, 0u)' \
    conformance_tests 'SandTest.RerunsAreBitIdenticalAndTheLedgerIsExact'

# --- the sheet of sand --------------------------------------------------------------------------------------------------

mutation "sand: it lands where fluid is" \
    shaders/sim/land.comp \
    'if (holds_fluid(place)) {' \
    'if (false) {' \
    conformance_tests 'SandTest.SandDoesNotLandWhereFluidIs'
mutation "sand: it has no sheet" \
    engine/run/solid_splats.cpp \
    'material.wind_erodes ? 1 : 0' \
    'material.wind_erodes ? 0 : 0' \
    image_tests 'SandFramesTest.ADuneIsSmooth:Scenes/SolidFramesTest.NothingPops/dune'
mutation "sand: all fits of its sheet count alike" \
    shaders/render/sand_surface.comp \
    'share / (scatter * scatter)' \
    'share' \
    conformance_tests 'SandSurfaceTest.ACrestStaysSharp:SandSurfaceTest.TheDeviceConformsToTheTwin'
mutation "sand: a particle that lands is a step of its sheet" \
    shaders/render/sand_column.comp \
    '1.0 - exp(-push.seconds / COLUMN_TIME)' \
    '1.0' \
    conformance_tests 'SandSurfaceTest.HeightsFollowInTime'
mutation "sand: its sheet is that of its columns" \
    shaders/render/sand_plane.comp \
    'base + (mean_height - dot(slope, mean)) * view.spacing, slope *' \
    'base, 0.0 * slope *' \
    conformance_tests 'SandSurfaceTest.AStaircaseIsASmoothSlope'
mutation "sand: its sheet hangs down cliffs" \
    shaders/render/sand_surface.comp \
    'length(slope) <= STEEPEST_SHEET && off <= ROUGHEST_SHEET * ROUGHEST_SHEET' \
    'length(slope) <= 100.0' \
    conformance_tests 'SandSurfaceTest.SteepSandHasNoSheet'
mutation "sand: what overhangs is not seen" \
    shaders/render/sand_cover.comp \
    'above < -COVERED_BELOW' \
    'false' \
    conformance_tests 'SandSurfaceTest.TheDeviceConformsToTheTwin'
mutation "solids: splats stretch as far as their hosts part" \
    shaders/render/surface_splat.comp \
    'stretch > MOST_STRETCH * splat.span' \
    'false' \
    conformance_tests 'SolidSplatsTest.WhoseHostsPartIsGone:SolidSplatsTest.TheDeviceConformsToTheTwin'
mutation "wind: sand flies through closed walls" \
    shaders/sim/hop.comp \
    'v = mix(v, vec3(0.0), notEqual(within, next));' \
    'within = next;' \
    conformance_tests 'SandTest.WallsStopSandInTheAir'

# --- heat ---------------------------------------------------------------------------------------------------------------

mutation "heat: what a float cannot hold is lost" \
    shaders/shared/two_float.h \
    'return vec2(large, rest)' \
    'return vec2(large, 0.0f)' \
    conformance_tests 'HeatTest.NothingIsTooLittleToCount'
mutation "heat: it leaves through walls and periodic borders" \
    shaders/sim/conduction.comp \
    'may_get_heat(tile, own) ? tile.images : 0u' \
    'may_get_heat(tile, own) ? 1u : 0u' \
    conformance_tests 'HeatTest.ConductsAsItsTwin'
mutation "heat: who looks for it misses its cell" \
    shaders/sim/conduction.comp \
    'ivec3 reach = ivec3(CELLS_PER_SUPPORT_X, 1, 1);' \
    'ivec3 reach = ivec3(1);' \
    conformance_tests 'HeatTest.AFewWarmOnesAmidMeltingIceConductAsTheirTwin'
mutation "heat: the first cell of a word is forgotten" \
    shaders/sim/conduction.comp \
    '& (~0u << from)' \
    '& (~1u << from)' \
    conformance_tests 'HeatTest.AFewWarmOnesAmidMeltingIceConductAsTheirTwin'
mutation "heat: who is colder than ice is not seen" \
    shaders/sim/temperature.comp \
    't != common_temperature' \
    't > common_temperature' \
    conformance_tests 'HeatTest.AFewWarmOnesAmidMeltingIceConductAsTheirTwin'
mutation "heat: pairs that have met need an ever shorter step" \
    shaders/sim/conduction.comp \
    'max(dot(offset, offset), nearest * nearest)' \
    'max(dot(offset, offset), 1e-14)' \
    conformance_tests 'HeatTest.NoTemperatureLeavesTheRangeThereIs'
mutation "heat: a pair does not agree about what flows" \
    shaders/sim/conduction.comp \
    'pair_conductivity(its[k].y, thermal_j.y)' \
    'pair_conductivity(its[k].y, its[k].y)' \
    conformance_tests 'HeatTest.AnInsulatedBlockKeepsItsHeat'
mutation "heat: 8 % too much flows" \
    shaders/sim/conduction.comp \
    'dt * its[k].w * params.gradient_scale' \
    '1.08 * dt * its[k].w * params.gradient_scale' \
    conformance_tests 'HeatTest.ASolidMeltsAsStefanFound'
mutation "heat: conductivities are averaged arithmetically" \
    shaders/shared/heat.h \
    '4.0f * k_i / (k_i + k_j) * k_j' \
    '(k_i + k_j)' \
    conformance_tests 'HeatMaterial.PairsHaveTheHarmonicMean'
mutation "heat: temperature falls below the melting point while it melts" \
    shaders/shared/heat.h \
    'beyond > 0.0f ? beyond / material.fluid_specific_heat : 0.0f' \
    'beyond / material.fluid_specific_heat' \
    conformance_tests 'HeatMaterial.TemperatureStaysWhileItMelts'
mutation "heat: colliders do not hold their temperature" \
    shaders/sim/temperature.comp \
    '!holds && k > 0.0' \
    'k > 0.0' \
    conformance_tests 'HeatTest.ConductsInThePlaneAsItsTwin'
mutation "heat: dust has some" \
    shaders/sim/temperature.comp \
    'holds || state == STATE_SOLID' \
    'state == STATE_DUST || holds || state == STATE_SOLID' \
    conformance_tests 'HeatTest.ConductsAsItsTwin'
mutation "heat: its last step may be too long" \
    engine/sim/heat.cpp \
    'std::ceil(' \
    'std::floor(' \
    conformance_tests 'HeatTest.StepsAreCountedAndLimited'
mutation "heat: poor conductors amid good ones are forgotten" \
    engine/sim/heat.cpp \
    'shared::pair_conductivity(its.solid_conductivity, best)' \
    '2.0f * its.solid_conductivity' \
    conformance_tests 'HeatTest.TheLongestStepIsThatOfTheFastestMaterialButForColliders'
mutation "heat: waves decay four times as fast as thought" \
    engine/particles/sph_kernel.cpp \
    '2.0 * gradient_shape(kernel, r / ratio) / r * (1.0' \
    '0.5 * gradient_shape(kernel, r / ratio) / r * (1.0' \
    unit_tests '*NoWaveOfALatticeDecaysFasterThanTheEigenvalueSays*'

# --- named liquids ------------------------------------------------------------------------------------------------------

mutation "liquids: what stands in the scene does not count" \
    engine/scene/scene_builder.cpp \
    'key.name == "shape" || key.name == "liquid"' \
    'key.name == "shape"' \
    unit_tests 'SceneFile.*Liquid*'
mutation "liquids: they have no viscosity of their own" \
    engine/scene/liquids.cpp \
    'body.viscosity = liquid.viscosity;' \
    '' \
    unit_tests 'SceneFile.*Liquid*'

# --- hydraulic erosion ----------------------------------------------------------------------------------------------------

mutation "scour: the flow towards the surface counts, too" \
    shaders/sim/scour.comp \
    'along -= dot(along, surface.xyz) * surface.xyz;' \
    '' \
    conformance_tests 'HydraulicTest.LooksAreTheTwins'
mutation "scour: what is strong begins to go as early as the rest" \
    shaders/sim/scour.comp \
    'stress / its_strength - ' \
    'stress - ' \
    conformance_tests 'HydraulicTest.LooksAreTheTwins'
mutation "scour: spray erodes as deep water does" \
    shaders/sim/scour.comp \
    'wet * loss' \
    'loss' \
    conformance_tests 'HydraulicTest.LooksAreTheTwins'
mutation "scour: there is no threshold" \
    shaders/sim/scour.comp \
    ' - hydraulic.threshold[material];' \
    ';' \
    conformance_tests 'HydraulicTest.NothingComesFreeBelowTheThreshold'
mutation "scour: the rate is linear in the excess" \
    shaders/sim/scour.comp \
    'pow(excess, hydraulic.exponent[material])' \
    'excess' \
    conformance_tests 'HydraulicTest.TheRateIsAPowerOfTheExcess'
mutation "scour: looks come half as often" \
    engine/sim/hydraulic.cpp \
    'largest_loss = 0.05' \
    'largest_loss = 0.1' \
    conformance_tests 'HydraulicTest.NoLookTakesMoreThanATwentiethOfAParticle'
mutation "detach: damage goes on beyond a particle" \
    shaders/sim/detach.comp \
    '        damage[slot] = vec2(1.0, 0.0);
' \
    '' \
    conformance_tests 'HydraulicTest.LooksAreTheTwins'
mutation "deposit: sediment sticks to flanks" \
    shaders/sim/deposit.comp \
    ' && is_below(way)' \
    '' \
    conformance_tests 'HydraulicTest.SedimentSlidesOffSteepFlanks'
mutation "deposit: sediment heals while it falls" \
    shaders/sim/deposit.comp \
    'bool rests = has_room && length(velocity[i].xyz) < hydraulic.deposition_speed && (rests_on_floor(x) || rests_on_solid(x));' \
    'bool rests = true;' \
    conformance_tests 'HydraulicTest.SedimentThatRestsIsSolidAgain'
mutation "deposit: sediment settles where it is crowded" \
    shaders/sim/deposit.comp \
    'density[i] < MOST_CROWDED *' \
    'density[i] < 1e6 *' \
    conformance_tests 'HydraulicTest.LooksAreTheTwins'
mutation "deposit: water settles" \
    shaders/sim/deposit.comp \
    'cause_of(attributes[i]) != CAUSE_HYDRAULIC || ' \
    '' \
    conformance_tests 'HydraulicTest.SedimentThatRestsIsSolidAgain'
mutation "deposit: what has settled counts as moving" \
    engine/sim/simulation.cpp \
    '- found.frozen - found.deposited;' \
    '- found.frozen;' \
    conformance_tests 'HydraulicTest.SedimentThatRestsIsSolidAgain'
mutation "hydraulic: coarse grains move a fifth too early" \
    engine/run/hydraulic_settings.cpp \
    '+ 0.055 *' \
    '+ 0.045 *' \
    unit_tests 'Shields.CoarseGrainsHaveAConstantParameter'
mutation "hydraulic: strata are lumps" \
    engine/run/hydraulic_settings.cpp \
    'if (erosion.strength_layers) {' \
    'if (false) {' \
    unit_tests 'Strength.OfLayersDependsOnTheWayAcrossThemAlone'
mutation "hydraulic: the strength of colors is that of noise" \
    engine/run/hydraulic_settings.cpp \
    'erosion.strength_from == StrengthSource::Color' \
    'erosion.strength_from == StrengthSource::Color && false' \
    unit_tests 'ColorStrength.OfAScenesSolidsIsThatOfTheirFiles'
mutation "color strength: sRGB is taken as linear" \
    engine/run/color_strength.cpp \
    'linear_from_srgb(encoded / 255.0)' \
    'encoded / 255.0' \
    unit_tests 'ColorStrength.IsOfLinearLuminance'
mutation "color strength: dark is strong" \
    engine/run/color_strength.cpp \
    '2.0 * luminance - 1.0' \
    '1.0 - 2.0 * luminance' \
    physics_short_tests 'ColoredBedTest.*'
mutation "mesh: welding forgets which vertices have which color" \
    engine/geometry/triangle_mesh.cpp \
    'welded.colors.push_back(mesh.colors[i]);' \
    'welded.colors.push_back(mesh.colors[welded.colors.size()]);' \
    unit_tests 'TriangleMesh.WeldingKeepsColors'
mutation "surface sampling: a sample has the color of a corner" \
    engine/geometry/mesh_candidates.cpp \
    '(1.0 - u - v) * a + u * b + v * c)};' \
    'a)};' \
    unit_tests 'SurfaceSampling.ColorsLieBetweenThoseOfTheCorners'

# --- the mutations: solids that melt to another volume ----------------------------------------------------------------------

mutation "volume relaxation: it is over at once" \
    shaders/sim/relax_volume.comp \
    'relaxed_weight(position[i].w)' \
    '1.0' \
    conformance_tests 'VolumeRelaxationTest.*'
mutation "volume relaxation: there is none" \
    engine/sim/volume_relaxation.cpp \
    'may_be_fluid && particles.weight[i] != 1.0f' \
    'false && may_be_fluid' \
    conformance_tests 'VolumeRelaxationTest.*'
mutation "volume relaxation: solids have the surface of their fluid" \
    shaders/sim/exposure.comp \
    'share * position[i].w * params.lattice_volume' \
    'share * params.lattice_volume' \
    conformance_tests 'ExposureTest.OfASolidThatMeltsToAnotherVolumeIsItsFace'
mutation "volume relaxation: solids conduct as their fluid's density has it" \
    shaders/sim/temperature.comp \
    'position[i].w / params.rest_density[material]; // 1 / rho0' \
    '1.0 / params.rest_density[material]; // 1 / rho0' \
    conformance_tests 'HeatTest.ConductsAsItsTwin'
mutation "volume relaxation: particles of solids lie as near as those of fluid" \
    engine/run/scene_particles.cpp \
    'std::pow(volume, 1.0 / scene.domain.dimensions)' \
    '1.0' \
    unit_tests 'SceneParticles.OfASolidThatMeltsToAnotherVolumeHaveTheMassOfItsFluids'
mutation "volume relaxation: solids are weighted as their fluid" \
    engine/run/scene_particles.cpp \
    'particles.weight[first + i] = static_cast<float>(volume);' \
    '' \
    unit_tests 'SceneParticles.OfASolidThatMeltsToAnotherVolumeHaveTheMassOfItsFluids'
mutation "steps: those of deep water are as long as any" \
    engine/run/fluid_settings.cpp \
    'scene.solver == Solver::Dfsph && waves > 0.0' \
    'scene.solver == Solver::Dfsph && waves > 1e9' \
    physics_short_tests 'DeepWaterTest.*'
mutation "steps: bodies weigh nothing on the water below them" \
    engine/run/fluid_settings.cpp \
    'return depth + load' \
    'return depth + 0.0 * load' \
    physics_short_tests 'FloatingTest.AHeavySlabFromWallToWallStaysOnItsWater'
mutation "warnings: nobody hears of bodies on trapped fluid" \
    engine/run/scene_warnings.cpp \
    'return solver == Solver::Pbf ? 2.0 : 5.0;' \
    'return 1e9;' \
    unit_tests 'SceneWarnings.BodiesOnFluidThatCannotGetOutOfTheirWay'

# --- the mutations: splats of solids --------------------------------------------------------------------------------------

mutation "solid splats: damage is no progress" \
    shaders/render/solid_progress.comp \
    'progress = max(progress, clamp(damage[slot].x, 0.0, 1.0));' \
    '' \
    conformance_tests 'SolidSplatsTest.TheDeviceConformsToTheTwin'
mutation "solid splats: solids are whole until they are freed" \
    shaders/render/solid_progress.comp \
    'left = 1.0 - progress;' \
    'left = 1.0;' \
    image_tests '*SolidFramesTest.NothingPops/melt_cube'
mutation "solid splats: the field's slope is half of what it is" \
    shaders/include/solid_field.glsl \
    'field.gradient *= 20.0 * scale' \
    'field.gradient *= 10.0 * scale' \
    conformance_tests 'SolidSplatsTest.TheDeviceConformsToTheTwin'
mutation "solid splats: particle splats lie above the surface" \
    shaders/render/particle_splat.comp \
    '(depth - sunk)' \
    '(depth + sunk)' \
    conformance_tests 'SolidSplatsTest.TheSurfaceRecedesSteadilyFromLayerToLayer'
mutation "solid splats: particle splats wait until surface splats are gone" \
    shaders/render/particle_splat.comp \
    'float backing = covered * (1.0 - eroded);' \
    'float backing = covered;' \
    conformance_tests 'SolidSplatsTest.TheDeviceConformsToTheTwin'
mutation "solid splats: nothing backs the edges of surface splats" \
    shaders/render/particle_splat.comp \
    'params.spacing ? BACKING_RADIUS : 0.0' \
    'params.spacing ? 0.0 : 0.0' \
    image_tests '*SolidFramesTest.NoHoleShowsTheInside/vanish'
mutation "solid splats: surface splats do not see that their hosts' neighbors go" \
    shaders/render/particle_splat.comp \
    'abs(part_left - 1.0) > UNCHANGED || here.fluid > 0.0 ? 1 : 0' \
    '0' \
    conformance_tests 'SolidSplatsTest.SurfaceSplatsDoNotStandOutOfWhatIsLeft'
mutation "erosion: a front's looks do not know when it arrives" \
    engine/sim/erosion.cpp \
    'return static_cast<double>(*last) - time;' \
    'return static_cast<double>(*last);' \
    conformance_tests 'ErosionTest.LooksAreSoNearThatAFrontFreesAFiftiethAtATime'
mutation "solid splats: they bend the wrong way across" \
    shaders/render/bend_splat.comp \
    'float uv = (turn_u.y' \
    'float uv = -(turn_u.y' \
    conformance_tests 'SolidSplatsTest.TheDeviceConformsToTheTwin'
mutation "solid splats: surface splats grow out of their solid" \
    shaders/render/surface_splat.comp \
    '- recession * normal;' \
    '+ recession * normal;' \
    conformance_tests 'SolidSplatsTest.TheDeviceConformsToTheTwin'
mutation "solid splats: surface splats go before they have sunk" \
    shaders/render/surface_splat.comp \
    '(1.0 - smooth_ramp(SHRINKING_FROM, 1.0, worst_progress))' \
    '(worst_progress < SINKING_FROM ? 1.0 : 0.0)' \
    conformance_tests 'SolidSplatsTest.SurfaceSplatsSinkBelowParticleSplatsBeforeTheyShrink'
mutation "solid splats: surface splats stand where others have gone" \
    shaders/render/surface_splat.comp \
    '1.0 - smooth_ramp(BARE_FULLY, BARE_FROM, here.filling / start)' \
    '0.0' \
    conformance_tests 'SolidSplatsTest.SurfaceSplatsDoNotStandOutOfWhatIsLeft'
mutation "solid splats: surface splats do not get wet" \
    shaders/render/surface_splat.comp \
    'mix(1.0, splat.wet_albedo, wetness)' \
    '1.0' \
    conformance_tests 'SolidSplatsTest.TheDeviceConformsToTheTwin'
mutation "solid splats: surface splats come back with their hosts" \
    shaders/render/surface_splat.comp \
    'worst_progress >= 1.0' \
    'worst_progress > 1.0' \
    conformance_tests 'SolidSplatsTest.WhoseHostWasFreedIsGoneForGood'
mutation "discs: an edge cuts nothing off" \
    shaders/render/disc.frag \
    ' && dot(q, in_edge.xyz) <= in_edge.w' \
    '' \
    image_tests 'DiscTest.AnEdgedOneEndsAtItsEdge'
mutation "discs: bent ones go on beyond their surface" \
    shaders/render/disc.frag \
    ' && off <= BENT_OFF * in_disc.w' \
    '' \
    image_tests 'DiscTest.ABentOne*'
mutation "discs: bent ones are seen from inside" \
    shaders/render/disc_quad.comp \
    'radius > 0.0 && !turned_away && is_there' \
    'radius > 0.0 && is_there' \
    image_tests 'DiscTest.BentAndEdgedOnesAreSeenFromOutsideAlone'
mutation "discs: normals turn the other way" \
    shaders/include/splat.glsl \
    'normalize(normal + dot(bend.xy, at) * u' \
    'normalize(normal - dot(bend.xy, at) * u' \
    image_tests 'DiscTest.ABentOne*'
mutation "splats: the list leaves out the first of each" \
    shaders/render/splat_list.comp \
    'list[starts[i]] = i' \
    'list[starts[i]] = i + 1u' \
    image_tests 'SplatTest.SpheresMatchTheRayCast*'
mutation "picture: surfaces are drawn where the floor alone is seen" \
    shaders/render/floor.frag \
    'only_floor ? 1.0 : 0.0' \
    'only_floor ? 0.0 : 1.0' \
    image_tests 'FrameTest.*'
mutation "balls: they all have one size" \
    shaders/render/sphere_look.comp \
    'return params.splat_radius * size[i];' \
    'return params.splat_radius;' \
    image_tests 'DiscTest.BallsMayHaveSizesOfTheirOwn'

# --- the machinery ------------------------------------------------------------------------------------------------------

source_dir=build/mutations/source
build_dir=build/mutations/build
log=build/mutations/log

# list_files FOLDER: its source files.
list_files() {
    (cd "$1" && find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f -print)
}

# copy_source: makes the scratch copy equal to the source. Only what differs is written: then its time is new and the build
# notices, also after a run that was interrupted in the middle of a mutation.
copy_source() {
    local file
    mkdir -p "$source_dir"
    while read -r file; do
        cmp --quiet "$file" "$source_dir/$file" || install -D "$file" "$source_dir/$file"
    done < <(list_files .)
    while read -r file; do
        [ -f "$file" ] || rm "$source_dir/$file"
    done < <(list_files "$source_dir")
}

# rebuild PROGRAM...
rebuild() {
    build "$build_dir" --target "$@" >"$log" 2>&1
}

# run_tests PROGRAM FILTER: a mutation may well hang or crash the program, which is red as well.
run_tests() {
    timeout 300 "$build_dir/tests/$1" --gtest_filter="$2" --gtest_fail_fast --gtest_brief=1 >"$log" 2>&1 </dev/null
}

# fits FILE ORIGINAL: whether the original is there exactly once.
fits() {
    local text rest
    [ -f "$1" ] || return 1
    text=$(<"$1")
    rest=${text#*"$2"}
    [[ "$rest" != "$text" && "$rest" != *"$2"* ]]
}

# replace FILE ORIGINAL REPLACEMENT
replace() {
    local text
    text=$(<"$1")
    printf '%s\n' "${text/"$2"/"$3"}" >"$1"
}

# try N: applies mutation N to the scratch copy and says in `verdict` who noticed. Fails if nobody did.
try() {
    local file=$source_dir/${files[$1]}
    if ! fits "$file" "${originals[$1]}"; then
        verdict="DOES NOT APPLY: its original text is not in ${files[$1]} exactly once"
        return 1
    fi
    replace "$file" "${originals[$1]}" "${replacements[$1]}"
    if ! rebuild "${programs[$1]}"; then
        verdict="DOES NOT BUILD: $(grep -m 1 -i error "$log")"
    elif run_tests "${programs[$1]}" "${filters[$1]}"; then
        verdict="SURVIVED ${filters[$1]}"
    else
        verdict=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$log" | head -n 1)
        verdict=${verdict:-${programs[$1]} crashed or hung}
        return 0
    fi
    return 1
}

chosen=()
while [ $# -gt 0 ]; do
    case $1 in
        --list)
            for n in "${!descriptions[@]}"; do
                printf '%3d  %-48s %s\n' "$n" "${files[n]}" "${descriptions[n]}"
            done
            exit 0
            ;;
        --check)
            missed=0
            for n in "${!descriptions[@]}"; do
                fits "${files[n]}" "${originals[n]}" || {
                    echo "mutation $n, \"${descriptions[n]}\": its original text is not in ${files[n]} exactly once"
                    missed=$((missed + 1))
                }
            done
            echo "${#descriptions[@]} mutations, $missed do not fit the source"
            exit $((missed > 0))
            ;;
        --only)
            [[ ${2:-} =~ ^[0-9]+$ && $2 -lt ${#descriptions[@]} ]] || fail "--only takes a number that --list shows"
            chosen+=("$2")
            shift
            ;;
        *) fail "unknown argument '$1': --list, --check and --only N are the only ones" ;;
    esac
    shift
done
[ ${#chosen[@]} -gt 0 ] || chosen=("${!descriptions[@]}")

copy_source
cmake -G Ninja -S "$source_dir" -B "$build_dir" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache)" >build/mutations/configure.log

# Unmutated, all is green: else red would mean nothing.
for program in $(for n in "${chosen[@]}"; do echo "${programs[n]}"; done | sort -u); do
    filter=$(for n in "${chosen[@]}"; do [ "${programs[n]}" != "$program" ] || echo "${filters[n]}"; done | sort -u | paste -sd :)
    rebuild "$program" || fail "the unmutated source does not build: see $log" 1
    run_tests "$program" "$filter" || fail "the unmutated source fails its tests: see $log" 1
done

missed=0
for n in "${chosen[@]}"; do
    started=$SECONDS
    try "$n" || missed=$((missed + 1))
    printf '%3d  %3d s  %-56s %s\n' "$n" $((SECONDS - started)) "${descriptions[n]}" "$verdict"
    if [ -f "${files[n]}" ]; then
        cp "${files[n]}" "$source_dir/${files[n]}"
    fi
done
printf '%d mutations in %d min %02d s, %d not noticed\n' ${#chosen[@]} $((SECONDS / 60)) $((SECONDS % 60)) $missed
[ $missed -eq 0 ]
