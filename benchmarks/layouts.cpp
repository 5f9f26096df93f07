// What each layout costs: the same sheared, dense, frictionless-in-fact sample (mu = 0) stepped in the frictionless
// layout and in the frictional one (which then stores rotations, springs and tangential parts for nothing), and with
// real friction. Then what each term of the contact law of md adds to the frictional sample. Google Benchmark;
// `grain_steps` is grains times steps per second of processor time. What it can't tell: absolute times of another
// machine; ratios between rows of one run are what counts.
#include <benchmark/benchmark.h>

#include "benchmarks/dense_sample.hpp"
#include "cd/engine.hpp"

namespace galet {
namespace {

/// One row: the layout, and what is added to the plain law.
struct Kind {
  bool friction = true;
  bool friction_layout = false;  ///< forced on a scene that does without
  bool rolling_layout = false;   ///< the same for rolling
  void (*add)(Scene&) = [](Scene&) {};
};

const Kind frictionless{.friction = false};
const Kind friction_layout_without_friction{.friction = false, .friction_layout = true};
const Kind friction{};
const Kind rolling_layout_without_rolling{.rolling_layout = true};
const Kind rolling{.add = [](Scene& scene) {
  scene.material.rolling_friction = 0.01;
  if (scene.dimension == 3) scene.material.pivoting_friction = 0.01;
}};
const Kind hertz{.add = [](Scene& scene) {
  scene.material.normal_law = NormalLaw::hertz;
  scene.material.poisson_ratio = 0.3;
  scene.material.tangential_stiffness_ratio.reset();
}};
const Kind tangential_viscosity{.add = [](Scene& scene) { scene.material.tangential_damping_ratio = 0.1; }};
const Kind cohesion{.add = [](Scene& scene) { scene.material.cohesion_force = 0.1; }};
const Kind cohesion_range{.add = [](Scene& scene) {
  scene.material.cohesion_force = 0.1;
  scene.material.cohesion_range = 0.05;
}};
const Kind two_materials{.add = [](Scene& scene) { scene.other_materials.push_back({.name = "other"}); }};
const Kind energy_budget{.add = [](Scene& scene) { scene.md.energy_budget = true; }};

template <int D>
Scene sheared(double coefficient) {
  Scene scene = bench::dense_scene(D, 2000, coefficient);
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.inertial_number = 0.01;
  scene.material.restitution = 0.1;
  return scene;
}

template <int D>
const Sample<D>& sample_with(double coefficient) {
  static const Sample<D> smooth = bench::dense_sample<D>(2000, 0), rough = bench::dense_sample<D>(2000, 0.4);
  return coefficient > 0 ? rough : smooth;
}

template <int D>
void step(benchmark::State& state, EngineKind engine_kind, const Kind& kind) {
  const double coefficient = kind.friction ? 0.4 : 0;
  Scene scene = sheared<D>(coefficient);
  kind.add(scene);
  Sample<D> sample = sample_with<D>(coefficient);
  if (!scene.other_materials.empty())
    for (int i = 0; i < sample.count(); ++i) sample.material[i] = i % 2;
  Derived derived = derive(scene, grain_facts<D>(scene, sample));
  if (kind.friction_layout) derived.layout.friction = true;
  if (kind.rolling_layout) derived.layout.rolling = true;
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

void disks(benchmark::State& state, EngineKind engine, const Kind& kind) { step<2>(state, engine, kind); }
void spheres(benchmark::State& state, EngineKind engine, const Kind& kind) { step<3>(state, engine, kind); }

BENCHMARK_CAPTURE(disks, md_frictionless, EngineKind::md, frictionless);
BENCHMARK_CAPTURE(disks, md_friction_layout_mu_0, EngineKind::md, friction_layout_without_friction);
BENCHMARK_CAPTURE(disks, md_friction, EngineKind::md, friction);
BENCHMARK_CAPTURE(disks, md_rolling_layout_mu_r_0, EngineKind::md, rolling_layout_without_rolling);
BENCHMARK_CAPTURE(disks, md_rolling, EngineKind::md, rolling);
BENCHMARK_CAPTURE(disks, md_hertz, EngineKind::md, hertz);
BENCHMARK_CAPTURE(disks, md_tangential_viscosity, EngineKind::md, tangential_viscosity);
BENCHMARK_CAPTURE(disks, md_cohesion, EngineKind::md, cohesion);
BENCHMARK_CAPTURE(disks, md_cohesion_range, EngineKind::md, cohesion_range);
BENCHMARK_CAPTURE(disks, md_two_materials, EngineKind::md, two_materials);
BENCHMARK_CAPTURE(disks, md_energy_budget, EngineKind::md, energy_budget);
BENCHMARK_CAPTURE(spheres, md_frictionless, EngineKind::md, frictionless);
BENCHMARK_CAPTURE(spheres, md_friction_layout_mu_0, EngineKind::md, friction_layout_without_friction);
BENCHMARK_CAPTURE(spheres, md_friction, EngineKind::md, friction);
BENCHMARK_CAPTURE(spheres, md_rolling_layout_mu_r_0, EngineKind::md, rolling_layout_without_rolling);
BENCHMARK_CAPTURE(spheres, md_rolling, EngineKind::md, rolling);
BENCHMARK_CAPTURE(spheres, md_hertz, EngineKind::md, hertz);
BENCHMARK_CAPTURE(spheres, md_tangential_viscosity, EngineKind::md, tangential_viscosity);
BENCHMARK_CAPTURE(spheres, md_cohesion, EngineKind::md, cohesion);
BENCHMARK_CAPTURE(spheres, md_cohesion_range, EngineKind::md, cohesion_range);
BENCHMARK_CAPTURE(spheres, md_two_materials, EngineKind::md, two_materials);
BENCHMARK_CAPTURE(spheres, md_energy_budget, EngineKind::md, energy_budget);
BENCHMARK_CAPTURE(disks, cd_frictionless, EngineKind::cd, frictionless);
BENCHMARK_CAPTURE(disks, cd_friction_layout_mu_0, EngineKind::cd, friction_layout_without_friction);
BENCHMARK_CAPTURE(disks, cd_friction, EngineKind::cd, friction);
BENCHMARK_CAPTURE(spheres, cd_frictionless, EngineKind::cd, frictionless);
BENCHMARK_CAPTURE(spheres, cd_friction_layout_mu_0, EngineKind::cd, friction_layout_without_friction);
BENCHMARK_CAPTURE(spheres, cd_friction, EngineKind::cd, friction);

}  // namespace
}  // namespace galet

BENCHMARK_MAIN();
