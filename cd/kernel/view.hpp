// The memory that a sweep of Gauss-Seidel works on, as raw pointers: the kernels are compiled once per instruction set
// and share no inline code with the rest of the program (common/core/instructions.hpp).
//
//   bodies      one record per body, and a last one that only fills lanes; from `movable` on nobody writes
//     frictionless   v, 1/m  (2D: vx vy 0 1/m)           32 B
//     2D             vx vy w 1/m                          32 B
//     3D             v, 1/m | w, 1/I                      64 B
//   groups      of four contacts that share no movable body; what doesn't change is in `contacts` (SweepColumns),
//               impulses in `reactions`: r as the last sweep left it, then r before that sweep
//   where       8 per group: where the records of i and of j begin, in doubles
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/core/layout.hpp"

namespace galet::cd {

inline constexpr int group_lanes = 4;

/// Doubles per record.
constexpr int record_size(Layout y) { return y.friction && y.dim == 3 ? 8 : 4; }
/// Doubles of an impulse, in the components of cd/problem.hpp.
constexpr int reaction_size(Layout y) { return y.friction ? y.dim : 1; }

/// Where each quantity of a contact lies; columns of four doubles.
template <Layout Y>
struct SweepColumns {
  static constexpr int normal = 0;
  static constexpr int offset = normal + Y.dim;      ///< of u_N
  static constexpr int inverse_wn = offset + 1;      ///< 0 where nothing can move the contact
  static constexpr int inverse_wt = inverse_wn + 1;  ///< likewise
  static constexpr int arm_i = inverse_wt + 1, arm_j = arm_i + 1;
  static constexpr int friction = arm_j + 1;
  static constexpr int turn_i = friction + 1, turn_j = turn_i + 1;  ///< 2D: arm / I
  static constexpr int distance = !Y.friction ? inverse_wn + 1 : Y.dim == 2 ? turn_j + 1 : friction + 1;
  static constexpr int count = distance + 1;
};

/// Sums over contacts, lane by lane.
struct alignas(64) SweepSums {
  double map[group_lanes];        ///< sum of w |change|^2, or of the squared residual
  double impulse[group_lanes];    ///< sum of w |r|^2
  double virial[9][group_lanes];  ///< sum of change (x) b, row by row; only where the cell moves
};

struct SweepView {
  const std::uint32_t* where;
  const double* contacts;
  double* reactions;
  double* bodies;
  std::uint32_t movable;  ///< in doubles
  double beta;            ///< contacts start from r + beta (r - r before)
  double gradient[9];     ///< L, row by row
};

/// Visits the groups [begin, end) one after the other and adds to the sums.
using SweepFunction = void (*)(const SweepView&, std::size_t begin, std::size_t end, SweepSums&);

struct SweepFunctions {
  SweepFunction sweep;     ///< writes impulses and bodies
  SweepFunction residual;  ///< of cd/residual.hpp; writes nothing (beta is not used)
};

}  // namespace galet::cd
