// Dense samples for the benchmarks: a gas compressed isotropically at kappa = 1000 by the md engine.
#pragma once

#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "md/engine.hpp"

namespace galet::bench {

/// A scene of `count` grains under isotropic pressure 1, md at kappa = 1000.
inline Scene dense_scene(int dim, int count, double friction) {
  Scene scene;
  scene.dimension = dim;
  scene.grains.count = count;
  scene.grains.diameter = dim == 2 ? SizeDistribution{SizeKind::uniform, 1, 0.2, {}, {}} : SizeDistribution{};
  scene.material.friction = friction;
  scene.material.restitution = 0.3;
  scene.material.stiffness_level = 1e3;
  scene.material.tangential_stiffness_ratio = 2.0 / 7;
  scene.initial.solid_fraction = dim == 2 ? 0.5 : 0.3;
  scene.cell.periodic.assign(dim, true);
  scene.loading.kind = LoadingKind::isotropic;
  scene.loading.pressure = 1;
  scene.run.duration = 1;
  return scene;
}

/// The grains of an engine as a sample at rest.
template <int D>
Sample<D> at_rest(Engine<D>& engine, const Sample<D>& start) {
  const Snapshot<D> now = engine.snapshot();
  Sample<D> sample = start;
  sample.cell = *now.cell;
  sample.cell.rate.setZero();
  sample.position.assign(now.position.begin(), now.position.end());
  for (auto& velocity : sample.velocity) velocity.setZero();
  for (auto& spin : sample.spin) spin = zero_spin<D>();
  return sample;
}

/// `friction`: while compressing.
template <int D>
Sample<D> dense_sample(int count, double friction) {
  const Scene scene = dense_scene(D, count, friction);
  const Sample<D> gas = initial_sample<D>(scene);
  const Derived derived = derive(scene, grain_facts<D>(scene, gas));
  auto engine = md::make_engine<D>(scene, derived, gas);
  engine->advance(static_cast<long>(60 * *derived.inertial_time / engine->dt()));
  return at_rest<D>(*engine, gas);
}

/// `copies` of the cell along each direction.
template <int D>
Sample<D> replicated(const Sample<D>& cell, int copies) {
  Sample<D> sample = cell;
  sample.cell.box *= copies;
  sample.resize(0);
  Image<D> image{};
  const int images = D == 2 ? copies * copies : copies * copies * copies;
  for (int k = 0; k < images; ++k) {
    for (int a = 0, rest = k; a < D; ++a, rest /= copies) image[a] = rest % copies;
    const Vec<D> shift = lattice<D>(cell.cell.box, image);
    for (int i = 0; i < cell.count(); ++i) {
      sample.position.push_back(cell.position[i] + shift);
      sample.velocity.push_back(cell.velocity[i]);
      sample.spin.push_back(cell.spin[i]);
      sample.radius.push_back(cell.radius[i]);
      sample.mass.push_back(cell.mass[i]);
      sample.material.push_back(cell.material[i]);
    }
  }
  return sample;
}

}  // namespace galet::bench
