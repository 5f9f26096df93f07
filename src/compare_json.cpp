// The comparison as one JSON object.
#include <nlohmann/json.hpp>

#include "src/compare_report.hpp"
#include "src/engines.hpp"

namespace galet {

namespace {

using Json = nlohmann::ordered_json;  // keeps the order in which keys are written; NaN becomes null

Json maybe(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }
Json of(const Estimate& estimate) { return {{"value", estimate.value}, {"error", estimate.error}}; }

Json of(const std::optional<EngineLimit>& limit) {
  if (!limit) return nullptr;
  return {{"value", limit->value.value}, {"error", limit->value.error},     {"slope", of(limit->slope)},
          {"on_line", limit->on_line},   {"systematic", limit->systematic}, {"runs", limit->runs}};
}

Json of(const RigidLimit& limit) {
  Json json{{"md", of(limit.md)}, {"cd", of(limit.cd)}, {"combined", of(limit.combined)}};
  json["difference"] = limit.difference ? of(*limit.difference) : Json(nullptr);
  json["agree"] = limit.agree ? Json(*limit.agree) : Json(nullptr);
  return json;
}

Json of(const CompareRow& row, const Comparison& comparison) {
  const auto off = deviation_of(row, comparison);
  Json json{{"engine", engine_name(row.plan.engine)},
            {"I", maybe(row.plan.inertial_number)},
            {"kappa", row.plan.engine == EngineKind::md ? Json(row.plan.stiffness_level.value_or(row.stiffness_level))
                                                        : Json(nullptr)},
            {"dt", row.dt},
            {"dt_factor", maybe(row.plan.dt_factor)},
            {"tolerance", maybe(row.plan.tolerance)},
            {"mu_star", of(row.mu_star)},
            {"Phi", of(row.solid_fraction)},
            {"z", of(row.z)},
            {"deviation", off ? of(*off) : Json(nullptr)},
            {"pressure", row.pressure},
            {"I_realised", row.inertial_number},
            {"penetration", row.peak_penetration},
            {"penetration_mean", row.mean_penetration},
            {"seconds", row.seconds},
            {"seconds_per_strain", comparison.shear ? Json(row.cost) : Json(nullptr)},
            {"seconds_per_time", comparison.shear ? Json(nullptr) : Json(row.cost)},
            {"strain", row.strain},
            {"time", row.time},
            {"steps", row.steps},
            {"solver_missed", row.solver.missed},
            {"ending", to_string(row.ending)}};
  if (!row.failure.empty()) json["failure"] = row.failure;
  json["notes"] = row.notes;
  return json;
}

}  // namespace

std::string compare_json(const Comparison& comparison, const std::string& scene) {
  Json json{{"scene", scene},
            {"shortened", comparison.shortened},
            {"interrupted", comparison.interrupted},
            {"jobs", comparison.jobs},
            {"wall_seconds", comparison.wall_seconds},
            {"judged_by", judged(comparison).name},
            {"rows", Json::array()},
            {"rigid_limit", Json::array()},
            {"notes", comparison.notes}};
  for (const CompareRow& row : comparison.rows) json["rows"].push_back(of(row, comparison));
  for (const StateLimit& state : comparison.limits)
    json["rigid_limit"].push_back({{"I", maybe(state.inertial_number)},
                                   {"mu_star", of(state.mu_star)},
                                   {"Phi", of(state.solid_fraction)},
                                   {"z", of(state.z)}});
  return json.dump(2);
}

}  // namespace galet
