// Runs for the tests of bits: sheared, frictional, dense enough for contacts in every step.
#pragma once

#include "common/core/archive.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/thread_count.hpp"

namespace galet::test {

template <int D>
std::uint64_t hash_of(const Engine<D>& engine) {
  Archive archive;
  engine.save(archive);
  return state_hash(archive);
}

/// A crystal of grains that almost touch and move against each other: about half of the pairs collide in the first
/// steps, and the pressure keeps the sample dense. `law`: in place of the plain one (md).
template <int D>
std::unique_ptr<Engine<D>> dense_run(EngineKind kind, int cells, double pressure, const RichLaw* law = nullptr) {
  Sample<D> sample = crystal_sample<D>(cells, 1.002);
  vary_sizes<D>(sample, 0.001, 51);
  shake<D>(sample, 0.3, 52, 0.3);
  Scene scene = sheared_scene<D>(0.3, pressure);
  scene.cd.dt = 4e-3;
  scene.cd.tolerance = 1e-3;
  scene.cd.max_sweeps = 40;  // bits must agree whether or not the tolerance is reached
  if (law) {
    law->change(scene);
    mix_materials<D>(scene, sample);
  }
  return make_engine<D>(kind, scene, sample);
}

/// More than 3000 grains: enough work for every thread to be woken.
template <int D>
std::unique_ptr<Engine<D>> large_run(EngineKind kind, double pressure, const RichLaw* law = nullptr) {
  return dense_run<D>(kind, D == 2 ? 40 : 10, pressure, law);
}
inline long large_steps(EngineKind kind) { return kind == EngineKind::md ? (sanitized ? 30 : 60) : 3; }

template <int D>
std::unique_ptr<Engine<D>> small_run(EngineKind kind, const RichLaw* law = nullptr) {
  return dense_run<D>(kind, D == 2 ? 6 : 3, 1, law);
}

}  // namespace galet::test
