// galet study: a published result from scenes to figures.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/core/error.hpp"
#include "src/commands/commands.hpp"
#include "src/commands/interrupt.hpp"
#include "src/commands/progress_line.hpp"
#include "src/studies/registry.hpp"
#include "src/studies/run_study.hpp"
#include "src/studies/study_files.hpp"
#include "src/text_table.hpp"

namespace galet::cli {

namespace {

struct StudyArguments {
  std::string name;
  std::string out;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  bool list = false, quick = false, fresh = false, json = false;
};

int list_studies(bool json) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  TextTable table({"study", "runs", "core time", "quick runs", "core time"});
  std::vector<std::string> titles{"what"};
  for (const Study& study : all_studies()) {
    const StudyCost full = estimate_study(study, StudySize::full), quick = estimate_study(study, StudySize::quick);
    table.add({study.name, std::to_string(full.runs), duration_text(full.seconds), std::to_string(quick.runs),
               duration_text(quick.seconds)});
    titles.emplace_back(study.title);
    entries.push_back({{"name", study.name},
                       {"title", study.title},
                       {"source", study.source},
                       {"runs", full.runs},
                       {"seconds", full.seconds},
                       {"quick_runs", quick.runs},
                       {"quick_seconds", quick.seconds}});
  }
  if (json) {
    fmt::print("{}\n", entries.dump(2));
    return 0;
  }
  std::istringstream lines(table.text());
  std::string line;
  for (const std::string& title : titles) {
    std::getline(lines, line);
    fmt::print("{}  {}\n", line, title);
  }
  fmt::print("\nTimes are estimates from sizes alone, of one core: a factor of 2 or 3 either way.\n");
  return 0;
}

int run(const StudyArguments& arguments) {
  if (arguments.list) return list_studies(arguments.json);
  if (arguments.name.empty()) throw InputError("name a study, or ask for --list");
  const Study& study = find_study(arguments.name);
  StudyOptions options;
  options.size = arguments.quick ? StudySize::quick : StudySize::full;
  options.directory = arguments.out;
  if (options.directory.empty())
    options.directory = "out/studies/" + arguments.name + (arguments.quick ? "_quick" : "");
  std::filesystem::create_directories(options.directory);
  options.jobs = arguments.jobs;
  options.fresh = arguments.fresh;
  options.stop = interrupted;
  ProgressLine line;
  options.progress = [&](double share, double seconds_left) {
    line.show(fmt::format("{} {:.0f} %, {} left", study.name, 100 * share, duration_text(seconds_left)));
  };
  catch_interrupts();
  const StudyOutcome outcome = run_study(study, options);
  line.clear();

  const std::vector<std::string> files = write_study(study, outcome, options.directory);
  if (arguments.json) {
    fmt::print("{}\n", study_json(study, outcome));
  } else {
    if (outcome.kept > 0) fmt::print("{} of {} runs were found finished and kept\n\n", outcome.kept, outcome.planned);
    fmt::print("{}\n", study_text(study, outcome));
    for (const std::string& file : files) fmt::print("wrote {}\n", file);
  }
  if (outcome.interrupted)
    fmt::print(stderr, "galet: stopped; finished runs are kept in {}, the same command goes on\n", options.directory);
  return outcome.failed() ? 1 : 0;
}

}  // namespace

void add_study(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("study", "Reproduce a published result: runs, table, verdicts, figures");
  auto arguments = std::make_shared<StudyArguments>();
  command->add_option("NAME", arguments->name, "the study; --list names them");
  command->add_flag("--list", arguments->list, "the studies, with estimates of their cost");
  command->add_flag("--quick", arguments->quick, "a smaller version, of minutes");
  command->add_option("--jobs", arguments->jobs, "runs side by side, one thread each")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--out", arguments->out,
                      "folder of the results (default: out/studies/NAME, with _quick for the quick version); finished "
                      "runs in it are kept");
  command->add_flag("--fresh", arguments->fresh, "run again what the folder has");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([&action, arguments] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace galet::cli
