// The memory that the contact pass works on, as raw pointers: the kernels are compiled once per instruction set and
// share no inline code with the rest of the program (see dispatch.hpp).
//
//   records   one per grain, aligned; what contacts see of it (velocities are predicted ones)
//     2D frictionless   x y vx vy                                32 B
//     2D                x y vx vy | R w, w, 0, 0                 64 B
//     3D frictionless   x y z 0 | vx vy vz 0                     64 B
//     3D                x y z wx | vx vy vz wy | R wx, R wy, R wz, wz | wx wy wz 0   128 B (the last 32 for rolling)
//     after the grains come two records of points at rest, a unit apart, for rows that only fill a block
//   rows      blocks of 8; a block holds indices (RowBlock) and one cache line of doubles per column (RowColumns)
//   out       per row what the contact does to its grains
//     2D frictionless   Fx Fy                   2D   Fx Fy twist torque
//     3D frictionless   F 0                     3D   F 0 | twist 0 (| torque 0 with rolling)
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
constexpr int record_size(Layout y) { return y.friction ? (y.dim == 2 ? 8 : 16) : (y.dim == 2 ? 4 : 8); }
/// Doubles per row in `out`.
constexpr int out_size(Layout y) {
  if (y.dim == 2) return y.friction ? 4 : 2;
  return y.rolling ? 12 : y.friction ? 8 : 4;
}

/// Where each quantity of a row lies among the columns of its block.
template <Layout Y>
struct RowColumns {
  static constexpr int vector = Y.dim == 3 ? 3 : 1;                // components of a spring
  static constexpr int reach = 0;                                  ///< R_i + R_j; negative for rows that fill a block
  static constexpr int coefficient = 1, critical = 2;              ///< see laws/terms.hpp
  static constexpr int inverse_reach = 3;                          ///< 1 / (R_i + R_j); grain and plane: 1 / R_i
  static constexpr int spring = 4;                                 ///< stored elongation, see laws/spring.hpp
  static constexpr int normal = spring + vector;                   ///< 3D: n when the springs were last updated
  static constexpr int stiffness = normal + (Y.dim == 3 ? 3 : 0);  ///< K_N at the last step; hertz only
  static constexpr int rolling = stiffness + 1;                    ///< stored rotation of the rolling spring
  static constexpr int pivoting = rolling + vector;                ///< 3D: the same about the normal
  static constexpr int count = !Y.friction ? 3 : !Y.rolling ? rolling : pivoting + (Y.dim == 3 ? 1 : 0);
};

struct alignas(64) RowBlock {
  int i[block_rows], j[block_rows];  ///< records
  std::uint16_t shift[block_rows];   ///< image of j: index into the table of lattice vectors
  std::uint8_t law[block_rows];      ///< index of the pair of materials
  std::uint8_t touching, attracted;  ///< bit k: the state of row k (attracted: across a gap, by a cohesion of range D0)
  std::uint8_t planes;               ///< bit k: j is a plane, counted from `first_plane`
};

/// A plane, and its motion.
struct PlaneRecord {
  double point[3], normal[3], velocity[3];
};

/// Sums over rows, eight lanes each, added in a fixed order at the end of a chunk.
struct alignas(64) LaneSums {
  double virial[9][block_rows];  ///< sum of F (x) b, row by row
  double normal_viscous[block_rows];
  double sliding[3][block_rows], rolling[3][block_rows], pivoting[3][block_rows];  ///< viscous, plastic, unloading
  double plane_power[block_rows];                                                  ///< of moving planes on the grains
};

struct PassView {
  const double* records;
  const double* shifts;  ///< 4 doubles each
  const PlaneRecord* planes;
  int first_plane;  ///< value of j for plane 0
  RowBlock* blocks;
  double* columns;
  double* out;
  double gradient[9];  ///< L, row by row
  bool deforming;      ///< L is not zero
  bool virial;         ///< whether it is wanted
  double half_before;  ///< half the time since the last pass (0 at the very start)
  double half_after;   ///< half the time to the next one
  double range;        ///< largest D0
  LawKind kind;
  const PairTerms<double>* terms;
  int laws;
};

/// Evaluates the blocks [begin, end): writes states, columns and out, adds to the sums.
using PassFunction = void (*)(const PassView&, std::size_t begin, std::size_t end, LaneSums&);

/// Share c of the last change of acceleration that velocities seen by contacts are extrapolated with
/// (md/grain_pass.hpp).
inline constexpr double extrapolation = 0.5;

/// Where each quantity of a grain's state lies; groups of four doubles.
///   2D   vx vy w m | ax ay dw/dt I | (the same a step ago) R                     96 B
///   3D   v m | a - | (a step ago) -      with friction also   w I | dw/dt R | (a step ago) -       96 B or 192 B
template <Layout Y>
struct StateGroups {
  static constexpr int velocity = 0, acceleration = 4, before = 8;
  static constexpr int spin = 12, turning = 16, turning_before = 20;  ///< 3D with friction
  static constexpr int mass = 3, inertia = Y.dim == 2 ? 7 : 15, radius = Y.dim == 2 ? 11 : 19;
  static constexpr int size = Y.dim == 3 && Y.friction ? 24 : 12;
};

/// What the per-grain work reads and writes. Matrices are columns of four.
struct GrainView {
  alignas(32) double gravity[4];
  alignas(32) double gradient[3][4];  ///< L
  alignas(32) double deform[3][4];    ///< x' = deform x + step v_half
  alignas(32) double step[3][4];
  double* records;
  double* state;
  double* position;  ///< dim doubles per grain
  const double* out;
  const int* slots;  ///< 8 per grain: 4 of its rows as second member, 4 as first; a row of zeros where it has fewer
  const int *first, *second, *rows_of_second;  ///< of the neighbour list
  double kick;                                 ///< dt/2 that ends a step (0 at the very start)
  double half;                                 ///< dt/2 that begins one
  bool deforming;
  bool kinetic;  ///< whether the sum of m v (x) v is wanted
};

struct GrainFunctions {
  /// Accelerations and the closing half kick; adds to the columns of the sum of m v (x) v.
  void (*gather)(const GrainView&, std::size_t begin, std::size_t end, double (&kinetic)[3][4]);
  void (*drift)(const GrainView&, std::size_t begin, std::size_t end);
};

}  // namespace galet::md
