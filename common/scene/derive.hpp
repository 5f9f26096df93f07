// What follows from a scene: the numbers that a user did not write, each from a stated formula. `galet describe`
// prints them; both engines are built from them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/layout.hpp"
#include "common/scene/pair_law.hpp"
#include "common/scene/restitution.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Largest speed of a cylinder's surface.
double surface_speed(const CylinderSpec& cylinder);

/// The facts about the grains that a derivation needs.
struct GrainFacts {
  int count = 0;
  double mean_diameter = 1;  ///< d
  double least_diameter = 1;
  double largest_diameter = 1;
  double mean_mass = 1;             ///< m, mass of a grain of mean diameter
  double least_mass = 1;            ///< of the grains, and what rigid bodies offer each of their grains' contacts
  double largest_speed = 0;         ///< at the start
  double largest_acceleration = 0;  ///< that forces and torques give to grains of rigid bodies
};

template <int D>
GrainFacts grain_facts(const Scene& scene, const Sample<D>& sample);

struct Derived {
  Layout layout{2, false};
  GrainFacts grains;
  LawTable laws;                          ///< of each pair of materials
  std::optional<double> pressure;         ///< P
  std::optional<double> stiffness_level;  ///< kappa of [material]
  std::optional<double> shear_rate;
  std::optional<double> compression_rate;   ///< axial, > 0 shortens
  std::optional<double> inertial_number;    ///< I = rate sqrt(m / (P d^(D-2))), shear or axial rate
  std::optional<double> inertial_time;      ///< tau_i = sqrt(m / (P d^(D-2)))
  std::optional<double> contact_stiffness;  ///< K_N of a typical contact (hertz: at the deflection expected)
  std::optional<double> collision_time;     ///< tau_c of two grains of mean mass with that stiffness
  std::optional<double> md_dt;              ///< time step of md
  std::optional<double> md_dt_stable;       ///< its stability bound
  double md_stiffest = 0;                   ///< K_N that the bound allows for
  double md_most_neighbours = 0;            ///< of the lightest grain, for which md_dt is stable
  double cd_dt = 0;
  std::string cd_dt_from;  ///< where it comes from, in words
  double duration = 0;     ///< simulated time of the run
};

/// Throws InputError when the scene lacks what the derivation needs (e.g. a duration). Of a scene with stages: its
/// first stage, but for the duration, which is that of all (stages.hpp).
Derived derive(const Scene& scene, const GrainFacts& facts);

/// The drives of the scene's loading as modes of the cell (initial rates set; default inertia from the sample).
template <int D>
std::vector<CellMode<D>> cell_modes(const Scene& scene, const Derived& derived, const Sample<D>& sample);
/// The same for grains of that total mass in a cell of that volume.
template <int D>
std::vector<CellMode<D>> cell_modes(const Scene& scene, const Derived& derived, double mass, double volume);

/// (symbol, value with unit, where it comes from), in reading order: what `galet describe` prints.
struct DerivedLine {
  std::string symbol;
  std::string value;
  std::string from;
};
std::vector<DerivedLine> explain(const Scene& scene, const Derived& derived);

extern template GrainFacts grain_facts<2>(const Scene&, const Sample<2>&);
extern template GrainFacts grain_facts<3>(const Scene&, const Sample<3>&);
extern template std::vector<CellMode<2>> cell_modes<2>(const Scene&, const Derived&, const Sample<2>&);
extern template std::vector<CellMode<3>> cell_modes<3>(const Scene&, const Derived&, const Sample<3>&);
extern template std::vector<CellMode<2>> cell_modes<2>(const Scene&, const Derived&, double, double);
extern template std::vector<CellMode<3>> cell_modes<3>(const Scene&, const Derived&, double, double);

}  // namespace galet
