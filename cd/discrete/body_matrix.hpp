// D W + A with D and A block-diagonal, factorised on the bodies: W = H^T M^-1 H (cd/discrete/global_problem.hpp), so
// that
//
//   (D W + A)^-1 b = z - D' H^T K^-1 H z,     z = A^-1 b,   D' = A^-1 D,   K = M + H D' H^T
//
// (Woodbury). K has a row for each freedom of the bodies and is sparse as the bodies touch; W has a row for each number
// of a contact and is singular wherever contacts outnumber freedoms. K is not: it is M, which is definite, and more, so
// that neither hyperstatic contacts nor a cell that couples all of them need any care. Where every D' is symmetric
// (the term of De Saxce frozen, or no friction) K is positive definite, and CHOLMOD factorises it; else UMFPACK.
// What A^-1 loses where A spans many decades (interior points) is won back by steps of refinement against W itself.
// Source: Hager 1989 (the identity). Cost: a factorisation of the size of M; a solution is two products with H more.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <Eigen/CholmodSupport>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <Eigen/UmfPackSupport>

#include "cd/discrete/global_problem.hpp"
#include "cd/discrete/newton_matrix.hpp"

namespace galet::cd {

template <int B>
class BodyMatrix final : public NewtonMatrix<B> {
 public:
  using Vector = typename ScaledProblem<B>::Vector;
  using Block = typename ScaledProblem<B>::Block;

  /// `problem`: the scaled local form of `bodies`.
  BodyMatrix(const ScaledProblem<B>& problem, const GlobalProblem& bodies)
      : problem_(problem), left_(problem.size()), added_(problem.size()), inverse_(problem.size()) {
    const Eigen::SparseMatrix<double> transposed = bodies.mass.transpose();
    symmetric_mass_ = (bodies.mass - transposed).norm() == 0;
    for (int c = 0; c < problem.size(); ++c) add_contact(c, bodies.jacobian);
    prepare(bodies.mass);
  }

  bool factorise(std::span<const Block> added) override {
    std::fill(left_.begin(), left_.end(), Block::Identity());
    return factorise_with(added);
  }
  bool factorise(std::span<const Block> left, std::span<const Block> added) override {
    std::copy(left.begin(), left.end(), left_.begin());
    return factorise_with(added);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& right) override {
    Eigen::VectorXd x = solve_once(right), rest = right - product(x);
    for (int round = 0; round < most_refinements; ++round) {
      const Eigen::VectorXd better = x + solve_once(rest), less = right - product(better);
      if (!(less.norm() < rest.norm())) break;
      const bool little_won = less.norm() > 0.5 * rest.norm();
      x = better, rest = less;
      if (little_won) break;
    }
    return x;
  }

 private:
  static constexpr int most_refinements = 6;

  /// What a contact sees of the bodies.
  struct Contact {
    std::vector<int> freedom;
    Eigen::Matrix<double, Eigen::Dynamic, B> share;  ///< H S
    std::vector<int> place;                          ///< of K's entry for each pair of freedoms, by columns
  };

  void add_contact(int c, const Eigen::SparseMatrix<double>& jacobian) {
    Contact contact;
    for (int a = 0; a < B; ++a)
      for (Eigen::SparseMatrix<double>::InnerIterator it(jacobian, B * c + a); it; ++it)
        contact.freedom.push_back(static_cast<int>(it.row()));
    std::sort(contact.freedom.begin(), contact.freedom.end());
    contact.freedom.erase(std::unique(contact.freedom.begin(), contact.freedom.end()), contact.freedom.end());
    contact.share.setZero(static_cast<Eigen::Index>(contact.freedom.size()), B);
    for (int a = 0; a < B; ++a)
      for (Eigen::SparseMatrix<double>::InnerIterator it(jacobian, B * c + a); it; ++it) {
        const auto at = std::lower_bound(contact.freedom.begin(), contact.freedom.end(), it.row());
        contact.share(at - contact.freedom.begin(), a) = problem_.scale[c][a] * it.value();
      }
    contacts_.push_back(std::move(contact));
  }

  /// The pattern of K, the values of M in it, and where each contact adds to it.
  void prepare(const Eigen::SparseMatrix<double>& mass) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int column = 0; column < mass.cols(); ++column) {
      entries.emplace_back(column, column, 0.0);
      for (Eigen::SparseMatrix<double>::InnerIterator it(mass, column); it; ++it)
        entries.emplace_back(it.row(), column, it.value()), entries.emplace_back(column, it.row(), 0.0);
    }
    for (const Contact& contact : contacts_)
      for (const int j : contact.freedom)
        for (const int i : contact.freedom) entries.emplace_back(i, j, 0.0);
    matrix_.resize(mass.rows(), mass.cols());
    matrix_.setFromTriplets(entries.begin(), entries.end());
    matrix_.makeCompressed();
    mass_.assign(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros());
    for (Contact& contact : contacts_)
      for (const int j : contact.freedom)
        for (const int i : contact.freedom) {
          const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[j];
          const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[j + 1];
          contact.place.push_back(static_cast<int>(std::lower_bound(begin, end, i) - matrix_.innerIndexPtr()));
        }
    definite_.cholmod().nmethods = 1;
    definite_.cholmod().method[0].ordering = mass.rows() > 1000 ? CHOLMOD_METIS : CHOLMOD_AMD;
    definite_.cholmod().print = 0;
    general_.umfpackControl()[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    general_.umfpackControl()[UMFPACK_ORDERING] = mass.rows() > 1000 ? UMFPACK_ORDERING_METIS : UMFPACK_ORDERING_AMD;
    general_.umfpackControl()[UMFPACK_SYM_PIVOT_TOLERANCE] = 1e-6;
    general_.umfpackControl()[UMFPACK_IRSTEP] = 0;  // the refinement against W does more
  }

  bool factorise_with(std::span<const Block> added) {
    std::copy(mass_.begin(), mass_.end(), matrix_.valuePtr());
    bool symmetric = symmetric_mass_;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      added_[c] = added[c];
      inverse_[c] = added[c].inverse();
      const Block middle = inverse_[c] * left_[c];
      symmetric = symmetric && middle.isApprox(middle.transpose(), 1e-13);
      const Contact& contact = contacts_[c];
      const Eigen::MatrixXd part = contact.share * middle * contact.share.transpose();
      for (Eigen::Index k = 0; k < part.size(); ++k) matrix_.valuePtr()[contact.place[k]] += part.data()[k];
    }
    definite_now_ = symmetric && factorised(definite_, definite_known_);
    return definite_now_ || factorised(general_, general_known_);
  }

  template <class Solver>
  bool factorised(Solver& solver, bool& known) {
    if (!known) solver.analyzePattern(matrix_);
    known = true;
    solver.factorize(matrix_);
    return solver.info() == Eigen::Success;
  }

  Eigen::VectorXd solve_once(const Eigen::VectorXd& right) {
    Eigen::VectorXd z(right.size()), pushed = Eigen::VectorXd::Zero(matrix_.rows());
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const Contact& contact = contacts_[c];
      const auto row = static_cast<Eigen::Index>(B * c);
      z.template segment<B>(row) = inverse_[c] * right.template segment<B>(row);
      const Eigen::VectorXd push = contact.share * z.template segment<B>(row);
      for (std::size_t k = 0; k < contact.freedom.size(); ++k) pushed[contact.freedom[k]] += push[k];
    }
    const Eigen::VectorXd moved = definite_now_ ? Eigen::VectorXd(definite_.solve(pushed)) : general_.solve(pushed);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const Contact& contact = contacts_[c];
      Vector motion = Vector::Zero();
      for (std::size_t k = 0; k < contact.freedom.size(); ++k)
        motion += moved[contact.freedom[k]] * contact.share.row(k).transpose();
      z.template segment<B>(static_cast<Eigen::Index>(B * c)) -= inverse_[c] * (left_[c] * motion);
    }
    return z;
  }

  /// (D W + A) x.
  Eigen::VectorXd product(const Eigen::VectorXd& x) const {
    Eigen::VectorXd result(x.size());
    for (int c = 0; c < problem_.size(); ++c) {
      Vector motion = problem_.own[c] * x.template segment<B>(B * c);
      for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k)
        motion += problem_.block[k] * x.template segment<B>(B * problem_.neighbour[k]);
      result.template segment<B>(B * c) = left_[c] * motion + added_[c] * x.template segment<B>(B * c);
    }
    return result;
  }

  const ScaledProblem<B>& problem_;
  std::vector<Block> left_, added_, inverse_;  ///< D, A and A^-1
  std::vector<Contact> contacts_;
  Eigen::SparseMatrix<double> matrix_;  ///< K
  std::vector<double> mass_;            ///< the values of M, where K has them
  bool symmetric_mass_ = true, definite_now_ = false, definite_known_ = false, general_known_ = false;
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> definite_;
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> general_;
};

}  // namespace galet::cd
