#include "src/run_result.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/engines.hpp"
#include "src/final_measures_json.hpp"
#include "src/text_table.hpp"
#include "src/version.hpp"

namespace galet {

namespace {

using Json = nlohmann::ordered_json;  // keeps the order in which keys are written; NaN becomes null

bool averaged(int k, const TimeSeries& series) {
  const auto observable = static_cast<Observable>(k);
  // Time, strains and other sums since the start have no mean; the budget is shown by itself.
  return info(observable).reduction != Reduction::latest && shown(observable, series);
}

Json averages_json(const RunResult& result) {
  Json json{{"from_time", result.averages.from}, {"rows", result.averages.rows}};
  for (int k = 0; k < observable_count; ++k)
    if (averaged(k, result.series))
      json[std::string(observable_table[k].name)] = {{"value", result.averages.values[k].value},
                                                     {"error", result.averages.values[k].error},
                                                     {"autocorrelation_time", result.averages.correlation_time[k]}};
  return json;
}

Json sample_json(const RunResult& result, const Measurement& sample) {
  Json json;
  for (int k = 0; k < observable_count; ++k)
    if (shown(static_cast<Observable>(k), result.series))
      json[std::string(observable_table[k].name)] = sample.values[k];
  return json;
}

Json stages_json(const RunResult& result) {
  Json json = Json::array();
  for (const StageReport& stage : result.stages)
    json.push_back({{"name", stage.name},
                    {"ending", to_string(stage.ending)},
                    {"time", stage.time},
                    {"steps", stage.steps},
                    {"last", sample_json(result, stage.last)}});
  return json;
}

Json solver_json(const SolverSummary& solver) {
  if (solver.steps == 0) return nullptr;
  return {{"steps", solver.steps},
          {"sweeps", solver.sweeps},
          {"missed", solver.missed},
          {"worst_residual", solver.worst_residual},
          {"mean_residual", solver.residual_sum / static_cast<double>(solver.steps)},
          {"corrections", solver.corrections},
          {"divided_steps", solver.divided},
          {"largest_penetration", solver.penetration},
          {"dissipated", solver.dissipated},
          {"gained", solver.gained}};
}

Json compression_json(const std::optional<CompressionReport>& report) {
  if (!report) return nullptr;
  return {{"time", report->time},
          {"steps", report->steps},
          {"equilibrium", report->equilibrium},
          {"kinetic_per_grain", report->kinetic_per_grain},
          {"pressure", report->pressure},
          {"Phi", report->solid_fraction},
          {"z", report->z},
          {"seconds", report->cpu_seconds}};
}

Json origin_json(const RunOrigin& origin) {
  Json json{{"dimension", origin.dimension},
            {"grains", origin.grains},
            {"seed", origin.seed},
            {"units", origin.reduced_units ? "reduced" : "SI"},
            {"scene", origin.scene}};
  json["changes"] = Json::array();
  for (const Override& change : origin.changes) json["changes"].push_back(change.path + "=" + change.value);
  json["derived"] = Json::array();
  for (const DerivedLine& line : origin.derived)
    json["derived"].push_back({{"symbol", line.symbol}, {"value", line.value}, {"from", line.from}});
  return json;
}

}  // namespace

std::string to_string(Ending ending) {
  switch (ending) {
    case Ending::finished:
      return "finished";
    case Ending::equilibrium:
      return "equilibrium";
    case Ending::reached:
      return "reached";
    case Ending::interrupted:
      return "interrupted";
    case Ending::failed:
      return "failed";
  }
  return "";
}

std::string to_json(const RunResult& result, const std::string& scene) {
  Json json{{"scene", scene},
            {"engine", engine_name(result.engine)},
            {"layout", to_string(result.layout)},
            {"ending", to_string(result.ending)},
            {"dt", result.dt},
            {"steps", result.steps},
            {"total_steps", result.total_steps},
            {"time", result.time},
            {"strain", result.strain}};
  if (!result.failure.empty()) json["failure"] = result.failure;
  json["averages"] = averages_json(result);
  json["last"] = sample_json(result, result.last);
  if (!result.stages.empty()) json["stages"] = stages_json(result);
  json["measures"] = measures_json(result.measures);
  json["compression"] = compression_json(result.compression);
  json["solver"] = solver_json(result.solver);
  json["seconds"] = result.cpu_seconds;
  json["wall_seconds"] = result.wall_seconds;
  for (std::size_t k = 0; k < stage_names.size(); ++k)
    json["stage_seconds"][std::string(stage_names[k])] = result.stage_seconds[k];
  json["notes"] = result.notes;
  json["origin"] = origin_json(result.origin);
  json["program"] = {{"version", program_version()}, {"build", program_build()}};
  json["state_hash"] = fmt::format("{:016x}", result.state_hash);
  return json.dump(2);
}

namespace {

/// Work, what became of it, and the error of the account, as shares of what was dissipated.
std::string budget_text(const Measurement& last) {
  double dissipated = 0;
  std::string channels;
  const std::string_view prefix = "dissipated_";
  for (int k = 0; k < observable_count; ++k)
    if (observable_table[k].name.starts_with(prefix)) dissipated += last.values[k];
  for (int k = 0; k < observable_count; ++k)
    if (observable_table[k].name.starts_with(prefix) && last.values[k] != 0)
      channels += fmt::format(", {} {:.1f} %", observable_table[k].name.substr(prefix.size()),
                              100 * last.values[k] / dissipated);
  return fmt::format("energy budget: work {:.6g}, dissipated {:.6g}{}; residual {:.2g}\n", last[Observable::work],
                     dissipated, channels.empty() ? "" : " (" + channels.substr(2) + ")",
                     last[Observable::energy_residual]);
}

/// How the contact problems of a cd run went.
std::string solver_text(const SolverSummary& solver) {
  return fmt::format(
      "contacts: {:.1f} sweeps and a residual of {:.2g} per solve; largest penetration {:.2g} d ({} corrections); "
      "energy dissipated {:.6g}, made {:.2g}{}\n",
      static_cast<double>(solver.sweeps) / static_cast<double>(solver.steps),
      solver.residual_sum / static_cast<double>(solver.steps), solver.penetration, solver.corrections,
      solver.dissipated, solver.gained,
      solver.divided > 0 ? fmt::format("; {} steps taken in parts", solver.divided) : "");
}

/// One line per stage: how it ended, and where it left the sample.
std::string stages_text(const RunResult& result) {
  if (result.stages.empty()) return "";
  const bool space = result.layout.dim == 3;
  std::vector<std::string> header{"stage", "ending", "time", "eps_xx", "eps_yy"};
  if (space) header.emplace_back("eps_zz");
  header.insert(header.end(), {"strain xy", "sigma_xx", "sigma_yy"});
  if (space) header.emplace_back("sigma_zz");
  header.insert(header.end(), {"sigma_xy", "Phi", "z_star"});
  TextTable table(header);
  for (const StageReport& stage : result.stages) {
    std::vector<std::string> row{stage.name, to_string(stage.ending), short_number(stage.time)};
    const auto add = [&](Observable observable) { row.push_back(short_number(stage.last[observable])); };
    add(Observable::eps_xx), add(Observable::eps_yy);
    if (space) add(Observable::eps_zz);
    add(Observable::strain), add(Observable::sigma_xx), add(Observable::sigma_yy);
    if (space) add(Observable::sigma_zz);
    add(Observable::sigma_xy), add(Observable::solid_fraction), add(Observable::z_star);
    table.add(row);
  }
  return table.text("  ");
}

}  // namespace

std::string summary(const RunResult& result) {
  std::string text = fmt::format("{}: {} of {} steps, dt = {:g}, time {:g}, strain {:g}\n", to_string(result.ending),
                                 result.steps, result.total_steps, result.dt, result.time, result.strain);
  if (!result.stage.empty()) text.insert(text.find(':'), " in " + result.stage);
  text += stages_text(result);
  if (result.averages.rows > 0) {
    TextTable table({"quantity", fmt::format("mean from time {:g} on", result.averages.from), "last"});
    for (int k = 0; k < observable_count; ++k) {
      if (!averaged(k, result.series) || std::isnan(result.averages.values[k].value)) continue;
      const bool tiny = std::abs(result.averages.values[k].value) < 1e-3;
      const Estimate& mean = result.averages.values[k];
      table.add({std::string(observable_table[k].name), tiny ? short_number(mean.value, 3) : with_error(mean),
                 short_number(result.last.values[k])});
    }
    text += table.text("  ");
  }
  if (result.series.budget) text += budget_text(result.last);
  text += measures_text(result.measures);
  if (result.solver.steps > 0) text += solver_text(result.solver);
  const double steps_per_second = result.wall_seconds > 0 ? static_cast<double>(result.steps) / result.wall_seconds : 0;
  text += fmt::format("cost: {} of steps ({:.0f} steps/s)\n", duration_text(result.wall_seconds), steps_per_second);
  if (result.ending != Ending::failed) text += fmt::format("state hash: {:016x}\n", result.state_hash);
  return text;
}

}  // namespace galet
