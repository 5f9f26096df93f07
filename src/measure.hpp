// One sample of a running engine: every column of observable.hpp at the end of the last step.
#pragma once

#include <optional>

#include "common/engine/engine.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/measure_names.hpp"
#include "src/observable.hpp"

namespace galet {

/// What the dimensionless numbers are referred to, for one scene and engine.
struct MeasureScale {
  int dimension = 2;
  bool friction = false;
  double diameter = 1;         ///< d, mean
  double mass = 1;             ///< m, of a grain of mean diameter
  double shear_rate = 0;       ///< L_xy imposed; 0 without shear
  std::optional<PairLaw> law;  ///< of [material], for kappa; none for rigid grains
  double energy_at_start = 0;  ///< total energy that the budget starts from
  MeasureSet asked;            ///< by output.measures
  bool si = false;             ///< the scene is in SI units
  Vec<3> gravity = Vec<3>::Zero();
  std::vector<char> held;  ///< 1 for a grain that is glued to a rigid body; empty: none is
};

MeasureScale measure_scale(const Derived& derived, bool rigid);

template <int D>
Measurement measure(Engine<D>& engine, const MeasureScale& scale);

/// Fills the columns that follow from the stress of `row`: mu*, pressure, I and kappa.
void complete(Measurement& row, const MeasureScale& scale);

extern template Measurement measure<2>(Engine<2>&, const MeasureScale&);
extern template Measurement measure<3>(Engine<3>&, const MeasureScale&);

}  // namespace galet
