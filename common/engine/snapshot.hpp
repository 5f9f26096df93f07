// What an engine shows of its state: the same columns whichever engine ran, so that a measure can't tell.
// Views stay valid until the engine advances.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"
#include "common/geometry/plane.hpp"

namespace galet {

/// The contacts that carry a force, one entry each, sorted by (i, j, image).
/// j >= number of grains means plane j - grains.
template <int D>
struct ContactColumns {
  std::vector<int> i, j;
  std::vector<Image<D>> image;  ///< of j, as seen from i
  std::vector<Vec<D>> normal;   ///< n, from i to j
  std::vector<Vec<D>> branch;   ///< b, from i's centre to j's centre (to the contact point on a plane)
  std::vector<double> gap;      ///< g, negative in overlap
  std::vector<Vec<D>> force;    ///< F on j (cd: reaction / dt)

  std::size_t size() const { return i.size(); }
  void clear() { i.clear(), j.clear(), image.clear(), normal.clear(), branch.clear(), gap.clear(), force.clear(); }
};

template <int D>
struct Snapshot {
  std::string_view engine;  ///< "md" or "cd"
  double time = 0;
  const Cell<D>* cell = nullptr;
  std::span<const Plane<D>> planes;
  std::span<const Vec<D>> position;
  std::span<const Vec<D>> velocity;  ///< fluctuation v
  std::span<const Spin<D>> spin;     ///< empty in a frictionless layout
  std::span<const double> radius;
  std::span<const double> mass;
  const ContactColumns<D>* contacts = nullptr;

  int grains() const { return static_cast<int>(position.size()); }
};

}  // namespace galet
