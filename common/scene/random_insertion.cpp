#include "common/scene/random_insertion.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/scene/placement.hpp"

namespace galet {

namespace {

/// Range of the fractional coordinates where a grain may be.
template <int D>
struct Room {
  Vec<D> low = Vec<D>::Zero(), high = Vec<D>::Ones();
};

template <int D>
Room<D> room_for(const Cell<D>& cell, double radius) {
  Room<D> room;
  const Vec<D> width = face_distances<D>(cell.box);
  for (int a = 0; a < D; ++a) {
    if (2 * radius > width[a])
      throw InputError(
          fmt::format("the cell is {:.6g} wide along its vector {}: too narrow for a grain of diameter {:.6g}",
                      width[a], a + 1, 2 * radius));
    if (cell.periodic[a]) continue;
    room.low[a] = radius / width[a];
    room.high[a] = 1 - radius / width[a];
  }
  return room;
}

[[noreturn]] void report_failure(int dim, int placed, std::size_t count, double reached, double wanted) {
  throw InputError(fmt::format(
      "a gas of solid fraction {:.4g} is too dense for random insertion: {} of {} grains (solid fraction {:.4g}) found "
      "a place; equal grains reach {} in {}D. Lower initial.solid_fraction, or start from a lattice",
      wanted, placed, count, reached, dim == 2 ? 0.54 : 0.38, dim));
}

}  // namespace

template <int D>
std::vector<Vec<D>> random_insertion(const Cell<D>& cell, const std::vector<Plane<D>>& planes,
                                     const std::vector<double>& radius, std::uint64_t seed,
                                     const Obstacles<D>& obstacles) {
  const int count = static_cast<int>(radius.size());
  std::vector<int> order(radius.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return radius[a] > radius[b]; });
  if (count == 0) return {};

  // Far more than any density takes that can be reached at all; the attempts that early grains leave over serve the
  // late ones.
  long attempts_left = 1000L * count + 100000;
  double largest = radius[order[0]];
  for (const double r : obstacles.radius) largest = std::max(largest, r);
  PlacementGrid<D> grid(cell, 2 * largest, count);
  for (std::size_t k = 0; k < obstacles.radius.size(); ++k) grid.add(obstacles.position[k], obstacles.radius[k]);
  std::vector<Vec<D>> position(radius.size());
  double placed_volume = 0;
  for (int i : order) {
    RandomStream random(seed, stream_number(StreamPurpose::insertion, i));
    const Room<D> room = room_for<D>(cell, radius[i]);
    do {
      if (attempts_left-- == 0) {
        double wanted = 0;
        for (double r : radius) wanted += grain_volume<D>(2 * r);
        report_failure(D, grid.count() - static_cast<int>(obstacles.radius.size()), radius.size(),
                       placed_volume / cell.volume(), wanted / cell.volume());
      }
      Vec<D> s;
      for (int a = 0; a < D; ++a) s[a] = random.uniform(room.low[a], room.high[a]);
      position[i] = cell.box * s;
    } while (crossed_plane<D>(planes, position[i], radius[i]) >= 0 || grid.touched(position[i], radius[i]) >= 0);
    grid.add(position[i], radius[i]);
    placed_volume += grain_volume<D>(2 * radius[i]);
  }
  return position;
}

template std::vector<Vec<2>> random_insertion<2>(const Cell<2>&, const std::vector<Plane<2>>&,
                                                 const std::vector<double>&, std::uint64_t, const Obstacles<2>&);
template std::vector<Vec<3>> random_insertion<3>(const Cell<3>&, const std::vector<Plane<3>>&,
                                                 const std::vector<double>&, std::uint64_t, const Obstacles<3>&);

}  // namespace galet
