// galet solve: discrete contact problems from FCLIB files, one row for each.
#include "cd/discrete/solve.hpp"

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cd/discrete/fclib.hpp"
#include "common/core/error.hpp"
#include "common/core/near_match.hpp"
#include "src/commands/commands.hpp"
#include "src/text_table.hpp"

namespace galet::cli {

namespace {

struct SolveArguments {
  std::vector<std::string> files;
  cd::DiscreteOptions options;
  std::string output;
  bool json = false;
};

struct Solved {
  std::string file;
  int contacts, block;
  cd::DiscreteSolution solution;
  std::optional<cd::FclibScale> scale;

  /// What the largest approach that is left takes from a gap in the step, in d.
  std::optional<double> lost_gap() const {
    if (!scale) return std::nullopt;
    return solution.violation * scale->gap_time / scale->diameter;
  }
};

void check_arguments(const SolveArguments& arguments) {
  std::vector<std::string> names;
  for (const std::string_view name : cd::discrete_solvers()) names.emplace_back(name);
  const std::string& solver = arguments.options.solver;
  if (std::find(names.begin(), names.end(), solver) == names.end())
    throw InputError(fmt::format("--solver {}: there is no such solver{}; expected {}", solver,
                                 suggestion(solver, names), alternatives(in_quotes(names))));
  if (!arguments.output.empty() && arguments.files.size() > 1)
    throw InputError(fmt::format("--output {}: it holds the solution of one problem, and {} are given",
                                 arguments.output, arguments.files.size()));
}

/// All problems, so that mistakes in any of them are known before the first is solved.
std::vector<cd::FclibContent> read_all(const std::vector<std::string>& files, const std::string& solver) {
  std::vector<cd::FclibContent> contents;
  std::vector<Mistake> mistakes;
  for (const std::string& file : files) {
    try {
      contents.push_back(cd::read_fclib(file));
    } catch (const InputError& error) {
      mistakes.insert(mistakes.end(), error.mistakes().begin(), error.mistakes().end());
    }
  }
  if (!mistakes.empty()) throw InputError(mistakes);
  for (std::size_t k = 0; k < contents.size(); ++k)
    if (cd::needs_bodies(solver) && !contents[k].global)
      mistakes.push_back(
          {files[k], 0, 0,
           fmt::format("--solver {} factorises matrices of the bodies: expected a problem in global form "
                       "(M, H, f, w)",
                       solver)});
  if (!mistakes.empty()) throw InputError(mistakes);
  return contents;
}

std::string text_of(const std::vector<Solved>& all) {
  TextTable table({"problem", "contacts", "block", "errS", "errP", "force error", "violation", "gap lost (d)",
                   "iterations", "time", "solver", "reason"});
  for (const Solved& solved : all) {
    const cd::DiscreteSolution& solution = solved.solution;
    const std::optional<double> lost = solved.lost_gap();
    table.add({solved.file, fmt::format("{}", solved.contacts), fmt::format("{}", solved.block),
               fmt::format("{:.2e}", solution.error), fmt::format("{:.2e}", solution.siconos_error),
               fmt::format("{:.2e}", solution.force_error), fmt::format("{:.2e}", solution.violation),
               lost ? fmt::format("{:.2e}", *lost) : "-", fmt::format("{}", solution.iterations),
               fmt::format("{:.3g} s", solution.seconds), solution.solver, solution.reason});
  }
  std::string text = table.text();
  for (const Solved& solved : all)
    if (const std::vector<int>& closing = solved.solution.contradiction; !closing.empty())
      text +=
          fmt::format("\n{}: no solution; {} contact{} against each other whatever the impulses: {}\n", solved.file,
                      closing.size(), closing.size() == 1 ? " closes" : "s close",
                      fmt::join(closing.begin(), closing.begin() + std::min<std::size_t>(closing.size(), 10), ", "));
  for (const Solved& solved : all) {
    if (solved.solution.history.empty()) continue;
    TextTable history({solved.file, "iterations", "errS", "errP", "time"});
    for (const cd::DiscreteHistory& at : solved.solution.history)
      history.add({at.solver, fmt::format("{}", at.iterations), fmt::format("{:.2e}", at.error),
                   fmt::format("{:.2e}", at.siconos_error), fmt::format("{:.3g} s", at.seconds)});
    text += "\n" + history.text();
  }
  return text;
}

std::string json_of(const std::vector<Solved>& all) {
  nlohmann::ordered_json json;
  json["problems"] = nlohmann::ordered_json::array();
  for (const Solved& solved : all) {
    const cd::DiscreteSolution& solution = solved.solution;
    nlohmann::ordered_json row{{"file", solved.file},
                               {"contacts", solved.contacts},
                               {"block", solved.block},
                               {"converged", solution.converged},
                               {"reason", solution.reason},
                               {"errS", solution.error},
                               {"errP", solution.siconos_error},
                               {"force_error", solution.force_error},
                               {"violation", solution.violation},
                               {"iterations", solution.iterations},
                               {"seconds", solution.seconds},
                               {"solver", solution.solver}};
    if (const auto lost = solved.lost_gap()) row["gap_lost_in_d"] = *lost;
    if (!solution.converged) row["least_impulse"] = solution.least_impulse;
    if (!solution.contradiction.empty()) row["contradiction"] = solution.contradiction;
    for (const cd::DiscreteHistory& at : solution.history)
      row["history"].push_back({{"seconds", at.seconds},
                                {"solver", at.solver},
                                {"iterations", at.iterations},
                                {"errS", at.error},
                                {"errP", at.siconos_error}});
    json["problems"].push_back(row);
  }
  return json.dump(2);
}

int solve_problems(const SolveArguments& arguments) {
  check_arguments(arguments);
  const std::vector<cd::FclibContent> contents = read_all(arguments.files, arguments.options.solver);
  std::vector<Solved> all;
  bool converged = true;
  for (std::size_t k = 0; k < contents.size(); ++k) {
    const cd::FclibContent& content = contents[k];
    const cd::DiscreteProblem& problem = content.problem;
    const cd::GlobalProblem* bodies = content.global ? &*content.global : nullptr;
    all.push_back({arguments.files[k], problem.contacts(), problem.block, cd::solve(problem, arguments.options, bodies),
                   content.scale});
    converged = converged && all.back().solution.converged;
  }
  fmt::print("{}\n", arguments.json ? json_of(all) : text_of(all));
  if (!arguments.output.empty())
    cd::write_fclib(arguments.output, {contents[0].problem, all[0].solution.u, all[0].solution.r, contents[0].scale});
  if (!converged) fmt::print(stderr, "galet: not every problem was solved to --error {:g}\n", arguments.options.error);
  return converged ? 0 : 1;
}

}  // namespace

void add_solve(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("solve", "Solve contact problems from FCLIB files (HDF5)");
  auto arguments = std::make_shared<SolveArguments>();
  command->add_option("PROBLEM", arguments->files, "FCLIB files")->required();
  command->add_option("--error", arguments->options.error, "error errS that is wanted; it depends on no unit")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--solver", arguments->options.solver, "auto, or one solver by name")->capture_default_str();
  command->add_option("--seconds", arguments->options.seconds, "processor time that each problem may take")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--output", arguments->output, "FCLIB file to write: the (reduced) problem and its solution");
  command->add_flag("--history", arguments->options.history, "show errors against time");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([&action, arguments] { action = [arguments] { return solve_problems(*arguments); }; });
}

}  // namespace galet::cli
