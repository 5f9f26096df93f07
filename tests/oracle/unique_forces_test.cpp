// Forces of hyperstatic stacks: with compliance they are unique, and as it vanishes they tend to those of least energy,
// which are computed apart from every solver; without it each start has its own. And what compliance does not make
// unique: Coulomb's law for one body.
#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "cd/discrete/solve.hpp"
#include "tests/support/contact_oracle.hpp"
#include "tests/support/random_contacts.hpp"

namespace galet::cd::unique_forces_test {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

DiscreteProblem from_dense(const Matrix& w, const Vector& q, double mu) {
  DiscreteProblem problem;
  problem.mu.assign(q.size() / 3, mu);
  problem.q.assign(q.data(), q.data() + q.size());
  for (Eigen::Index a = 0; a < q.size(); ++a) {
    problem.start.push_back(a * q.size());
    for (Eigen::Index b = 0; b < q.size(); ++b)
      problem.column.push_back(static_cast<int>(b)), problem.value.push_back(w(a, b));
  }
  problem.start.push_back(q.size() * q.size());
  return problem;
}

/// Two boards, one on the floor and one on it, shifted: six points of contact at each level, where they overlap, which
/// are more numbers than freedoms. Under gravity that is tilted a little they rest.
struct Tower {
  static constexpr int boards = 2, points = 6;
  Matrix h = Matrix::Zero(6 * boards, 3 * points * boards);  ///< six freedoms a board
  Vector mass = Vector::Zero(6 * boards), load = Vector::Zero(6 * boards);

  explicit Tower(double shift) {
    const double length = 2, width = 1, height = 0.3, m = 0.6;
    for (int k = 0; k < boards; ++k) {
      mass.segment(6 * k, 6) << m, m, m, m / 12 * (width * width + height * height),
          m / 12 * (length * length + height * height), m / 12 * (length * length + width * width);
      load.segment(6 * k, 6) << 0.05, 0.03, -1, 0, 0, 0;
      const double left = -0.4 * length, right = 0.4 * length - (k > 0 ? shift : 0);
      for (int point = 0; point < points; ++point) {
        const Eigen::Vector3d above(left + 0.5 * (point % 3) * (right - left), (point / 3 - 0.5) * width, -height / 2);
        touch(points * k + point, k, above, 1);
        if (k > 0) touch(points * k + point, k - 1, above + Eigen::Vector3d(shift, 0, height), -1);
      }
    }
  }
  void touch(int contact, int board, const Eigen::Vector3d& lever, double side) {
    const Eigen::Vector3d directions[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    for (int a = 0; a < 3; ++a) {
      h.block<3, 1>(6 * board, 3 * contact + a) += side * directions[a];
      h.block<3, 1>(6 * board + 3, 3 * contact + a) += side * lever.cross(directions[a]);
    }
  }
  Matrix w() const { return h.transpose() * mass.cwiseInverse().asDiagonal() * h; }
  Vector q() const { return h.transpose() * load; }
};

/// W + eps D, D the mean diagonal of each contact's block.
Matrix with_compliance(const Matrix& w, double eps) {
  Matrix soft = w;
  for (Eigen::Index c = 0; c < w.rows() / 3; ++c)
    soft.diagonal().segment(3 * c, 3).array() += eps * w.diagonal().segment(3 * c, 3).mean();
  return soft;
}

/// The r of least r.D r with W r + q = 0, r_N >= 0 and r = 0 where r_N = 0, by trying which contacts are open. Asserts
/// that friction holds every contact with room to spare, so that the cone's other bound plays no part, and that what
/// holds open contacts back lies in the dual cone.
Vector least_energy(const Matrix& w, const Vector& q, double mu) {
  const Eigen::Index rows = q.size(), contacts = rows / 3;
  Vector scale(rows);
  for (Eigen::Index c = 0; c < contacts; ++c)
    scale.segment(3 * c, 3).setConstant(1 / std::sqrt(w.diagonal().segment(3 * c, 3).mean()));
  const Matrix scaled = scale.asDiagonal() * w * scale.asDiagonal();
  const Vector load = scale.cwiseProduct(q);
  for (int open = 0; open < 1 << contacts; ++open) {
    std::vector<Eigen::Index> bearing;
    for (Eigen::Index a = 0; a < rows; ++a)
      if ((open >> (a / 3) & 1) == 0) bearing.push_back(a);
    if (bearing.empty()) break;
    Eigen::CompleteOrthogonalDecomposition<Matrix> factor;
    factor.setThreshold(1e-10);
    factor.compute(scaled(Eigen::all, bearing));
    Vector r = Vector::Zero(rows);
    const Vector least_norm = factor.solve(-load);
    r(bearing) = least_norm;
    if ((scaled * r + load).norm() > 1e-10 * load.norm()) continue;
    // r + W y = l, l on the open contacts only and in the dual cone there.
    Eigen::CompleteOrthogonalDecomposition<Matrix> across;
    across.setThreshold(1e-10);
    across.compute(scaled(bearing, Eigen::all));
    const Vector multiplier = across.solve(-least_norm);
    const Vector force = r + scaled * multiplier, borne = force(bearing);
    bool least = borne.norm() <= 1e-9 * r.norm();
    for (Eigen::Index c = 0; c < contacts; ++c) {
      const bool shut = (open >> c & 1) == 0;
      if (shut)
        least = least && r[3 * c] > 0;
      else
        least = least && force[3 * c] >= mu * force.segment(3 * c + 1, 2).norm();
    }
    if (!least) continue;
    for (Eigen::Index c = 0; c < contacts; ++c)
      if ((open >> c & 1) == 0) {
        EXPECT_LT(r.segment(3 * c + 1, 2).norm(), 0.9 * mu * r[3 * c]);
      }
    return scale.cwiseProduct(r);
  }
  ADD_FAILURE() << "no choice of open contacts has least energy";
  return Vector::Zero(rows);
}

Vector solved(const Matrix& w, const Vector& q, double mu, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 2);
  DiscreteOptions options;
  options.error = 1e-11;
  options.start.assign(q.size(), 0.0);
  // Any forces to begin with, a few times those that bear the boards.
  for (Eigen::Index c = 0; c < q.size() / 3; ++c) options.start[3 * c] = uniform(random);
  const DiscreteSolution solution = solve(from_dense(w, q, mu), options);
  EXPECT_TRUE(solution.converged) << "errS " << solution.error << ", " << solution.reason;
  return Vector::Map(solution.r.data(), q.size());
}

double spread_of(const Matrix& w, const Vector& q, double mu, Vector& mean) {
  std::vector<Vector> answers;
  mean = Vector::Zero(q.size());
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    answers.push_back(solved(w, q, mu, seed));
    mean += answers.back() / 3;
  }
  double spread = 0;
  for (const Vector& r : answers) spread = std::max(spread, (r - mean).norm() / mean.norm());
  return spread;
}

TEST(UniqueForces, OfTowersTendToThoseOfLeastEnergy) {
  const double mu = 0.8;
  for (const double shift : {0.1, 0.7}) {  // all points bear; two of them open
    SCOPED_TRACE(testing::Message() << "shift " << shift);
    const Tower tower(shift);
    const Matrix w = tower.w();
    const Vector q = tower.q(), least = least_energy(w, q, mu);
    int open = 0;
    for (Eigen::Index c = 0; c < q.size() / 3; ++c) open += least[3 * c] == 0;
    EXPECT_EQ(open, shift > 0.5 ? 2 : 0);
    Vector mean;
    EXPECT_GT(spread_of(w, q, mu, mean), 0.05) << "without compliance each start has forces of its own";
    double before = 0;
    for (const double eps : {1e-2, 1e-3, 1e-4}) {
      // errS times the condition 1/eps that compliance leaves.
      EXPECT_LT(spread_of(with_compliance(w, eps), q, mu, mean), 1e-9 / eps);
      const double distance = (mean - least).norm() / least.norm();
      // First order in eps: a tenth of the compliance, a tenth of the distance.
      if (before > 0) {
        EXPECT_NEAR(distance / before, 0.1, 0.03);
      }
      before = distance;
    }
    EXPECT_LT(before, 1e-3);
  }
}

// W is definite, so that compliance has done what it can, and still there are several answers: each is one of Coulomb's
// law, and the solver gives one of them.
TEST(UniqueForces, OneBodyHasSeveralWhereFrictionIsLarge) {
  std::mt19937 random(7);
  int several = 0;
  for (int k = 0; k < 300; ++k) {
    RandomContacts kind;
    kind.block = 2, kind.contacts = 3, kind.freedoms = 3;
    kind.mu = 2, kind.compliance = 1e-3;
    const DiscreteProblem problem = random_contacts(kind, random);
    const ContactOracle oracle(problem);
    const auto found = oracle.enumerate(2, 1e-13L);
    several += found.size() > 1;
    DiscreteOptions options;
    options.error = 1e-11, options.seconds = 0.05;
    const DiscreteSolution solution = solve(problem, options);
    if (found.size() < 2 || !solution.converged) continue;
    long double nearest = 1e300L;
    const auto r = oracle.scaled(solution.r);
    for (const auto& other : found)
      nearest = std::min<long double>(nearest, (other - r).norm() / (other.norm() + oracle.load()));
    EXPECT_LT(static_cast<double>(nearest), 1e-5) << "number " << k;  // errS times a condition of 1e3 to 1e6
  }
  std::printf("%d of 300 have several solutions\n", several);
  EXPECT_GT(several, 0);
}

}  // namespace
}  // namespace galet::cd::unique_forces_test
