#include "src/report/report.hpp"

#include <cmath>

#include <fmt/format.h>

#include "src/report/engine_section.hpp"
#include "src/report/html.hpp"

namespace galet::report {

namespace {

std::string scene_title(const RunFolder& folder) {
  const auto& named = folder.runs.empty() ? folder.comparison : folder.runs.front().summary;
  const std::string title = text(named, "scene");
  return title.empty() ? "Results" : title;
}

/// A page of several parts begins with links to them.
std::string contents(const RunFolder& folder) {
  std::string links;
  for (const EngineRun& run : folder.runs) links += fmt::format("<a href=\"#{0}\">{0}</a>", run.engine);
  if (!folder.comparison.is_null()) links += "<a href=\"#compare\">comparison</a>";
  links += "<a href=\"#files\">files</a>";
  return fmt::format("<nav>{}</nav>\n", links);
}

std::string size_text(double bytes) {
  if (bytes < 1e4) return fmt::format("{:.0f} B", bytes);
  return bytes < 1e6 ? fmt::format("{:.0f} kB", bytes / 1e3) : fmt::format("{:.1f} MB", bytes / 1e6);
}

std::string files_section(const RunFolder& folder) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, bytes] : folder.files)
    if (name != "report.html") rows.push_back({escaped(name), size_text(static_cast<double>(bytes))});
  return "<h2 id=\"files\">Files of the folder</h2>\n" + table({"file", "size"}, rows, "numbers");
}

}  // namespace

std::string report_html(const RunFolder& folder) {
  const std::string title = scene_title(folder);
  std::string body = fmt::format("<h1>{}</h1>\n{}", escaped(title), contents(folder));
  for (const EngineRun& run : folder.runs) body += engine_section(run);
  if (!folder.comparison.is_null()) body += comparison_section(folder);
  body += files_section(folder);
  return page(title, body);
}

}  // namespace galet::report
