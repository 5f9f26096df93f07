// The state in a checkpoint as the start of another scene.
#pragma once

#include "common/core/archive.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// The checkpoint that initial.file names. Throws InputError as read_checkpoint does.
Archive initial_checkpoint(const Scene& scene);

/// Its grains where they are now, with their velocities, in their cell at rest (strain 0, rate 0). No planes. Throws
/// InputError when it is of another dimension or holds rigid bodies.
template <int D>
Sample<D> checkpoint_sample(const Archive& archive);

extern template Sample<2> checkpoint_sample<2>(const Archive&);
extern template Sample<3> checkpoint_sample<3>(const Archive&);

}  // namespace galet
