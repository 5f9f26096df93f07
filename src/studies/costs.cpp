#include "src/studies/costs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace galet {

namespace {

constexpr double unknown_cost = std::numeric_limits<double>::quiet_NaN();

/// The samples of one state of one engine.
struct CostGroup {
  EngineKind engine = EngineKind::md;
  std::string state;
  double kappa = 0;  ///< 0: rigid, or the same in the whole study
  std::vector<const StudyRow*> samples;
};

/// "I = 0.1, mu = 0.4": the parameters that both engines have.
std::string shared_state(const StudyRun& run) {
  std::string text;
  for (const auto& [name, value] : run.parameters)
    if (name != "kappa" && name != "rigid" && name != "seed")
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, parameter_text(name, value));
  return text;
}

std::vector<CostGroup> groups_of(const std::vector<StudyRow>& rows) {
  std::vector<CostGroup> groups;
  for (const StudyRow& row : rows) {
    if (!row.usable()) continue;
    const std::string state = shared_state(row.plan);
    const double level = row.plan.parameter("kappa"), kappa = level > 0 ? level : 0;
    auto found = std::find_if(groups.begin(), groups.end(), [&](const CostGroup& group) {
      return group.engine == row.plan.engine && group.state == state && group.kappa == kappa;
    });
    if (found == groups.end()) found = groups.insert(groups.end(), {row.plan.engine, state, kappa, {}});
    found->samples.push_back(&row);
  }
  return groups;
}

double mean_of(const CostGroup& group, Observable observable) {
  return mean_over(group.samples, [&](const StudyRow& row) { return row[observable].value; }).value;
}

/// Squares of the samples' deviations from their mean, over the mean: the variance times (samples - 1).
double relative_squares(const CostGroup& group, Observable observable) {
  const double mean = mean_of(group, observable);
  double squares = 0;
  for (const StudyRow* row : group.samples) squares += std::pow((*row)[observable].value / mean - 1, 2);
  return squares;
}

double cost_of_run(const StudyRow& row, Observable observable) {
  return row.run.ending == Ending::equilibrium ? unknown_cost : seconds_to_one_percent(row, observable);
}

double seconds_of_a_sample(const CostGroup& group) {
  double seconds = 0;
  for (const StudyRow* row : group.samples) seconds += row->run.cpu_seconds;
  return seconds / static_cast<double>(group.samples.size());
}

/// Costs of md and of cd.
std::pair<double, double> costs_of(const CostGroup& md, const CostGroup& cd, Observable observable) {
  const double freedoms = static_cast<double>(md.samples.size() + cd.samples.size()) - 2;
  if (freedoms < 1) return {cost_of_run(*md.samples[0], observable), cost_of_run(*cd.samples[0], observable)};
  const double variance = (relative_squares(md, observable) + relative_squares(cd, observable)) / freedoms;
  return {1e4 * variance * seconds_of_a_sample(md), 1e4 * variance * seconds_of_a_sample(cd)};
}

/// The rows of md that a row of cd stands beside; null when there are none.
const CostGroup* partner_of(const CostGroup& cd, const std::vector<CostGroup>& groups) {
  const CostGroup* partner = nullptr;
  for (const CostGroup& group : groups) {
    if (group.engine != EngineKind::md || group.state != cd.state) continue;
    const bool fits = cd.kappa > 0 ? group.kappa == cd.kappa : !partner || group.kappa > partner->kappa;
    if (fits) partner = &group;
  }
  return partner;
}

}  // namespace

double seconds_to_one_percent(const StudyRow& row, Observable observable) {
  const Estimate& mean = row[observable];
  if (!(mean.error > 0) || !(mean.value != 0)) return unknown_cost;
  return row.run.cpu_seconds * std::pow(100 * mean.error / mean.value, 2);
}

std::vector<CostPair> cost_pairs(const Study& study, const std::vector<StudyRow>& rows) {
  const std::vector<CostGroup> groups = groups_of(rows);
  std::vector<CostPair> pairs;
  for (const CostGroup& cd : groups) {
    if (cd.engine != EngineKind::cd) continue;
    const CostGroup* md = partner_of(cd, groups);
    if (!md) continue;
    const auto [soft, rigid] = costs_of(*md, cd, study.judged);
    CostPair pair{cd.state, soft, rigid};
    if (md->kappa > 0) pair.state += fmt::format("{}kappa = {:g}", pair.state.empty() ? "" : ", ", md->kappa);
    if (md->kappa > 0 && cd.kappa == 0) pair.state += " (cd: rigid)";
    if (pair.md > 0 && pair.cd > 0) pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace galet
