// How the speed and the memory of md scale with the number of grains.
//
//   md_scaling [--most N] [--quick] > md_scaling.csv        N = 1100000; --quick: N = 70000, one short batch each
//
// A frictional packing of 1000 spheres (disks), periodic, at kappa = 1000 under pressure 1, is repeated along each
// direction and numbered along Morton's curve: `hold` keeps the cell, `shear` shears it at constant volume with
// inertial number 0.01. `shuffled` holds the same grains numbered at random, as a file may bring them: md sorts them in
// memory, so that it should cost what `hold` does. One thread, its processor time (stages: its shares by wall time);
// the best of three batches, since the machine is shared (shear: one long batch, builds of the list included). Columns:
// listed and touching pairs per grain; millions of grain-steps per second; ns per grain-step, per listed and touching
// pair; ns per grain-step by stage; bytes that the engine's arrays hold per grain and per listed pair (with room to
// grow and second buffers); the process's peak so far in MiB; `moved`: bytes per grain-step between memory and
// processor if no array stays in a cache from one step to the next; `stream`: GB/s of a sum of two long arrays into a
// third (the line fetched before it is written counts); `floor`: ns per grain-step of `moved` at that rate. Below the
// floor: caches helped. What it can't tell: copies move alike, so that no larger structure forms; times of another
// machine.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <numeric>

#include <fmt/format.h>
#include <sys/resource.h>

#include "benchmarks/dense_sample.hpp"
#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/scene/spatial_order.hpp"
#include "md/kernel/view.hpp"

namespace galet::bench {
namespace {

struct Options {
  int most = 1100000;
  bool quick = false;
};

/// Bytes per second of c = a + b, over arrays that no cache holds.
double stream_rate() {
  constexpr std::size_t count = 1 << 23;
  std::vector<double> a(count, 1.0), b(count, 2.0), c(count, 0.0);
  double best = 1e300;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double start = thread_seconds();
    for (std::size_t k = 0; k < count; ++k) c[k] = a[k] + b[k];
    best = std::min(best, thread_seconds() - start);
    std::swap(a, c);  // the sums are used
  }
  return 4 * sizeof(double) * static_cast<double>(count) / best;
}

/// Bytes moved per grain-step, see above: a row's block is read, its columns are read and written, its result is
/// fetched and written; a record is read and written, a state likewise. (What the grains of a strip read of rows and
/// records is still in the cache, md/sweep.hpp.) Stiffnesses are touched by Hertz contacts only.
template <Layout Y>
double moved_per_grain(double listed) {
  constexpr double word = sizeof(double);
  constexpr int columns = md::RowColumns<Y>::count(false);
  const double row =
      sizeof(md::RowBlock) / static_cast<double>(md::block_rows) + 2 * word * columns + 2 * word * md::out_size(Y);
  return listed * row + 2 * word * md::record_size(Y) + 2 * word * md::StateGroups<Y>::size +
         sizeof(int) * md::slots_per_grain;
}

template <int D>
Sample<D> numbered(const Sample<D>& from, const std::vector<int>& order) {
  Sample<D> to = from;
  for (std::size_t k = 0; k < order.size(); ++k) {
    to.position[k] = from.position[order[k]];
    to.radius[k] = from.radius[order[k]], to.mass[k] = from.mass[order[k]];
  }
  return to;
}

std::vector<int> shuffled(int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (int k = count - 1; k > 0; --k)
    std::swap(order[k], order[static_cast<int>(RandomStream(1, k).uniform(0, 1) * (k + 1))]);
  return order;
}

struct Measured {
  double seconds = 1e300, stage[3] = {};  // of the best batch
  long steps = 0;
};

constexpr Stage stages[] = {Stage::neighbours, Stage::contacts, Stage::grains};

template <int D>
Measured timed(Engine<D>& engine, int count, bool shear, bool quick) {
  Measured best;
  best.steps = std::clamp(static_cast<long>((quick ? 5e6 : 1.2e7) / count), 10L, 4000L);
  // Skins are narrowed at 250 and 500 steps where nothing moves.
  engine.advance(std::max(best.steps, 550L));
  // A batch of shear holds several builds of the list, so it is long and stands alone.
  if (shear) best.steps = std::max(3 * best.steps, quick ? 10L : 100L);
  for (int batch = 0; batch < (quick || shear ? 1 : 3); ++batch) {
    const Profile before = engine.profile();
    const double start = thread_seconds(), start_of_wall = wall_seconds();
    engine.advance(best.steps);
    const double seconds = thread_seconds() - start, share = seconds / (wall_seconds() - start_of_wall);
    if (seconds >= best.seconds) continue;
    best.seconds = seconds;
    for (int k = 0; k < 3; ++k)
      best.stage[k] = share * (engine.profile().seconds(stages[k]) - before.seconds(stages[k]));
  }
  return best;
}

template <int D>
void row(const char* name, bool shear, const Sample<D>& sample, double stream, const Options& options) {
  constexpr Layout layout{D, true};
  Scene scene = dense_scene(D, sample.count(), 0.4);
  scene.loading.kind = LoadingKind::none;
  if (shear) {
    scene.loading.kind = LoadingKind::drives;
    scene.loading.drives = {{"xy", 0.01, std::nullopt}};
  }
  const Derived derived = derive(scene, grain_facts<D>(scene, sample));
  auto engine = md::make_engine<D>(scene, derived, sample);
  require(engine->layout() == layout, "the bytes are counted for the layout with friction");
  const int count = sample.count();
  const Measured best = timed<D>(*engine, count, shear, options.quick);
  const MemoryUse memory = engine->memory();
  const double grains = count, listed = static_cast<double>(memory.listed) / grains;
  const double touching = static_cast<double>(engine->snapshot().contacts->force.size()) / grains;
  const double nanoseconds = 1e9 * best.seconds / (static_cast<double>(best.steps) * grains);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto stage = [&](int k) { return 1e9 * best.stage[k] / (static_cast<double>(best.steps) * grains); };
  const double moved = moved_per_grain<layout>(listed);
  fmt::print(
      "{},{},{},{:.3f},{:.3f},{:.2f},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{:.0f},{:.0f},{:.0f},{:.0f},"
      "{:.1f},{:.0f}\n",
      D, name, count, listed, touching, 1e3 / nanoseconds, nanoseconds, nanoseconds / listed, nanoseconds / touching,
      stage(0), stage(1), stage(2), static_cast<double>(memory.grains) / grains,
      static_cast<double>(memory.pairs) / static_cast<double>(memory.listed),
      static_cast<double>(usage.ru_maxrss) / 1024, moved, stream / 1e9, 1e9 * moved / stream);
  std::fflush(stdout);
}

template <int D>
void rows(const std::vector<int>& copies, double stream, const Options& options) {
  const Sample<D> cell = dense_sample<D>(1000, 0.4);
  for (const int along : copies) {
    const Sample<D> tiled = replicated<D>(cell, along);
    if (tiled.count() > options.most) break;
    const Sample<D> sample = numbered<D>(tiled, spatial_order<D>(tiled.cell, tiled.position));
    row<D>("hold", false, sample, stream, options);
    row<D>("shear", true, sample, stream, options);
    row<D>("shuffled", false, numbered<D>(tiled, shuffled(tiled.count())), stream, options);
  }
}

Options parsed(int argc, char** argv) {
  Options options;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--quick") == 0) {
      options.quick = true, options.most = std::min(options.most, 70000);
    } else if (std::strcmp(argv[k], "--most") == 0 && k + 1 < argc && std::atoi(argv[k + 1]) > 0) {
      options.most = std::atoi(argv[++k]);
    } else {
      fmt::print(stderr, "usage: md_scaling [--most N] [--quick]\n");
      std::exit(2);
    }
  }
  return options;
}

}  // namespace
}  // namespace galet::bench

int main(int argc, char** argv) {
  const galet::bench::Options options = galet::bench::parsed(argc, argv);
  fmt::print(
      "dim,case,grains,listed,touching,M_per_s,ns_grain,ns_listed,ns_touching,neighbours,contacts,grain_pass,"
      "bytes_grain,bytes_pair,peak_MiB,moved,stream,floor\n");
  const double stream = galet::bench::stream_rate();
  galet::bench::rows<3>({1, 2, 3, 4, 6, 8, 10}, stream, options);
  galet::bench::rows<2>({1, 2, 4, 8, 16, 32}, stream, options);
}
