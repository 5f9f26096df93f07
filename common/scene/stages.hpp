// The stages of a run. Each is a scene of its own, with the stage's loading, end, friction and restitution; a scene
// without
// [[stage]] entries is one stage. The state goes from stage to stage as it is (Engine::change): grains, contacts and
// what they remember, and the rates of the components that stay driven in stress.
//
// All stages share the layout of the state (the largest that one of them needs), the time step (the smallest), and the
// unit of stress P = loading.pressure of the scene, to which kappa, I and the material's stiffness refer.
//
// A stage with cycles is a path run there and back: parts of equal length, in which imposed rates change sign and
// changing stresses go from one end to the other.
#pragma once

#include <string>
#include <vector>

#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// At least one. Their `stages` are empty.
std::vector<Scene> stage_scenes(const Scene& scene);

/// Its name, or "stage 2" for the second one without a name; "run" for a scene without stages.
std::string stage_name(const Scene& scene, std::size_t stage);

/// What follows from each stage, with what they share.
std::vector<Derived> derive_stages(const Scene& scene, const GrainFacts& facts);

/// Parts of a stage's path: 2 per cycle, 1 without cycles.
int path_parts(const Scene& stage);

/// Whether the engine must be told of the path when the stage starts, beyond what the stage's scene says.
bool path_needs_start(const Scene& stage);

/// One part of the path, as a loading of drives. `stress`: at the start of the stage, for what is held there.
template <int D>
LoadingSpec path_part(const Scene& stage, const Derived& derived, int part, const Mat<D>& stress);

extern template LoadingSpec path_part<2>(const Scene&, const Derived&, int, const Mat<2>&);
extern template LoadingSpec path_part<3>(const Scene&, const Derived&, int, const Mat<3>&);

}  // namespace galet
