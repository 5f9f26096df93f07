// Two bodies that meet: samples of any size (SI or reduced), how the bodies lie to each other, running until they
// part, and the constants of Hertz contacts written out from the literature.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test {

inline constexpr std::array both_laws{NormalLaw::linear, NormalLaw::hertz};

inline std::string to_string(NormalLaw law) { return law == NormalLaw::linear ? "linear" : "hertz"; }

/// A further material that takes everything from [material] but its name.
inline OtherMaterial other(const std::string& name) {
  OtherMaterial material;
  material.name = name;
  return material;
}

/// Grains in free space with the Hertz law; elastic unless the test says more. The step is the test's own.
inline Scene hertz_scene(int dim, double friction, double young, double poisson) {
  Scene scene = free_scene(dim, friction, 1, 1);
  scene.material.normal_stiffness.reset();
  scene.material.normal_law = NormalLaw::hertz;
  scene.material.young_modulus = young;
  scene.material.poisson_ratio = poisson;
  scene.md.allow_unsafe_dt = true;
  return scene;
}

/// Likewise with the linear law.
inline Scene linear_scene(int dim, double friction, double stiffness) {
  Scene scene = free_scene(dim, friction, 1, stiffness);
  scene.md.allow_unsafe_dt = true;  // the bound is for packings; a test of one pair chooses its own step
  return scene;
}

/// Elastic constants of one body.
struct Elastic {
  double young = 1;
  double poisson = 0;
};

/// E*: 1/E* = sum of (1 - nu^2) / E.
inline double contact_modulus(Elastic a, Elastic b) {
  return 1 / ((1 - a.poisson * a.poisson) / a.young + (1 - b.poisson * b.poisson) / b.young);
}

/// G*: 1/G* = sum of 2 (2 - nu)(1 + nu) / E.
inline double contact_shear_modulus(Elastic a, Elastic b) {
  const auto compliance = [](Elastic x) { return 2 * (2 - x.poisson) * (1 + x.poisson) / x.young; };
  return 1 / (compliance(a) + compliance(b));
}

/// k of F_N = k h^(3/2): (4/3) E* sqrt(R*).
inline double hertz_coefficient(double modulus, double radius) { return 4.0 / 3.0 * modulus * std::sqrt(radius); }

/// R* = R_i R_j / (R_i + R_j), likewise m*.
inline double reduced(double a, double b) { return a * b / (a + b); }

/// An elastic Hertz impact of relative speed V (references.md, A8): m* V^2 / 2 = (2/5) k h^(5/2) at the turning point.
struct HertzImpact {
  double deflection, force, duration;
};

inline HertzImpact hertz_impact(double coefficient, double reduced_mass, double speed) {
  const double h = std::pow(1.25 * reduced_mass * speed * speed / coefficient, 0.4);
  const double duration = 0.8 * std::sqrt(pi) * std::tgamma(0.4) / std::tgamma(0.9) * h / speed;
  return {h, coefficient * std::pow(h, 1.5), duration};
}

/// Grains 0 and 1 in the middle of a cell of 20 times the sum of their radii; 1 lies in direction n of 0.
template <int D>
Sample<D> pair_apart(const Vec<D>& n, double gap, std::array<double, 2> radius, std::array<double, 2> mass) {
  const double sum = radius[0] + radius[1];
  Sample<D> sample;
  sample.cell = cube<D>(20 * sum, false);
  sample.resize(2);
  sample.radius = {radius[0], radius[1]};
  sample.mass = {mass[0], mass[1]};
  sample.position[0] = Vec<D>::Constant(10 * sum);
  sample.position[1] = sample.position[0] + (sum + gap) * n;
  return sample;
}

/// A grain and a plane in the middle of a cell of 20 diameters; n points from the grain to the plane.
template <int D>
Sample<D> ball_apart(const Vec<D>& n, double gap, double radius, double mass) {
  Sample<D> sample;
  sample.cell = cube<D>(40 * radius, false);
  sample.resize(1);
  sample.radius[0] = radius;
  sample.mass[0] = mass;
  sample.planes.push_back({Vec<D>::Constant(20 * radius), -n, Vec<D>::Zero()});
  sample.position[0] = sample.planes[0].point - (radius + gap) * n;
  return sample;
}

/// How grain 1 (or the plane) lies and moves, seen from grain 0; spins apart.
template <int D>
struct Meeting {
  Vec<D> normal;
  double gap;
  double opening_speed;  ///< u_N
};

template <int D>
Meeting<D> meeting(const Snapshot<D>& state) {
  const Vec<D> u = relative_velocity<D>(state);
  if (state.grains() == 1) {
    const Vec<D> n = -state.planes[0].normal;
    return {n, (state.planes[0].point - state.position[0]).dot(n) - state.radius[0], u.dot(n)};
  }
  const Vec<D> branch = state.position[1] - state.position[0];
  const Vec<D> n = branch.normalized();
  return {n, branch.norm() - state.radius[0] - state.radius[1], u.dot(n)};
}

/// Runs until the bodies are apart and flying away from each other; false when they still are not after `longest`.
template <int D>
bool run_until_apart(Engine<D>& engine, double longest) {
  const long chunk = std::max(1L, std::lround(longest / engine.dt() / 100));
  while (engine.time() < longest) {
    engine.advance(chunk);
    const Meeting<D> now = meeting<D>(engine.snapshot());
    if (now.gap > 0 && now.opening_speed > 0) return true;
  }
  ADD_FAILURE() << "the bodies have not parted by t = " << engine.time();
  return false;
}

/// A head-on impact. Free flights are uniform, so touching and parting are found by extrapolating them.
struct HeadOn {
  double restitution = 0;
  double contact_time = 0;  ///< while the surfaces overlap
  double momentum_error = 0;
};

/// Runs the impact of a sample whose bodies just touch, at relative speed `speed`; they are drawn (1 + phase) steps
/// apart first, so that contact starts in any phase of a step. `longest`: well above the contact's duration.
template <int D>
HeadOn head_on(Scene scene, Sample<D> sample, double speed, double dt, double phase, double longest) {
  set_dt(scene, dt);
  const Meeting<D> start = [&] {
    Snapshot<D> view;
    view.position = sample.position, view.velocity = sample.velocity, view.radius = sample.radius;
    view.planes = sample.planes;
    return meeting<D>(view);
  }();
  const Vec<D> n = start.normal;
  set_relative_velocity<D>(sample, -speed * n);
  const double gap = (1 + phase) * speed * dt;
  sample.position[0] -= (gap - start.gap) * n;
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  HeadOn result;
  if (!run_until_apart<D>(*engine, longest)) return result;
  const Snapshot<D> after = engine->snapshot();
  const Meeting<D> end = meeting<D>(after);
  result.restitution = end.opening_speed / speed;
  result.contact_time = engine->time() - end.gap / end.opening_speed - gap / speed;
  if (after.grains() == 2)
    result.momentum_error = (after.mass[0] * after.velocity[0] + after.mass[1] * after.velocity[1]).norm();
  return result;
}

/// The only contact of a sample after three steps of dt, too short to move anything: force and gap of a given state.
template <int D>
struct Probe {
  double gap = 0, normal_force = 0;
  Vec<D> normal = Vec<D>::Zero(), tangential_force = Vec<D>::Zero();
  bool touches = false;
};

template <int D>
Probe<D> probe(Scene scene, const Sample<D>& sample, double dt) {
  set_dt(scene, dt);
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  engine->advance(3);
  const Snapshot<D> state = engine->snapshot();
  Probe<D> seen;
  EXPECT_EQ(state.contacts->size(), 1u);
  if (state.contacts->size() != 1) return seen;
  seen.gap = state.contacts->gap[0];
  seen.normal = state.contacts->normal[0];
  seen.normal_force = state.contacts->force[0].dot(seen.normal);
  seen.tangential_force = state.contacts->force[0] - seen.normal_force * seen.normal;
  seen.touches = state.contacts->touches(0);
  return seen;
}

}  // namespace galet::test
