// Random sequential insertion: grains are put at random places, one after the other, largest first; a place where
// a grain would touch another one, an image or a plane is given up for a new one. Cost O(N) at a given solid fraction,
// diverging at the saturation of the method (equal grains: 0.547 in 2D, 0.382 in 3D; Feder 1980, Torquato 2002).
#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/sample.hpp"

namespace galet {

/// Grains that are there already.
template <int D>
struct Obstacles {
  std::vector<Vec<D>> position;
  std::vector<double> radius;
};

/// Positions for grains of the given radii, none touching another or an obstacle. Along directions that are not
/// periodic, grains lie wholly inside the cell. Throws InputError when the grains do not all find a place.
template <int D>
std::vector<Vec<D>> random_insertion(const Cell<D>& cell, const std::vector<Plane<D>>& planes,
                                     const std::vector<double>& radius, std::uint64_t seed,
                                     const Obstacles<D>& obstacles);

extern template std::vector<Vec<2>> random_insertion<2>(const Cell<2>&, const std::vector<Plane<2>>&,
                                                        const std::vector<double>&, std::uint64_t, const Obstacles<2>&);
extern template std::vector<Vec<3>> random_insertion<3>(const Cell<3>&, const std::vector<Plane<3>>&,
                                                        const std::vector<double>&, std::uint64_t, const Obstacles<3>&);

/// Whether a grain crosses a plane (touching it does not count), with the plane's index; -1 when it crosses none.
template <int D>
int crossed_plane(const std::vector<Plane<D>>& planes, const Vec<D>& x, double radius) {
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (distance_from<D>(planes[k], x) < radius * (1 - 1e-9)) return static_cast<int>(k);
  return -1;
}

/// Number of the random stream that serves one purpose for one grain: no two purposes share numbers.
enum class StreamPurpose : std::uint64_t { diameter, shake, insertion, velocity, material, body };
inline std::uint64_t stream_number(StreamPurpose purpose, int grain) {
  return (static_cast<std::uint64_t>(purpose) << 32) | static_cast<std::uint32_t>(grain);
}

}  // namespace galet
