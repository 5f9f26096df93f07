// Rigid bodies for tests: dumbbells, gases of clumps, and sums over the bodies of a snapshot.
#pragma once

#include "tests/support/scenes.hpp"

namespace galet::test {

/// A body that forces move and turn as they like.
inline BodySpec free_body(int dim, std::string name) {
  BodySpec body;
  body.name = std::move(name);
  body.free.assign(dim, true);
  body.free_rotation.assign(dim == 2 ? 1 : 3, true);
  return body;
}

/// Two touching grains (d = m = 1) along `direction` about `centre`, in a large cell that is no boundary: body 0.
template <int D>
Sample<D> dumbbell_sample(const Vec<D>& direction, const Vec<D>& centre = Vec<D>::Constant(20)) {
  Sample<D> sample;
  sample.cell = cube<D>(40, false);
  sample.resize(2);
  for (int k : {0, 1}) sample.position[k] = centre + (k - 0.5) * direction;
  sample.body = {0, 0};
  return sample;
}

/// Adds a free grain (d = m = 1).
template <int D>
int add_grain(Sample<D>& sample, const Vec<D>& position, const Vec<D>& velocity = Vec<D>::Zero()) {
  sample.position.push_back(position);
  sample.velocity.push_back(velocity);
  sample.spin.push_back(zero_spin<D>());
  sample.radius.push_back(0.5);
  sample.mass.push_back(1);
  sample.material.push_back(0);
  if (!sample.body.empty()) sample.body.push_back(-1);
  return sample.count() - 1;
}

/// A gas of side^D free clumps of three unequal grains, and as many free grains, with random velocities and spins.
template <int D>
std::pair<Scene, Sample<D>> clump_gas(int side, double speed, std::uint64_t seed, bool periodic = true) {
  constexpr double spacing = 3.2;
  Scene scene = periodic ? periodic_scene(D, 0.4, 0.5, 1e4) : free_scene(D, 0.4, 0.5, 1e4);
  const Sample<D> sites = lattice_sample<D>(side, spacing);
  Sample<D> sample;
  sample.cell = cube<D>(side * spacing + (periodic ? 0 : 40), periodic);
  sample.body = {-1};
  const auto random = [&](RandomStream& stream, double size) {
    std::vector<double> values(D);
    for (double& value : values) value = size * stream.normal();
    return values;
  };
  for (int k = 0; k < sites.count(); ++k) {
    RandomStream stream(seed, k);
    const Vec<D> site = sites.position[k] + Vec<D>::Constant(periodic ? 0 : 20);
    BodySpec body = free_body(D, std::to_string(k));
    body.velocity = random(stream, speed);
    body.spin = random(stream, speed);
    if (D == 2) body.spin.resize(1);
    Vec<D> along = Eigen::Map<const Vec<D>>(random(stream, 1).data());
    along.normalize();
    const Vec<D> across = generic_tangent<D>(along);
    for (int grain = 0; grain < 3; ++grain) {
      const Vec<D> offset = grain == 2 ? Vec<D>(0.5 * across) : Vec<D>((grain - 0.5) * 0.8 * along);
      add_grain<D>(sample, site + offset);
      sample.radius.back() = grain == 2 ? 0.3 : 0.5, sample.mass.back() = grain == 2 ? 0.4 : 1;
      sample.body.back() = k;
    }
    const auto velocity = random(stream, speed);
    add_grain<D>(sample, site + Vec<D>(1.55 * Vec<D>::Ones()), Eigen::Map<const Vec<D>>(velocity.data()));
    scene.bodies.push_back(body);
  }
  sample.body.erase(sample.body.begin());
  scene.cd.dt = 2e-3;
  return {scene, sample};
}

/// Contacts resist rolling, and pivoting in 3D.
inline void resist_rolling(Scene& scene) {
  scene.material.rolling_friction = 0.08;
  if (scene.dimension == 3) scene.material.pivoting_friction = 0.05;
}

/// Momentum and angular momentum about `origin`; scale: what rounding is relative to.
template <int D>
struct BodyMomenta {
  Vec<D> linear = Vec<D>::Zero();
  Spin<D> angular = zero_spin<D>();
  double scale = 0;
};

template <int D>
BodyMomenta<D> body_momenta(const Snapshot<D>& state, const std::vector<int>& body_of, const Vec<D>& origin) {
  BodyMomenta<D> sum;
  const auto add = [&](double mass, const Vec<D>& x, const Vec<D>& v, const Spin<D>& own) {
    sum.linear += mass * v;
    sum.angular += cross(Vec<D>(x - origin), Vec<D>(mass * v)) + own;
    sum.scale += mass * v.norm() * (1 + (x - origin).norm()) + spin_norm(own);
  };
  for (int i = 0; i < state.grains(); ++i)
    if (body_of[i] < 0)
      add(state.mass[i], state.position[i], state.velocity[i],
          Spin<D>(inertia_ratio<D> * state.mass[i] * state.radius[i] * state.radius[i] * state.spin[i]));
  for (const RigidBody<D>& body : state.bodies) add(body.mass, body.centre, body.velocity, angular_momentum(body));
  return sum;
}

}  // namespace galet::test
