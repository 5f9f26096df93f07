// The observables that a run measures, as columns of one table: the series of a run, its averages, its files and its
// checkpoint all walk this table. Units are the scene's own; signs are those of common/core/conventions.hpp.
#pragma once

#include <array>
#include <string_view>

namespace galet {

enum class Observable {
  time,
  strain,
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
  gravity,
  inertial_number,
  stiffness_level,
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

struct ObservableInfo {
  std::string_view name;
  Reduction reduction;
  bool only_3d;
  std::string_view meaning;
};

inline constexpr std::array<ObservableInfo, observable_count> observable_table = {{
    {"time", Reduction::latest, false, "simulated time"},
    {"strain", Reduction::latest, false, "shear strain, L_xy times time; 0 without imposed shear"},
    {"sigma_xx", Reduction::mean, false, "stress, positive in compression"},
    {"sigma_yy", Reduction::mean, false, "stress"},
    {"sigma_zz", Reduction::mean, true, "stress"},
    {"sigma_xy", Reduction::mean, false, "stress"},
    {"sigma_xz", Reduction::mean, true, "stress"},
    {"sigma_yz", Reduction::mean, true, "stress"},
    {"mu_star", Reduction::derived, false, "|sigma_xy| / sigma_yy"},
    {"pressure", Reduction::derived, false, "mean normal stress, tr(sigma) / D"},
    {"Phi", Reduction::mean, false, "solid fraction"},
    {"z", Reduction::mean, false, "coordination number, all grains"},
    {"z_star", Reduction::mean, false, "coordination number without rattlers"},
    {"rattler_fraction", Reduction::mean, false, "share of the grains that carry no force network"},
    {"mean_overlap", Reduction::mean, false, "mean overlap of the contacts, in units of d"},
    {"largest_overlap", Reduction::mean, false, "largest overlap of a sample, in units of d; mean over the samples"},
    {"peak_overlap", Reduction::largest, false, "largest overlap of all samples, in units of d"},
    {"kinetic_per_grain", Reduction::mean, false, "kinetic energy of fluctuations and rotations per grain"},
    {"kinetic", Reduction::mean, false, "energy: translation fluctuations"},
    {"rotational", Reduction::mean, false, "energy: rotations"},
    {"cell", Reduction::mean, false, "energy: stress-driven motion of the cell"},
    {"elastic_normal", Reduction::mean, false, "energy: normal deflections"},
    {"elastic_tangential", Reduction::mean, false, "energy: tangential deflections"},
    {"gravity", Reduction::mean, false, "energy: gravity"},
    {"I", Reduction::derived, false, "inertial number as realised"},
    {"kappa", Reduction::derived, false, "stiffness level as realised; none for rigid grains"},
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
