#include "cd/discrete/global_problem.hpp"

#include <stdexcept>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

namespace galet::cd {

namespace {

using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// Calls take(factor) with a factor of M, of LDL^T where it is symmetric.
template <class Take>
void factorise(const Columns& mass, const Take& take) {
  const Columns transposed = mass.transpose();
  const double symmetric_to_rounding = 1e-14;
  if ((mass - transposed).norm() <= symmetric_to_rounding * mass.norm()) {
    const Eigen::SimplicialLDLT<Columns> factor(mass);
    if (factor.info() != Eigen::Success || (mass.rows() > 0 && !(factor.vectorD().minCoeff() > 0)))
      throw std::invalid_argument("is not positive definite: expected masses and inertias");
    take(factor);
  } else {
    Eigen::SparseLU<Columns> factor;
    factor.compute(mass);
    if (factor.info() != Eigen::Success) throw std::invalid_argument("is singular");
    take(factor);
  }
}

}  // namespace

DiscreteProblem reduced(const GlobalProblem& problem) {
  DiscreteProblem local;
  local.block = problem.block;
  local.mu = problem.mu, local.mu_r = problem.mu_r;
  local.title = problem.title, local.description = problem.description;
  const Columns& h = problem.jacobian;
  factorise(problem.mass, [&](const auto& factor) {
    const Columns answer = factor.solve(h);
    const Rows w = h.transpose() * answer;
    local.start.assign(w.outerIndexPtr(), w.outerIndexPtr() + w.rows() + 1);
    local.column.assign(w.innerIndexPtr(), w.innerIndexPtr() + w.nonZeros());
    local.value.assign(w.valuePtr(), w.valuePtr() + w.nonZeros());
    const Eigen::VectorXd v = factor.solve(Eigen::Map<const Eigen::VectorXd>(problem.f.data(), h.rows()));
    const Eigen::VectorXd q = h.transpose() * v + Eigen::Map<const Eigen::VectorXd>(problem.w.data(), h.cols());
    local.q.assign(q.data(), q.data() + q.size());
  });
  return local;
}

}  // namespace galet::cd
