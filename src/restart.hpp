// What a checkpoint holds besides the engine's own columns, so that the file alone is enough to go on: the text of
// the scene with the changes made to it, the engine's name, and the sample that the engine was built from.
#pragma once

#include <vector>

#include "common/core/archive.hpp"
#include "common/io/scene_file.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Stores scene.source and the overrides. A scene built in code has no text; then only code can resume it.
void save_scene(Archive& archive, const Scene& scene, EngineKind kind, const std::vector<Override>& overrides);

/// The overrides that were stored.
std::vector<Override> stored_overrides(const Archive& archive);

/// The engine that wrote the checkpoint.
EngineKind stored_engine(const Archive& archive);

/// Reads the stored scene again, with the stored overrides and then `more`. A resumed run keeps its scene, so `more`
/// may only change how long it runs, what it writes and when it is stopped: fields of [run], [output] and [guard].
/// Throws InputError when it changes more, or when the checkpoint has no scene text.
Scene stored_scene(const Archive& archive, const std::vector<Override>& more = {});

/// `fresh`, the state of an engine that has just been started at the grains of the checkpoint `state`, with the
/// contacts of that checkpoint and what they remember. Throws InputError when they are of another engine or of other
/// laws.
Archive with_contacts_of(Archive fresh, EngineKind kind, const Archive& state);

template <int D>
void save_sample(Archive& archive, const Sample<D>& sample);

template <int D>
Sample<D> stored_sample(const Archive& archive);

extern template void save_sample<2>(Archive&, const Sample<2>&);
extern template void save_sample<3>(Archive&, const Sample<3>&);
extern template Sample<2> stored_sample<2>(const Archive&);
extern template Sample<3> stored_sample<3>(const Archive&);

}  // namespace galet
