#include "src/studies/study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/studies/estimates.hpp"
#include "src/studies/published.hpp"
#include "src/text_table.hpp"

namespace galet {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool matches(const StudyRow& row, std::optional<EngineKind> engine,
             const std::vector<std::pair<std::string, double>>& parameters) {
  if (engine && row.plan.engine != *engine) return false;
  return std::all_of(parameters.begin(), parameters.end(),
                     [&](const auto& wanted) { return row.plan.parameter(wanted.first) == wanted.second; });
}

}  // namespace

double StudyRun::parameter(std::string_view wanted) const {
  for (const auto& [key, value] : parameters)
    if (key == wanted) return value;
  return none;
}

void StudyReport::add(const std::string& quantity, const Estimate& ours, std::string_view key,
                      const std::string& note) {
  const Published& number = published(key);
  findings.push_back({quantity, ours, number, judge(ours, number), note});
}

std::string parameter_text(std::string_view name, double value) {
  return name == "state" && !std::isnan(value) ? std::string(1, static_cast<char>(value)) : short_number(value);
}

std::vector<const StudyRow*> rows_with(const std::vector<StudyRow>& rows, std::optional<EngineKind> engine,
                                       const std::vector<std::pair<std::string, double>>& parameters) {
  std::vector<const StudyRow*> found;
  for (const StudyRow& row : rows)
    if (matches(row, engine, parameters)) found.push_back(&row);
  return found;
}

const StudyRow* row_with(const std::vector<StudyRow>& rows, EngineKind engine,
                         const std::vector<std::pair<std::string, double>>& parameters) {
  for (const StudyRow& row : rows)
    if (matches(row, engine, parameters)) return &row;
  return nullptr;
}

Estimate value_of(const StudyRow* row, Observable observable) {
  return row ? (*row)[observable] : Estimate{none, none};
}

std::vector<double> values_of(const std::vector<StudyRow>& rows, std::string_view parameter) {
  std::vector<double> values;
  for (const StudyRow& row : rows) {
    const double value = row.plan.parameter(parameter);
    if (value == value && std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

Estimate mean_over(const std::vector<const StudyRow*>& samples, const std::function<double(const StudyRow&)>& number) {
  std::vector<Estimate> values;
  for (const StudyRow* row : samples) values.push_back({number(*row), 0});
  return weighted_mean(values);
}

Series series_of(const std::string& label, const std::vector<const StudyRow*>& rows, std::string_view parameter,
                 Observable observable) {
  Series series;
  series.label = label;
  for (const StudyRow* row : rows) {
    series.x.push_back(row->plan.parameter(parameter));
    series.y.push_back((*row)[observable].value);
    series.y_error.push_back((*row)[observable].error);
  }
  return series;
}

Series with_look(Series series, std::size_t look, EngineKind engine) {
  series.look = static_cast<int>(look);
  series.open = engine == EngineKind::cd;
  return series;
}

const StageReport* stage_of(const StudyRow& row, std::string_view name) {
  for (const StageReport& stage : row.run.stages)
    if (stage.name == name) return &stage;
  return nullptr;
}

}  // namespace galet
