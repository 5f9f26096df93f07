// Random small contact problems of bodies that move as they like: W = H^T M^-1 H with random H and masses.
#pragma once

#include <cmath>
#include <random>

#include <Eigen/Dense>

#include "cd/discrete/problem.hpp"

namespace galet::cd {

struct RandomContacts {
  int block = 3, contacts = 3, freedoms = 8;
  double mu = 0.3, mu_r = 0.1;
  double mass_ratio = 10;
  double cohesion = 0;    ///< attraction of each contact, in units of a typical impulse
  double compliance = 0;  ///< on the diagonal of W, relative to it
  double walls = 0;       ///< motion of each contact that no body has, as of moving walls or gaps; W may not answer it
  bool wedge = false;     ///< the normals of the first two contacts oppose each other and both close: no solution
};

/// Columns of W and q; those of H are of one size.
inline DiscreteProblem random_contacts(const RandomContacts& wanted, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  DiscreteProblem problem;
  problem.block = wanted.block;
  problem.mu.assign(wanted.contacts, wanted.mu);
  if (wanted.block == 5) problem.mu_r.assign(wanted.contacts, wanted.mu_r);
  const int rows = wanted.block * wanted.contacts;
  Eigen::MatrixXd h(wanted.freedoms, rows);
  Eigen::VectorXd v(wanted.freedoms), inverse_mass(wanted.freedoms), offset(rows);
  for (int a = 0; a < h.size(); ++a) h.data()[a] = normal(random);
  for (int a = 0; a < wanted.freedoms; ++a)
    v[a] = normal(random), inverse_mass[a] = std::pow(wanted.mass_ratio, -uniform(random));
  for (int a = 0; a < rows; ++a) offset[a] = wanted.walls * normal(random);
  if (wanted.wedge) {
    h.col(wanted.block) = -2 * h.col(0);
    offset[0] = -std::abs(offset[0]), offset[wanted.block] = -std::abs(offset[wanted.block]) - wanted.walls;
  }
  Eigen::MatrixXd w = h.transpose() * inverse_mass.asDiagonal() * h;
  w.diagonal() += wanted.compliance * w.diagonal();
  Eigen::VectorXd q = h.transpose() * v + offset;
  for (int c = 0; c < wanted.contacts; ++c)
    q -= wanted.cohesion * uniform(random) / w(wanted.block * c, wanted.block * c) * w.col(wanted.block * c);
  problem.q.assign(q.data(), q.data() + rows);
  problem.start.assign(1, 0);
  for (int a = 0; a < rows; ++a) {
    for (int b = 0; b < rows; ++b) problem.column.push_back(b), problem.value.push_back(w(a, b));
    problem.start.push_back(static_cast<std::int64_t>(problem.value.size()));
  }
  return problem;
}

}  // namespace galet::cd
