#include "src/studies/study_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "common/io/csv.hpp"
#include "common/io/files.hpp"
#include "src/engines.hpp"
#include "src/picture_files.hpp"
#include "src/studies/costs.hpp"
#include "src/studies/row_file.hpp"

namespace galet {

namespace {

using Json = nlohmann::ordered_json;  // keeps the order in which keys are written; NaN becomes null

Json json_of(const Estimate& estimate) { return {{"value", estimate.value}, {"error", estimate.error}}; }

CsvCell cell(double value) { return std::isfinite(value) ? CsvCell(value) : CsvCell(); }

constexpr std::array measured = {Observable::mu_star,         Observable::solid_fraction,   Observable::z,
                                 Observable::z_star,          Observable::rattler_fraction, Observable::mean_overlap,
                                 Observable::inertial_number, Observable::stiffness_level};

Json json_of(const StudyRow& row) {
  Json json{{"name", row.plan.name}, {"engine", engine_name(row.plan.engine)}, {"scene_hash", scene_hash(row.plan)}};
  for (const auto& [name, value] : row.plan.parameters) json["parameters"][name] = value;
  for (const Observable observable : measured) json[std::string(info(observable).name)] = json_of(row[observable]);
  json["dt"] = row.run.dt;
  json["steps"] = row.run.steps;
  json["seconds"] = row.run.cpu_seconds;
  json["solver_missed"] = row.run.solver.missed;
  json["ending"] = to_string(row.run.ending);
  json["kept"] = row.kept;
  if (!row.run.failure.empty()) json["failure"] = row.run.failure;
  return json;
}

Json json_of(const StudyFinding& finding) {
  Json json{{"quantity", finding.quantity},
            {"ours", json_of(finding.ours)},
            {"claim", claim_text(finding.published)},
            {"published", finding.published.value},
            {"uncertainty", finding.published.uncertainty},
            {"source", finding.published.source},
            {"uncertainty_from", finding.published.basis},
            {"verdict", to_string(finding.verdict)}};
  if (!finding.note.empty()) json["note"] = finding.note;
  return json;
}

CsvTable runs_table(const std::vector<StudyRow>& rows) {
  CsvTable table;
  table.comments = {"means with standard errors; seconds: processor time of one thread; lengths in units of d"};
  std::vector<std::string> parameters;
  for (const StudyRow& row : rows)
    for (const auto& [name, value] : row.plan.parameters)
      if (std::find(parameters.begin(), parameters.end(), name) == parameters.end()) parameters.push_back(name);
  const auto column = [&](const std::string& name) { table.columns.push_back({name, ""}); };
  column("name"), column("engine");
  for (const std::string& name : parameters) column(name == "I" || name == "kappa" ? name + "_set" : name);
  for (const Observable observable : measured) {
    column(std::string(info(observable).name));
    column(std::string(info(observable).name) + "_error");
  }
  column("dt"), column("steps"), column("seconds"), column("missed"), column("ending"), column("scene_hash");
  for (const StudyRow& row : rows) {
    std::vector<CsvCell> cells{row.plan.name, engine_name(row.plan.engine)};
    for (const std::string& name : parameters) cells.push_back(cell(row.plan.parameter(name)));
    for (const Observable observable : measured) {
      cells.push_back(cell(row[observable].value));
      cells.push_back(cell(row[observable].error));
    }
    cells.insert(cells.end(), {row.run.dt, std::int64_t{row.run.steps}, row.run.cpu_seconds,
                               std::int64_t{row.run.solver.missed}, to_string(row.run.ending), scene_hash(row.plan)});
    table.rows.push_back(std::move(cells));
  }
  return table;
}

CsvTable findings_table(const StudyReport& report) {
  CsvTable table;
  for (const char* name :
       {"finding", "ours", "error", "claim", "published", "uncertainty", "agrees", "source", "uncertainty_from"})
    table.columns.push_back({name, ""});
  const auto claim = [](Claim kind) {
    return std::string(kind == Claim::equal ? "equal" : kind == Claim::at_least ? "at least" : "at most");
  };
  for (const StudyFinding& finding : report.findings)
    table.rows.push_back({finding.quantity, cell(finding.ours.value), cell(finding.ours.error),
                          claim(finding.published.claim), finding.published.value, finding.published.uncertainty,
                          to_string(finding.verdict), std::string(finding.published.source),
                          std::string(finding.published.basis)});
  return table;
}

}  // namespace

std::string study_json(const Study& study, const StudyOutcome& outcome) {
  Json json{{"study", study.name},
            {"title", study.title},
            {"source", study.source},
            {"settings", study.about},
            {"size", outcome.size == StudySize::quick ? "quick" : "full"},
            {"interrupted", outcome.interrupted},
            {"planned", outcome.planned},
            {"kept", outcome.kept},
            {"jobs", outcome.jobs},
            {"wall_seconds", outcome.wall_seconds},
            {"findings", Json::array()},
            {"rows", Json::array()},
            {"costs", Json::array()},
            {"remarks", outcome.report.remarks}};
  for (const StudyFinding& finding : outcome.report.findings) json["findings"].push_back(json_of(finding));
  for (const StudyRow& row : outcome.rows) json["rows"].push_back(json_of(row));
  for (const CostPair& pair : cost_pairs(study, outcome.rows))
    json["costs"].push_back({{"state", pair.state}, {"md", pair.md}, {"cd", pair.cd}});
  return json.dump(2);
}

std::vector<std::string> write_study(const Study& study, const StudyOutcome& outcome, const std::string& directory) {
  const auto path = [&](const std::string& name) { return (std::filesystem::path(directory) / name).string(); };
  std::vector<std::string> files{path("report.txt"), path("runs.csv"), path("findings.csv"), path("study.json")};
  write_file(files[0], study_text(study, outcome));
  write_csv(files[1], runs_table(outcome.rows));
  write_csv(files[2], findings_table(outcome.report));
  write_file(files[3], study_json(study, outcome) + "\n");
  for (const NamedFigure& named : outcome.report.figures) {
    Figure figure = named.figure;
    if (outcome.size == StudySize::quick) figure.title += " (quick size)";
    add_figure(files, path(named.name), figure);
  }
  return files;
}

}  // namespace galet
