#include "src/report/engine_section.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/io/checkpoint.hpp"
#include "common/io/files.hpp"
#include "common/io/scratch_folder.hpp"
#include "src/engines.hpp"
#include "src/render.hpp"
#include "src/report/figures.hpp"
#include "src/report/html.hpp"
#include "src/report/polar.hpp"
#include "src/restart.hpp"
#include "src/simulation.hpp"
#include "src/text_table.hpp"

namespace galet::report {

namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

std::string value(const Json& json, const std::string& key, int digits = 4) {
  return short_number(number(json, key), digits);
}

/// What a user must know first: how the run ended, what went wrong, what the solver missed.
std::string warnings(const Json& summary) {
  const std::string ending = text(summary, "ending");
  std::string html;
  if (ending == "failed")
    html += fmt::format("<p class=\"failure\"><b>The run failed</b> after step {}: {}</p>\n",
                        value(summary, "steps", 12), escaped(text(summary, "failure")));
  if (ending == "interrupted")
    html += fmt::format(
        "<p class=\"warning\">The run was stopped after step {} of {}; it can go on from its checkpoint."
        "</p>\n",
        value(summary, "steps", 12), value(summary, "total_steps", 12));
  for (const Json& note : summary.value("notes", Json::array()))
    html += fmt::format("<p class=\"warning\">{}</p>\n", escaped(note.get<std::string>()));
  const Json solver = summary.value("solver", Json());
  if (solver.is_object() && number(solver, "missed") == 0)
    html += fmt::format("<p class=\"good\">The contact solver met its tolerance in each of {} steps.</p>\n",
                        value(solver, "steps", 12));
  if (html.empty()) html = "<p class=\"good\">No warnings.</p>\n";
  return "<h3>Warnings</h3>\n" + html;
}

std::string facts(const EngineRun& run) {
  const Json& summary = run.summary;
  const Json& origin = summary.at("origin");
  return fmt::format("<p class=\"facts\">{} · {} grains · {} · {} of {} steps of {} · time {} · strain {}</p>\n",
                     run.engine == "md" ? "soft spheres (md)" : "rigid grains (cd)", value(origin, "grains", 12),
                     escaped(text(summary, "ending")), value(summary, "steps", 12), value(summary, "total_steps", 12),
                     value(summary, "dt"), value(summary, "time"), value(summary, "strain"));
}

std::string derived_table(const Json& origin) {
  Rows rows;
  for (const Json& line : origin.value("derived", Json::array()))
    rows.push_back({escaped(text(line, "symbol")), escaped(text(line, "value")), escaped(text(line, "from"))});
  return rows.empty() ? "" : "<h3>Derived numbers</h3>\n" + table({"symbol", "value", "from"}, rows, "said");
}

/// Unit of a column of the series, in brackets.
std::string unit_of(const EngineRun& run, const std::string& name) {
  if (!run.series) return "";
  const auto index = run.series->find(name);
  if (!index) return "";
  const std::string& unit = run.series->columns[static_cast<std::size_t>(*index)].unit;
  return unit.empty() ? "" : " [" + escaped(unit) + "]";
}

std::string averages_table(const EngineRun& run) {
  const Json& averages = run.summary.at("averages");
  const Json last = run.summary.value("last", Json::object());
  Rows rows;
  bool correlated = false;
  for (const auto& [name, entry] : averages.items()) {
    if (!entry.is_object() || std::isnan(number(entry, "value"))) continue;
    const Estimate mean{number(entry, "value"), number(entry, "error")};
    const bool zero = mean.value == 0 && !(mean.error > 0) && number(last, name) == 0;
    if (zero) continue;  // quantities that the scene doesn't have
    const double time = number(entry, "autocorrelation_time");
    const bool said = mean.error > 1e-12 * std::abs(mean.value);  // below that it is rounding
    correlated = correlated || std::isfinite(time);
    rows.push_back({html_symbol(name) + unit_of(run, name), short_number(mean.value, 5),
                    said ? "± " + short_number(mean.error, 2) : "-", short_number(time, 2), value(last, name, 5)});
    if (!correlated) rows.back().erase(rows.back().begin() + 3);
  }
  if (rows.empty()) return "";
  std::vector<std::string> header = {"quantity", "mean", "standard error"};
  if (correlated) header.emplace_back("autocorrelation time");
  header.emplace_back("last sample");
  for (std::vector<std::string>& row : rows)
    if (row.size() < header.size()) row.insert(row.begin() + 3, "-");
  return fmt::format("<h3>Results</h3>\n<p class=\"facts\">Means of {} rows of the series, from time {} on{}.</p>\n",
                     value(averages, "rows", 8), value(averages, "from_time"),
                     run.summary.contains("stages") ? ", of the last stage" : "") +
         table(header, rows, "numbers");
}

std::string stages_table(const EngineRun& run) {
  const Json stages = run.summary.value("stages", Json::array());
  if (stages.empty()) return "";
  std::vector<std::string> shown;
  for (const char* name :
       {"eps_xx", "eps_yy", "eps_zz", "strain", "sigma_xx", "sigma_yy", "sigma_zz", "sigma_xy", "Phi", "z_star"})
    if (stages[0].contains("last") && stages[0]["last"].contains(name)) shown.emplace_back(name);
  std::vector<std::string> header = {"stage", "ending", "time", "steps"};
  for (const std::string& name : shown) header.push_back(html_symbol(name));
  Rows rows;
  for (const Json& stage : stages) {
    rows.push_back({escaped(text(stage, "name")), escaped(text(stage, "ending")), value(stage, "time"),
                    value(stage, "steps", 12)});
    for (const std::string& name : shown) rows.back().push_back(value(stage.value("last", Json::object()), name));
  }
  return "<h3>Stages</h3>\n" + table(header, rows, "numbers");
}

/// Numbers of the contact network, of the gas's compression, and of the contact solver.
std::string further_tables(const Json& summary) {
  std::string html;
  const auto add = [&](const char* heading, const Json& json,
                       const std::vector<std::pair<const char*, const char*>>& shown) {
    if (!json.is_object()) return;
    Rows rows;
    for (const auto& [key, label] : shown)
      if (json.contains(key)) rows.push_back({label, value(json, key, 6)});
    html += fmt::format("<h3>{}</h3>\n", heading) + table({"quantity", "value"}, rows, "numbers");
  };
  const Json measures = summary.value("measures", Json::object());
  add("Force indeterminacy of the last state", measures.value("indeterminacy", Json()),
      {{"forces", "force components"},
       {"freedoms", "degrees of freedom"},
       {"rank", "rank of the equilibrium matrix"},
       {"indeterminacy", "degree of force indeterminacy h"},
       {"mechanisms", "mechanisms k"}});
  add("Elastic moduli of the contact network", measures.value("moduli", Json()),
      {{"bulk", "bulk modulus"},
       {"shear", "shear modulus"},
       {"affine_bulk", "bulk modulus, affine estimate"},
       {"affine_shear", "shear modulus, affine estimate"}});
  add("Compression of the gas, before the run", summary.value("compression", Json()),
      {{"time", "time"},
       {"steps", "steps"},
       {"pressure", "mean stress"},
       {"Phi", "Φ"},
       {"z", "z"},
       {"kinetic_per_grain", "kinetic energy per grain"},
       {"seconds", "seconds"}});
  add("Contact solver", summary.value("solver", Json()),
      {{"steps", "steps"},
       {"sweeps", "sweeps, all steps"},
       {"missed", "steps that missed the tolerance"},
       {"mean_residual", "mean residual"},
       {"worst_residual", "worst residual"},
       {"largest_penetration", "largest penetration / d"},
       {"corrections", "penetration corrections"},
       {"divided_steps", "steps taken in parts"},
       {"dissipated", "energy dissipated"},
       {"gained", "energy made"}});
  return html;
}

/// The last state of spheres, drawn from its checkpoint.
std::string drawn_spheres(const EngineRun& run) {
  if (run.checkpoint.empty()) return "";
  const Archive archive = read_checkpoint(run.checkpoint);
  const Scene scene = stored_scene(archive);
  if (scene.dimension != 3) return "";
  Simulation<3> simulation = Simulation<3>::resume(scene, archive);
  const ScratchFolder folder;
  const std::string missing = render_spheres(folder.file("state.png"), simulation.engine().snapshot(),
                                             {fmt::format("{}, last state", run.engine)});
  if (!missing.empty()) return fmt::format("<p class=\"warning\">No picture: {}.</p>\n", escaped(missing));
  return fmt::format(
      "<figure>{}<figcaption>Left: grains, by the speed of their fluctuation. Right: contact forces; "
      "radius and colour grow with the normal force.</figcaption></figure>\n",
      inline_png(read_file(folder.file("state.png")), "grains and contact forces"));
}

std::string picture(const EngineRun& run) {
  std::string html;
  if (!run.picture.empty())
    html = fmt::format("<figure class=\"picture\">{}</figure>\n", inline_svg(run.picture, run.engine + "-sample-"));
  else
    html = drawn_spheres(run);
  return html.empty() ? "" : "<h3>Last state</h3>\n" + html;
}

/// Contacts by direction, as a rose.
std::string directions(const EngineRun& run) {
  const std::string svg = run.directions ? polar_svg(*run.directions) : std::string();
  if (svg.empty()) return "";
  const std::string plane = run.directions->comments.empty() ? "" : escaped(run.directions->comments.front()) + ". ";
  return fmt::format(
      "<h3>Contact directions of the last state</h3>\n<figure style=\"max-width:520px\">{}<figcaption>"
      "Wedges: density of contacts by direction (dashed: isotropic). Line: mean normal force by "
      "direction / mean of all. {}</figcaption></figure>\n",
      svg, plane);
}

std::string cost_table(const Json& summary) {
  const double wall = number(summary, "wall_seconds"), steps = number(summary, "steps");
  const double grains = number(summary.at("origin"), "grains");
  Rows rows = {{"wall time of the steps", short_number(wall, 4) + " s"},
               {"processor time of the main thread", value(summary, "seconds") + " s"}};
  if (wall > 0) {
    rows.push_back({"steps per second", short_number(steps / wall, 4)});
    rows.push_back({"grains · steps per second", short_number(grains * steps / wall, 3)});
  }
  const Json stages = summary.value("stage_seconds", Json::object());
  double sum = 0;
  for (const auto& [name, seconds] : stages.items()) sum += seconds.is_number() ? seconds.get<double>() : 0;
  for (const auto& [name, seconds] : stages.items())
    if (seconds.is_number() && seconds.get<double>() > 0)
      rows.push_back({"part of a step: " + escaped(name), fmt::format("{:.1f} %", 100 * seconds.get<double>() / sum)});
  return "<h3>Cost</h3>\n" + table({"", ""}, rows, "numbers");
}

std::string provenance_table(const EngineRun& run) {
  const Json& summary = run.summary;
  const Json program = summary.value("program", Json::object());
  const Json& origin = summary.at("origin");
  return "<h3>Provenance</h3>\n" +
         table({"", ""}, {{"program", "galet " + escaped(text(program, "version"))},
                          {"build", escaped(text(program, "build"))},
                          {"engine", escaped(run.engine) + ", " + escaped(text(summary, "layout"))},
                          {"time step", value(summary, "dt", 6)},
                          {"seed", value(origin, "seed", 18)},
                          {"units", escaped(text(origin, "units"))},
                          {"state hash", "<code>" + escaped(text(summary, "state_hash")) + "</code>"}});
}

std::string scene_echo(const Json& origin) {
  const std::string scene = text(origin, "scene");
  std::string html = "<h3>Scene</h3>\n";
  const Json changes = origin.value("changes", Json::array());
  if (!changes.empty()) {
    html += "<p>Changed on the command line:</p>\n<pre>";
    for (const Json& change : changes) html += "--set " + escaped(change.get<std::string>()) + "\n";
    html += "</pre>\n";
  }
  if (scene.empty()) return html + "<p>The scene was built by a program and has no text.</p>\n";
  return html + "<pre>" + escaped(scene) + "</pre>\n";
}

}  // namespace

std::string engine_section(const EngineRun& run) {
  const Json& origin = run.summary.at("origin");
  std::string html = fmt::format("<h2 id=\"{0}\">{0}</h2>\n", run.engine) + facts(run);
  html += warnings(run.summary);
  html += averages_table(run) + stages_table(run) + further_tables(run.summary);
  html += picture(run);
  html += figures_html("Histories", series_figures(run), run.engine + "-");
  html += figures_html("Profiles", profile_figures(run), run.engine + "-");
  html += figures_html("Distributions", distribution_figures(run), run.engine + "-");
  html += directions(run) + derived_table(origin);
  html += cost_table(run.summary) + provenance_table(run) + scene_echo(origin);
  return html;
}

}  // namespace galet::report
