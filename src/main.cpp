// The command line: galet SUBCOMMAND ... Exit codes: 0 done, 1 the run failed or was stopped, 2 bad input.
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/core/error.hpp"
#include "src/commands/commands.hpp"
#include "src/version.hpp"

namespace {

constexpr int exit_failed = 1, exit_bad_input = 2;

int complain(const char* what, int code) {
  fmt::print(stderr, "galet: {}\n", what);
  return code;
}

int perform(const galet::cli::Action& action) {
  try {
    return action();
  } catch (const galet::InputError& error) {
    for (const galet::Mistake& mistake : error.mistakes()) fmt::print(stderr, "{}\n", galet::to_string(mistake));
    return exit_bad_input;
  } catch (const std::invalid_argument& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", exit_failed);
  } catch (const std::exception& error) {
    return complain(error.what(), exit_failed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  // A file that may not grow further is an error of write(), like a full disk, and no reason to be killed.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app(
      "Granular materials of disks and spheres: soft-sphere molecular dynamics (md) and nonsmooth contact "
      "dynamics (cd) on one scene.",
      "galet");
  app.set_version_flag("--version", "galet " + galet::program_version());
  app.require_subcommand(1);
  galet::cli::Action action;
  galet::cli::add_run(app, action);
  galet::cli::add_compare(app, action);
  galet::cli::add_describe(app, action);
  galet::cli::add_check(app, action);
  galet::cli::add_solve(app, action);
  galet::cli::add_export(app, action);
  galet::cli::add_picture(app, action);
  galet::cli::add_report(app, action);
  galet::cli::add_study(app, action);
  galet::cli::add_reference(app, action);
  galet::cli::add_verify(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are no errors; everything else on the command line is bad input.
    return app.exit(error) == 0 ? 0 : exit_bad_input;
  }
  return perform(action);
}
