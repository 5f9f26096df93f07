// Scenes of flows whose stress is not uniform, as TOML text, and what the profile of such a run says. The material is
// that of ShearScene (templates.hpp).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/measure/block_average.hpp"
#include "common/measure/profile.hpp"
#include "src/studies/study.hpp"

namespace galet {

/// A layer of disks on a floor of glued ones, in a cell periodic along the slope. Units: d = m = g = 1.
struct SlopeScene {
  std::string title;
  EngineKind engine = EngineKind::md;
  int grains = 2000;
  double length = 40;          ///< of the floor
  double angle = 20;           ///< of the slope, degrees
  double stiffness = 2e5;      ///< K_N in units of m g / d; ignored by rigid grains
  double duration = 600;       ///< of the run; the second half is averaged
  double cd_dt_factor = 0.01;  ///< of sqrt(d / g)
};
std::string slope_scene(const SlopeScene& scene);

/// Disks in an annulus between two rings of glued ones: the inner one turns, the outer one is cut into arcs that move
/// along their radius under P. Units: d = m = P = 1.
struct AnnulusScene {
  std::string title;
  EngineKind engine = EngineKind::md;
  int seed = 1;
  double inner_radius = 24;
  double gap = 24;               ///< outer less inner radius
  double surface_speed = 1;      ///< of the inner ring
  double stiffness_level = 1e4;  ///< ignored by rigid grains
  double duration = 200;         ///< of the run; averages leave the first 0.4 out
  double cd_dt_factor = 0.01;    ///< of the inertial time
};
std::string annulus_scene(const AnnulusScene& scene);

/// Plane shear between two walls of glued disks in a cell periodic along them: the lower one stands, the upper one
/// moves at a speed and is pressed down by P. Dense start. Units: d = m = P = 1.
struct WallShearScene {
  std::string title;
  EngineKind engine = EngineKind::md;
  int grains = 2000;
  double length = 44;            ///< of the walls
  double inertial_number = 0.1;  ///< of the wall's speed over the distance of the walls
  double stiffness_level = 1e4;  ///< ignored by rigid grains
  double duration = 2000;        ///< of the run; the second half is averaged
  double cd_dt = 0.01;           ///< in inertial times
};
std::string wall_shear_scene(const WallShearScene& scene);

/// What a layer or ring has: |shear stress| / normal stress across it, I of that normal stress, Phi.
struct LocalState {
  double position = 0, mu_star = 0, inertial_number = 0, solid_fraction = 0;
  double moment = 0;  ///< shear stress times position^2
};
/// Of layers along y: stress_xy, stress_yy, d v_x / dy.
std::vector<LocalState> layer_states(const std::vector<ProfileRow>& profile);
/// Of rings: stress_theta,r, stress_rr, shear rate along theta.
std::vector<LocalState> ring_states(const std::vector<ProfileRow>& profile);

/// Mean over layers; its error is the scatter of single layers, not that of their mean: they fluctuate together. NaN of
/// fewer than three.
Estimate mean_over(std::span<const LocalState> layers, double LocalState::*quantity);

/// The value of an observable at the inertial number I, on straight lines between the homogeneous flows (in I, the
/// realised one); NaN outside of them.
Estimate homogeneous_at(const std::vector<const StudyRow*>& flows, double inertial_number, Observable observable);

/// A local quantity at the inertial number I, on straight lines in ln I between neighbouring states; the first pair
/// that I lies between. NaN when there is none.
double local_at(std::span<const LocalState> states, double inertial_number, double LocalState::*quantity);

}  // namespace galet
