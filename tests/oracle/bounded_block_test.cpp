// The problem of one contact with a full block and several bounds: its answers against the laws, against the states of
// a disk's contact one by one, and against the closed form of spheres.
#include "cd/laws/bounded_block.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cd/laws/two_discs.hpp"
#include "common/core/random.hpp"

namespace galet::cd::bounded_block_test {
namespace {

template <int D>
using Block = std::conditional_t<D == 2, BoundedBlock<3, 2>, BoundedBlock<6, 3>>;
template <int D>
constexpr auto parts() {
  if constexpr (D == 2)
    return std::array{1, 2, 3};
  else
    return std::array{1, 3, 5, 6};
}

/// A contact of two bodies with random masses, moments and levers.
template <int D>
struct RandomContact {
  static constexpr int size = D == 2 ? 3 : 6, spins = D == 2 ? 1 : 3;
  typename Block<D>::Matrix w = Block<D>::Matrix::Zero();
  typename Block<D>::Vector b;
  std::array<double, D> mu;

  explicit RandomContact(std::uint64_t seed) {
    RandomStream stream(seed, 4);
    for (int side : {0, 1}) {
      (void)side;
      const double mass = std::exp(stream.normal());
      Eigen::Matrix<double, D, size> force = Eigen::Matrix<double, D, size>::Identity();
      Eigen::Matrix<double, spins, size> torque = Eigen::Matrix<double, spins, size>::Zero();
      Eigen::Matrix<double, spins, spins> turning;
      if constexpr (D == 2) {
        torque << -stream.normal(), stream.normal(), 1;
        turning(0, 0) = std::exp(stream.normal()) / mass;
      } else {
        const Eigen::Vector3d lever(stream.normal(), stream.normal(), stream.normal());
        for (int a = 0; a < 3; ++a) torque.col(a) = lever.cross(Eigen::Vector3d::Unit(a));
        for (int a = 0; a < 3; ++a) torque(a, a == 0 ? 5 : 2 + a) = 1;
        Eigen::Matrix3d root;
        for (double& value : root.reshaped()) value = stream.normal();
        turning = (root * root.transpose() + 0.1 * Eigen::Matrix3d::Identity()) / mass;
      }
      w += force.transpose() * force / mass + torque.transpose() * turning * torque;
    }
    for (double& value : b) value = stream.normal();
    b[0] = -std::abs(b[0]);
    for (double& bound : mu) bound = stream.uniform(0, 1) < 0.1 ? 0 : stream.uniform(0, 0.8);
  }
};

/// The largest miss of the laws, relative to b.
template <int D>
double miss(const RandomContact<D>& contact, const typename Block<D>::Vector& r) {
  const auto first = parts<D>();
  const typename Block<D>::Vector u = contact.w * r + contact.b;
  double worst = std::max({std::abs(std::min(r[0] * contact.w(0, 0), u[0])), -u[0], -r[0]});
  for (int p = 0; p < D; ++p) {
    const int from = first[p], count = first[p + 1] - from;
    const double w = contact.w.diagonal().segment(from, count).mean(), bound = contact.mu[p] * r[0];
    const Eigen::VectorXd z = r.segment(from, count) - u.segment(from, count) / w;
    const double cut = z.norm() > bound ? bound / z.norm() : 1;
    worst = std::max(worst, w * (r.segment(from, count) - cut * z).norm());
  }
  return worst / contact.b.norm();
}

template <int D>
void check_laws() {
  int missed = 0;
  constexpr int blocks = 50000;
  for (int seed = 0; seed < blocks; ++seed) {
    const RandomContact<D> contact(seed);
    Block<D> block(contact.w, contact.b, parts<D>(), contact.mu);
    // Stopped when a step of Newton's method is 1e-14 of the impulse, whose parts may differ by orders of magnitude.
    missed += miss<D>(contact, block.solve(Block<D>::Vector::Zero())) > 1e-9;
  }
  // Where friction on a long lever jams, a contact may have no solution, or Newton's method may not find it.
  EXPECT_LE(missed, blocks / 10000) << "D = " << D;
}

TEST(BoundedBlock, SatisfiesTheLaws) {
  check_laws<2>();
  check_laws<3>();
}

/// Disks: every state (stick, or slide and roll either way) by its linear equations. The answer is one that stands.
TEST(BoundedBlock, IsAStateOfADisksContact) {
  for (int seed = 0; seed < 5000; ++seed) {
    const RandomContact<2> contact(seed + 100000);
    Block<2> block(contact.w, contact.b, parts<2>(), contact.mu);
    const Eigen::Vector3d found = block.solve(Eigen::Vector3d::Zero());
    double nearest = 1e300;
    for (int state = 0; state < 9; ++state) {
      Eigen::Matrix3d equations = contact.w;
      Eigen::Vector3d right = -contact.b;
      for (int p : {0, 1}) {
        const int side = (p == 0 ? state % 3 : state / 3) - 1;
        if (side == 0 && contact.mu[p] > 0) continue;
        equations.row(p + 1) = Eigen::RowVector3d::Unit(p + 1);
        equations(p + 1, 0) -= side * contact.mu[p];
        right[p + 1] = 0;
      }
      const Eigen::Vector3d r = equations.partialPivLu().solve(right);
      if (miss<2>(contact, r) < 1e-10) nearest = std::min(nearest, (r - found).norm() / r.norm());
    }
    // The same equations solved twice: rounding times a condition number of some hundreds.
    if (nearest < 1e300) {
      EXPECT_LT(nearest, 1e-9) << "block " << seed;
    }
  }
}

/// A sphere and a plane: only sliding and rolling are coupled, by the lever, as in two_discs.hpp.
TEST(BoundedBlock, OfASphereIsItsClosedForm) {
  constexpr double radius = 0.5, inverse_inertia = 10;
  RandomStream stream(7, 5);
  for (int trial = 0; trial < 2000; ++trial) {
    Block<3>::Matrix w = Block<3>::Matrix::Identity();
    w.diagonal().tail<3>().setConstant(inverse_inertia);
    w(1, 1) = w(2, 2) = 1 + radius * radius * inverse_inertia;
    // n x u_T += c gamma, with n x (u_1, u_2) = (-u_2, u_1).
    const double c = radius * inverse_inertia;
    w(2, 3) = w(3, 2) = -c, w(1, 4) = w(4, 1) = c;
    Block<3>::Vector b;
    for (double& value : b) value = stream.normal();
    b[0] = -std::abs(b[0]);
    const std::array<double, 3> mu{stream.uniform(0, 0.8), stream.uniform(0, 0.3), stream.uniform(0, 0.3)};
    const Block<3>::Vector r = Block<3>(w, b, parts<3>(), mu).solve(Block<3>::Vector::Zero());
    const double normal = -b[0];
    // Tangential quantities turned by a quarter about n: (t1, t2) -> (-t2, t1).
    TwoDiscs<Vec<3>> discs{w(1, 1), inverse_inertia, c, Vec<3>::Zero(), Vec<3>::Zero()};
    discs.solve(Vec<3>(0, -b[2], b[1]), Vec<3>(0, b[3], b[4]), mu[0] * normal, mu[1] * normal);
    const Vec<3> sliding(0, discs.x[2], -discs.x[1]);
    const double pivoting = bounded(-b[5] / inverse_inertia, mu[2] * normal);
    EXPECT_NEAR(r[0], normal, 1e-11);  // W is shifted by 1e-12 of its size
    EXPECT_LT((r.segment<2>(1) - sliding.tail<2>()).norm(), 1e-11);
    EXPECT_LT((r.segment<2>(3) - discs.y.tail<2>()).norm(), 1e-11);
    EXPECT_NEAR(r[5], pivoting, 1e-11);
  }
}

TEST(BoundedBlock, OpensAndHoldsNothingThatNothingMoves) {
  Block<3>::Matrix w = Block<3>::Matrix::Zero();
  Block<3>::Vector b = Block<3>::Vector::Constant(-1);
  EXPECT_EQ(Block<3>(w, b, parts<3>(), {0.5, 0.1, 0.1}).solve(b), Block<3>::Vector::Zero());
  w.diagonal().head<3>().setOnes();  // nothing can turn the contact
  const Block<3>::Vector r = Block<3>(w, b, parts<3>(), {0.5, 0.1, 0.1}).solve(Block<3>::Vector::Zero());
  EXPECT_NEAR(r[0], 1, 1e-11);
  EXPECT_NEAR(r.segment<2>(1).norm(), 0.5, 1e-11);
  EXPECT_EQ(r.tail<3>().norm(), 0);
  b[0] = 1;
  EXPECT_EQ(Block<3>(w, b, parts<3>(), {0.5, 0.1, 0.1}).solve(-b), Block<3>::Vector::Zero());
}

}  // namespace
}  // namespace galet::cd::bounded_block_test
