// What each layout costs: the same sheared, dense, frictionless-in-fact sample (mu = 0) stepped in the frictionless
// layout and in the frictional one (which then stores rotations, springs and tangential parts for nothing), and with
// real friction. Google Benchmark; `grain_steps` is grains times steps per second of processor time.
// What it can't tell: absolute times of another machine; ratios between rows of one run are what counts.
#include <benchmark/benchmark.h>

#include "benchmarks/dense_sample.hpp"
#include "cd/engine.hpp"

namespace galet {
namespace {

enum class Kind { frictionless, friction_layout_without_friction, friction };

template <int D>
Scene sheared(double friction) {
  Scene scene = bench::dense_scene(D, 2000, friction);
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.inertial_number = 0.01;
  scene.material.restitution = 0.1;
  return scene;
}

template <int D>
const Sample<D>& sample_with(double friction) {
  static const Sample<D> smooth = bench::dense_sample<D>(2000, 0), rough = bench::dense_sample<D>(2000, 0.4);
  return friction > 0 ? rough : smooth;
}

template <int D>
void step(benchmark::State& state, EngineKind engine_kind, Kind kind) {
  const double friction = kind == Kind::friction ? 0.4 : 0;
  const Scene scene = sheared<D>(friction);
  const Sample<D>& sample = sample_with<D>(friction);
  Derived derived = derive(scene, grain_facts<D>(scene, sample));
  if (kind == Kind::friction_layout_without_friction) derived.layout.friction = true;
  auto engine = engine_kind == EngineKind::md ? md::make_engine<D>(scene, derived, sample)
                                              : cd::make_engine<D>(scene, derived, sample);
  const long batch = engine_kind == EngineKind::md ? 50 : 2;
  engine->advance(10 * batch);
  long steps = 0;
  const long sweeps_before = engine->solver_summary().sweeps;
  for (auto _ : state) {
    engine->advance(batch);
    steps += batch;
  }
  const auto grain_steps = static_cast<double>(steps) * sample.count();
  state.counters["grain_steps"] = benchmark::Counter(grain_steps, benchmark::Counter::kIsRate);
  // Every row has the same counters (the CSV output wants that): no sweeps in md.
  state.counters["sweeps_per_step"] =
      static_cast<double>(engine->solver_summary().sweeps - sweeps_before) / static_cast<double>(steps);
}

void disks(benchmark::State& state, EngineKind engine, Kind kind) { step<2>(state, engine, kind); }
void spheres(benchmark::State& state, EngineKind engine, Kind kind) { step<3>(state, engine, kind); }

BENCHMARK_CAPTURE(disks, md_frictionless, EngineKind::md, Kind::frictionless);
BENCHMARK_CAPTURE(disks, md_friction_layout_mu_0, EngineKind::md, Kind::friction_layout_without_friction);
BENCHMARK_CAPTURE(disks, md_friction, EngineKind::md, Kind::friction);
BENCHMARK_CAPTURE(spheres, md_frictionless, EngineKind::md, Kind::frictionless);
BENCHMARK_CAPTURE(spheres, md_friction_layout_mu_0, EngineKind::md, Kind::friction_layout_without_friction);
BENCHMARK_CAPTURE(spheres, md_friction, EngineKind::md, Kind::friction);
BENCHMARK_CAPTURE(disks, cd_frictionless, EngineKind::cd, Kind::frictionless);
BENCHMARK_CAPTURE(disks, cd_friction_layout_mu_0, EngineKind::cd, Kind::friction_layout_without_friction);
BENCHMARK_CAPTURE(disks, cd_friction, EngineKind::cd, Kind::friction);
BENCHMARK_CAPTURE(spheres, cd_frictionless, EngineKind::cd, Kind::frictionless);
BENCHMARK_CAPTURE(spheres, cd_friction_layout_mu_0, EngineKind::cd, Kind::friction_layout_without_friction);
BENCHMARK_CAPTURE(spheres, cd_friction, EngineKind::cd, Kind::friction);

}  // namespace
}  // namespace galet

BENCHMARK_MAIN();
