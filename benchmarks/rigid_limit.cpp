// Forces of a hyperstatic packing in the rigid limit: which of the many that are in equilibrium do both engines take?
//
//   rigid_limit OUT      writes OUT/forces.csv and OUT/forces.svg
//
// 40 disks packed without friction until rigid disks rest (isostatic: work_precision/isostatic.hpp). At each kappa they
// are first put to rest without friction under stresses (1, 1) by md, which presses the contacts together; then they
// get friction, which makes them hyperstatic, and stresses (1 + x, 1 - x), x = 30 % of what opens a contact without
// friction. From the same positions: md, by its drag; cd with compliance, in steps of 0.2 whatever kappa; and rigid cd.
// Columns, rms over the contacts and over the mean force:
//   elastic     cd with compliance - md at the same kappa
//   limit       md - md at kappa = 1e7
//   limit_cd    cd with compliance - the same at kappa = 1e7
//   rigid       rigid cd - md at kappa = 1e7: another admissible set of forces
// branch: rms of |branch - the rigid one|, d; contacts: share of md's contacts that cd with compliance has not, or
// more; stress: largest error of a held component in md. Friction 0.5, and 10, with which no contact slides.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "benchmarks/work_precision/isostatic.hpp"
#include "common/core/clock.hpp"
#include "common/io/csv.hpp"
#include "common/io/figure.hpp"
#include "common/measure/stress.hpp"
#include "src/verify/trial.hpp"

namespace galet::precision {
namespace {

constexpr double rest = 40;

struct State {
  ContactMap contacts;
  double stress_error = 0, seconds = 0;
};

/// The scene with friction under the deviator.
Scene loaded(int count, double friction, double kappa, double x) {
  Scene scene = loaded_scene(count, friction);
  scene.material.normal_stiffness = kappa;
  scene.md.drag = 1;
  scene.loading.drives[0].stress = 1 + x, scene.loading.drives[1].stress = 1 - x;
  scene.cd.dt = 0.2, scene.cd.tolerance = 1e-10, scene.cd.max_sweeps = 1000000;
  return scene;
}

State settle(EngineKind engine, const Scene& scene, const Sample<2>& start, double x) {
  verify::Report report;
  const double before = thread_seconds();
  verify::Trial<2> trial(report, engine, scene, start);
  trial.run_to(rest);
  const Mat<2> sigma = stress<2>(trial.state()).total();
  return {contacts_of(trial.state()), std::max(std::abs(sigma(0, 0) - 1 - x), std::abs(sigma(1, 1) - 1 + x)),
          thread_seconds() - before};
}

/// At rest without friction under (1, 1).
Sample<2> pressed(const IsostaticPacking& packing, double kappa) {
  verify::Report report;
  Sample<2> start = packing.start;
  scale(start, 1 - 0.8 / kappa);
  verify::Trial<2> trial(report, EngineKind::md, loaded(start.count(), 0, kappa, 0), start);
  trial.run_to(rest);
  return at_rest(trial.state(), start);
}

/// rms over the contacts of either of the difference, over the mean force of b.
double difference(const ContactMap& a, const ContactMap& b) {
  double sum = 0, mean = 0;
  std::map<ContactKey, Vec<2>> off;
  for (const auto& [key, state] : b)
    off[key] = -state.whole, mean += state.whole.norm() / static_cast<double>(b.size());
  for (const auto& [key, state] : a) off.try_emplace(key, Vec<2>(0, 0)).first->second += state.whole;
  for (const auto& [key, vector] : off) sum += vector.squaredNorm() / static_cast<double>(off.size());
  return std::sqrt(sum) / mean;
}

double branch_error(const ContactMap& found, const IsostaticPacking& packing) {
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < packing.key.size(); ++k)
    if (const auto at = found.find(packing.key[k]); at != found.end())
      sum += std::pow(at->second.branch - packing.branch[k], 2), ++count;
  return std::sqrt(sum / count);
}

double unshared(const ContactMap& a, const ContactMap& b) {
  long common = 0;
  for (const auto& [key, state] : a) common += b.contains(key);
  return static_cast<double>(static_cast<long>(a.size() + b.size()) - 2 * common) / static_cast<double>(b.size());
}

void study(const IsostaticPacking& packing, double friction, CsvTable& table, Figure& figure) {
  const std::vector<double> levels{1e2, 1e3, 1e4, 1e5, 1e6, 1e7};
  const double x = 0.3 * packing.largest_deviator;
  const int count = packing.start.count();
  std::map<double, State> soft, elastic;
  for (const double kappa : levels) {
    const Sample<2> start = pressed(packing, kappa);
    Scene scene = loaded(count, friction, kappa, x);
    soft[kappa] = settle(EngineKind::md, scene, start, x);
    scene.cd.compliance = true;
    elastic[kappa] = settle(EngineKind::cd, scene, start, x);
    fmt::print(stderr, "friction {} kappa {:g}: md {:.3g} s, cd {:.3g} s\n", friction, kappa, soft[kappa].seconds,
               elastic[kappa].seconds);
  }
  const State rigid = settle(EngineKind::cd, loaded(count, friction, 1e7, x), packing.start, x);
  const ContactMap& limit = soft[1e7].contacts;
  Series same{.label = fmt::format("elastic cd - md, mu = {}", friction), .x = {}, .y = {}, .y_error = {}};
  Series far{.label = fmt::format("md - md at 1e7, mu = {}", friction), .x = {}, .y = {}, .y_error = {}};
  const auto cell = [](double value) { return CsvCell(std::stod(fmt::format("{:.2e}", value))); };
  for (const double kappa : levels) {
    const State &md = soft[kappa], &cd = elastic[kappa];
    const double off = difference(cd.contacts, md.contacts), to_limit = difference(md.contacts, limit);
    table.rows.push_back({friction, kappa, cell(off), cell(to_limit),
                          cell(difference(cd.contacts, elastic[1e7].contacts)), cell(difference(rigid.contacts, limit)),
                          cell(branch_error(md.contacts, packing)), cell(unshared(cd.contacts, md.contacts)),
                          cell(md.stress_error), cell(md.seconds), cell(cd.seconds)});
    same.x.push_back(kappa), same.y.push_back(off);
    if (kappa < 1e7) far.x.push_back(kappa), far.y.push_back(to_limit);
  }
  figure.series.push_back(same);
  figure.series.push_back(far);
}

int run(const std::string& folder) {
  std::filesystem::create_directories(folder);
  const IsostaticPacking packing = isostatic_packing();
  CsvTable table;
  table.comments = {"see benchmarks/rigid_limit.cpp"};
  for (const char* name : {"friction", "kappa", "elastic", "limit", "limit_cd", "rigid", "branch", "contacts", "stress",
                           "md_seconds", "cd_seconds"})
    table.columns.push_back({name, ""});
  Figure figure{.title = "Contact forces of a hyperstatic packing",
                .x_label = "stiffness level",
                .y_label = "rms difference of forces / mean force",
                .log_x = true,
                .log_y = true,
                .series = {}};
  for (const double friction : {0.5, 10.0}) study(packing, friction, table, figure);
  write_csv(folder + "/forces.csv", table);
  write_figure(folder + "/forces", figure);
  return 0;
}

}  // namespace
}  // namespace galet::precision

int main(int argc, char** argv) try {
  if (argc != 2) {
    fmt::print(stderr, "usage: rigid_limit OUT\n");
    return 2;
  }
  return galet::precision::run(argv[1]);
} catch (const std::exception& error) {
  fmt::print(stderr, "rigid_limit: {}\n", error.what());
  return 1;
}
