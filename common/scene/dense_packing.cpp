#include "common/scene/dense_packing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/geometry/contact_frame.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "common/scene/placement.hpp"

namespace galet {

namespace {

constexpr double growth = 1.01;     // of the radii, from step to step
constexpr double inflation = 5e-4;  // of the last radii beyond the true ones
constexpr double alpha = 0.25;  // with the next one stable for contact networks of spheres: alpha * 8 < 2 (1 + beta)
constexpr double beta = 0.9;
constexpr int moves_between = 300, moves_at_last = 30000;

/// Grains that grow. The obstacles come after them and stay.
template <int D>
class Growth {
 public:
  Growth(const Cell<D>& cell, const std::vector<Plane<D>>& planes, const std::vector<double>& radius,
         std::vector<Vec<D>> position, const Obstacles<D>& obstacles)
      : cell_(cell), planes_(planes), own_radius_(radius), free_(radius.size()), position_(std::move(position)) {
    position_.insert(position_.end(), obstacles.position.begin(), obstacles.position.end());
    own_radius_.insert(own_radius_.end(), obstacles.radius.begin(), obstacles.radius.end());
    // Obstacles are glued to one another.
    group_.assign(position_.size(), -1);
    std::fill(group_.begin() + static_cast<std::ptrdiff_t>(free_), group_.end(), 0);
    move_.assign(free_, Vec<D>::Zero());
    largest_ = *std::max_element(own_radius_.begin(), own_radius_.end());
  }

  /// Radii `factor` times the true ones, and at most `moves` moves until overlaps are below `tolerance` times the sum
  /// of the radii. Returns whether they are.
  bool relax(double factor, double tolerance, int moves) {
    radius_ = own_radius_;
    for (std::size_t i = 0; i < radius_.size(); ++i) radius_[i] *= i < free_ ? factor : std::max(1.0, factor);
    std::fill(move_.begin(), move_.end(), Vec<D>::Zero());
    list_.configure(0, 0.3 * largest_);
    list_.build(position_, radius_, cell_, planes_, group_);
    for (int k = 0; k < moves; ++k) {
      if (list_.expired(position_, cell_, planes_)) list_.build(position_, radius_, cell_, planes_, group_);
      if (push() <= tolerance) return true;
      for (std::size_t i = 0; i < free_; ++i) {
        move_[i] = alpha * push_[i] + beta * move_[i];
        position_[i] += move_[i];
      }
    }
    return false;
  }

  std::vector<Vec<D>> result() const {
    return {position_.begin(), position_.begin() + static_cast<std::ptrdiff_t>(free_)};
  }

 private:
  /// Pushes from all overlaps; returns the largest overlap over the sum of the radii.
  double push() {
    push_.assign(position_.size(), Vec<D>::Zero());
    double worst = 0;
    const PairColumns<D>& pairs = list_.pairs();
    const int grains = static_cast<int>(position_.size());
    for (std::size_t row = 0; row < pairs.size(); ++row) {
      const int i = pairs.i[row], j = pairs.j[row];
      if (i >= static_cast<int>(free_)) continue;  // an obstacle and a boundary
      if (j >= grains) {
        const ContactFrame<D> frame = plane_frame<D>(position_[i], radius_[i], planes_[j - grains]);
        if (frame.gap >= 0) continue;
        worst = std::max(worst, -frame.gap / radius_[i]);
        push_[i] += frame.gap * frame.normal;
        continue;
      }
      const Vec<D> branch = position_[j] - position_[i] + lattice<D>(cell_.box, pairs.image[row]);
      const double reach = radius_[i] + radius_[j], square = branch.squaredNorm();
      if (square >= reach * reach) continue;
      const double distance = std::sqrt(square);
      worst = std::max(worst, 1 - distance / reach);
      const Vec<D> apart = (reach - distance) / distance * branch;
      push_[i] -= apart, push_[j] += apart;
    }
    return worst;
  }

  Cell<D> cell_;
  const std::vector<Plane<D>>& planes_;
  std::vector<double> own_radius_, radius_;
  std::size_t free_;
  std::vector<Vec<D>> position_, move_, push_;
  std::vector<int> group_;
  VerletList<D> list_;
  double largest_ = 0;
};

/// Volume of the cell where the centre of a small grain could be: from points at random.
template <int D>
double room_left(const Cell<D>& cell, const std::vector<Plane<D>>& planes, const Obstacles<D>& obstacles,
                 std::uint64_t seed) {
  constexpr int points = 20000;
  double largest = 1e-3;
  for (const double r : obstacles.radius) largest = std::max(largest, r);
  PlacementGrid<D> grid(cell, 2 * largest, static_cast<int>(obstacles.radius.size()));
  for (std::size_t k = 0; k < obstacles.radius.size(); ++k) grid.add(obstacles.position[k], obstacles.radius[k]);
  int inside = 0;
  RandomStream random(seed, stream_number(StreamPurpose::insertion, std::numeric_limits<int>::max()));
  for (int k = 0; k < points; ++k) {
    Vec<D> s;
    for (int a = 0; a < D; ++a) s[a] = random.uniform();
    const Vec<D> x = cell.box * s;
    if (crossed_plane<D>(planes, x, 0) < 0 && grid.touched(x, 0) < 0) ++inside;
  }
  return cell.volume() * inside / points;
}

/// Faces of the cell are boundaries where it is not periodic: no grain may be pushed through them.
template <int D>
std::vector<Plane<D>> with_faces(const Cell<D>& cell, std::vector<Plane<D>> planes) {
  for (int a = 0; a < D; ++a) {
    if (cell.periodic[a]) continue;
    planes.push_back({Vec<D>::Zero(), Vec<D>::Unit(a), Vec<D>::Zero()});
    planes.push_back({cell.box.col(a), -Vec<D>::Unit(a), Vec<D>::Zero()});
  }
  return planes;
}

}  // namespace

template <int D>
std::vector<Vec<D>> dense_packing(const Cell<D>& cell, const std::vector<Plane<D>>& planes,
                                  const std::vector<double>& radius, std::uint64_t seed,
                                  const Obstacles<D>& obstacles) {
  const std::vector<Plane<D>> bounds = with_faces<D>(cell, planes);
  double solid = 0;
  for (const double r : radius) solid += grain_volume<D>(2 * r);
  const double wanted = solid / room_left<D>(cell, bounds, obstacles, seed);
  const auto refuse = [&] {
    throw InputError(fmt::format(
        "a dense packing of solid fraction {:.4g} in the room there is was not found: about {} can be reached in {}D; "
        "lower initial.solid_fraction or grains.count, or enlarge cell.size",
        wanted, D == 2 ? 0.83 : 0.62, D));
  };
  if (!(wanted < (D == 2 ? 0.9 : 0.73))) refuse();
  // A gas that is easy to place, and then larger and larger grains.
  double factor = std::min(1.0, std::pow((D == 2 ? 0.35 : 0.2) / wanted, 1.0 / D));
  std::vector<double> reduced = radius;
  for (double& r : reduced) r *= factor;
  Growth<D> packing(cell, bounds, radius, random_insertion<D>(cell, planes, reduced, seed, obstacles), obstacles);
  try {
    for (; factor < 1; factor *= growth) packing.relax(factor, 2e-3, moves_between);
    // Lengths shrink by 1 + inflation, overlaps relative to the larger radii by nearly as much.
    if (!packing.relax(1 + inflation, 0.8 * inflation, moves_at_last)) refuse();
  } catch (const RunError&) {
    refuse();  // grains were pushed through one another
  }
  return packing.result();
}

template std::vector<Vec<2>> dense_packing<2>(const Cell<2>&, const std::vector<Plane<2>>&, const std::vector<double>&,
                                              std::uint64_t, const Obstacles<2>&);
template std::vector<Vec<3>> dense_packing<3>(const Cell<3>&, const std::vector<Plane<3>>&, const std::vector<double>&,
                                              std::uint64_t, const Obstacles<3>&);

}  // namespace galet
