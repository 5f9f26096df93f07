// The two engines behind one name.
#pragma once

#include <memory>
#include <string>

#include "common/engine/engine.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

std::string engine_name(EngineKind kind);

/// "md" or "cd"; throws InputError for anything else.
EngineKind engine_kind(const std::string& name);

template <int D>
std::unique_ptr<Engine<D>> make_engine(EngineKind kind, const Scene& scene, const Derived& derived,
                                       const Sample<D>& sample);

extern template std::unique_ptr<Engine<2>> make_engine<2>(EngineKind, const Scene&, const Derived&, const Sample<2>&);
extern template std::unique_ptr<Engine<3>> make_engine<3>(EngineKind, const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet
