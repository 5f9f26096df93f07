// Plane shear between rough walls, the upper one pressed by a force, against the periodic cell at the inertial number
// that the flow has in the middle between the walls, with both engines.
//
//   rough_wall SCENE OUT      SCENE: scenes/rough_wall_shear_2d.toml
//
// 1000 disks (+-20 %, mu = 0.4, e = 0.1, kappa = 1000 in md), walls 32 d apart, V = 3 sqrt(P/m) d. Bulk: the middle
// half between the walls, whose layers are 8 d and more from them. There I is the least-squares slope of v_x over y
// times sqrt(m / sigma_yy), mu* = sigma_xy / sigma_yy and Phi, all of the layers of common/measure/profile.hpp. The
// cell has as many grains, at that I and at sigma_yy = P. After a time of 300 (three times that in which the profile
// between the walls settles, H^2 rho / (pi^2 d(tau)/d(rate)), about 100) means over 900, of 600 in the cell (after
// 100), with block errors (common/measure/block_average.hpp). Writes OUT/flows.csv, and OUT/verdict.csv: walls less
// cell, its standard error (the error of I counts by the slopes 1.1 of mu* and 0.37 of Phi), and whether they agree
// within two of these. What it can't tell: the flow next to the walls, and other I.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cd/engine.hpp"
#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "common/io/scene_file.hpp"
#include "common/measure/block_average.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/profile.hpp"
#include "common/measure/stress.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "md/engine.hpp"

namespace galet {
namespace {

constexpr double look_interval = 0.1;
constexpr int layers = 34;

struct Flow {
  Estimate inertial = {}, mu = {}, fraction = {}, normal = {};
  int grains = 0;
  double time = 0, seconds = 0;
};

/// Values of every look; `estimate` makes means of them.
struct Series {
  std::vector<double> rate, shear, normal, fraction;

  void estimate(Flow& flow) const {
    flow.normal = block_average(normal), flow.fraction = block_average(fraction);
    const Estimate rates = block_average(rate);
    flow.inertial = {rates.value / std::sqrt(flow.normal.value), rates.error / std::sqrt(flow.normal.value)};
    // A ratio of means: its error is that of shear - mu normal, whose terms go together.
    flow.mu.value = block_average(shear).value / flow.normal.value;
    std::vector<double> miss(shear.size());
    for (std::size_t k = 0; k < miss.size(); ++k) miss[k] = (shear[k] - flow.mu.value * normal[k]) / flow.normal.value;
    flow.mu.error = block_average(miss).error;
  }
};

/// One look at the middle half between the walls' centres `low` and `high`.
void look_at_bulk(const Snapshot<2>& state, double low, double high, Series& series) {
  const double from = low + 0.25 * (high - low), to = high - 0.25 * (high - low);
  double n = 0, y = 0, v = 0, yy = 0, yv = 0;
  for (int k = 0; k < state.grains(); ++k) {
    const double at = state.position[k].y(), speed = state.velocity[k].x();
    if (state.body_of[k] >= 0 || at < from || at > to) continue;
    n += 1, y += at, v += speed, yy += at * at, yv += at * speed;
  }
  const double slope = (n * yv - y * v) / (n * yy - y * y);
  double shear = 0, normal = 0, fraction = 0;
  int count = 0;
  for (const ProfileRow& row : layer_profile<2>(state, layers)) {
    if (row.position < from || row.position > to) continue;
    shear -= 0.5 * (row.stress(0, 1) + row.stress(1, 0)), normal += row.stress(1, 1), fraction += row.solid_fraction;
    ++count;
  }
  series.rate.push_back(slope), series.shear.push_back(shear / count);
  series.normal.push_back(normal / count), series.fraction.push_back(fraction / count);
}

std::unique_ptr<Engine<2>> engine_of(EngineKind kind, Scene scene, const Sample<2>& sample) {
  scene.engine = kind;
  const Derived derived = derive(scene, grain_facts<2>(scene, sample));
  return kind == EngineKind::md ? md::make_engine<2>(scene, derived, sample)
                                : cd::make_engine<2>(scene, derived, sample);
}

/// Advances by `duration` and calls look(snapshot) now and then.
template <class Look>
void run(Engine<2>& engine, double duration, const Look& look) {
  const long interval = std::max(1L, std::lround(look_interval / engine.dt()));
  const long looks = std::lround(duration / engine.dt()) / interval;
  for (long k = 0; k < looks; ++k) {
    engine.advance(interval);
    look(engine.snapshot());
  }
}

Scene with_numerics(Scene scene) {
  scene.material.stiffness_level = 1e3;
  scene.cd.dt = 0.02;
  scene.cd.tolerance = 1e-3;
  return scene;
}

Flow between_walls(EngineKind kind, const Scene& scene) {
  const Sample<2> sample = initial_sample<2>(scene);
  const auto engine = engine_of(kind, scene, sample);
  const double start = thread_seconds();
  run(*engine, 300, [](const Snapshot<2>&) {});
  Series series;
  run(*engine, 900, [&](const Snapshot<2>& state) {
    look_at_bulk(state, state.bodies[0].centre.y(), state.bodies[1].centre.y(), series);
  });
  Flow flow{.grains = sample.count(), .time = engine->time(), .seconds = thread_seconds() - start};
  series.estimate(flow);
  return flow;
}

/// The same grains without walls, sheared at `rate` under the pressure P = 1.
Flow in_a_cell(EngineKind kind, Scene scene, double rate) {
  scene.bodies.clear();
  scene.cell = {};
  scene.cell.periodic.assign(2, true);
  scene.initial = {};
  scene.initial.solid_fraction = 0.5;
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.shear_rate = rate;
  const Sample<2> sample = initial_sample<2>(scene);
  const auto engine = engine_of(kind, scene, sample);
  const double start = thread_seconds();
  run(*engine, 100, [](const Snapshot<2>&) {});
  Series series;
  run(*engine, 600, [&](const Snapshot<2>& state) {
    const Mat<2> sigma = stress<2>(state).total();
    series.rate.push_back(rate), series.shear.push_back(-0.5 * (sigma(0, 1) + sigma(1, 0)));
    series.normal.push_back(sigma(1, 1)), series.fraction.push_back(solid_fraction<2>(state));
  });
  Flow flow{.grains = sample.count(), .time = engine->time(), .seconds = thread_seconds() - start};
  series.estimate(flow);
  return flow;
}

std::string row_of(const std::string& engine, const std::string& geometry, const Flow& flow) {
  return fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.4f},{:.4f},{},{:.0f},{:.0f}\n", engine,
                     geometry, flow.inertial.value, flow.inertial.error, flow.mu.value, flow.mu.error,
                     flow.fraction.value, flow.fraction.error, flow.normal.value, flow.normal.error, flow.grains,
                     flow.time, flow.seconds);
}

/// `slope`: of the quantity with I.
std::string verdict_of(const std::string& engine, const std::string& quantity, const Estimate& walls,
                       const Estimate& cell, const Estimate& inertial, double slope) {
  const double difference = walls.value - cell.value;
  const double error = std::hypot(walls.error, cell.error, slope * inertial.error);
  return fmt::format("{},{},{:.5f},{:.5f},{:.1f},{}\n", engine, quantity, difference, error, difference / error,
                     std::abs(difference) <= 2 * error ? "agree" : "differ");
}

void compare(const std::string& scene_file, const std::string& out) {
  const Scene scene = with_numerics(read_scene(
      scene_file, {{"grains.count", "1000"}, {"cell.size", "[32.5, 34.0]"}, {"body[1].force", "[0, -32.5]"}}));
  std::string flows =
      "engine,geometry,I,I_error,mu_star,mu_star_error,Phi,Phi_error,sigma_yy,sigma_yy_error,grains,time,seconds\n";
  std::string verdicts = "engine,quantity,walls_minus_cell,error,in_errors,within_two_errors\n";
  for (const EngineKind kind : {EngineKind::cd, EngineKind::md}) {
    const std::string name = kind == EngineKind::md ? "md" : "cd";
    const Flow walls = between_walls(kind, scene);
    flows += row_of(name, "walls", walls);
    const Flow cell = in_a_cell(kind, scene, walls.inertial.value);
    flows += row_of(name, "cell", cell);
    verdicts += verdict_of(name, "mu_star", walls.mu, cell.mu, walls.inertial, 1.1);
    verdicts += verdict_of(name, "Phi", walls.fraction, cell.fraction, walls.inertial, 0.37);
    write_file(out + "/flows.csv", flows), write_file(out + "/verdict.csv", verdicts);
    fmt::print("{}{}", flows, verdicts);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace galet

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw galet::InputError("rough_wall SCENE OUT");
    galet::compare(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
