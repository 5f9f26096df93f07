// What the scenes of all studies begin with, as TOML text: title, units, engine, grains, and the first lines of
// [material]. What follows belongs to a study: further lines of [material], then the sections of its own.
#pragma once

#include <string>

#include "common/scene/scene.hpp"

namespace galet {

inline constexpr const char* disks_20 = R"({distribution = "uniform", mean = 1.0, spread = 0.2})";  ///< +-20 %
inline constexpr const char* equal_grains = "1.0";
/// Units of the scenes whose pressure is one.
inline constexpr const char* units_of_pressure = "d = m = P = 1; the unit of time is the inertial time";

struct SceneHead {
  std::string title;
  EngineKind engine = EngineKind::md;
  int dimension = 2;
  int seed = 1;
  std::string units = units_of_pressure;  ///< of which everything else is a number
  int grains = 1000;
  std::string diameter = disks_20;
  double friction = 0.4, restitution = 0.1;
};
std::string scene_head(const SceneHead& head);

/// Steps per contact of md where its runs are long: means of flows and packings at rest don't tell them from the
/// default, 50 (docs/theory.md).
inline constexpr int sparing_steps = 30;
/// Disks of the full size of most studies: the least of the chapter's flows (sec. cishom: 1000 to 5000).
inline constexpr int full_size_disks = 1000;
/// The section [md] of a scene of md with so many steps per contact; empty for cd, and for 0: the default.
std::string md_section(EngineKind engine, int contact_steps);

}  // namespace galet
