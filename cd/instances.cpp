// Every layout of the cd engine is compiled here, and only here.
#include "cd/engine.hpp"
#include "cd/rigid_engine.hpp"

namespace galet::cd {

template <int D>
std::unique_ptr<Engine<D>> make_engine(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
  if (derived.layout.friction) return std::make_unique<RigidEngine<Layout{D, true}>>(scene, derived, sample);
  return std::make_unique<RigidEngine<Layout{D, false}>>(scene, derived, sample);
}

template std::unique_ptr<Engine<2>> make_engine<2>(const Scene&, const Derived&, const Sample<2>&);
template std::unique_ptr<Engine<3>> make_engine<3>(const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet::cd
