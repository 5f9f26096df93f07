// Cost per grain and step of both engines, and what they hold in memory, against the number of grains and the ratio of
// sizes.
//
//   engine_scaling FOLDER [--quick]     FOLDER/engine_scaling.csv and figures; --quick: to 64000 grains
//
// shear: a packing of 1000 frictional spheres under pressure 1 (md: kappa = 1000; cd: rigid), repeated along each
// direction, in plane shear at constant pressure, I = 0.01. sizes: spheres of unlike sizes (unlike_sample.hpp, solid
// fraction 0.45 to 0.59) that fly about with random velocities in a fixed cell and collide (mu = 0.4, e = 0.3): ratio
// 1, 10, 50. One thread, its processor time: the median of five batches of 4 to 30 steps, after 30 steps that are not
// counted; builds of the list are in it. `bytes`: growth of the resident memory per grain, sample and engine, after
// these batches; every row is a process of its own. What it can't tell: copies move alike, so that no force network
// larger than the first packing forms and the solver's sweeps don't grow with N; cd_piles has that.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "benchmarks/dense_sample.hpp"
#include "benchmarks/unlike_sample.hpp"
#include "cd/engine.hpp"
#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/io/figure.hpp"

namespace galet::bench {
namespace {

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Prints one row to the file descriptor `out`.
void measure(const char* name, EngineKind kind, double ratio, Scene scene, const std::function<Sample<3>()>& make,
             int out) {
  const double before = resident_bytes();
  const Sample<3> sample = make();
  const int count = sample.count();
  scene.grains.count = count;
  scene.engine = kind;
  scene.cd.tolerance = 1e-3;
  const Derived derived = derive(scene, grain_facts<3>(scene, sample));
  auto engine =
      kind == EngineKind::md ? md::make_engine<3>(scene, derived, sample) : cd::make_engine<3>(scene, derived, sample);
  const double wanted = kind == EngineKind::md ? 1e6 : 1e5;  // grain-steps of a batch
  const long steps = std::clamp(static_cast<long>(wanted / count), 4L, 30L);
  engine->advance(30);  // cd starts without impulses to begin from, and takes more sweeps at first
  std::vector<double> times;
  for (int batch = 0; batch < 5; ++batch) {
    const double start = thread_seconds();
    engine->advance(steps);
    times.push_back(1e9 * (thread_seconds() - start) / (static_cast<double>(steps) * count));
  }
  std::sort(times.begin(), times.end());
  const double contacts = static_cast<double>(engine->snapshot().contacts->size()) / count;
  const std::string row = fmt::format("{},{},{:g},{},{},{:.2f},{:.1f},{:.1f},{:.1f},{:.0f}\n", name,
                                      kind == EngineKind::md ? "md" : "cd", ratio, count, steps, contacts, times[2],
                                      times.front(), times.back(), (resident_bytes() - before) / count);
  if (write(out, row.data(), row.size()) < 0) std::abort();
}

/// The row as text, made by a child process.
std::string in_a_process(const std::function<void(int)>& work) {
  int ends[2];
  require(pipe(ends) == 0, "no pipe");
  const pid_t child = fork();
  require(child >= 0, "no process");
  if (child == 0) {
    close(ends[0]);
    work(ends[1]);
    _exit(0);
  }
  close(ends[1]);
  std::string text;
  char bytes[256];
  for (ssize_t got; (got = read(ends[0], bytes, sizeof bytes)) > 0;) text.append(bytes, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) throw RunError("a row failed");
  fmt::print("{}", text);
  std::fflush(stdout);
  return text;
}

Scene shear_scene() {
  Scene scene = dense_scene(3, 1000, 0.4);
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.inertial_number = 0.01;
  return scene;
}

Scene gas_scene() {
  Scene scene = dense_scene(3, 1000, 0.4);
  scene.loading.kind = LoadingKind::none;
  return scene;
}

Sample<3> flying(int side, double ratio, int large) {
  Sample<3> sample = unlike_sample(side, 1.05, ratio, large);
  const std::size_t count = sample.position.size();
  sample.velocity.assign(count, Vec<3>::Zero());
  sample.spin.assign(count, zero_spin<3>());
  sample.mass.resize(count);
  sample.material.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    sample.mass[i] = std::pow(2 * sample.radius[i], 3);
    RandomStream random(2, i);
    for (int a = 0; a < 3; ++a) sample.velocity[i][a] = random.normal() / std::sqrt(sample.mass[i]);
  }
  return sample;
}

struct Point {
  std::string name, engine;
  double ratio = 0, grains = 0, time = 0, bytes = 0;
};

Point point_of(const std::string& row) {
  std::vector<std::string> cells;
  for (std::size_t from = 0, to = 0; to != std::string::npos; from = to + 1) {
    to = row.find(',', from);
    cells.push_back(row.substr(from, to - from));
  }
  return {cells[0], cells[1], std::stod(cells[2]), std::stod(cells[3]), std::stod(cells[6]), std::stod(cells[9])};
}

void draw(const std::string& folder, const std::vector<Point>& points) {
  for (const bool memory : {false, true}) {
    Figure figure{memory ? "Memory of both engines" : "Cost of both engines",
                  "number of grains",
                  memory ? "bytes per grain" : "ns per grain and step",
                  true,
                  true,
                  {}};
    for (const char* engine : {"md", "cd"})
      for (const char* name : {"shear", "sizes"}) {
        Series series;
        for (const Point& point : points) {
          if (point.engine != engine || point.name != name) continue;
          if (point.name == "sizes") {
            figure.series.push_back({fmt::format("{}, sizes 1:{:g}", engine, point.ratio), {point.grains}, {}, {}});
            figure.series.back().y = {memory ? point.bytes : point.time};
          } else {
            series.x.push_back(point.grains), series.y.push_back(memory ? point.bytes : point.time);
          }
        }
        if (series.x.empty()) continue;
        series.label = std::string(engine) + ", shear of equal spheres";
        series.line = true;
        figure.series.push_back(series);
      }
    write_figure(folder + (memory ? "/memory" : "/cost"), figure);
  }
}

void run(const std::string& folder, bool quick) {
  std::string table =
      "case,engine,size_ratio,grains,steps,contacts_per_grain,ns_per_grain_step,least,most,bytes_per_grain\n";
  std::vector<Point> points;
  const auto add = [&](const std::string& row) { table += row, points.push_back(point_of(row)); };
  const Sample<3> cell = dense_sample<3>(1000, 0.4);
  for (const EngineKind kind : {EngineKind::md, EngineKind::cd})
    for (const int copies : {1, 2, 3, 4, 5, 6, 8, 10}) {
      if (copies > (quick ? 4 : kind == EngineKind::cd ? 5 : 10)) continue;
      add(in_a_process([&](int out) {
        measure(
            "shear", kind, 1, shear_scene(), [&] { return replicated<3>(cell, copies); }, out);
      }));
    }
  struct Mixture {
    double ratio;
    int side, large;
  };
  for (const EngineKind kind : {EngineKind::md, EngineKind::cd})
    for (const Mixture& mix : {Mixture{1, 40, 0}, Mixture{10, 42, 3}, Mixture{50, 60, 1}})
      add(in_a_process([&](int out) {
        measure(
            "sizes", kind, mix.ratio, gas_scene(), [&] { return flying(mix.side, mix.ratio, mix.large); }, out);
      }));
  std::ofstream(folder + "/engine_scaling.csv") << table;
  draw(folder, points);
}

}  // namespace
}  // namespace galet::bench

int main(int argc, char** argv) {
  try {
    const bool quick = argc == 3 && std::strcmp(argv[2], "--quick") == 0;
    if (argc < 2 || (argc > 2 && !quick)) throw galet::InputError("engine_scaling FOLDER [--quick]");
    galet::bench::run(argv[1], quick);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "engine_scaling: {}\n", error.what());
    return 1;
  }
}
