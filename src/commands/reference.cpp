// galet reference: the scene reference of the documentation, from the table that the reader itself uses.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/io/scene_file.hpp"
#include "src/commands/commands.hpp"

namespace galet::cli {

void add_reference(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("reference", "Print every field of a scene file (Markdown)");
  command->callback([&action] {
    action = [] {
      fmt::print("{}", scene_reference());
      return 0;
    };
  });
}

}  // namespace galet::cli
