// galet compare: both engines on one scene, speed against error.
#include "src/compare.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "src/advice.hpp"
#include "src/commands/arguments.hpp"
#include "src/commands/commands.hpp"
#include "src/commands/interrupt.hpp"
#include "src/commands/progress_line.hpp"
#include "src/compare_report.hpp"
#include "src/text_table.hpp"

namespace galet::cli {

namespace {

struct CompareArguments {
  SceneArguments scene;
  std::string out;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  bool brief = false;
  bool json = false;
  std::optional<double> error;  ///< wanted
};

bool failed(const Comparison& comparison) {
  return comparison.interrupted || std::any_of(comparison.rows.begin(), comparison.rows.end(),
                                               [](const CompareRow& row) { return !row.usable(); });
}

int compare_engines(const CompareArguments& arguments) {
  const Scene whole = load(arguments.scene);
  const Scene scene = arguments.brief ? shortened(whole) : whole;
  const std::string directory = output_directory(arguments.out, arguments.scene.path);
  const std::string title = scene.title.empty() ? arguments.scene.path : scene.title;
  catch_interrupts();
  if (!arguments.json)
    fmt::print("{}: {} runs, {} side by side{}\n\n", title, compare_plan(scene).size(), arguments.jobs,
               arguments.brief ? " (--short: a shortened comparison)" : "");
  std::fflush(stdout);

  ProgressLine line;
  SideBySideOptions options;
  options.jobs = arguments.jobs;
  options.stop = interrupted;
  options.progress = [&](double share, double seconds_left) {
    line.show(fmt::format("compare {:.0f} %, {} left", 100 * share, duration_text(seconds_left)));
  };
  Comparison comparison = compare(scene, options);
  comparison.shortened = arguments.brief;
  line.clear();

  const std::vector<std::string> files = write_comparison(comparison, title, directory);
  if (arguments.json) {
    fmt::print("{}\n", compare_json(comparison, title));
  } else {
    fmt::print("{}\n", compare_text(comparison));
    if (arguments.error) fmt::print("{}\n", advice_text(advise(comparison, *arguments.error), comparison));
    for (const std::string& file : files) fmt::print("wrote {}\n", file);
  }
  if (comparison.interrupted) fmt::print(stderr, "galet: stopped; the rows that were not finished are left out\n");
  return failed(comparison) ? 1 : 0;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("compare", "Run both engines on a scene: speed against error");
  auto arguments = std::make_shared<CompareArguments>();
  add_scene_arguments(*command, arguments->scene);
  command->add_option("--jobs", arguments->jobs, "runs side by side, one thread each")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--short", arguments->brief,
                    "a shortened comparison, a minute or two: at most 400 grains, I = 0.1, kappa = 1e3 and 1e4, "
                    "cd.dt_factor = 0.02 and 0.01, cd.tolerance = 1e-3, strain 30");
  command->add_option("--out", arguments->out, "folder for tables and pictures (default: out/<scene name>)");
  CLI::Option* json = command->add_flag("--json", arguments->json, "print one JSON object");
  command
      ->add_option("--error", arguments->error,
                   "wanted relative error of mu* (without shear: Phi) of rigid grains: say which engine reaches it at "
                   "the least cost, with which settings, and on what evidence")
      ->check(CLI::Range(1e-6, 0.99))
      ->excludes(json);
  command->callback([&action, arguments] { action = [arguments] { return compare_engines(*arguments); }; });
}

}  // namespace galet::cli
