// What the study of regimes varies: the rows of the chapter's last table, its columns, and the scenes of both.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "src/studies/study.hpp"

namespace galet::regimes {

enum class Regime { assembly, type_I, type_II, critical, dense, collisional };
inline constexpr int regime_count = 6;

/// The columns of the table.
struct State {
  double inertial_number = 0, stiffness_level = 0, restitution = 0, friction = 0;
  double rolling = 0;   ///< mu_R / d
  double cohesion = 0;  ///< eta
};
inline constexpr std::array<double State::*, 6> columns = {&State::inertial_number, &State::stiffness_level,
                                                           &State::restitution,     &State::friction,
                                                           &State::rolling,         &State::cohesion};
inline constexpr std::array<const char*, 6> column_names = {"I", "kappa", "e", "mu", "mu_R/d", "eta"};

struct RegimeRow {
  const char* name;
  std::string_view printed;  ///< its letters, by columns
  State reference, changed;  ///< one column at a time is taken from `changed`
};
RegimeRow regime_row(Regime regime, StudySize size);

/// What is measured in a regime, and the relative change that counts as an effect.
struct Quantity {
  const char* name;
  double threshold;
};
std::vector<Quantity> quantities_of(Regime regime);

/// Samples that a regime is run with: flows are averaged over time, the others over samples.
int samples_of(Regime regime, StudySize size);

/// Has the engine this cell? Strains of type I are those of contacts, which rigid grains don't have; between rigid
/// spheres there is no kappa to change.
bool has_cell(Regime regime, EngineKind engine, int column);

/// `column` < 0: the reference.
StudyRun regime_run(Regime regime, EngineKind engine, int column, int seed, StudySize size);

}  // namespace galet::regimes
