// A discrete contact problem before the velocities of the bodies are eliminated (FCLIB's global form):
//
//   M v = H r + f,   u = H^T v + w,   Coulomb's law between u and r at each contact (cd/discrete/problem.hpp)
//
// M: masses and inertias, one row for each freedom of the bodies, positive definite but for gyroscopic terms;
// H: a column for each number of a contact; f: M times the velocities without contacts; w: what moves contacts besides.
// The local form is W = H^T M^-1 H, q = H^T M^-1 f + w.
// Source: Acary, Bremond and Huber 2018 (FCLIB).
#pragma once

#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "cd/discrete/problem.hpp"

namespace galet::cd {

struct GlobalProblem {
  int block = 3;                         ///< numbers per contact, as in DiscreteProblem
  Eigen::SparseMatrix<double> mass;      ///< M
  Eigen::SparseMatrix<double> jacobian;  ///< H
  std::vector<double> f;                 ///< one per freedom
  std::vector<double> w;                 ///< block per contact
  std::vector<double> mu;                ///< one per contact
  std::vector<double> mu_r;              ///< one per contact where block = 5, else empty
  std::string title, description;
};

/// The local form. Throws std::invalid_argument where M is singular, or symmetric and not positive definite ("is not
/// positive definite: expected masses and inertias", "is singular"). Cost: a factorisation of M and a solution for each
/// column of H.
DiscreteProblem reduced(const GlobalProblem& problem);

}  // namespace galet::cd
