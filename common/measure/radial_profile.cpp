#include "common/measure/radial_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/core/error.hpp"
#include "common/measure/grain_cuts.hpp"

namespace galet {

namespace {

/// Rows: the unit vectors along r, theta and z at a place across the axis.
Mat<3> directions(const Vec<2>& across) {
  Mat<3> rows = Mat<3>::Identity();
  const double r = across.norm();
  if (!(r > 0)) return rows;
  rows.topLeftCorner<2, 2>() << across.x() / r, across.y() / r, -across.y() / r, across.x() / r;
  return rows;
}

template <int D>
Vec<3> padded(const Vec<D>& value) {
  Vec<3> result = Vec<3>::Zero();
  result.template head<D>() = value;
  return result;
}

struct Rings {
  double inner, width;
  std::vector<RingRow> rows;
  int of(double r) const {
    if (r < inner) return -1;
    const int ring = static_cast<int>((r - inner) / width);
    return ring < static_cast<int>(rows.size()) ? ring : -1;
  }
};

/// Where along start + t branch, 0 < t < 1, the circles are crossed; with both ends.
std::vector<double> crossings(const Rings& rings, const Vec<2>& start, const Vec<2>& branch) {
  std::vector<double> at = {0, 1};
  const double a = branch.squaredNorm(), b = start.dot(branch);
  for (std::size_t k = 0; k <= rings.rows.size() && a > 0; ++k) {
    const double r = rings.inner + static_cast<double>(k) * rings.width;
    const double root = b * b - a * (start.squaredNorm() - r * r);
    if (!(root > 0)) continue;
    for (const double sign : {-1.0, 1.0}) {
      const double t = (-b + sign * std::sqrt(root)) / a;
      if (t > 0 && t < 1) at.push_back(t);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

template <int D>
void add_contacts(const Snapshot<D>& snapshot, const Vec<2>& centre, Rings& rings) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec<2> start = snapshot.position[contacts.i[c]].template head<2>() - centre;
    const Vec<2> branch = contacts.branch[c].template head<2>();
    const Mat<3> virial = padded<D>(contacts.force[c]) * padded<D>(contacts.branch[c]).transpose();
    const std::vector<double> at = crossings(rings, start, branch);
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
      const Vec<2> middle = start + 0.5 * (at[k] + at[k + 1]) * branch;
      const int ring = rings.of(middle.norm());
      if (ring < 0) continue;
      const Mat<3> turn = directions(middle);
      rings.rows[ring].stress += (at[k + 1] - at[k]) * turn * virial * turn.transpose();
    }
  }
}

template <int D>
void add_grains(const Snapshot<D>& snapshot, const Vec<2>& centre, Rings& rings) {
  for (int i = 0; i < snapshot.grains(); ++i) {
    const Vec<2> across = snapshot.position[i].template head<2>() - centre;
    const double distance = across.norm(), radius = snapshot.radius[i];
    if (const int ring = rings.of(distance); ring >= 0) {
      ++rings.rows[ring].grains;
      const Vec<D> velocity = snapshot.velocity[i] + snapshot.cell->rate * snapshot.position[i];
      rings.rows[ring].velocity += directions(across) * padded<D>(velocity);
    }
    for (std::size_t k = 0; k < rings.rows.size(); ++k) {
      const double low = rings.inner + static_cast<double>(k) * rings.width, high = low + rings.width;
      if (distance + radius <= low || distance - radius >= high) continue;
      rings.rows[k].solid_fraction +=
          volume_within<D>(high, distance, radius) - volume_within<D>(low, distance, radius);
    }
  }
}

/// Fluctuations about the rings' mean velocities, which are known.
template <int D>
void add_fluctuations(const Snapshot<D>& snapshot, const Vec<2>& centre, Rings& rings) {
  for (int i = 0; i < snapshot.grains(); ++i) {
    const Vec<2> across = snapshot.position[i].template head<2>() - centre;
    const int ring = rings.of(across.norm());
    if (ring < 0) continue;
    RingRow& row = rings.rows[ring];
    const Vec<D> velocity = snapshot.velocity[i] + snapshot.cell->rate * snapshot.position[i];
    const double square = (directions(across) * padded<D>(velocity) - row.velocity).squaredNorm() / (D * row.grains);
    row.fluctuation += square, row.temperature += snapshot.mass[i] * square;
  }
  for (RingRow& row : rings.rows) row.fluctuation = std::sqrt(row.fluctuation);
}

}  // namespace

template <int D>
std::vector<RingRow> radial_profile(const Snapshot<D>& snapshot, const Vec<D>& centre, double inner, double outer,
                                    int rings) {
  require(rings > 0 && inner >= 0 && outer > inner, "a radial profile needs rings between two radii");
  const Cell<D>& cell = *snapshot.cell;
  require(!cell.periodic[0] && !cell.periodic[1], "a radial profile needs a cell that is open across its axis");
  Rings cut{inner, (outer - inner) / rings, std::vector<RingRow>(rings)};
  add_grains(snapshot, centre.template head<2>(), cut);
  add_contacts(snapshot, centre.template head<2>(), cut);
  const double depth = D == 2 ? 1 : cell.box(D - 1, D - 1);
  for (int k = 0; k < rings; ++k) {
    RingRow& row = cut.rows[k];
    const double low = inner + k * cut.width, high = low + cut.width;
    const double volume = std::numbers::pi * (high - low) * (high + low) * depth;
    row.position = low + 0.5 * cut.width;
    row.solid_fraction /= volume;
    row.stress /= volume;
    if (row.grains > 0) row.velocity /= row.grains;
  }
  add_fluctuations(snapshot, Vec<2>(centre.template head<2>()), cut);
  for (int k = 0; k < rings; ++k) {
    const int below = k > 0 && cut.rows[k - 1].grains > 0 ? k - 1 : k;
    const int above = k + 1 < rings && cut.rows[k + 1].grains > 0 ? k + 1 : k;
    RingRow& row = cut.rows[k];
    if (row.grains == 0 || above == below) continue;
    row.shear_rate = (cut.rows[above].velocity[1] - cut.rows[below].velocity[1]) / ((above - below) * cut.width) -
                     row.velocity[1] / row.position;
  }
  return std::move(cut.rows);
}

template std::vector<RingRow> radial_profile<2>(const Snapshot<2>&, const Vec<2>&, double, double, int);
template std::vector<RingRow> radial_profile<3>(const Snapshot<3>&, const Vec<3>&, double, double, int);

}  // namespace galet
