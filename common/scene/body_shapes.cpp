#include "common/scene/body_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/scene/materials.hpp"
#include "common/scene/size_distribution.hpp"

namespace galet {

namespace {

/// How many places at least `spacing` apart there are on a length.
int places(double length, double spacing) { return std::max(1, static_cast<int>(length / spacing * (1 + 1e-12))); }

template <int D>
Vec<D> centre_of(const BodySpec& body) {
  if (body.centre.size() != static_cast<std::size_t>(D))
    throw InputError(fmt::format("body '{}': a ring needs a centre of {} components", body.name, D));
  return Eigen::Map<const Vec<D>>(body.centre.data());
}

int direction_across(const BodySpec& body, int dim) {
  const int across = static_cast<int>(body.across);
  if (across >= dim) throw InputError(fmt::format("body '{}': across = \"z\" needs three dimensions", body.name));
  return across;
}

template <int D>
std::vector<Vec<D>> wall_places(const BodySpec& body, const Cell<D>& cell, double spacing) {
  const int across = direction_across(body, D);
  std::vector<Vec<D>> result{Vec<D>::Zero()};
  for (int a = 0; a < D; ++a) {
    std::vector<Vec<D>> line;
    const double length = cell.box(a, a);
    const int count = a == across ? 1 : places(length, spacing);
    for (const Vec<D>& x : result)
      for (int k = 0; k < count; ++k) {
        Vec<D> place = x;
        place[a] = a == across ? body.at.value_or(0) : (k + 0.5) * length / count;
        line.push_back(place);
      }
    result = line;
  }
  return result;
}

template <int D>
std::vector<Vec<D>> ring_places(const BodySpec& body, const Cell<D>& cell, double spacing) {
  const double radius = body.radius.value_or(0);
  const Vec<D> centre = centre_of<D>(body);
  const int count = places(2 * std::numbers::pi * radius, spacing);
  const int rings = D == 2 ? 1 : places(cell.box(D - 1, D - 1), spacing);
  std::vector<Vec<D>> result;
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < count; ++k) {
      if (body.segments > 0 && static_cast<long>(k) * body.segments / count != body.segment) continue;
      const double angle = 2 * std::numbers::pi * (k + 0.5 + 0.5 * (ring % 2)) / count;
      Vec<D> place = centre;
      place[0] += radius * std::cos(angle), place[1] += radius * std::sin(angle);
      if (D == 3) place[D - 1] = (ring + 0.5) * cell.box(D - 1, D - 1) / rings;
      result.push_back(place);
    }
  return result;
}

/// A direction at random.
template <int D>
Vec<D> random_direction(RandomStream& random) {
  const double angle = 2 * std::numbers::pi * random.uniform();
  if constexpr (D == 2) {
    return {std::cos(angle), std::sin(angle)};
  } else {
    const double z = 2 * random.uniform() - 1, across = std::sqrt(1 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
  }
}

/// The stream of a clump: its diameter comes first, then its orientation.
RandomStream clump_stream(const Scene& scene, int body) {
  return {scene.seed, stream_number(StreamPurpose::body, body)};
}
double clump_diameter(const Scene& scene, RandomStream& random) {
  return diameter_at(scene.grains.diameter, scene.dimension, random.uniform());
}

/// Distance of the outermost centres from the middle of a clump, in diameters.
double clump_reach(const BodySpec& body) {
  if (body.shape == BodyShape::chain || body.size < 3) return 0.5 * (body.size - 1) * body.spacing;
  return 0.5 * body.spacing / std::sin(std::numbers::pi / body.size);
}

/// Segment `k` of a ring: free along its radius, pressed on the grains.
BodySpec segment_of(const Scene& scene, const BodySpec& ring, int k) {
  BodySpec segment = ring;
  segment.segment = k;
  segment.name = fmt::format("{} {}", ring.name, k + 1);
  const double angle = 2 * std::numbers::pi * (k + 0.5) / ring.segments;
  segment.guide = {std::cos(angle), std::sin(angle)};
  if (scene.dimension == 3) segment.guide.push_back(0);
  double area = 2 * std::numbers::pi * ring.radius.value_or(0) / ring.segments;
  if (scene.dimension == 3 && scene.cell.size.size() == 3) area *= scene.cell.size[2];
  const double push = (ring.outside ? 1 : -1) * ring.pressure.value_or(0) * area;
  segment.force.clear();
  for (const double component : segment.guide) segment.force.push_back(push * component);
  return segment;
}

}  // namespace

Scene with_bodies_apart(Scene scene) {
  std::vector<BodySpec> apart;
  for (const BodySpec& body : scene.bodies) {
    const bool whole_ring = body.segments > 0 && body.guide.empty();
    if (whole_ring) {
      for (int k = 0; k < body.segments; ++k) apart.push_back(segment_of(scene, body, k));
    } else if (body.copies > 1) {
      BodySpec one = body;
      one.copies = 1;
      for (int k = 0; k < body.copies; ++k) {
        one.name = fmt::format("{} {}", body.name, k + 1);
        apart.push_back(one);
      }
    } else {
      apart.push_back(body);
    }
  }
  scene.bodies = std::move(apart);
  return scene;
}

std::vector<UnplacedClump> unplaced_clumps(const Scene& scene) {
  std::vector<UnplacedClump> clumps;
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    if (!is_clump(scene.bodies[b])) continue;
    RandomStream random = clump_stream(scene, b);
    clumps.push_back({b, clump_diameter(scene, random) * (clump_reach(scene.bodies[b]) + 0.5)});
  }
  return clumps;
}

template <int D>
void add_clump(const Scene& scene, const UnplacedClump& clump, const Vec<D>& centre, GluedGrains<D>& glued) {
  const BodySpec& body = scene.bodies[clump.body];
  RandomStream random = clump_stream(scene, clump.body);
  const double diameter = clump_diameter(scene, random), reach = clump_reach(body) * diameter;
  const Vec<D> first = random_direction<D>(random);
  Vec<D> second;
  if constexpr (D == 2) {
    second = Vec<2>(-first.y(), first.x());
  } else {
    do second = first.cross(random_direction<D>(random));
    while (second.norm() < 1e-3);
    second.normalize();
  }
  const int material = material_index(scene, body.material);
  for (int k = 0; k < body.size; ++k) {
    Vec<D> arm = Vec<D>::Zero();
    if (body.shape == BodyShape::chain || body.size < 3) {
      arm = (k - 0.5 * (body.size - 1)) * body.spacing * diameter * first;
    } else {
      const double angle = 2 * std::numbers::pi * k / body.size;
      arm = reach * (std::cos(angle) * first + std::sin(angle) * second);
    }
    glued.add(centre + arm, diameter / 2, clump.body, material);
  }
}

bool any_shape(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const BodySpec& body) { return body.shape != BodyShape::listed; });
}

template <int D>
void add_shapes(const Scene& scene, const Cell<D>& cell, GluedGrains<D>& glued) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodySpec& body = scene.bodies[b];
    if (body.shape != BodyShape::wall && body.shape != BodyShape::ring) continue;
    const double spacing = body.spacing * mean_power(scene.grains.diameter, D, 1);
    RandomStream random(scene.seed, stream_number(StreamPurpose::body, static_cast<int>(b)));
    const int material = material_index(scene, body.material);
    for (const Vec<D>& x :
         body.shape == BodyShape::wall ? wall_places<D>(body, cell, spacing) : ring_places<D>(body, cell, spacing))
      glued.add(x, diameter_at(scene.grains.diameter, D, random.uniform()) / 2, static_cast<int>(b), material);
  }
}

template <int D>
std::vector<Plane<D>> shape_bounds(const Scene& scene, const Cell<D>& cell) {
  std::vector<Plane<D>> bounds;
  for (const BodySpec& body : scene.bodies) {
    // A hair outside the centres, so that the body's own grains are not behind it.
    const double hair = 1e-6 * mean_power(scene.grains.diameter, D, 1);
    Plane<D> bound;
    if (body.shape == BodyShape::wall) {
      const int across = direction_across(body, D);
      const double at = body.at.value_or(0);
      const int side = 2 * at < cell.box(across, across) ? 1 : -1;
      bound.point = (at - side * hair) * Vec<D>::Unit(across);
      bound.normal = side * Vec<D>::Unit(across);
    } else if (body.shape == BodyShape::ring) {
      bound.point = centre_of<D>(body);
      bound.inside = !body.outside;
      bound.radius = body.radius.value_or(0) + (bound.inside ? hair : -hair);
    } else {
      continue;
    }
    bounds.push_back(bound);
  }
  return bounds;
}

template void add_clump<2>(const Scene&, const UnplacedClump&, const Vec<2>&, GluedGrains<2>&);
template void add_clump<3>(const Scene&, const UnplacedClump&, const Vec<3>&, GluedGrains<3>&);
template void add_shapes<2>(const Scene&, const Cell<2>&, GluedGrains<2>&);
template void add_shapes<3>(const Scene&, const Cell<3>&, GluedGrains<3>&);
template std::vector<Plane<2>> shape_bounds<2>(const Scene&, const Cell<2>&);
template std::vector<Plane<3>> shape_bounds<3>(const Scene&, const Cell<3>&);

}  // namespace galet
