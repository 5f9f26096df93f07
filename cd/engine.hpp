// The rigid-grain engine: nonsmooth contact dynamics (cd).
#pragma once

#include <memory>

#include "common/engine/engine.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet::cd {

/// The cd engine of a scene, in the layout `derived.layout`, starting from `sample`.
template <int D>
std::unique_ptr<Engine<D>> make_engine(const Scene& scene, const Derived& derived, const Sample<D>& sample);

extern template std::unique_ptr<Engine<2>> make_engine<2>(const Scene&, const Derived&, const Sample<2>&);
extern template std::unique_ptr<Engine<3>> make_engine<3>(const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet::cd
