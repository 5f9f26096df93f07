// What many steps do to a packing that nothing drives: drift of its energy and of its positions over 1e7 steps.
//
//   md_drift [GRAINS [STEPS]] > md_drift.csv        default 100 grains, 1e7 steps: about four minutes
//
// Packings in a cell that does not move, made at kappa = 1000 under pressure 1; the default time step. Cases:
//   vibrating   no friction, no damping, made without friction; grains kicked so little that no contact opens
//   colliding   the same kicked a thousand times as hard: contacts open and close all the time
//   spinning    as colliding, with friction 0.4: sliding takes energy until no contact slides any more
//   rest        friction 0.4, restitution 0.3, come to rest before
// Rows at 1e3, 1e4 ... steps:
//   energy      mean total energy over 512 states (3 steps apart) less that at the start of the run, over the energy of
//               the kick (rest: over the elastic energy). Scheme of second order: the energy that it keeps differs from
//               the true one by an amount that swings with the motion and does not grow.
//   kinetic     mean kinetic energy, spins included, over the same
//   moved       rms distance of the grains from their places at the start, over d; farthest: the largest
// seconds: processor time since the case began.
#include <cstdlib>

#include <fmt/format.h>

#include "benchmarks/dense_sample.hpp"
#include "common/core/clock.hpp"
#include "common/core/random.hpp"

namespace galet::bench {
namespace {

struct Case {
  const char* name;
  double friction, restitution, speed;  ///< of the kick, rms per component
};

constexpr Case cases[] = {
    {"vibrating", 0, 1, 1e-4}, {"colliding", 0, 1, 0.1}, {"spinning", 0.4, 1, 0.1}, {"rest", 0.4, 0.3, 0}};

struct Mean {
  double energy = 0, kinetic = 0;
  static constexpr int states = 512, apart = 3;
  static constexpr long steps = static_cast<long>(states) * apart;
};

template <int D>
Mean mean_energy(Engine<D>& engine) {
  Mean mean;
  for (int k = 0; k < Mean::states; ++k) {
    engine.advance(Mean::apart);
    const EnergyParts parts = engine.energy();
    mean.energy += parts.total() / Mean::states;
    mean.kinetic += (parts.kinetic + parts.rotational) / Mean::states;
  }
  return mean;
}

template <int D>
std::vector<Vec<D>> places(Engine<D>& engine) {
  const auto position = engine.snapshot().position;
  return {position.begin(), position.end()};
}

template <int D>
void run(const Case& which, const Sample<D>& packing, long steps) {
  Sample<D> sample = packing;
  Scene scene = dense_scene(D, sample.count(), which.friction);
  scene.loading.kind = LoadingKind::none;
  scene.material.restitution = which.restitution;
  for (int i = 0; i < sample.count(); ++i) {
    RandomStream random(17, i);
    for (int a = 0; a < D; ++a) sample.velocity[i][a] = which.speed * random.normal();
  }
  const Derived derived = derive(scene, grain_facts<D>(scene, sample));
  auto engine = md::make_engine<D>(scene, derived, sample);
  const double kick = engine->energy().kinetic;
  if (which.speed == 0) engine->advance(200000);  // to rest
  const double start = thread_seconds();
  const Mean first = mean_energy<D>(*engine);
  const double unit = which.speed > 0 ? kick : engine->energy().elastic_normal;
  const std::vector<Vec<D>> before = places<D>(*engine);
  long done = 0;
  for (long mark = 1000; mark <= steps; mark *= 10) {
    engine->advance(std::max(0L, mark - done));
    done = std::max(done, mark);
    const std::vector<Vec<D>> after = places<D>(*engine);
    double sum = 0, farthest = 0;
    const Mat<D> box = sample.cell.box, inverse = box.inverse();
    for (int i = 0; i < sample.count(); ++i) {
      Vec<D> fraction = inverse * (after[i] - before[i]);
      for (int a = 0; a < D; ++a) fraction[a] -= std::round(fraction[a]);
      const double moved = (box * fraction).squaredNorm();
      sum += moved, farthest = std::max(farthest, moved);
    }
    const Mean mean = mean_energy<D>(*engine);
    done += Mean::steps;
    fmt::print("{},{},{},{:.4g},{},{:.2e},{:.2e},{:.2e},{:.2e},{:.0f}\n", which.name, D, sample.count(),
               *derived.collision_time / engine->dt(), mark, (mean.energy - first.energy) / unit, mean.kinetic / unit,
               std::sqrt(sum / sample.count()), std::sqrt(farthest), thread_seconds() - start);
    std::fflush(stdout);
  }
}

template <int D>
void run_all(int grains, long steps) {
  const Sample<D> slippery = dense_sample<D>(grains, 0), rough = dense_sample<D>(grains, 0.4);
  for (const Case& which : cases) run<D>(which, which.friction > 0 ? rough : slippery, steps);
}

}  // namespace
}  // namespace galet::bench

int main(int argc, char** argv) {
  const int grains = argc > 1 ? std::atoi(argv[1]) : 100;
  const double steps = argc > 2 ? std::atof(argv[2]) : 1e7;
  if (argc > 3 || grains < 20 || !(steps >= 1000)) {
    fmt::print(stderr, "usage: md_drift [GRAINS [STEPS]], at least 20 grains and 1000 steps\n");
    return 2;
  }
  fmt::print("case,dim,grains,steps_per_collision,steps,energy,kinetic,moved,farthest,seconds\n");
  galet::bench::run_all<3>(grains, static_cast<long>(steps));
  galet::bench::run_all<2>(grains, static_cast<long>(steps));
}
