#include "cd/discrete/scaled_problem.hpp"

#include <algorithm>
#include <cmath>

namespace galet::cd {

namespace {

/// The blocks of W, whole, sorted by row and column.
template <int B>
struct Blocks {
  using Block = typename ScaledProblem<B>::Block;
  std::vector<int> first, column;
  std::vector<Block> value;

  explicit Blocks(const DiscreteProblem& problem) {
    const int contacts = problem.contacts();
    first.assign(1, 0);
    std::vector<int> place(contacts, -1);
    for (int c = 0; c < contacts; ++c) {
      std::vector<int> columns = {c};
      for (std::int64_t k = problem.start[B * c]; k < problem.start[B * c + B]; ++k)
        columns.push_back(problem.column[k] / B);
      std::sort(columns.begin(), columns.end());
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
      for (const int j : columns) {
        place[j] = static_cast<int>(column.size());
        column.push_back(j);
        value.push_back(Block::Zero());
      }
      for (int a = 0; a < B; ++a)
        for (std::int64_t k = problem.start[B * c + a]; k < problem.start[B * c + a + 1]; ++k)
          value[place[problem.column[k] / B]](a, problem.column[k] % B) = problem.value[k];
      first.push_back(static_cast<int>(column.size()));
    }
  }
};

/// 1 / sqrt(mean of a part of the diagonal); `otherwise` where nothing can move the contact that way.
template <class Diagonal>
double scale_of(const Diagonal& diagonal, double otherwise) {
  const double mean = diagonal.mean();
  return mean > 0 ? 1 / std::sqrt(mean) : otherwise;
}

template <int B>
bool is_plain(const Eigen::Matrix<double, B, B, Eigen::RowMajor>& own) {
  Eigen::Matrix<double, B, 1> diagonal = own.diagonal();
  const double largest = diagonal.cwiseAbs().maxCoeff(), rounding = 1e-12 * largest;
  if ((own - Eigen::Matrix<double, B, B, Eigen::RowMajor>(diagonal.asDiagonal())).cwiseAbs().maxCoeff() > rounding)
    return false;
  if (B > 2 && std::abs(diagonal[1] - diagonal[2]) > rounding) return false;
  return B < 5 || std::abs(diagonal[B - 2] - diagonal[B - 1]) <= rounding;
}

}  // namespace

template <int B>
ScaledProblem<B>::ScaledProblem(const DiscreteProblem& problem) {
  const int contacts = problem.contacts();
  const Blocks<B> blocks(problem);
  constexpr int D = B == 5 ? 3 : B;
  scale.resize(contacts), q.resize(contacts), cone.resize(contacts), own.resize(contacts);
  for (int c = 0; c < contacts; ++c) {
    const auto columns = blocks.column.begin();
    const auto at = std::lower_bound(columns + blocks.first[c], columns + blocks.first[c + 1], c) - columns;
    const Vector weights = blocks.value[at].diagonal();
    const double translation = scale_of(weights.template head<D>(), 1);
    scale[c].setConstant(translation);
    cone[c].mu = problem.mu[c];
    if constexpr (B == 5) {
      const double rotation = scale_of(weights.template tail<2>(), translation);
      scale[c].template tail<2>().setConstant(rotation);
      cone[c].mu_r = problem.mu_r[c] * translation / rotation;
    }
    q[c] = scale[c].cwiseProduct(Eigen::Map<const Vector>(&problem.q[B * c]));
  }
  first.assign(1, 0);
  for (int c = 0; c < contacts; ++c) {
    for (int k = blocks.first[c]; k < blocks.first[c + 1]; ++k) {
      const int j = blocks.column[k];
      const Block scaled_block = scale[c].asDiagonal() * blocks.value[k] * scale[j].asDiagonal();
      if (j == c) {
        own[c] = scaled_block;
        diagonal = diagonal && is_plain<B>(scaled_block);
      } else {
        neighbour.push_back(j);
        block.push_back(scaled_block);
      }
    }
    first.push_back(static_cast<int>(neighbour.size()));
  }
}

template <int B>
auto ScaledProblem<B>::scaled(std::span<const double> r) const -> std::vector<Vector> {
  std::vector<Vector> result(size());
  for (int c = 0; c < size(); ++c) result[c] = Eigen::Map<const Vector>(&r[B * c]).cwiseQuotient(scale[c]);
  return result;
}

template <int B>
std::vector<double> ScaledProblem<B>::physical(std::span<const Vector> r) const {
  std::vector<double> result(B * r.size());
  for (std::size_t c = 0; c < r.size(); ++c) Eigen::Map<Vector>(result.data() + B * c) = scale[c].cwiseProduct(r[c]);
  return result;
}

template struct ScaledProblem<2>;
template struct ScaledProblem<3>;
template struct ScaledProblem<5>;

}  // namespace galet::cd
