// galet report: one HTML page of what a folder of results holds.
#include "src/report/report.hpp"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/io/files.hpp"
#include "src/commands/commands.hpp"

namespace galet::cli {

namespace {

struct ReportArguments {
  std::string folder;
  std::string out;
};

int write_report(const ReportArguments& arguments) {
  const std::string path =
      arguments.out.empty() ? (std::filesystem::path(arguments.folder) / "report.html").string() : arguments.out;
  write_file(path, report::report_html(report::read_run_folder(arguments.folder)));
  fmt::print("wrote {}\n", path);
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("report", "Write one HTML page of the results in a folder");
  auto arguments = std::make_shared<ReportArguments>();
  command->add_option("DIR", arguments->folder, "folder that galet run or galet compare wrote")->required();
  command->add_option("--out", arguments->out, "page to write (default: report.html in that folder)");
  command->callback([&action, arguments] { action = [arguments] { return write_report(*arguments); }; });
}

}  // namespace galet::cli
