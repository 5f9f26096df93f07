// A discrete contact problem scaled so that every block of W has a mean diagonal of one, in blocks of B numbers.
//   r = S r~,  u = S^-1 u~,  W~ = S W S,  q~ = S q,   S_c = 1 / sqrt(mean diagonal of W_cc)
// with a scale of its own for the rolling part, so that mu_r~ = mu_r S_T / S_R. r~ and u~ are square roots of energies:
// errors in them depend on no unit, and steps of first-order methods need no tuning.
#pragma once

#include <span>
#include <vector>

#include "cd/discrete/cone.hpp"
#include "cd/discrete/problem.hpp"

namespace galet::cd {

template <int B>
struct ScaledProblem {
  using Block = Eigen::Matrix<double, B, B, Eigen::RowMajor>;
  using Vector = Eigen::Matrix<double, B, 1>;

  explicit ScaledProblem(const DiscreteProblem& problem);

  int size() const { return static_cast<int>(cone.size()); }

  /// u of contact c without its own block: q_c + sum of W_cj r_j, j != c.
  Vector free_motion(int c, std::span<const Vector> r) const {
    Vector motion = q[c];
    for (int k = first[c]; k < first[c + 1]; ++k) motion.noalias() += block[k] * r[neighbour[k]];
    return motion;
  }
  Vector motion(int c, std::span<const Vector> r) const { return free_motion(c, r) + own[c] * r[c]; }

  std::vector<Vector> scaled(std::span<const double> r) const;
  std::vector<double> physical(std::span<const Vector> r) const;

  std::vector<Block> own;      ///< W_cc
  std::vector<int> first;      ///< other blocks of row c: [first[c], first[c + 1])
  std::vector<int> neighbour;  ///< their columns
  std::vector<Block> block;    ///< their values
  std::vector<Vector> q;
  std::vector<Vector> scale;  ///< the diagonal of S
  std::vector<Cone<B>> cone;  ///< of the scaled impulses
  bool diagonal = true;       ///< every W_cc is diagonal with W_TT (and W_RR) a multiple of the identity
};

extern template struct ScaledProblem<2>;
extern template struct ScaledProblem<3>;
extern template struct ScaledProblem<5>;

}  // namespace galet::cd
