// What many steps do to a packing that nothing drives: drift of its energy and of its positions over 1e7 steps.
//
//   md_drift [GRAINS [STEPS]] > md_drift.csv        default 100 grains, 1e7 steps: about six minutes
//
// Packings in a cell that does not move, made at kappa = 1000 under pressure 1; the default time step. Cases:
//   vibrating   no friction, no damping, made without friction; grains kicked so little that few contacts open
//   colliding   the same kicked a thousand times as hard: contacts open and close all the time
//   half        the same with half the step and twice the steps
//   spinning    as colliding, with friction 0.4: sliding takes energy until no contact slides any more
//   rest        friction 0.4, restitution 0.3, come to rest before (200000 steps)
// Rows at 1e3, 1e4 ... steps:
//   energy      mean total energy over 512 states (3 steps apart) less that at the start of the run, over the energy of
//               the kick; rest: the same of the elastic energy, over itself (rattlers fly on). A smooth force would
//               leave it where it is; the kink of the force where a contact opens or closes gives each of them an
//               error of its own, and these heat; `half` tells how that goes with the step
//   kinetic     mean kinetic energy, spins included, over the same
//   moved       rms distance of the grains with a contact from their places at the start, the common motion taken off,
//               over d; farthest: the largest; both empty where no grain has a contact
// seconds: processor time since the case began.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "benchmarks/dense_sample.hpp"
#include "common/core/clock.hpp"
#include "common/core/random.hpp"

namespace galet::bench {
namespace {

struct Case {
  const char* name;
  double friction, restitution, speed;  ///< of the kick, rms per component
  double step;                          ///< in units of the default one
};

constexpr Case cases[] = {{"vibrating", 0, 1, 1e-4, 1},
                          {"colliding", 0, 1, 0.1, 1},
                          {"half", 0, 1, 0.1, 0.5},
                          {"spinning", 0.4, 1, 0.1, 1},
                          {"rest", 0.4, 0.3, 0, 1}};

struct Mean {
  double energy = 0, kinetic = 0;
  static constexpr int states = 512, apart = 3;
  static constexpr long steps = static_cast<long>(states) * apart;
};

template <int D>
Mean mean_energy(Engine<D>& engine, bool elastic) {
  Mean mean;
  for (int k = 0; k < Mean::states; ++k) {
    engine.advance(Mean::apart);
    const EnergyParts parts = engine.energy();
    mean.energy += (elastic ? parts.elastic_normal + parts.elastic_tangential : parts.total()) / Mean::states;
    mean.kinetic += (parts.kinetic + parts.rotational) / Mean::states;
  }
  return mean;
}

template <int D>
std::vector<Vec<D>> places(Engine<D>& engine) {
  const auto position = engine.snapshot().position;
  return {position.begin(), position.end()};
}

/// How far the grains with a contact have come, rms and at most, less their mean.
template <int D>
std::pair<double, double> moved(Engine<D>& engine, const std::vector<Vec<D>>& before) {
  const Snapshot<D> now = engine.snapshot();
  std::vector<bool> held(before.size(), false);
  for (const int i : now.contacts->i) held[i] = true;
  for (const int j : now.contacts->j) held[j] = true;
  const Mat<D> inverse = now.cell->box.inverse();
  std::vector<Vec<D>> way;
  Vec<D> mean = Vec<D>::Zero();
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!held[i]) continue;
    Vec<D> fraction = inverse * (now.position[i] - before[i]);
    for (int a = 0; a < D; ++a) fraction[a] -= std::round(fraction[a]);
    way.push_back(now.cell->box * fraction);
    mean += way.back();
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (way.empty()) return {none, none};
  double sum = 0, farthest = 0;
  const auto count = static_cast<double>(way.size());
  for (const Vec<D>& one : way) {
    const double square = (one - mean / count).squaredNorm();
    sum += square, farthest = std::max(farthest, square);
  }
  return {std::sqrt(sum / count), std::sqrt(farthest)};
}

template <int D>
void run(const Case& which, const Sample<D>& packing, long steps) {
  Sample<D> sample = packing;
  Scene scene = dense_scene(D, sample.count(), which.friction);
  scene.loading.kind = LoadingKind::none;
  scene.material.restitution = which.restitution;
  Vec<D> momentum = Vec<D>::Zero();
  double mass = 0;
  for (int i = 0; i < sample.count(); ++i) {
    RandomStream random(17, i);
    for (int a = 0; a < D; ++a) sample.velocity[i][a] = which.speed * random.normal();
    momentum += sample.mass[i] * sample.velocity[i], mass += sample.mass[i];
  }
  for (Vec<D>& velocity : sample.velocity) velocity -= momentum / mass;
  scene.md.dt = which.step * *derive(scene, grain_facts<D>(scene, sample)).md_dt;
  const Derived derived = derive(scene, grain_facts<D>(scene, sample));
  auto engine = md::make_engine<D>(scene, derived, sample);
  const double kick = engine->energy().kinetic;
  if (which.speed == 0) engine->advance(200000);  // to rest
  const double start = thread_seconds();
  const bool at_rest = which.speed == 0;
  const Mean first = mean_energy<D>(*engine, at_rest);
  const double unit = at_rest ? first.energy : kick;
  const std::vector<Vec<D>> before = places<D>(*engine);
  long done = 0;
  const long stride = std::lround(1 / which.step);
  for (long mark = 1000; mark <= steps; mark *= 10) {
    engine->advance(std::max(0L, stride * mark - done));
    done = std::max(done, stride * mark);
    const auto [distance, farthest] = moved<D>(*engine, before);
    const Mean mean = mean_energy<D>(*engine, at_rest);
    done += Mean::steps;
    const auto shown = [](double value) { return std::isnan(value) ? std::string() : fmt::format("{:.2e}", value); };
    fmt::print("{},{},{},{:.4g},{},{:.2e},{:.2e},{},{},{:.0f}\n", which.name, D, sample.count(),
               *derived.collision_time / engine->dt(), stride * mark, (mean.energy - first.energy) / unit,
               mean.kinetic / unit, shown(distance), shown(farthest), thread_seconds() - start);
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
