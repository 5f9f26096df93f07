// Work-precision: error against processor time of both engines over their numerical parameters, scene class by scene
// class; where one overtakes the other; what their costs follow.
//
//   work_precision OUT [CLASS...]
//
// OUT/rows.csv keeps each row as it is made: a run that was stopped goes on where it was. From the rows follow
// OUT/work.csv (error of each row, and whether no other row of its engine is both cheaper and better), crossover.csv,
// crossings.csv, cost.csv, limit.csv and a figure per class (evaluation.hpp).
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "benchmarks/work_precision/classes.hpp"
#include "benchmarks/work_precision/evaluation.hpp"
#include "common/core/clock.hpp"
#include "src/engines.hpp"

namespace galet::precision {
namespace {

void make_rows(const std::vector<SceneClass>& classes, RowFile& file) {
  for (const SceneClass& each : classes)
    for (const Setting& setting : each.plan) {
      if (file.has(each.name, setting)) continue;
      const double before = wall_seconds();
      file.add(each.run(setting));
      const Row& row = file.rows().back();
      fmt::print(stderr, "{} {} kappa {:g} dt {:g} tolerance {:g}: {:.4g}, {:.3g} s of {:.3g} s\n", each.name,
                 engine_name(setting.engine), setting.kappa, setting.dt, setting.tolerance, row.quantities[0].values[0],
                 row.seconds, wall_seconds() - before);
    }
}

}  // namespace
}  // namespace galet::precision

int main(int argc, char** argv) try {
  using namespace galet::precision;
  if (argc < 2) {
    fmt::print(stderr, "usage: work_precision OUT [CLASS...]\n");
    return 2;
  }
  const std::filesystem::path out(argv[1]);
  std::filesystem::create_directories(out);
  const std::vector<std::string> names(argv + 2, argv + argc);
  std::vector<SceneClass> classes = all_classes();
  RowFile file((out / "rows.csv").string());
  std::vector<SceneClass> asked;
  for (const SceneClass& each : classes)
    if (names.empty() || std::find(names.begin(), names.end(), each.name) != names.end()) asked.push_back(each);
  if (asked.empty() || (!names.empty() && asked.size() != names.size())) {
    fmt::print(stderr, "work_precision: there is no such class\n");
    return 2;
  }
  make_rows(asked, file);
  evaluate(classes, file.rows(), out.string());
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "work_precision: {}\n", error.what());
  return 1;
}
