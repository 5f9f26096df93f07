// Every layout of the cd engine is compiled here, and only here.
#include "cd/engine.hpp"
#include "cd/rigid_engine.hpp"
#include "common/core/error.hpp"

namespace galet::cd {

namespace {

/// What the rigid engine has no law for yet is refused: it is never left out silently.
void check_laws(const Derived& derived) {
  std::string missing;
  const auto name = [&](bool present, const char* what) {
    if (present) missing += (missing.empty() ? "" : ", ") + std::string(what);
  };
  bool cohesive = false;
  for (const PairLaw& law : derived.laws.pairs) cohesive = cohesive || law.cohesion > 0;
  name(derived.layout.rolling, "rolling or pivoting resistance");
  name(cohesive, "cohesion");
  name(derived.laws.materials > 1, "several materials");
  if (!missing.empty())
    throw InputError("the cd engine has no laws yet for: " + missing + "; run this scene with engine md");
}

}  // namespace

template <int D>
std::unique_ptr<Engine<D>> make_engine(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
  check_laws(derived);
  if (derived.layout.friction) return std::make_unique<RigidEngine<Layout{D, true}>>(scene, derived, sample);
  return std::make_unique<RigidEngine<Layout{D, false}>>(scene, derived, sample);
}

template std::unique_ptr<Engine<2>> make_engine<2>(const Scene&, const Derived&, const Sample<2>&);
template std::unique_ptr<Engine<3>> make_engine<3>(const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet::cd
