// Every layout of the md engine is compiled here, and only here.
#include <fmt/format.h>

#include "md/engine.hpp"
#include "md/soft_engine.hpp"

namespace galet::md {

namespace {

void check_step(const Scene& scene, const Derived& derived) {
  if (!derived.soft)
    throw InputError("the md engine needs a stiffness: give material.stiffness_level or material.normal_stiffness");
  if (*derived.md_dt > *derived.md_dt_stable && !scene.md.allow_unsafe_dt)
    throw InputError(
        fmt::format("md.dt = {:.6g} is above the stability bound {:.6g}; choose a smaller step, or set "
                    "md.allow_unsafe_dt = true to run all the same",
                    *derived.md_dt, *derived.md_dt_stable));
}

}  // namespace

template <int D>
std::unique_ptr<Engine<D>> make_engine(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
  check_step(scene, derived);
  if (derived.layout.friction) return std::make_unique<SoftEngine<Layout{D, true}>>(scene, derived, sample);
  return std::make_unique<SoftEngine<Layout{D, false}>>(scene, derived, sample);
}

template std::unique_ptr<Engine<2>> make_engine<2>(const Scene&, const Derived&, const Sample<2>&);
template std::unique_ptr<Engine<3>> make_engine<3>(const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet::md
