// Runs for the tests of bits: sheared, frictional, dense enough for contacts in every step.
#pragma once

#include "common/core/archive.hpp"
#include "common/core/parallel.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test {

/// Puts the number of threads back, also when an assertion leaves the test early.
class ThreadCount {
 public:
  ThreadCount() = default;
  ~ThreadCount() { set_thread_count(before_); }
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

 private:
  int before_ = thread_count();
};

template <int D>
std::uint64_t hash_of(const Engine<D>& engine) {
  Archive archive;
  engine.save(archive);
  return state_hash(archive);
}

/// A crystal of unequal grains at about zero gap (some overlap by 0.02 d), so that half of the pairs touch at once.
template <int D>
std::unique_ptr<Engine<D>> dense_run(EngineKind kind, int cells, double pressure) {
  Sample<D> sample = crystal_sample<D>(cells, 1.0);
  vary_sizes<D>(sample, 0.02, 51);
  shake<D>(sample, 0.2, 52, 0.2);
  Scene scene = sheared_scene<D>(0.5, pressure);
  scene.cd.dt = 2e-3;
  scene.cd.tolerance = 1e-3;
  scene.cd.max_sweeps = 100;  // bits must agree whether or not the tolerance is reached
  scene.cd.penetration = 1e-3;
  return make_engine<D>(kind, scene, sample);
}

/// More than 3000 grains: enough work for every thread to be woken.
template <int D>
std::unique_ptr<Engine<D>> large_run(EngineKind kind, double pressure) {
  return dense_run<D>(kind, D == 2 ? 40 : 10, pressure);
}
inline long large_steps(EngineKind kind) { return kind == EngineKind::md ? 150 : 6; }

template <int D>
std::unique_ptr<Engine<D>> small_run(EngineKind kind) {
  return dense_run<D>(kind, D == 2 ? 6 : 3, 1);
}

}  // namespace galet::test
