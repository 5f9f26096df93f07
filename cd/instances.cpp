// Every layout of the cd engine is compiled here, and only here.
#include "cd/engine.hpp"
#include "cd/rigid_engine.hpp"
#include "common/core/error.hpp"

namespace galet::cd {

template <int D>
std::unique_ptr<Engine<D>> make_engine(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
  for (const PairLaw& law : derived.laws.pairs)
    if (law.cohesion > 0 && law.cohesion_law == CohesionLaw::square_root)
      throw InputError(
          "the cd engine has the cohesion law \"constant\" only: the square root is one of the deflection");
  if (derived.layout.rolling) return std::make_unique<RigidEngine<Layout{D, true, true}>>(scene, derived, sample);
  if (derived.layout.friction) return std::make_unique<RigidEngine<Layout{D, true}>>(scene, derived, sample);
  return std::make_unique<RigidEngine<Layout{D, false}>>(scene, derived, sample);
}

template std::unique_ptr<Engine<2>> make_engine<2>(const Scene&, const Derived&, const Sample<2>&);
template std::unique_ptr<Engine<3>> make_engine<3>(const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet::cd
