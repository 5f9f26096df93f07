// The contact problems of hard cases of `galet verify` given to Siconos and to Galet's solvers, cold.
//
//   siconos_hard_cases OUT [SECONDS]      SECONDS: processor time that one solve may take (10)
//
// The problem is that of the first step of grains under gravity that should stay where they are, in FCLIB's local form.
// OUT/answers.csv: a row per solve, Siconos asked for each power of ten of its own error, Galet for that of errS.
//   motion   largest |u| / (g dt) of a contact: what should be zero
//   force    largest error of a normal force over the weight on the floor, where statics determines it (columns)
// OUT/summary.csv: for each case and solver the seconds to both errors below 1e-3, and the best errors at all. Nothing
// is written where there is no Siconos.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "benchmarks/peers/siconos_run.hpp"
#include "cd/discrete/solve.hpp"
#include "cd/discrete/step_problem.hpp"
#include "common/io/csv.hpp"
#include "common/io/scratch_folder.hpp"
#include "src/verify/trial.hpp"

namespace galet::hard_cases {
namespace {

constexpr double dt = 1e-2, wanted = 1e-3;

struct HardCase {
  std::string name;
  cd::DiscreteProblem problem;
  std::vector<double> normal;  ///< exact normal forces by contact, where statics determines them
  double weight = 1;           ///< on the floor
};

/// Of the first step. `weights`: the exact normal forces in any order; the engine's own impulses say whose each is.
template <int D>
HardCase first_step(const std::string& name, Scene scene, const std::vector<double>& weights, double tolerance) {
  verify::Report report;
  scene.cd.dt = dt, scene.cd.tolerance = tolerance, scene.cd.max_sweeps = 100000000;
  verify::Trial<D> trial(report, EngineKind::cd, scene);
  const cd::StepProblem step =
      dynamic_cast<cd::ProblemSource&>(trial.engine()).step_with_problem(cd::ProblemForm::local);
  HardCase made{.name = name, .problem = step.problem, .normal = {}};
  made.problem.title = name;
  if (weights.empty()) return made;
  made.weight = *std::max_element(weights.begin(), weights.end());
  for (int c = 0; c < step.problem.contacts(); ++c) {
    const double found = step.r[c * step.problem.block] / dt;
    made.normal.push_back(*std::min_element(
        weights.begin(), weights.end(), [&](double a, double b) { return std::abs(a - found) < std::abs(b - found); }));
  }
  std::vector<double> sorted = made.normal, exact = weights;
  std::sort(sorted.begin(), sorted.end()), std::sort(exact.begin(), exact.end());
  // Weights that differ by less than the engine's error may be taken for each other: 2e-6 at the mass ratio 1e6.
  for (std::size_t k = 0; k < exact.size(); ++k)
    if (std::abs(sorted[k] - exact[k]) > 1e-5 * made.weight)
      throw RunError(name + ": the engine's impulses are not those of statics");
  return made;
}

Scene spheres(double friction) {
  Scene scene = verify::free_scene(3, friction, 0, 1e5);
  verify::add_floor(scene);
  return scene;
}

HardCase column(int count) {
  Scene scene = spheres(0.5);
  std::vector<double> weights;
  for (int k = 0; k < count; ++k) verify::add_grain(scene, {0, 0, 0.5 + k}), weights.push_back(k + 1);
  return first_step<3>(fmt::format("column_{}", count), scene, weights, 1e-4 / std::pow(count, 2.5));
}

/// Two light spheres below one that is `ratio` times as heavy.
HardCase heavy_on_light(double ratio) {
  Scene scene = spheres(0.3);
  scene.grains.density = 6 / verify::pi;
  OtherMaterial heavy;
  heavy.name = "heavy", heavy.density = ratio * 6 / verify::pi;
  scene.other_materials = {heavy};
  for (int k = 0; k < 3; ++k) verify::add_grain(scene, {0, 0, 0.5 + k}, {}, 1, k == 2 ? "heavy" : "");
  const int power = static_cast<int>(std::lround(std::log10(ratio)));
  return first_step<3>(fmt::format("mass_ratio_1e{}", power), scene, {ratio + 2, ratio + 1, ratio}, 1e-5 / ratio);
}

/// A sphere between two planes at `half` from the vertical.
HardCase between_planes(const std::string& name, double half) {
  Scene scene = verify::free_scene(3, 0.3, 0, 1e5);
  const double c = std::cos(half), s = std::sin(half);
  verify::add_plane(scene, {0, 0, 0}, {c, 0, s});
  verify::add_plane(scene, {0, 0, 0}, {-c, 0, s});
  scene.loading.gravity = {0, 0, -1};
  verify::add_grain(scene, {0, 0, 0.5 / s});
  return first_step<3>(name, scene, {}, 1e-10);
}

/// Three equal disks, friction between them 1 % above what they need to stand.
HardCase three_cylinders() {
  Scene scene = verify::free_scene(2, 1.01 * (2 - std::sqrt(3.0)), 0, 1e5);
  OtherMaterial ground;
  ground.name = "ground";
  scene.other_materials = {ground};
  MaterialPair pair;
  pair.between = {"default", "ground"}, pair.friction = 0.5;
  scene.pairs = {pair};
  verify::add_floor(scene, 1, "ground");
  verify::add_grain(scene, {-0.5, 0.5});
  verify::add_grain(scene, {0.5, 0.5});
  verify::add_grain(scene, {0, 0.5 + std::sqrt(0.75)});
  return first_step<2>("three_cylinders", scene, {}, 1e-10);
}

std::vector<HardCase> all_cases() {
  return {column(10),
          column(100),
          column(1000),
          heavy_on_light(1e3),
          heavy_on_light(1e6),
          between_planes("groove", verify::pi / 4),
          between_planes("wedge", 5 * verify::pi / 180),
          three_cylinders()};
}

/// One solve, judged.
struct Answer {
  std::string which, solver;
  int contacts = 0;
  double asked = 0, seconds = 0;
  long iterations = 0;
  double motion = 0;
  std::optional<double> force;
  bool good() const { return motion < wanted && (!force || *force < wanted); }
};

Answer judged(const HardCase& from, const std::string& solver, double asked, double seconds, long iterations,
              const std::vector<double>& r) {
  const cd::DiscreteProblem& p = from.problem;
  Answer made{from.name, solver, p.contacts(), asked, seconds, iterations, 0, {}};
  for (int c = 0; c < p.contacts(); ++c) {
    double square = 0;
    for (int row = c * p.block; row < (c + 1) * p.block; ++row) {
      double u = p.q[row];
      for (auto k = p.start[row]; k < p.start[row + 1]; ++k) u += p.value[k] * r[p.column[k]];
      square += u * u;
    }
    made.motion = std::max(made.motion, std::sqrt(square) / dt);
  }
  if (from.normal.empty()) return made;
  made.force = 0;
  for (int c = 0; c < p.contacts(); ++c)
    made.force = std::max(*made.force, std::abs(r[c * p.block] / dt - from.normal[c]) / from.weight);
  return made;
}

std::vector<Answer> answers_of(const HardCase& from, double seconds) {
  std::vector<Answer> all;
  const ScratchFolder folder;
  for (const std::string& solver : bench::siconos_solvers(from.problem.block)) {
    for (const bench::SiconosAnswer& each : bench::run_siconos(from.problem, solver, seconds, folder.path()))
      all.push_back(judged(from, "siconos " + solver, each.tolerance, each.seconds, each.iterations, each.r));
    // What took too long has no answer, but it was asked.
    if (all.empty() || all.back().solver != "siconos " + solver)
      all.push_back({from.name, "siconos " + solver, from.problem.contacts(), 1e-3, seconds, 0, NAN, {}});
  }
  for (int power = 3; power <= 12; ++power) {
    const double asked = std::pow(10.0, -power);
    cd::DiscreteOptions options;
    options.error = asked, options.seconds = seconds;
    const cd::DiscreteSolution found = cd::solve(from.problem, options);
    all.push_back(judged(from, "galet auto", asked, found.seconds, found.iterations, found.r));
    if (!found.converged) break;
  }
  return all;
}

CsvCell number(double value) {
  return std::isfinite(value) ? CsvCell(std::stod(fmt::format("{:.3g}", value))) : CsvCell();
}

CsvTable answers_table(const std::vector<Answer>& all) {
  CsvTable table;
  for (const char* name : {"case", "contacts", "solver", "asked", "seconds", "iterations", "motion", "force"})
    table.columns.push_back({name, ""});
  for (const Answer& each : all)
    table.rows.push_back({each.which, std::int64_t{each.contacts}, each.solver, number(each.asked),
                          number(each.seconds), std::int64_t{each.iterations}, number(each.motion),
                          each.force ? number(*each.force) : CsvCell()});
  return table;
}

/// Rows of one case and one solver stand together.
CsvTable summary_table(const std::vector<Answer>& all) {
  CsvTable table;
  for (const char* name : {"case", "contacts", "solver", "seconds", "asked", "least_motion", "least_force", "verdict"})
    table.columns.push_back({name, ""});
  for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
    const Answer* first_good = nullptr;
    double motion = INFINITY, force = INFINITY;
    for (; to < all.size() && all[to].which == all[from].which && all[to].solver == all[from].solver; ++to) {
      if (!first_good && all[to].good()) first_good = &all[to];
      motion = std::fmin(motion, all[to].motion);
      if (all[to].force) force = std::fmin(force, *all[to].force);
    }
    table.rows.push_back({all[from].which, std::int64_t{all[from].contacts}, all[from].solver,
                          first_good ? number(first_good->seconds) : CsvCell(),
                          first_good ? number(first_good->asked) : CsvCell(), number(motion), number(force),
                          std::string(first_good ? "reached" : "not reached")});
  }
  return table;
}

}  // namespace
}  // namespace galet::hard_cases

int main(int argc, char** argv) try {
  using namespace galet;
  using namespace galet::hard_cases;
  if (argc < 2) {
    fmt::print(stderr, "usage: siconos_hard_cases OUT [SECONDS]\n");
    return 2;
  }
  if (bench::siconos_solvers(3).empty()) {
    fmt::print("skipped: there is no Python with Siconos, SciPy and h5py\n");
    return 0;
  }
  const std::filesystem::path out(argv[1]);
  std::filesystem::create_directories(out);
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
  std::vector<Answer> all;
  for (const HardCase& each : all_cases()) {
    fmt::print(stderr, "{}: {} contacts\n", each.name, each.problem.contacts());
    const std::vector<Answer> some = answers_of(each, seconds);
    all.insert(all.end(), some.begin(), some.end());
  }
  write_csv((out / "answers.csv").string(), answers_table(all));
  write_csv((out / "summary.csv").string(), summary_table(all));
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "siconos_hard_cases: {}\n", error.what());
  return 1;
}
