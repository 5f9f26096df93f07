#include "src/compression.hpp"

#include "common/core/error.hpp"

namespace galet {

Scene compression_scene(const Scene& scene, const Derived& derived) {
  if (!derived.pressure || !derived.inertial_time)
    throw InputError("initial.kind = \"compressed_gas\" needs loading.pressure: the gas is compressed to it");
  Scene gas = scene;
  gas.initial.kind = InitialKind::gas;
  gas.material.friction = scene.initial.friction.value_or(scene.material.friction);
  gas.loading = LoadingSpec{};
  gas.loading.kind = LoadingKind::isotropic;
  gas.loading.pressure = derived.pressure;
  gas.stages.clear();
  static_cast<EndSpec&>(gas.run) = EndSpec{};
  gas.run.duration = compression_limit * *derived.inertial_time;
  gas.run.equilibrium = compression_equilibrium;
  gas.run.samples = 400;
  gas.output = OutputSpec{};
  gas.compare = CompareSpec{};
  return gas;
}

}  // namespace galet
