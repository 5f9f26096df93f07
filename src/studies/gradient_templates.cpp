#include "src/studies/gradient_templates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "src/studies/scene_head.hpp"

namespace galet {

namespace {

constexpr double area_of_a_grain = 0.796;  ///< mean of pi d^2 / 4, diameters uniform in [0.8, 1.2]

std::string gradient_head(const std::string& title, EngineKind engine, int seed, const std::string& units, int grains) {
  return scene_head({title, engine, 2, seed, units, grains}) + "tangential_stiffness_ratio = 0.5\n";
}

std::string numerics(EngineKind engine, double cd_dt_factor) {
  return engine == EngineKind::md ? md_section(engine, sparing_steps)
                                  : fmt::format("\n[cd]\ntolerance = 1e-3\ndt_factor = {}\n", cd_dt_factor);
}

}  // namespace

std::string slope_scene(const SlopeScene& scene) {
  const double depth = scene.grains * area_of_a_grain / (0.8 * scene.length);
  const double height = std::ceil(2.2 * depth + 6);  // a gas has to find room
  std::string text =
      gradient_head(scene.title, scene.engine, 1, "d = m = g = 1; the unit of time is sqrt(d / g)", scene.grains);
  text += fmt::format(R"(normal_stiffness = {}

[initial]
kind = "gas"

[cell]
size = [{}, {}]
periodic = [true, false]

[[body]]
name = "floor"
shape = "wall"
at = 0.5

[loading]
gravity = [0.0, -1.0]
inclination = {}
)",
                      scene.stiffness, scene.length, height, scene.angle);
  text += numerics(scene.engine, scene.cd_dt_factor);
  return text + fmt::format(
                    "\n[run]\nduration = {}\naverage_from = 0.5\nsamples = 2000\n\n"
                    "[output]\nmeasures = [\"profile\"]\nprofile_layers = {}\n",
                    scene.duration, height);
}

std::string annulus_scene(const AnnulusScene& scene) {
  const double inner = scene.inner_radius, outer = inner + scene.gap, middle = outer + 2;
  // The rings' own grains take half a diameter on either side; the dense start fills the rest.
  const double room = std::numbers::pi * (std::pow(outer - 0.5, 2) - std::pow(inner + 0.5, 2));
  const int grains = static_cast<int>(0.785 * room / area_of_a_grain);
  std::string text = gradient_head(scene.title, scene.engine, scene.seed, units_of_pressure, grains);
  text += fmt::format(R"(stiffness_level = {0}

[initial]
kind = "dense"

[cell]
size = [{1}, {1}]
periodic = [false, false]

[[body]]
name = "inner"
shape = "ring"
centre = [{2}, {2}]
radius = {3}
grains = "outside"
spin = {4:.6g}

[[body]]
name = "outer"
shape = "ring"
centre = [{2}, {2}]
radius = {5}
segments = {6}
pressure = 1.0
mass = 20.0

[loading]
pressure = 1.0
)",
                      scene.stiffness_level, 2 * middle, middle, inner, scene.surface_speed / inner, outer,
                      static_cast<int>(std::lround(outer)));
  text += numerics(scene.engine, scene.cd_dt_factor);
  return text + fmt::format(R"(
[run]
duration = {0}
average_from = 0.4
samples = 1000

[output]
measures = ["profile"]
profile_layers = {1}
profile_centre = [{2}, {2}]
profile_radii = [{3}, {4}]
)",
                            scene.duration, std::lround(scene.gap), middle, inner, outer);
}

std::string wall_shear_scene(const WallShearScene& scene) {
  // Between the centres of the walls: the disks at the density of the dense start, and half a diameter of either wall.
  const double distance = scene.grains * area_of_a_grain / (0.785 * scene.length) + 1;
  const double height = std::ceil(1.15 * distance + 2);  // flow dilates
  std::string text = gradient_head(scene.title, scene.engine, 1, units_of_pressure, scene.grains);
  text += fmt::format(R"(stiffness_level = {0}

[initial]
kind = "dense"

[cell]
size = [{1}, {2}]
periodic = [true, false]

[[body]]
name = "lower wall"
shape = "wall"
at = 0.5

[[body]]
name = "upper wall"
shape = "wall"
at = {3:.6g}
velocity = [{4:.6g}, 0.0]
free = [false, true]
force = [0.0, {5}]

[loading]
pressure = 1.0
)",
                      scene.stiffness_level, scene.length, height, 0.5 + distance, scene.inertial_number * distance,
                      -scene.length);
  // The default step of cd follows the fastest grains at the start, which are those of the wall.
  text += scene.engine == EngineKind::md ? md_section(scene.engine, sparing_steps)
                                         : fmt::format("\n[cd]\ntolerance = 1e-3\ndt = {}\n", scene.cd_dt);
  return text + fmt::format(
                    "\n[run]\nduration = {}\naverage_from = 0.5\nsamples = 2000\n\n"
                    "[output]\nmeasures = [\"profile\"]\nprofile_layers = {}\n",
                    scene.duration, height);
}

std::vector<LocalState> layer_states(const std::vector<ProfileRow>& profile) {
  std::vector<LocalState> states;
  for (const ProfileRow& row : profile)
    states.push_back({row.position, std::abs(row.stress(0, 1)) / row.stress(1, 1),
                      std::abs(row.shear_rate.x()) / std::sqrt(row.stress(1, 1)), row.solid_fraction, 0});
  return states;
}

std::vector<LocalState> ring_states(const std::vector<ProfileRow>& profile) {
  std::vector<LocalState> states;
  for (const ProfileRow& row : profile) {
    const double shear = std::abs(row.stress(1, 0)), normal = row.stress(0, 0);
    states.push_back({row.position, shear / normal, std::abs(row.shear_rate.y()) / std::sqrt(normal),
                      row.solid_fraction, shear * row.position * row.position});
  }
  return states;
}

Estimate mean_over(std::span<const LocalState> layers, double LocalState::*quantity) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (layers.size() < 3) return {none, none};
  const double n = static_cast<double>(layers.size());
  double mean = 0, square = 0;
  for (const LocalState& layer : layers) mean += layer.*quantity / n;
  for (const LocalState& layer : layers) square += std::pow(layer.*quantity - mean, 2) / (n - 1);
  return {mean, std::sqrt(square)};
}

Estimate homogeneous_at(const std::vector<const StudyRow*>& flows, double inertial_number, Observable observable) {
  std::vector<const StudyRow*> sorted = flows;
  const auto number = [](const StudyRow* row) { return (*row)[Observable::inertial_number].value; };
  std::sort(sorted.begin(), sorted.end(), [&](auto* a, auto* b) { return number(a) < number(b); });
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    const double low = number(sorted[k - 1]), high = number(sorted[k]);
    if (!(inertial_number >= low && inertial_number <= high && low < high)) continue;
    const double t = (inertial_number - low) / (high - low);
    const Estimate &a = (*sorted[k - 1])[observable], &b = (*sorted[k])[observable];
    return {(1 - t) * a.value + t * b.value, std::hypot((1 - t) * a.error, t * b.error)};
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {none, none};
}

double local_at(std::span<const LocalState> states, double inertial_number, double LocalState::*quantity) {
  for (std::size_t k = 1; k < states.size(); ++k) {
    const LocalState &a = states[k - 1], &b = states[k];
    const double from = std::log(a.inertial_number), to = std::log(b.inertial_number), at = std::log(inertial_number);
    if (!((at - from) * (at - to) <= 0) || from == to) continue;
    const double t = (at - from) / (to - from);
    return (1 - t) * a.*quantity + t * b.*quantity;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace galet
