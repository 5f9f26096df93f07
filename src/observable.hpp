// The observables that a run measures, as columns of one table: the series of a run, its averages, its files and its
// checkpoint all walk this table. Units are the scene's own; signs are those of common/core/conventions.hpp.
#pragma once

#include <array>
#include <string_view>

namespace galet {

enum class Observable {
  time,
  strain,
  eps_xx,
  eps_yy,
  eps_zz,
  eps_v,
  sigma_xx,
  sigma_yy,
  sigma_zz,
  sigma_xy,
  sigma_xz,
  sigma_yz,
  mu_star,
  pressure,
  solid_fraction,
  z,
  z_star,
  rattler_fraction,
  mean_overlap,
  largest_overlap,
  peak_overlap,
  kinetic_per_grain,
  kinetic,
  rotational,
  cell,
  elastic_normal,
  elastic_tangential,
  elastic_rolling,
  cohesive,
  gravity,
  work,
  dissipated_viscous,
  dissipated_sliding,
  dissipated_unloading,
  dissipated_rolling,
  dissipated_pivoting,
  dissipated_relaxation,
  energy_residual,
  inertial_number,
  stiffness_level,
  anisotropy_contact,
  anisotropy_normal,
  anisotropy_tangential,
  anisotropy_branch,
  mobilised,
  sliding,
  temperature,
  rotational_temperature,
  unbalanced_force,
  unbalanced_torque,
  count
};

inline constexpr int observable_count = static_cast<int>(Observable::count);

/// What a row makes of the samples that were taken since the row before.
enum class Reduction {
  mean,     ///< their mean
  latest,   ///< the value of the latest one
  largest,  ///< the largest value
  derived   ///< computed from the other columns of the row
};

/// Where an observable is a column.
enum class Shown {
  always,
  in_3d,
  with_budget,  ///< only where md accounts for energy
  with_fabric,  ///< these only where output.measures asks for them
  with_friction,
  with_temperature,
  with_balance
};

struct ObservableInfo {
  std::string_view name;
  Reduction reduction;
  Shown shown;
  std::string_view meaning;
};

inline constexpr std::array<ObservableInfo, observable_count> observable_table = {{
    {"time", Reduction::latest, Shown::always, "simulated time"},
    {"strain", Reduction::latest, Shown::always, "shear strain, integral of L_xy"},
    {"eps_xx", Reduction::latest, Shown::always, "strain of the cell along x, - integral of L_xx: > 0 in compression"},
    {"eps_yy", Reduction::latest, Shown::always, "strain of the cell along y"},
    {"eps_zz", Reduction::latest, Shown::in_3d, "strain of the cell along z"},
    {"eps_v", Reduction::latest, Shown::always, "volume strain, ln(volume at the start / volume): > 0 in compression"},
    {"sigma_xx", Reduction::mean, Shown::always, "stress, positive in compression"},
    {"sigma_yy", Reduction::mean, Shown::always, "stress"},
    {"sigma_zz", Reduction::mean, Shown::in_3d, "stress"},
    {"sigma_xy", Reduction::mean, Shown::always, "stress"},
    {"sigma_xz", Reduction::mean, Shown::in_3d, "stress"},
    {"sigma_yz", Reduction::mean, Shown::in_3d, "stress"},
    {"mu_star", Reduction::derived, Shown::always, "|sigma_xy| / sigma_yy"},
    {"pressure", Reduction::derived, Shown::always, "mean normal stress, tr(sigma) / D"},
    {"Phi", Reduction::mean, Shown::always, "solid fraction"},
    {"z", Reduction::mean, Shown::always, "coordination number, all grains"},
    {"z_star", Reduction::mean, Shown::always, "coordination number without rattlers"},
    {"rattler_fraction", Reduction::mean, Shown::always, "share of the grains that carry no force network"},
    {"mean_overlap", Reduction::mean, Shown::always, "mean overlap of the contacts, in units of d"},
    {"largest_overlap", Reduction::mean, Shown::always,
     "largest overlap of a sample, in units of d; mean over the samples"},
    {"peak_overlap", Reduction::largest, Shown::always, "largest overlap of all samples, in units of d"},
    {"kinetic_per_grain", Reduction::mean, Shown::always, "kinetic energy of fluctuations and rotations per grain"},
    {"kinetic", Reduction::mean, Shown::always, "energy: translation fluctuations"},
    {"rotational", Reduction::mean, Shown::always, "energy: rotations"},
    {"cell", Reduction::mean, Shown::always, "energy: stress-driven motion of the cell"},
    {"elastic_normal", Reduction::mean, Shown::always, "energy: normal deflections"},
    {"elastic_tangential", Reduction::mean, Shown::always, "energy: tangential deflections"},
    {"elastic_rolling", Reduction::mean, Shown::always, "energy: rolling and pivoting springs"},
    {"cohesive", Reduction::mean, Shown::always, "energy: attraction of grains, zero out of its range"},
    {"gravity", Reduction::mean, Shown::always, "energy: gravity"},
    {"work", Reduction::latest, Shown::with_budget, "energy done on the sample by drives and moving planes so far"},
    {"dissipated_viscous", Reduction::latest, Shown::with_budget, "energy dissipated so far by dashpots"},
    {"dissipated_sliding", Reduction::latest, Shown::with_budget, "energy dissipated so far by sliding"},
    {"dissipated_unloading", Reduction::latest, Shown::with_budget,
     "tangential elastic energy given up so far while normal forces change (hertz)"},
    {"dissipated_rolling", Reduction::latest, Shown::with_budget, "energy dissipated so far by plastic rolling"},
    {"dissipated_pivoting", Reduction::latest, Shown::with_budget, "energy dissipated so far by plastic pivoting"},
    {"dissipated_relaxation", Reduction::latest, Shown::with_budget, "energy taken so far by relaxers"},
    {"energy_residual", Reduction::latest, Shown::with_budget,
     "all energy - that at the start - work + dissipated: the error of the budget"},
    {"I", Reduction::derived, Shown::always, "inertial number as realised"},
    {"kappa", Reduction::derived, Shown::always, "stiffness level as realised; none for rigid grains"},
    {"a_c", Reduction::mean, Shown::with_fabric, "anisotropy of contact directions along the stress"},
    {"a_n", Reduction::mean, Shown::with_fabric, "anisotropy of normal forces"},
    {"a_t", Reduction::mean, Shown::with_fabric, "anisotropy of tangential forces"},
    {"a_l", Reduction::mean, Shown::with_fabric, "anisotropy of branches, and of how they go with forces"},
    {"mobilised", Reduction::mean, Shown::with_friction, "mean of |F_T| / its bound over the contacts"},
    {"sliding", Reduction::mean, Shown::with_friction, "share of the contacts that slide"},
    {"T", Reduction::mean, Shown::with_temperature, "granular temperature, an energy"},
    {"T_rot", Reduction::mean, Shown::with_temperature, "granular temperature of rotations"},
    {"unbalanced_force", Reduction::mean, Shown::with_balance, "mean resultant on a grain / mean contact force"},
    {"unbalanced_torque", Reduction::mean, Shown::with_balance,
     "mean torque on a grain / mean contact force times d/2"},
}};

inline const ObservableInfo& info(Observable observable) { return observable_table[static_cast<int>(observable)]; }

/// One value of each observable: a sample at an instant, or a row of a series. NaN where an observable has no meaning.
struct Measurement {
  std::array<double, observable_count> values{};
  double& operator[](Observable observable) { return values[static_cast<int>(observable)]; }
  double operator[](Observable observable) const { return values[static_cast<int>(observable)]; }
  bool operator==(const Measurement&) const = default;
};

}  // namespace galet
