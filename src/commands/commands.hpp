// The subcommands of `galet`. Each function adds one to the command line; when it is chosen, `action` becomes what
// it does, and returns the exit code.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace galet::cli {

using Action = std::function<int()>;

void add_run(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_describe(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_solve(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_picture(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_study(CLI::App& app, Action& action);
void add_reference(CLI::App& app, Action& action);
void add_verify(CLI::App& app, Action& action);

}  // namespace galet::cli
