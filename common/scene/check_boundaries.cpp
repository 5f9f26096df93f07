// The rules of smooth boundaries: planes and cylinders.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/scene/check_report.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/size_distribution.hpp"

namespace galet::scene_check {

namespace {

void check_plane(Report& report, std::size_t k) {
  const Scene& scene = report.scene;
  const PlaneSpec& plane = scene.planes[k];
  const std::string path = fmt::format("plane[{}].", k);
  report.components(path + "point", plane.point.size(), false);
  report.components(path + "normal", plane.normal.size(), false);
  report.components(path + "velocity", plane.velocity.size());
  report.rule(!plane.mass || scene.engine == EngineKind::cd, path + "mass",
              path + "mass needs engine = \"cd\": planes of md have imposed velocities", {"engine"});
  report.rule(plane.mass || plane.force == 0, path + "force",
              path + "force needs " + path + "mass: a plane without mass has an imposed velocity", {path + "mass"});
  if (plane.normal.size() != static_cast<std::size_t>(scene.dimension)) return;
  const bool zero = std::all_of(plane.normal.begin(), plane.normal.end(), [](double n) { return n == 0; });
  report.rule(!zero, path + "normal", path + "normal is zero: it must point to the grains' side");
  for (std::size_t a = 0; a < plane.normal.size(); ++a)
    report.rule(plane.normal[a] == 0 || !is_periodic(scene, a), path + "normal",
                fmt::format("{}normal: the plane crosses the periodic direction {}; set cell.periodic to false there",
                            path, axis(a)),
                {"cell.periodic", "dimension"});
}

/// Planes that face each other leave room between them, at the start and, where both motions are imposed, to the end.
void check_facing(Report& report, std::size_t k, std::size_t other) {
  const Scene& scene = report.scene;
  const PlaneSpec &a = scene.planes[other], &b = scene.planes[k];
  const auto dim = static_cast<std::size_t>(scene.dimension);
  for (const PlaneSpec* plane : {&a, &b})
    if (plane->point.size() != dim || plane->normal.size() != dim) return;
  double aa = 0, bb = 0, ab = 0, gap = 0, closing = 0;
  for (std::size_t c = 0; c < dim; ++c) {
    aa += a.normal[c] * a.normal[c], bb += b.normal[c] * b.normal[c], ab += a.normal[c] * b.normal[c];
    gap += (b.point[c] - a.point[c]) * a.normal[c];
    closing -=
        ((b.velocity.size() == dim ? b.velocity[c] : 0) - (a.velocity.size() == dim ? a.velocity[c] : 0)) * a.normal[c];
  }
  if (!(ab < -(1 - 1e-12) * std::sqrt(aa * bb))) return;  // they don't face each other, or a normal is zero
  const std::string path = fmt::format("plane[{}].", k);
  const Paths reads = {fmt::format("plane[{}]", other), "run"};
  if (!(gap > 0))
    return report.add(path + "point", fmt::format("{}point: no room is left before plane[{}]", path, other), reads);
  if (a.mass || b.mass || !ends_in_time(scene)) return;
  report.rule(closing * *scene.run.duration < gap, path + "velocity",
              fmt::format("{}velocity: the plane crosses plane[{}] at the time {:.6g}, before the end of the run", path,
                          other, gap / closing),
              reads);
}

void check_cylinder(Report& report, std::size_t k) {
  const Scene& scene = report.scene;
  const CylinderSpec& cylinder = scene.cylinders[k];
  const std::string path = fmt::format("cylinder[{}].", k);
  report.components(path + "point", cylinder.point.size(), false);
  report.components(path + "velocity", cylinder.velocity.size());
  const auto along = static_cast<std::size_t>(cylinder.axis);
  report.rule(scene.dimension == 3 || cylinder.axis == Axis::z, path + "axis",
              path + "axis needs dimension = 3: in 2D the axis is the third direction", {"dimension"});
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a)
    report.rule(
        (scene.dimension == 3 && a == along) || !is_periodic(scene, a), path + "radius",
        fmt::format("{}radius: the cylinder crosses the periodic direction {}; set cell.periodic to false there", path,
                    axis(a)),
        {"cell.periodic", "dimension", path + "axis"});
  report.rule(cylinder.spin == 0 || rotates(scene), path + "spin",
              path + "spin needs material.friction > 0: a smooth surface that turns has no effect without",
              {"material", "other_material", "material_pair"});
  if (cylinder.outside || !drawn(scene.initial.kind)) return;
  const double largest = largest_diameter(scene.grains.diameter);
  report.rule(2 * cylinder.radius > largest, path + "radius",
              fmt::format("{}radius: {:.6g} is too narrow for grains of diameter {:.6g} inside", path, cylinder.radius,
                          largest),
              {"grains.diameter", path + "grains"});
}

}  // namespace

void check_boundaries(Report& report) {
  for (std::size_t k = 0; k < report.scene.planes.size(); ++k) {
    check_plane(report, k);
    for (std::size_t other = 0; other < k; ++other) check_facing(report, k, other);
  }
  for (std::size_t k = 0; k < report.scene.cylinders.size(); ++k) check_cylinder(report, k);
}

}  // namespace galet::scene_check
