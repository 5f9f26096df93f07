// What each stage of a step costs, one at a time, on packings of 2000 disks and 2000 spheres (mu = 0.4, P = 1, at
// rest). Google Benchmark; `per_item` is the time of one processor per item: a grain, a listed pair or a contact, as
// the row's label says.
//
//   md   list: made anew, and the test whether it still holds; contact pass and grain pass: their shares of steps in
//        plane shear at I = 0.01, by the engine's own clock
//   cd   assembly (frames, choice of pairs, colours, columns), the colours alone, a sweep, the residual
//   both measures of a state, a checkpoint on the disk
//
// What it can't tell: how often a stage runs (layouts.cpp, cd_runs.cpp), larger samples (md_scaling.cpp).
#include <benchmark/benchmark.h>

#include "benchmarks/cold_problem.hpp"
#include "cd/engine.hpp"
#include "cd/solvers/nsgs.hpp"
#include "common/core/clock.hpp"
#include "common/io/checkpoint.hpp"
#include "common/io/scratch_folder.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/fabric.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/stress.hpp"
#include "common/measure/voronoi.hpp"

namespace galet {
namespace {

constexpr int grains = 2000;

/// Time per item; `done`: how many were dealt with in all iterations.
void count_items(benchmark::State& state, double done, const char* item) {
  state.counters["per_item"] = benchmark::Counter(done, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.SetLabel(item);
}

template <int D>
const bench::ColdProblem<Layout{D, true}>& cold() {
  static const bench::ColdProblem<Layout{D, true}> made(grains);
  return made;
}

/// A sheared packing of either engine, some steps on.
template <int D>
Engine<D>& flowing(EngineKind kind) {
  static const Sample<D> sample = bench::dense_sample<D>(grains, 0.4);
  static std::unique_ptr<Engine<D>> engines[2];
  std::unique_ptr<Engine<D>>& engine = engines[kind == EngineKind::cd];
  if (engine) return *engine;
  Scene scene = bench::dense_scene(D, grains, 0.4);
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.inertial_number = 0.01;
  const Derived derived = derive(scene, grain_facts<D>(scene, sample));
  engine =
      kind == EngineKind::md ? md::make_engine<D>(scene, derived, sample) : cd::make_engine<D>(scene, derived, sample);
  engine->advance(kind == EngineKind::md ? 500 : 20);
  return *engine;
}

// ---- neighbours ---------------------------------------------------------------------------------------------------

template <int D>
void list_made(benchmark::State& state) {
  auto bodies = cold<D>().bodies;
  VerletList<D> list;
  list.configure(0, 0.1);
  for (auto _ : state) list.build(bodies.position, bodies.radius, bodies.cell, bodies.planes);
  count_items(state, static_cast<double>(state.iterations()) * grains, "grain");
}

template <int D>
void list_tested(benchmark::State& state) {
  const auto& at = cold<D>();
  for (auto _ : state) {
    bool expired = at.list.expired(at.bodies.position, at.bodies.cell, at.bodies.planes);
    benchmark::DoNotOptimize(expired);
  }
  count_items(state, static_cast<double>(state.iterations()) * grains, "grain");
}

// ---- md -----------------------------------------------------------------------------------------------------------

/// Steps of md; the time of one stage is its share of theirs.
template <int D>
void md_stage(benchmark::State& state, Stage stage) {
  Engine<D>& engine = flowing<D>(EngineKind::md);
  constexpr long batch = 50;
  double pairs = 0;
  for (auto _ : state) {
    const double before = engine.profile().seconds(stage), wall = wall_seconds(), processor = thread_seconds();
    engine.advance(batch);
    const double share = (thread_seconds() - processor) / (wall_seconds() - wall);
    state.SetIterationTime(share * (engine.profile().seconds(stage) - before));
    pairs += static_cast<double>(batch * engine.memory().listed);
  }
  if (stage == Stage::contacts)
    count_items(state, pairs, "listed pair");
  else
    count_items(state, static_cast<double>(state.iterations() * batch) * grains, "grain");
}

// ---- cd -----------------------------------------------------------------------------------------------------------

template <int D>
void assembly(benchmark::State& state) {
  auto problem = cold<D>();
  for (auto _ : state) problem.assemble();
  count_items(state, static_cast<double>(state.iterations()) * static_cast<double>(problem.problem.size()), "contact");
}

template <int D>
void colours(benchmark::State& state) {
  const auto& problem = cold<D>().problem;
  const std::vector<int> i(problem.i.begin(), problem.i.end()), j(problem.j.begin(), problem.j.end());
  Colouring colouring;
  for (auto _ : state) colouring.colour(i, j, grains);
  count_items(state, static_cast<double>(state.iterations()) * static_cast<double>(i.size()), "contact");
}

/// From rest each time, 50 sweeps; the solver's own copy of the problem is part of the cost.
template <int D>
void sweeps(benchmark::State& state) {
  constexpr Layout layout{D, true};
  const auto& at = cold<D>();
  cd::Nsgs<layout> solver;
  cd::Iterate<layout> iterate;
  long done = 0;
  for (auto _ : state) {
    iterate = at.start;
    done += solver.solve(at.problem, {1e-14, 50, 0.9}, iterate).sweeps;
  }
  count_items(state, static_cast<double>(done) * static_cast<double>(at.problem.size()), "contact and sweep");
}

template <int D>
void residual(benchmark::State& state) {
  constexpr Layout layout{D, true};
  const auto& at = cold<D>();
  cd::Nsgs<layout> solver;
  cd::Iterate<layout> iterate = at.start;
  solver.solve(at.problem, {1e-14, 50, 0.9}, iterate);
  std::vector<cd::ResidualParts> partial;
  for (auto _ : state) {
    double found = cd::residual(at.problem, iterate, partial);
    benchmark::DoNotOptimize(found);
  }
  count_items(state, static_cast<double>(state.iterations()) * static_cast<double>(at.problem.size()), "contact");
}

// ---- both ---------------------------------------------------------------------------------------------------------

template <int D>
void snapshot(benchmark::State& state) {
  Engine<D>& engine = flowing<D>(EngineKind::md);
  for (auto _ : state) {
    const Snapshot<D> shown = engine.snapshot();
    benchmark::DoNotOptimize(shown.contacts);
  }
  count_items(state, static_cast<double>(state.iterations()) * grains, "grain");
}

/// `measure`: any function of a snapshot.
template <int D, class Measure>
void measured(benchmark::State& state, const Measure& measure) {
  Engine<D>& engine = flowing<D>(EngineKind::md);
  engine.advance(1);
  const Snapshot<D> shown = engine.snapshot();
  for (auto _ : state) {
    auto found = measure(shown);
    benchmark::DoNotOptimize(&found);
  }
  count_items(state, static_cast<double>(state.iterations()) * grains, "grain");
}

template <int D>
void checkpoint(benchmark::State& state, EngineKind kind) {
  Engine<D>& engine = flowing<D>(kind);
  const ScratchFolder folder;
  const std::string file = folder.file("state.h5");
  for (auto _ : state) {
    Archive archive;
    engine.save(archive);
    write_checkpoint(file, archive);
  }
  count_items(state, static_cast<double>(state.iterations()) * grains, "grain");
}

template <int D>
void add_stages(const std::string& what) {
  const auto add = [&](const std::string& name, auto&& run) {
    return benchmark::RegisterBenchmark((what + "/" + name).c_str(), run)->Unit(benchmark::kMicrosecond);
  };
  add("list made", list_made<D>);
  add("list tested", list_tested<D>);
  add("md contact pass", [](benchmark::State& state) { md_stage<D>(state, Stage::contacts); })->UseManualTime();
  add("md grain pass", [](benchmark::State& state) { md_stage<D>(state, Stage::grains); })->UseManualTime();
  add("cd assembly", assembly<D>);
  add("cd colours", colours<D>);
  add("cd sweeps", sweeps<D>);
  add("cd residual", residual<D>);
  add("snapshot", snapshot<D>);
  add("stress", [](benchmark::State& state) {
    measured<D>(state, [](const Snapshot<D>& shown) { return stress<D>(shown).total(); });
  });
  add("coordination", [](benchmark::State& state) {
    measured<D>(state, [](const Snapshot<D>& shown) { return coordination<D>(shown, true).z; });
  });
  add("solid fraction", [](benchmark::State& state) {
    measured<D>(state, [](const Snapshot<D>& shown) { return solid_fraction<D>(shown); });
  });
  add("fabric",
      [](benchmark::State& state) { measured<D>(state, [](const Snapshot<D>& shown) { return fabric<D>(shown); }); });
  add("Voronoi cells", [](benchmark::State& state) {
    measured<D>(state, [](const Snapshot<D>& shown) { return voronoi_volumes<D>(shown); });
  });
  add("md checkpoint", [](benchmark::State& state) { checkpoint<D>(state, EngineKind::md); });
  add("cd checkpoint", [](benchmark::State& state) { checkpoint<D>(state, EngineKind::cd); });
}

}  // namespace
}  // namespace galet

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  galet::add_stages<2>("disks");
  galet::add_stages<3>("spheres");
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
