// What a comparison tells: on the terminal, as JSON, and as files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/csv.hpp"
#include "src/compare.hpp"

namespace galet {

/// Tables of the rows state by state, each with its rigid limit and what follows from it.
std::string compare_text(const Comparison& comparison);

/// One JSON object: `rows`, `rigid_limit`, notes.
std::string compare_json(const Comparison& comparison, const std::string& scene);

CsvTable compare_table(const Comparison& comparison);

/// Writes compare.csv, compare.json, the figures (error against cost, mu* against strain, velocity profile) and the
/// pictures of the reference rows' last states into `directory`, which must exist. Returns the files' paths.
std::vector<std::string> write_comparison(const Comparison& comparison, const std::string& scene,
                                          const std::string& directory);

/// What rows are judged by: mu* in shear, Phi without.
struct Judged {
  const char* name;
  Estimate CompareRow::*value;
  RigidLimit StateLimit::*limit;
};
Judged judged(const Comparison& comparison);

/// Deviation of a row's judged quantity from the rigid limit of its state, when both exist.
std::optional<Estimate> deviation_of(const CompareRow& row, const Comparison& comparison);

/// The cheapest usable row of `engine` in a state whose deviation is at most two standard errors; null when there is
/// none.
const CompareRow* cheapest_within_error(const Comparison& comparison, const StateLimit& state, EngineKind engine);

}  // namespace galet
