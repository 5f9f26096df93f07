// What the methods that factorise (interior point, Newton) ask of a matrix: D W + A with D and A block-diagonal,
// factorised again and again. On the contacts (cd/discrete/block_matrix.hpp) or on the bodies
// (cd/discrete/body_matrix.hpp).
#pragma once

#include <span>

#include <Eigen/Core>

#include "cd/discrete/scaled_problem.hpp"

namespace galet::cd {

template <int B>
class NewtonMatrix {
 public:
  using Block = typename ScaledProblem<B>::Block;

  virtual ~NewtonMatrix() = default;
  /// W + A; false where it can't be factorised.
  virtual bool factorise(std::span<const Block> added) = 0;
  /// D W + A; false where it can't be factorised.
  virtual bool factorise(std::span<const Block> left, std::span<const Block> added) = 0;
  /// Of the matrix factorised last.
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& right) = 0;
};

}  // namespace galet::cd
