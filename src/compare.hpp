// The comparison of the two engines on one scene: for each inertial number, md at each stiffness level and cd at
// each (time step, tolerance); from the rows the rigid limit, and how far each row is from it at which cost.
//
// Every row is a whole simulation on one thread (its cost is the processor time of that thread); `jobs` rows run
// side by side. A gas that the scene compresses first is compressed once for each set of engine parameters, and
// is no part of a row's cost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/measure/block_average.hpp"
#include "common/measure/profile.hpp"
#include "common/scene/scene.hpp"
#include "src/rigid_limit.hpp"
#include "src/run_result.hpp"
#include "src/side_by_side.hpp"

namespace galet {

/// One run that is to be made.
struct PlannedRow {
  EngineKind engine = EngineKind::md;
  std::optional<double> inertial_number;  ///< absent: the scene's own shear rate, or none
  std::optional<double> stiffness_level;  ///< md
  std::optional<double> dt_factor;        ///< cd; absent when the scene gives cd.dt itself
  std::optional<double> tolerance;        ///< cd
  bool reference = false;  ///< the stiffest md row or the finest cd row of the first state: its last state is drawn
  Scene scene;             ///< with all this put in
};

struct CompareRow {
  PlannedRow plan;
  Ending ending = Ending::finished;
  std::string failure;
  std::vector<std::string> notes;
  double dt = 0;
  long steps = 0;
  double time = 0, strain = 0;
  Estimate mu_star, solid_fraction, z;
  double inertial_number = 0;   ///< as realised; NaN without shear
  double stiffness_level = 0;   ///< as realised; NaN for rigid grains
  double pressure = 0;          ///< sigma_yy in shear, else the mean normal stress; mean
  double peak_penetration = 0;  ///< largest overlap of all averaged samples, units of d
  double mean_penetration = 0;  ///< mean over them of their largest overlap, units of d
  double seconds = 0;           ///< processor time of the run
  double cost = 0;              ///< the same per unit strain (per unit time without shear)
  SolverSummary solver;
  TimeSeries series;
  std::string picture;              ///< reference rows in 2D: SVG text of the last state
  std::vector<ProfileRow> profile;  ///< reference rows: across the last state
  bool usable() const { return ending != Ending::interrupted && ending != Ending::failed; }
};

/// What the rows at one inertial number say together.
struct StateLimit {
  std::optional<double> inertial_number;
  RigidLimit mu_star, solid_fraction, z;
};

struct Comparison {
  std::vector<CompareRow> rows;    ///< in the order of the plan; without those that were interrupted
  std::vector<StateLimit> limits;  ///< of the states that have usable rows
  std::vector<std::string> notes;
  bool shear = false;  ///< costs are per unit strain
  bool shortened = false;
  bool interrupted = false;
  int jobs = 1;
  double wall_seconds = 0;
};

/// The rows of a comparison. A scene that says nothing about stiffness has cd rows only.
std::vector<PlannedRow> compare_plan(const Scene& scene);

/// A version of the scene that is compared within two minutes: at most 400 grains, one
/// inertial number, two stiffness levels, two time steps, one tolerance, strain 30.
Scene shortened(const Scene& scene);

Comparison compare(const Scene& scene, const SideBySideOptions& options);

/// The limits of the usable rows, state by state (a part of compare()).
std::vector<StateLimit> state_limits(const std::vector<CompareRow>& rows);

}  // namespace galet
