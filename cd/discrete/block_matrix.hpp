// D W + E with D and E block-diagonal, factorised again and again with one pattern: dense where small, else sparse
// (UMFPACK).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <Eigen/UmfPackSupport>

#include "cd/discrete/newton_matrix.hpp"

namespace galet::cd {

template <int B>
class BlockMatrix final : public NewtonMatrix<B> {
 public:
  using Block = typename ScaledProblem<B>::Block;

  explicit BlockMatrix(const ScaledProblem<B>& problem) : problem_(problem), dense_(B * problem.size() <= 400) {
    if (!dense_) {
      prepare();
      sparse_solver_.umfpackControl()[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
      sparse_solver_.umfpackControl()[UMFPACK_SYM_PIVOT_TOLERANCE] = 1e-6;
      sparse_solver_.analyzePattern(matrix_);
    }
  }

  bool factorise(std::span<const Block> added) override {
    return factorise_as([](int, const Block& block) { return block; }, added);
  }
  bool factorise(std::span<const Block> left, std::span<const Block> added) override {
    return factorise_as([&](int c, const Block& block) -> Block { return left[c] * block; }, added);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& right) override {
    return dense_ ? Eigen::VectorXd(dense_solver_.solve(right)) : Eigen::VectorXd(sparse_solver_.solve(right));
  }

 private:
  /// `of`: what stands for a block of row c.
  template <class Of>
  bool factorise_as(const Of& of, std::span<const Block> added) {
    if (dense_) {
      const int rows = B * problem_.size();
      Eigen::MatrixXd full = Eigen::MatrixXd::Zero(rows, rows);
      for (int c = 0; c < problem_.size(); ++c) {
        full.block<B, B>(B * c, B * c) = of(c, problem_.own[c]) + added[c];
        for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k)
          full.block<B, B>(B * c, B * problem_.neighbour[k]) = of(c, problem_.block[k]);
      }
      dense_solver_.compute(full);
      return true;
    }
    const auto put = [&](const int* places, const Block& block) {
      for (int b = 0; b < B; ++b)
        for (int a = 0; a < B; ++a) matrix_.valuePtr()[places[b] + a] = block(a, b);
    };
    for (int c = 0; c < problem_.size(); ++c) {
      put(&own_place_[B * c], of(c, problem_.own[c]) + added[c]);
      for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k) put(&place_[B * k], of(c, problem_.block[k]));
    }
    sparse_solver_.factorize(matrix_);
    return sparse_solver_.info() == Eigen::Success;
  }

  void prepare() {
    const int rows = B * problem_.size();
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int c, int j, const Block& block) {
      for (int a = 0; a < B; ++a)
        for (int b = 0; b < B; ++b) entries.emplace_back(B * c + a, B * j + b, block(a, b));
    };
    for (int c = 0; c < problem_.size(); ++c) {
      add(c, c, problem_.own[c]);
      for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k) add(c, problem_.neighbour[k], problem_.block[k]);
    }
    matrix_.resize(rows, rows);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    matrix_.makeCompressed();
    // Where column b of the block in row c and column j begins: rows are sorted within a column.
    const auto place = [&](int c, int column) {
      const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
      const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
      return static_cast<int>(std::lower_bound(begin, end, B * c) - matrix_.innerIndexPtr());
    };
    for (int c = 0; c < problem_.size(); ++c) {
      for (int b = 0; b < B; ++b) own_place_.push_back(place(c, B * c + b));
      for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k)
        for (int b = 0; b < B; ++b) place_.push_back(place(c, B * problem_.neighbour[k] + b));
    }
  }

  const ScaledProblem<B>& problem_;
  bool dense_;
  Eigen::PartialPivLU<Eigen::MatrixXd> dense_solver_;
  Eigen::SparseMatrix<double> matrix_;
  std::vector<int> own_place_, place_;  ///< of the first number of each column of the blocks
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> sparse_solver_;
};

}  // namespace galet::cd
