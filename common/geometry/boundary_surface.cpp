#include "common/geometry/boundary_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/geometry/wrap.hpp"

namespace galet {

namespace {

constexpr int sides = 96;  // of a circle

/// What of a face has sign (x[axis] - bound) >= -slack. A face of two points is a line, of more a closed polygon.
template <int D>
std::vector<Vec<D>> cut(const std::vector<Vec<D>>& face, int axis, double bound, double sign, double slack) {
  const auto inside = [&](const Vec<D>& x) { return sign * (x[axis] - bound) >= -slack; };
  const bool closed = face.size() > 2;
  std::vector<Vec<D>> kept;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vec<D>& to = face[k];
    if (closed || k > 0) {
      const Vec<D>& from = face[(k + face.size() - 1) % face.size()];
      if (inside(from) != inside(to))
        kept.push_back(from + (bound - from[axis]) / (to[axis] - from[axis]) * (to - from));
    }
    if (inside(to)) kept.push_back(to);
  }
  return kept;
}

template <int D>
std::vector<Vec<D>> cut_to(std::vector<Vec<D>> face, const Extent<D>& shown, double slack) {
  for (int a = 0; a < D; ++a) {
    face = cut<D>(face, a, shown.low[a], 1, slack);
    face = cut<D>(face, a, shown.high[a], -1, slack);
  }
  return face.size() < static_cast<std::size_t>(D) ? std::vector<Vec<D>>() : face;
}

template <int D>
std::vector<Vec<D>> plane_face(const Plane<D>& plane, Extent<D> shown) {
  const auto foot = [&](const Vec<D>& x) { return Vec<D>(x - (x - plane.point).dot(plane.normal) * plane.normal); };
  const std::vector<Vec<D>> corners = shown.corners();
  const auto side = [&](const Vec<D>& x) { return (x - plane.point).dot(plane.normal); };
  const auto [least, largest] = std::minmax_element(corners.begin(), corners.end(),
                                                    [&](const auto& a, const auto& b) { return side(a) < side(b); });
  if (side(*least) > 0 || side(*largest) < 0)
    for (const Vec<D>& corner : corners) shown.include(foot(corner));
  const double reach = (shown.high - shown.low).norm();
  const Vec<D> centre = foot((shown.low + shown.high) / 2);
  std::vector<Vec<D>> face;
  if constexpr (D == 2) {
    const Vec<2> along(plane.normal.y(), -plane.normal.x());
    face = {centre - reach * along, centre + reach * along};
  } else {
    const Vec<3> first = plane.normal.unitOrthogonal(), second = plane.normal.cross(first);
    for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      face.push_back(centre + reach * (a * first + b * second));
  }
  // Planes that lie in a face of the box are kept, whatever rounding says.
  return cut_to<D>(std::move(face), shown, 1e-9 * reach);
}

std::vector<std::vector<Vec<2>>> cylinder_faces(const Plane<2>& cylinder, const Extent<2>&) {
  std::vector<Vec<2>> circle;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    circle.push_back(cylinder.point + cylinder.radius * Vec<2>(std::cos(angle), std::sin(angle)));
  }
  circle.push_back(circle.front());
  return {circle};
}

std::vector<std::vector<Vec<3>>> cylinder_faces(const Plane<3>& cylinder, const Extent<3>& shown) {
  double from = HUGE_VAL, to = -HUGE_VAL;
  for (const Vec<3>& corner : shown.corners()) {
    const double along = (corner - cylinder.point).dot(cylinder.axis);
    from = std::min(from, along), to = std::max(to, along);
  }
  const Vec<3> first = cylinder.axis.unitOrthogonal(), second = cylinder.axis.cross(first);
  const auto out = [&](int k) {
    const double angle = 2 * std::numbers::pi * (k % sides) / sides;
    return Vec<3>(cylinder.point + cylinder.radius * (std::cos(angle) * first + std::sin(angle) * second));
  };
  std::vector<std::vector<Vec<3>>> faces;
  for (int k = 0; k < sides; ++k)
    faces.push_back({out(k) + from * cylinder.axis, out(k + 1) + from * cylinder.axis, out(k + 1) + to * cylinder.axis,
                     out(k) + to * cylinder.axis});
  return faces;
}

}  // namespace

template <int D>
std::vector<Vec<D>> Extent<D>::corners() const {
  std::vector<Vec<D>> all;
  for (int corner = 0; corner < 1 << D; ++corner) {
    Vec<D> x = low;
    for (int a = 0; a < D; ++a)
      if ((corner >> a & 1) != 0) x[a] = high[a];
    all.push_back(x);
  }
  return all;
}

template <int D>
Extent<D> sample_extent(const Cell<D>& cell, std::span<const Vec<D>> position, std::span<const double> radius) {
  Extent<D> shown;
  for (const Vec<D>& s : Extent<D>{Vec<D>::Zero(), Vec<D>::Ones()}.corners()) shown.include(cell.box * s);
  const Mat<D> inverse = cell.box.inverse();
  const Vec<D> width = face_distances<D>(cell.box);
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vec<D> s = wrapped_fraction<D>(cell, inverse, position[i]);
    for (int a = 0; a < D; ++a) {
      const double reach = radius[i] / width[a];
      if (!cell.periodic[a] && (s[a] < reach || s[a] > 1 - reach)) shown.include(cell.box * s, radius[i]);
    }
  }
  return shown;
}

template <int D>
std::vector<std::vector<Vec<D>>> boundary_faces(const Plane<D>& boundary, const Extent<D>& shown) {
  if (boundary.curved()) return cylinder_faces(boundary, shown);
  std::vector<Vec<D>> face = plane_face<D>(boundary, shown);
  if (face.empty()) return {};
  return {std::move(face)};
}

template struct Extent<2>;
template struct Extent<3>;
template Extent<2> sample_extent<2>(const Cell<2>&, std::span<const Vec<2>>, std::span<const double>);
template Extent<3> sample_extent<3>(const Cell<3>&, std::span<const Vec<3>>, std::span<const double>);
template std::vector<std::vector<Vec<2>>> boundary_faces<2>(const Plane<2>&, const Extent<2>&);
template std::vector<std::vector<Vec<3>>> boundary_faces<3>(const Plane<3>&, const Extent<3>&);

}  // namespace galet
