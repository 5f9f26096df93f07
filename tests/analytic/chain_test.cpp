// Three balls in a row that just touch, the first one moving (references.md, T14): with springs the impact is neither
// that of rigid balls in contact (-1/3, 2/3, 2/3) nor a sequence of pair collisions (0, 0, 1).
// Linear springs: -0.1303, 0.1502, 0.9800, whatever the stiffness. Hertz: from an integration of the chain.
#include <gtest/gtest.h>

#include "tests/support/impact.hpp"

namespace galet::test::chain_test {
namespace {

/// Velocities of the balls and deflections of the two contacts; masses, coefficient and first velocity are 1.
struct Chain {
  std::array<double, 3> velocity{1, 0, 0};
  std::array<double, 2> deflection{0, 0};
};

Chain operator+(const Chain& a, const Chain& b) {
  Chain sum;
  for (int i = 0; i < 3; ++i) sum.velocity[i] = a.velocity[i] + b.velocity[i];
  for (int i = 0; i < 2; ++i) sum.deflection[i] = a.deflection[i] + b.deflection[i];
  return sum;
}
Chain operator*(double factor, const Chain& a) {
  Chain product;
  for (int i = 0; i < 3; ++i) product.velocity[i] = factor * a.velocity[i];
  for (int i = 0; i < 2; ++i) product.deflection[i] = factor * a.deflection[i];
  return product;
}

Chain derivative(const Chain& at, double exponent) {
  const auto force = [&](double h) { return h > 0 ? std::pow(h, exponent) : 0.0; };
  const double first = force(at.deflection[0]), second = force(at.deflection[1]);
  return {{-first, first - second, second}, {at.velocity[0] - at.velocity[1], at.velocity[1] - at.velocity[2]}};
}

/// Final velocities; exponent 1 (linear) or 3/2 (hertz). The opening of a contact costs dt^2 at 1e-4: 1e-8.
std::array<double, 3> integrate(double exponent) {
  Chain state;
  const double dt = 1e-4;
  for (int step = 0; step < 100000; ++step) {  // the last contact opens before t = 5
    const Chain a = derivative(state, exponent);
    const Chain b = derivative(state + dt / 2 * a, exponent);
    const Chain c = derivative(state + dt / 2 * b, exponent);
    const Chain d = derivative(state + dt * c, exponent);
    state = state + dt / 6 * (a + 2 * b + 2 * c + d);
  }
  EXPECT_LT(std::max(state.deflection[0], state.deflection[1]), 0) << "still in contact";
  return state.velocity;
}

constexpr double stiffness = 1e6;

/// Final velocities along a row in a direction that is no axis; `steps`: per time unit of the integration above.
template <int D>
std::array<double, 3> collide(NormalLaw law, double steps) {
  const double speed = 0.3;
  const Elastic matter{stiffness, 0.2};
  Scene scene = law == NormalLaw::linear ? linear_scene(D, 0, stiffness) : hertz_scene(D, 0, matter.young, 0.2);
  const double k = hertz_coefficient(contact_modulus(matter, matter), 0.25);
  const double unit =
      law == NormalLaw::linear ? 1 / std::sqrt(stiffness) : std::pow(1 / (k * k * speed), 0.2);  // m = 1
  set_dt(scene, unit / steps);
  const Vec<D> n = generic_direction<D>();
  Sample<D> sample;
  sample.cell = cube<D>(20, false);
  sample.resize(3);
  // Gaps of 1e-14 by rounding: 1e-9 of the deflections.
  for (int i = 0; i < 3; ++i) sample.position[i] = Vec<D>::Constant(10) + (i - 1) * n;
  sample.velocity[0] = speed * n;
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  engine->advance(std::lround(10 * steps));
  const Snapshot<D> after = engine->snapshot();
  EXPECT_FALSE(in_contact<D>(after));
  std::array<double, 3> result;
  for (int i = 0; i < 3; ++i) {
    result[i] = after.velocity[i].dot(n) / speed;
    EXPECT_LT((after.velocity[i] / speed - result[i] * n).norm(), 1e-12);
  }
  EXPECT_NEAR(result[0] + result[1] + result[2], 1, 1e-13);
  return result;
}

TEST(Chain, LinearSpringsOfTheLiterature) {
  // 1e-8 from 2e4 steps per w0^-1, and half a unit of the last digit.
  const std::array expected{-0.1303, 0.1502, 0.9800};
  const std::array<double, 3> computed = integrate(1);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(computed[i], expected[i], 0.51e-4);
  for (const std::array<double, 3>& found : {collide<2>(NormalLaw::linear, 2e4), collide<3>(NormalLaw::linear, 2e4)})
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 0.51e-4) << i;
}

/// Largest error of the three final velocities.
template <int D>
double chain_error(NormalLaw law, double steps, const std::array<double, 3>& expected) {
  const std::array<double, 3> found = collide<D>(law, steps);
  double largest = 0;
  for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(found[i] - expected[i]));
  return largest;
}

template <int D>
void check_convergence(NormalLaw law) {
  SCOPED_TRACE(to_string(law) + " D = " + std::to_string(D));
  const std::array<double, 3> expected = integrate(law == NormalLaw::linear ? 1 : 1.5);
  const std::array<double, 5> steps{20.3, 41.7, 83.1, 166.9, 333.3};
  std::array<double, 5> dt, error;
  for (std::size_t k = 0; k < 5; ++k) {
    dt[k] = 1 / steps[k];
    error[k] = chain_error<D>(law, steps[k], expected);
  }
  // Order 2: no force jumps. A slope over five points may be off by some tenths, as the phase of the opening within
  // its step varies.
  EXPECT_GT(observed_order(dt, error), 1.7);
  EXPECT_LT(error[4], 4 * dt[4] * dt[4]);  // (w0 dt)^2 with a coefficient of order 1
}

TEST(Chain, ConvergesAtSecondOrderDisks) {
  for (NormalLaw law : both_laws) check_convergence<2>(law);
}
TEST(Chain, ConvergesAtSecondOrderSpheres) {
  for (NormalLaw law : both_laws) check_convergence<3>(law);
}

}  // namespace
}  // namespace galet::test::chain_test
