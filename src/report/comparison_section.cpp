#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "common/io/files.hpp"
#include "src/report/engine_section.hpp"
#include "src/report/html.hpp"
#include "src/text_table.hpp"

namespace galet::report {

namespace {

using Json = nlohmann::ordered_json;

std::string estimate(const Json& json) {
  if (!json.is_object()) return "-";
  return with_error({number(json, "value"), number(json, "error")});
}

std::string rows_table(const Json& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& row : comparison.value("rows", Json::array())) {
    const auto shown = [&](const char* key, int digits = 4) { return short_number(number(row, key), digits); };
    const double cost = std::isnan(number(row, "seconds_per_strain")) ? number(row, "seconds_per_time")
                                                                      : number(row, "seconds_per_strain");
    rows.push_back({escaped(text(row, "engine")), shown("I"), shown("kappa"), shown("dt"), shown("tolerance"),
                    estimate(row.value("mu_star", Json())), estimate(row.value("Phi", Json())),
                    estimate(row.value("z", Json())), shown("penetration", 2), estimate(row.value("deviation", Json())),
                    short_number(cost, 3), shown("solver_missed"), escaped(text(row, "ending"))});
  }
  return table({"engine", "I", "κ", "Δt", "tolerance", "μ*", "Φ", "z", "largest overlap / d",
                "deviation from the limit", "processor s per strain or time", "solver misses", "ending"},
               rows, "numbers");
}

std::string limits_table(const Json& comparison) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& state : comparison.value("rigid_limit", Json::array()))
    for (const char* quantity : {"mu_star", "Phi", "z"}) {
      const Json limit = state.value(quantity, Json());
      if (!limit.is_object()) continue;
      const Json agree = limit.value("agree", Json());
      rows.push_back({short_number(number(state, "I")), html_symbol(quantity), estimate(limit.value("md", Json())),
                      estimate(limit.value("cd", Json())), estimate(limit.value("combined", Json())),
                      agree.is_boolean() ? (agree.get<bool>() ? "yes" : "no") : "-"});
    }
  if (rows.empty()) return "";
  return "<h3>Rigid limit</h3>\n" +
         table({"I", "quantity", "md, κ to infinity", "cd, Δt to 0", "both", "agree within two errors"}, rows,
               "numbers");
}

std::string notes(const Json& comparison) {
  std::string html;
  if (comparison.value("shortened", false))
    html +=
        "<p class=\"warning\">A shortened comparison (--short): few grains, short averages, one state. A first look, "
        "not a result.</p>\n";
  if (comparison.value("interrupted", false))
    html += "<p class=\"warning\">The comparison was interrupted: some rows are missing.</p>\n";
  for (const Json& note : comparison.value("notes", Json::array()))
    if (note.is_string()) html += fmt::format("<p class=\"warning\">{}</p>\n", escaped(note.get<std::string>()));
  for (const Json& row : comparison.value("rows", Json::array())) {
    const std::string failure = text(row, "failure");
    if (!failure.empty()) html += fmt::format("<p class=\"failure\">{}</p>\n", escaped(failure));
    for (const Json& note : row.value("notes", Json::array()))
      if (note.is_string())
        html += fmt::format("<p class=\"warning\">{}, I = {}, Δt = {}: {}</p>\n", escaped(text(row, "engine")),
                            short_number(number(row, "I")), short_number(number(row, "dt")),
                            escaped(note.get<std::string>()));
  }
  return html.empty() ? "" : "<h3>Warnings</h3>\n" + html;
}

std::string pictures(const RunFolder& folder) {
  std::string html;
  for (const char* name : {"error_cost", "mu_star", "velocity_profile"}) {
    const std::filesystem::path path = std::filesystem::path(folder.path) / (std::string(name) + ".svg");
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored))
      html += fmt::format("<figure>{}</figure>\n", inline_svg(read_file(path.string()), std::string(name) + "-"));
  }
  std::string samples;
  for (const char* name : {"sample_md", "sample_cd"}) {
    const std::filesystem::path path = std::filesystem::path(folder.path) / (std::string(name) + ".svg");
    std::error_code ignored;
    if (folder.runs.empty() && std::filesystem::is_regular_file(path, ignored))
      samples += fmt::format("<figure>{}</figure>\n", inline_svg(read_file(path.string()), std::string(name) + "-"));
  }
  return html + samples == "" ? "" : "<h3>Figures</h3>\n<div class=\"figures\">\n" + html + samples + "</div>\n";
}

}  // namespace

std::string comparison_section(const RunFolder& folder) {
  return "<h2 id=\"compare\">Comparison of the engines</h2>\n" + notes(folder.comparison) +
         "<h3>Rows</h3>\n<p class=\"facts\">Means with standard errors.</p>\n" + rows_table(folder.comparison) +
         limits_table(folder.comparison) + pictures(folder);
}

}  // namespace galet::report
