// The rigid limit of a quantity q (mu*, Phi, z), from runs of both engines at finite numerical parameters.
//   md   q = q_md + slope kappa^-power, least squares with weights 1/error^2; the limit is kappa -> infinity. The mean
//        deflection is h/d ~ 1/kappa (chapter, sec. anadim): power 1 is the leading order of what is smooth in h (mu*,
//        Phi). The coordination number is not: a collision counts as a contact for its duration, which goes as
//        kappa^-1/2, and near jamming the excess contacts go as sqrt(h). For z the power is 1/2.
//   cd   q = q_cd + slope * dt, from the rows with the tightest tolerance; the limit is dt -> 0 (the time stepping is
//        of first order). The tolerance has no known law: a second tolerance gives its own limit q', and
//        systematic^2 = max(0, (q_cd - q')^2 - (error^2 + error'^2)): what noise doesn't explain of the difference.
//   line        a limit stands only if the runs lie on the line: with runs to spare, chi^2 <= 9 per spare run (three
//        standard errors). z in a flow often does not: an instant counts every collision that is under way, for as long
//        as it lasts (md) or as the step is (cd), and z falls with the logarithm of that time, without a limit to see.
//   agreement   |q_md - q_cd| <= 2 sqrt(error_md^2 + error_cd^2); not judged when a limit does not stand
//   combined    mean of the limits that stand, with weights 1/error^2; NaN when there are two and neither stands
// A single run is not extrapolated: its value stands for the limit, and `runs` says so. Errors are standard errors;
// an error of 0 means "unknown". Pure functions.
#pragma once

#include <optional>
#include <span>

#include "common/measure/block_average.hpp"
#include "src/line_fit.hpp"

namespace galet {

struct MdRun {
  double stiffness_level = 0;  ///< kappa
  Estimate value;
};

struct CdRun {
  double dt = 0;
  double tolerance = 0;
  Estimate value;
};

/// The limit that one engine's runs tend to.
struct EngineLimit {
  Estimate value;         ///< error: statistical and systematic parts together
  Estimate slope;         ///< per kappa^-power (md) or per dt (cd)
  double systematic = 0;  ///< cd: part of the error that comes from the tolerance
  int runs = 0;           ///< in the fit; 1: not extrapolated
  bool on_line = true;    ///< the runs lie on the line within their errors; otherwise the value is no limit
};

/// None without runs. `power`: see above.
std::optional<EngineLimit> md_limit(std::span<const MdRun> runs, double power = 1);
std::optional<EngineLimit> cd_limit(std::span<const CdRun> runs);

struct RigidLimit {
  std::optional<EngineLimit> md, cd;
  Estimate combined;                   ///< of the limits that exist
  std::optional<Estimate> difference;  ///< md - cd, when both exist
  std::optional<bool> agree;           ///< within two standard errors of the difference
};

/// Runs whose value is not finite are left out; without any run the combined limit is NaN.
RigidLimit rigid_limit(std::span<const MdRun> md, std::span<const CdRun> cd, double power = 1);

/// Deviation of one run from the rigid limit, with the error of the difference (the two are taken as independent).
Estimate deviation(const Estimate& value, const Estimate& limit);

}  // namespace galet
