// Every layout of the md engine is compiled here, and only here.
#include <fmt/format.h>

#include "md/engine.hpp"
#include "md/soft_engine.hpp"

namespace galet::md {

namespace {

void check_step(const Scene& scene, const Derived& derived) {
  if (!derived.laws.stiff)
    throw InputError(
        scene.material.normal_law == NormalLaw::hertz
            ? "the md engine needs a stiffness: give material.young_modulus or material.stiffness_level"
            : "the md engine needs a stiffness: give material.stiffness_level or material.normal_stiffness");
  if (!derived.md_dt)
    throw InputError("md.dt is needed: no pressure, weight or speed in the scene tells how deep Hertz contacts get");
  if (derived.md_dt_stable && *derived.md_dt > *derived.md_dt_stable && !scene.md.allow_unsafe_dt)
    throw InputError(
        fmt::format("md.dt = {:.6g} is above the stability bound {:.6g}; choose a smaller step, or set "
                    "md.allow_unsafe_dt = true to run all the same",
                    *derived.md_dt, *derived.md_dt_stable));
}

/// Width of the cell across each periodic direction: a longer range would let a grain act on itself.
template <int D>
void check_range(const Derived& derived, const Sample<D>& sample) {
  const double range = derived.laws.cohesion_range();
  const Mat<D> across = sample.cell.box.inverse();
  for (int a = 0; a < D; ++a) {
    const double width = 1 / across.row(a).norm();
    if (sample.cell.periodic[a] && !(range + derived.grains.largest_diameter < width))
      throw InputError(fmt::format(
          "material.cohesion_range = {:.6g} is too long for the cell: with the largest diameter {:.6g} it must stay "
          "below the cell's width, {:.6g}",
          range, derived.grains.largest_diameter, width));
  }
}

}  // namespace

template <int D>
std::unique_ptr<Engine<D>> make_engine(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
  check_step(scene, derived);
  if (derived.laws.cohesion_range() > 0) check_range<D>(derived, sample);
  if (derived.layout.rolling) return std::make_unique<SoftEngine<Layout{D, true, true}>>(scene, derived, sample);
  if (derived.layout.friction) return std::make_unique<SoftEngine<Layout{D, true}>>(scene, derived, sample);
  return std::make_unique<SoftEngine<Layout{D, false}>>(scene, derived, sample);
}

template std::unique_ptr<Engine<2>> make_engine<2>(const Scene&, const Derived&, const Sample<2>&);
template std::unique_ptr<Engine<3>> make_engine<3>(const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet::md
