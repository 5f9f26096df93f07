#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/costs.hpp"
#include "src/studies/study_files.hpp"
#include "src/text_table.hpp"

namespace galet {

namespace {

std::vector<std::string> parameter_names(const std::vector<StudyRow>& rows) {
  std::vector<std::string> names;
  for (const StudyRow& row : rows)
    for (const auto& [name, value] : row.plan.parameters)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::string runs_text(const Study& study, const StudyOutcome& outcome) {
  const std::vector<std::string> parameters = parameter_names(outcome.rows);
  std::vector<std::string> header{"engine"};
  header.insert(header.end(), parameters.begin(), parameters.end());
  header.insert(header.end(), {"mu*", "Phi", "z", "steps", "seconds", "s to 1 %"});
  TextTable table(header);
  std::string notes;
  for (const StudyRow& row : outcome.rows) {
    std::vector<std::string> cells{engine_name(row.plan.engine)};
    for (const std::string& name : parameters) cells.push_back(parameter_text(name, row.plan.parameter(name)));
    for (const Observable observable : {Observable::mu_star, Observable::solid_fraction, Observable::z})
      cells.push_back(with_error(row[observable]));
    cells.push_back(std::to_string(row.run.steps));
    cells.push_back(short_number(row.run.cpu_seconds, 3));
    cells.push_back(short_number(seconds_to_one_percent(row, study.judged), 2));
    table.add(cells);
    if (row.run.ending == Ending::failed) notes += fmt::format("  FAILED  {}: {}\n", row.plan.name, row.run.failure);
    for (const std::string& note : row.run.notes) notes += fmt::format("  note  {}: {}\n", row.plan.name, note);
  }
  return fmt::format("runs\n{}{}", table.text("  "), notes);
}

std::string findings_text(const StudyReport& report) {
  TextTable table({"finding", "ours", "published", "agrees"});
  std::string notes;
  for (const StudyFinding& finding : report.findings) {
    table.add({finding.quantity, with_error(finding.ours), claim_text(finding.published), to_string(finding.verdict)});
    if (!finding.note.empty()) notes += fmt::format("  note  {}: {}\n", finding.quantity, finding.note);
  }
  return fmt::format("findings\n{}{}", table.text("  "), notes);
}

std::string costs_text(const Study& study, const std::vector<StudyRow>& rows) {
  const std::vector<CostPair> pairs = cost_pairs(study, rows);
  if (pairs.empty()) return "";
  TextTable table({"state", "md", "cd", "md / cd"});
  double sum = 0;
  for (const CostPair& pair : pairs) {
    table.add({pair.state.empty() ? "all" : pair.state, short_number(pair.md, 2), short_number(pair.cd, 2),
               short_number(pair.md / pair.cd, 2)});
    sum += std::log(pair.md / pair.cd);
  }
  return fmt::format(
      "cost: processor seconds to a standard error of 1 % of {}, of the mean over a long run or over samples\n{}  "
      "geometric mean of md / cd: {:.2g}\n",
      info(study.judged).name, table.text("  "), std::exp(sum / static_cast<double>(pairs.size())));
}

}  // namespace

std::string study_text(const Study& study, const StudyOutcome& outcome) {
  double seconds = 0;
  for (const StudyRow& row : outcome.rows) seconds += row.run.cpu_seconds;
  std::string text = fmt::format("{}: {}\nsource: {}\nsettings: {}\nsize: {}; {} of {} runs, {} of processor time\n\n",
                                 study.name, study.title, study.source, study.about,
                                 outcome.size == StudySize::quick
                                     ? "quick (--quick: few grains and states, short averages; a first look)"
                                     : "full",
                                 outcome.rows.size(), outcome.planned, duration_text(seconds));
  text += findings_text(outcome.report) + '\n' + runs_text(study, outcome) + '\n';
  const std::string costs = costs_text(study, outcome.rows);
  if (!costs.empty()) text += costs + '\n';
  for (const std::string& remark : outcome.report.remarks) text += "remark: " + remark + '\n';
  return text;
}

}  // namespace galet
