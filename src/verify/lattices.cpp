// Crystals in a cell driven in stress: strength, stiffness, and one grain between its own images.
#include <fmt/format.h>

#include "src/verify/trial.hpp"

namespace galet::verify {

namespace {

/// Triangular lattice of 2 n^2 disks that just touch, rows along x.
Sample<2> triangular(int n) {
  Sample<2> sample;
  const Vec<2> edge(1, std::sqrt(3.0));
  sample.cell.box = (n * edge).asDiagonal();
  sample.cell.periodic.fill(true);
  sample.resize(2 * n * n);
  for (int k = 0; k < sample.count(); ++k) {
    const int cell = k / 2;
    const Vec<2> corner(cell % n, cell / n);
    sample.position[k] = (corner + Vec<2>::Constant(k % 2 == 0 ? 0.25 : 0.75)).cwiseProduct(edge);
  }
  return sample;
}

Scene driven_scene(int count, double friction, double stiffness, std::vector<CellDrive> drives) {
  Scene scene = periodic_scene(2, count, friction, 0.1, stiffness);
  scene.loading.kind = LoadingKind::drives;
  scene.loading.pressure = 1;
  scene.loading.drives = std::move(drives);
  scene.cd.dt = 1e-2, scene.cd.tolerance = 1e-8, scene.cd.max_sweeps = 20000;
  return scene;
}

/// sigma_1 / sigma_3 beyond which no forces are in equilibrium.
double rowe_limit(double friction) { return std::sqrt(3.0) / std::tan(pi / 6 - std::atan(friction)); }

struct Strength {
  double ratio = 0;
  long missed = 0;  ///< steps whose contact problem was not solved to the tolerance
};

/// sigma_yy is raised at constant sigma_xx = 1 until the crystal has given way by 0.5 %.
Strength strength(EngineKind kind, int cells, bool compliant, double friction, Report& report) {
  constexpr double rate = 0.02;
  const double limit = rowe_limit(friction);
  CellDrive side{.component = "xx", .stress = 1.0}, axis{.component = "yy", .stress = 1.0};
  axis.stress_to = 1.2 * limit;
  Scene scene = driven_scene(2 * cells * cells, friction, 1e5, {side, axis});
  scene.cd.compliance = compliant;
  if (compliant) scene.material.convention = DampingConvention::total;
  scene.run.duration = (1.2 * limit - 1) / rate;
  Trial<2> trial(report, kind, scene, triangular(cells));
  const double height = trial.start().cell.box(1, 1);
  while (trial.time() < *scene.run.duration) {
    trial.run_to(trial.time() + 0.05);
    if (trial.state().cell->box(1, 1) < 0.995 * height) break;
  }
  return {1 + rate * trial.time(), trial.engine().solver_summary().missed};
}

const char* const pace = "sigma_1 grows by 0.02 per inertial time, and 0.5 % of strain take one to three";

void lattice_strength(EngineKind kind, int cells, bool compliant, Report& report) {
  for (const double friction : {0.0, 0.1, 0.3})
    report.relative(fmt::format("sigma_1 / sigma_3, mu = {}", friction),
                    strength(kind, cells, compliant, friction, report).ratio, rowe_limit(friction), 0.02, pace);
}

/// Rigid disks in a hyperstatic crystal may give way anywhere between two limits. Beyond Rowe's ratio no forces are in
/// equilibrium: of each contact between rows F_y <= tan(60 + atan mu) F_x, and with these sigma_1 / sigma_3 <=
/// sqrt(3) tan(60 + atan mu), whatever the distribution. Below the frictionless ratio nothing can move: there normal
/// forces f >= 0 alone carry the load, so that the load's power, - sum of f u_N, is negative in every motion that does
/// not make grains overlap. Between the two, equal forces at all contacts solve each step at rest, but motions solve it
/// as well (half of the contacts slide, the others roll): friction is not associated, and which solution is met depends
/// on the forces before. Elastic contacts decide: lattice_strength_elastic, and md.
void lattice_strength_rigid(Report& report) {
  for (const double friction : {0.0, 0.1, 0.3}) {
    const Strength found = strength(EngineKind::cd, 2, false, friction, report);
    report.relative(fmt::format("sigma_1 / sigma_3, mu = {}, nearest of what is possible", friction), found.ratio,
                    std::clamp(found.ratio, rowe_limit(0), rowe_limit(friction)), 0.02, pace);
    // Without friction W is singular and steps of the collapse miss the tolerance (docs/theory.md, rigid limit).
    if (friction > 0)
      report.small(fmt::format("steps above the tolerance, mu = {}", friction), static_cast<double>(found.missed), 0,
                   "what moves although rest is possible must be a solution, to 1e-8");
  }
}

/// Shear stress there and back: G = (sqrt 3 / 4)(K_N + K_T).
void stress_reversal(EngineKind kind, Report& report) {
  constexpr double stiffness = 1e4, ratio = 0.5, shear = 0.05, wait = 40;
  const auto scene_at = [](double stress) {
    return driven_scene(8, 0.5, stiffness,
                        {{.component = "xx", .stress = 1.0},
                         {.component = "yy", .stress = 1.0},
                         {.component = "xy", .stress = stress}});
  };
  Trial<2> trial(report, kind, scene_at(0), triangular(2));
  trial.run_to(wait);
  const auto strain = [&] { return trial.state().cell->strain(0, 1); };
  const double zero = strain();
  std::vector<double> at;
  for (const double stress : {shear, -shear, shear, 0.0}) {
    trial.change(scene_at(stress));
    trial.run_to(trial.time() + wait);
    at.push_back(strain() - zero);
  }
  if (kind == EngineKind::cd) {
    for (std::size_t k = 0; k < at.size(); ++k)
      report.small(fmt::format("shear strain after change {}", k + 1), at[k], 1e-4, "rigid; the penetration allowed");
    return;
  }
  // L_xy alone is driven: strain_xy is the whole gamma. Stress on a face is positive in compression.
  const double exact = -shear / (std::sqrt(3.0) / 4 * stiffness * (1 + ratio));
  const std::string reason = "geometry changes by 1/kappa and P by some 1 %";
  report.relative("shear strain under +tau", at[0], exact, 0.02, reason);
  report.relative("under -tau", at[1], -exact, 0.02, reason);
  report.relative("under +tau again", at[2], at[0], 1e-3, "elastic: the same state");
  report.small("without tau, over the strain under it", at[3] / exact, 1e-3, "nothing is left");
}

/// One disk in a cell under pressure: it meets its own images, F = P L on each of two contacts.
void one_grain(EngineKind kind, Report& report) {
  constexpr double stiffness = 1e4;
  Scene scene =
      driven_scene(1, 0.3, stiffness, {{.component = "xx", .stress = 1.0}, {.component = "yy", .stress = 1.0}});
  Sample<2> start;
  start.resize(1);
  start.cell.box = 1.1 * Mat<2>::Identity();
  start.cell.periodic.fill(true);
  start.position[0] = Vec<2>(0.3, 0.4);
  Trial<2> trial(report, kind, scene, start);
  trial.run_to(200);
  const bool rigid = kind == EngineKind::cd;
  const double edge = rigid ? 1 : 1 / (1 + 1 / stiffness);
  const Snapshot<2> state = trial.state();
  report.near("contacts", static_cast<double>(state.contacts->size()), 2, 0, "one along each edge");
  double force = 0;
  for (const Vec<2>& f : state.contacts->force) force += f.norm() / 2;
  const std::string reason = rigid ? "tolerance 1e-8 of the solver" : "the cell has come to rest";
  report.relative("contact force", force, edge, 1e-6, reason);
  report.relative("edge of the cell", state.cell->box(0, 0), edge, rigid ? 1e-4 : 1e-8,
                  rigid ? "the penetration allowed" : reason);
}

}  // namespace

std::vector<Case> lattice_cases() {
  const auto strength_case = [](const std::string& name, int cells, bool compliant, Effort effort,
                                const std::string& what) {
    return Case{.name = name,
                .tags = {"lattice", "threshold", "friction"},
                .effort = effort,
                .scene = "a triangular crystal under a growing stress across its rows, mu = 0, 0.1, 0.3 (" + what + ")",
                .exact = "sigma_1/sigma_3 = sqrt 3 / tan(30 - atan mu) (Rowe 1962)",
                .trouble = "failure too early (contacts lost), or strength beyond the limit",
                .run = [cells, compliant](EngineKind kind, Report& report) {
                  lattice_strength(kind, cells, compliant, report);
                }};
  };
  return {
      strength_case("lattice_strength", 1, false, Effort::quick, "2 disks: nothing is undetermined"),
      {.name = "lattice_strength_8",
       .tags = {"lattice", "threshold", "friction"},
       .effort = Effort::full,
       .scene = "the same with 8 disks: hyperstatic",
       .exact = "md: the same limit; cd: between the limit without friction and that with it (src/verify/lattices.cpp)",
       .trouble = "strength beyond the limit, failure where nothing can move, motion that is no solution",
       .run =
           [](EngineKind kind, Report& report) {
             if (kind == EngineKind::md) return lattice_strength(kind, 2, false, report);
             lattice_strength_rigid(report);
           }},
      strength_case("lattice_strength_elastic", 2, true, Effort::full, "8 disks, cd with compliance"),
      {.name = "stress_reversal",
       .tags = {"lattice", "reversal"},
       .effort = Effort::quick,
       .scene = "a triangular crystal under P = 1, shear stress 0.05, -0.05, 0.05, 0",
       .exact = "md: G = (sqrt 3 / 4)(K_N + K_T); cd: no strain",
       .trouble = "strain left after a cycle, ratcheting",
       .run = stress_reversal},
      {.name = "one_grain",
       .tags = {"lattice", "few"},
       .scene = "one disk in a periodic cell under pressure, which meets its own images",
       .exact = "F = P L on each of two contacts; L = 1 / (1 + P/K), 1 for rigid grains",
       .trouble = "contacts counted twice or not at all",
       .run = one_grain},
  };
}

}  // namespace galet::verify
