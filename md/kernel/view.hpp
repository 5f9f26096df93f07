// The memory that the contact pass works on, as raw pointers: the kernels are compiled once per instruction set and
// share no inline code with the rest of the program (see dispatch.hpp).
//
//   records   one per grain, aligned; what contacts see of it (velocities are predicted ones)
//     2D frictionless   x y vx vy                                32 B
//     2D                x y vx vy | R w, w, 0, 0                 64 B
//     3D frictionless   x y z 0 | vx vy vz 0                     64 B
//     3D                x y z wx | vx vy vz wy | R wx, R wy, R wz, wz                96 B
//     3D with rolling   the same | wx wy wz 0                                        128 B
//     after the grains come two records of points at rest, far apart, for rows that only fill a block; then one for
//     each row of a grain and a plane: the point of the plane next to the grain, with the velocity of the plane there
//     and no spin. So kernels know pairs of records and nothing of planes.
//   rows      blocks of 8; a block holds indices (RowBlock), constants of its pairs (RowConstants; one block of them
//             serves all rows where the pairs are equal) and one cache line of doubles per column (RowColumns)
//   out       per row what the contact does to its grains
//     2D frictionless   Fx Fy                   2D   Fx Fy twist torque
//     3D frictionless   F 0                     3D   F twist      with rolling F twist torque 0
//     F on j; twist = |b|/(R_i+R_j) n x F: the torque on grain k of the pair is -R_k twist; torque: rolling and
//     pivoting torque on j
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/core/layout.hpp"
#include "md/laws/terms.hpp"

namespace galet::md {

inline constexpr int block_rows = 8;

/// Doubles per grain in `records`.
constexpr int record_size(Layout y) {
  if (y.dim == 2) return y.friction ? 8 : 4;
  return y.rolling ? 16 : y.friction ? 12 : 8;
}
/// Doubles per row in `out`.
constexpr int out_size(Layout y) {
  if (y.dim == 2) return y.friction ? 4 : 2;
  return y.rolling ? 10 : y.friction ? 6 : 4;
}
/// Where the twist and the torque lie in it.
constexpr int twist_place(Layout y) { return y.dim == 2 ? 2 : 3; }
constexpr int torque_place(Layout y) { return y.dim == 2 ? 3 : 6; }

/// What the laws need of the two grains of each row; does not change while the list holds.
struct alignas(64) RowConstants {
  double reach[block_rows];          ///< R_i + R_j; grain and plane: R_i
  double coefficient[block_rows];    ///< see laws/terms.hpp
  double critical[block_rows];       ///< see laws/terms.hpp
  double inverse_reach[block_rows];  ///< 1 / reach
};

/// Where each quantity that a row remembers lies among the columns of its block.
template <Layout Y>
struct RowColumns {
  static constexpr int vector = Y.dim == 3 ? 3 : 1;  // components of a spring
  static constexpr int spring = 0;                   ///< stored elongation, see laws/spring.hpp
  static constexpr int rolling = spring + vector;    ///< stored rotation of the rolling spring
  static constexpr int pivoting = rolling + vector;  ///< 3D: the same about the normal
  static constexpr int stiffness =                   ///< K_N at the last step; only where it varies (hertz)
      !Y.friction  ? 0
      : !Y.rolling ? rolling
                   : pivoting + (Y.dim == 3 ? 1 : 0);
  static constexpr int count(bool varying) { return stiffness + (Y.friction && varying ? 1 : 0); }
};

/// Rows that only fill a block refer to the two records after the grains, `filler_distance` apart: never in contact.
inline constexpr double filler_distance = 1e100;

struct alignas(64) RowBlock {
  std::uint32_t i[block_rows], j[block_rows];  ///< where the two records begin, in bytes
  std::uint32_t shift[block_rows];             ///< image of j: where its lattice vector begins in the table, in bytes
  std::uint8_t law[block_rows];                ///< index of the pair of materials
  std::uint8_t touching, attracted;  ///< bit k: the state of row k (attracted: across a gap, by a cohesion of range D0)
  std::uint8_t sliding[3];  ///< bit k: whether row k slid, rolled, pivoted a step ago; a guess, of no consequence
  std::uint8_t imaged;      ///< whether any row's j is an image
};

/// Grains whose records can be addressed by RowBlock.
constexpr std::size_t most_grains(Layout y) { return (std::size_t{1} << 32) / (sizeof(double) * record_size(y)) - 2; }

/// Sums over rows, eight lanes each, added in a fixed order at the end of a chunk.
struct alignas(64) LaneSums {
  double virial[9][block_rows];  ///< sum of F (x) b, row by row
  double normal_viscous[block_rows];
  double sliding[3][block_rows], rolling[3][block_rows], pivoting[3][block_rows];  ///< viscous, plastic, unloading
};

struct PassView {
  const double* records;
  const double* shifts;  ///< 4 doubles each
  RowBlock* blocks;
  const RowConstants* constants;
  std::size_t constants_stride;  ///< 1, or 0 where one block of constants serves all
  double* columns;
  std::size_t column_count;  ///< of a block
  double* out;
  double gradient[9];     ///< L, row by row
  unsigned columns_used;  ///< bit k: whether the k-th column of L is not zero
  bool virial;            ///< whether it is wanted
  bool stepping;          ///< whether a step led here (not at the very start)
  double half_before;     ///< half the time since the last pass (0 at the very start)
  double half_after;      ///< half the time to the next one
  double range;           ///< largest D0
  LawKind kind;
  const PairTerms<double>* terms;
  int laws;
};

/// Evaluates the blocks [begin, end): writes states, columns and out, adds to the sums.
using PassFunction = void (*)(const PassView&, std::size_t begin, std::size_t end, LaneSums&);

/// Share c of the last change of acceleration that velocities seen by contacts are extrapolated with
/// (md/grain_pass.hpp).
inline constexpr double extrapolation = 0.5;

/// Where each quantity of a grain's state lies; groups of four doubles, whose fourth (c) is a constant of the grain.
///   2D   vx vy w c | ax ay dw/dt c | factors | record factors      128 B (frictionless 96 B)
///        factors of the rows Fx Fy twist torque: 1/m, 1/m, -R/I, 1/I;  of w in the record: R, 1, 0, 0
///   3D   v c | a c; with friction   v c | w c | a c | dw/dt c       64 B or 128 B
/// `expected`: accelerations extrapolated to the next step. They are needed only where a step begins apart from the
/// last one's end, so they lie in a second array (groups from `size` on): large samples are bound by what is moved.
template <Layout Y>
struct StateGroups {
  static constexpr bool twice = Y.dim == 3 && Y.friction;  ///< groups of the rotation behind those of the centre
  static constexpr int velocity = 0, acceleration = twice ? 8 : 4;
  static constexpr int factors = 8, record_factors = 12;  ///< 2D
  static constexpr int spin = 4, turning = 12;            ///< 3D with friction
  static constexpr int inverse_mass = 3;
  static constexpr int twist_factor = 7, inverse_inertia = 11, radius = 15;  ///< 3D with friction; twist: -R/I
  static constexpr int size = Y.dim == 2 ? (Y.friction ? 16 : 12) : (Y.friction ? 16 : 8);
  // The second array.
  static constexpr int expected = size, expected_turning = size + 4;  ///< the latter: 3D with friction
  static constexpr int mass = size + 3;
  static constexpr int second_size = twice ? 8 : 4;
};

/// Slots of a grain in GrainView::slots.
inline constexpr int slots_per_grain = 9;
/// Rows that slots can address.
constexpr std::size_t most_rows(Layout y) { return (std::size_t{1} << 32) / (sizeof(double) * out_size(y)) - 8; }

/// What the per-grain work reads and writes. Matrices are columns of four.
struct GrainView {
  alignas(32) double gravity[4];
  alignas(32) double gradient[3][4];  ///< L
  alignas(32) double deform[3][4];    ///< x' = x + dt v_half + deform x + step v_half
  alignas(32) double step[3][4];
  unsigned columns_used;  ///< bit k: whether the k-th column of any of these matrices is not zero
  double* records;
  double* state;
  double* expected;  ///< second array of the state
  const double* out;
  /// 9 per grain: where in `out`, in bytes, 4 of its rows as second member begin, 4 as first, a row of zeros where it
  /// has fewer; then whether it has more
  const std::uint32_t* slots;
  const int *first, *second, *rows_of_second;  ///< of the neighbour list
  std::size_t count;                           ///< grains
  double kick;                                 ///< dt/2 that ends a step (0 at the very start)
  double half;                                 ///< dt/2 that begins one
  bool kinetic;                                ///< whether the sum of m v (x) v is wanted
};

struct GrainFunctions {
  /// End of a step: accelerations and the closing half kick; adds to the columns of the sum of m v (x) v.
  void (*gather)(const GrainView&, std::size_t begin, std::size_t end, double (&kinetic)[3][4]);
  /// Beginning of a step; raises `fastest` to the squares of the half-step velocities, component by component.
  void (*drift)(const GrainView&, std::size_t begin, std::size_t end, double (&fastest)[4]);
  /// Both.
  void (*step)(const GrainView&, std::size_t begin, std::size_t end, double (&fastest)[4]);
};

}  // namespace galet::md
