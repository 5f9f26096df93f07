// The soft-sphere engine: finite stiffness, contact forces from deflections (md).
#pragma once

#include <memory>

#include "common/engine/engine.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet::md {

/// The md engine of a scene, in the layout `derived.layout`, starting from `sample`.
/// Throws InputError when the scene says nothing about stiffness, or when the time step is above its stability
/// bound and the scene does not allow that.
template <int D>
std::unique_ptr<Engine<D>> make_engine(const Scene& scene, const Derived& derived, const Sample<D>& sample);

extern template std::unique_ptr<Engine<2>> make_engine<2>(const Scene&, const Derived&, const Sample<2>&);
extern template std::unique_ptr<Engine<3>> make_engine<3>(const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet::md
