// galet verify: cases whose answer is known, with both engines: value, exact, error, cost.
#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/near_match.hpp"
#include "common/io/files.hpp"
#include "src/commands/commands.hpp"
#include "src/commands/progress_line.hpp"
#include "src/engines.hpp"
#include "src/verify/output.hpp"

namespace galet::cli {

namespace {

struct VerifyArguments {
  std::vector<std::string> names;
  std::string engine, out;
  bool list = false, quick = false, all = false, json = false;
};

std::vector<EngineKind> engines_of(const std::string& name) {
  if (name.empty()) return {EngineKind::md, EngineKind::cd};
  return {engine_kind(name)};
}

/// Without --quick and --all: what is named is run whole, and without names the quick set.
verify::Effort effort_of(const VerifyArguments& arguments) {
  if (arguments.quick && arguments.all) throw InputError("--quick and --all exclude each other");
  if (arguments.quick) return verify::Effort::quick;
  return arguments.all || arguments.list || !arguments.names.empty() ? verify::Effort::full : verify::Effort::quick;
}

int verify_cases(const VerifyArguments& arguments) {
  const std::vector<EngineKind> engines = engines_of(arguments.engine);
  const auto cases = verify::select_cases(arguments.names, effort_of(arguments));
  if (cases.empty())
    throw InputError("no case of these is as short as --quick asks; leave it out, or name cases one by one");
  if (arguments.list) {
    if (arguments.json)
      fmt::print("{}\n", verify::list_json(cases));
    else
      fmt::print("{}", verify::list_text(cases));
    return 0;
  }
  ProgressLine line;
  const std::size_t total = cases.size() * engines.size();
  const auto outcomes =
      verify::run_cases(cases, engines, [&](std::size_t done, const verify::Case& next, EngineKind engine) {
        line.show(fmt::format("{}/{}  {} {}", done + 1, total, next.name, engine_name(engine)));
      });
  line.clear();
  if (arguments.json)
    fmt::print("{}\n", verify::to_json(outcomes));
  else
    fmt::print("{}", verify::to_text(outcomes));
  if (!arguments.out.empty()) {
    const std::filesystem::path folder(arguments.out);
    std::filesystem::create_directories(folder);
    write_file((folder / "verify.json").string(), verify::to_json(outcomes) + "\n");
    write_file((folder / "verify.md").string(), verify::to_markdown(outcomes));
  }
  return verify::all_pass(outcomes) ? 0 : 1;
}

}  // namespace

void add_verify(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("verify", "Run cases whose answer is known: value, exact, error and cost of both engines");
  auto arguments = std::make_shared<VerifyArguments>();
  command->add_option("NAME", arguments->names, "cases or tags (default: the quick set)");
  command->add_option("--engine", arguments->engine, "md or cd only");
  command->add_option("--out", arguments->out, "folder for verify.json and verify.md");
  command->add_flag("--list", arguments->list, "show the cases, run nothing");
  command->add_flag("--quick", arguments->quick, "leave out long cases, but for those named one by one");
  command->add_flag("--all", arguments->all, "all lengths");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([&action, arguments] { action = [arguments] { return verify_cases(*arguments); }; });
}

}  // namespace galet::cli
