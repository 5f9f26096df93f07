#include "src/engines.hpp"

#include "cd/engine.hpp"
#include "common/core/error.hpp"
#include "md/engine.hpp"

namespace galet {

std::string engine_name(EngineKind kind) { return kind == EngineKind::md ? "md" : "cd"; }

EngineKind engine_kind(const std::string& name) {
  if (name == "md") return EngineKind::md;
  if (name == "cd") return EngineKind::cd;
  throw InputError("there is no engine '" + name + "': take md (soft spheres) or cd (rigid grains)");
}

template <int D>
std::unique_ptr<Engine<D>> make_engine(EngineKind kind, const Scene& scene, const Derived& derived,
                                       const Sample<D>& sample) {
  if (kind == EngineKind::md)
    for (const Plane<D>& plane : sample.planes)
      if (plane.inverse_mass > 0)
        throw InputError("planes with a mass need engine cd: those of md have imposed velocities");
  return kind == EngineKind::md ? md::make_engine<D>(scene, derived, sample)
                                : cd::make_engine<D>(scene, derived, sample);
}

template std::unique_ptr<Engine<2>> make_engine<2>(EngineKind, const Scene&, const Derived&, const Sample<2>&);
template std::unique_ptr<Engine<3>> make_engine<3>(EngineKind, const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet
