// What the rows say: the error of each, the fronts, where one engine overtakes the other, cost laws, rigid limits.
//   error      exact classes: the first quantity; others: |value - limit| / |limit|, or its standard error where that
//   is
//              larger (`noise`: below two of them), limit by src/rigid_limit.hpp from md at kappa >= 1e3 and cd at
//              dt <= 0.05
//   replicates are the same starts in every row: the scatter of a row is what is left once the mean of each start over
//              all rows is taken off
//   cost       processor seconds per unit of the class's extent
//   front      rows such that no other row of the engine is both cheaper and better
#pragma once

#include <map>
#include <string>
#include <vector>

#include "benchmarks/work_precision/classes.hpp"
#include "common/io/csv.hpp"
#include "common/measure/block_average.hpp"
#include "src/rigid_limit.hpp"

namespace galet::precision {

/// A row with what it is worth.
struct JudgedRow {
  Row row;
  double cost = 0, error = 0, uncertainty = 0;
  double deviation = 0;  ///< (value - limit) / |limit|; exact classes: the error
  bool noise = false;    ///< the error is no larger than its noise
  bool front = false;
};

using JudgedClass = std::pair<SceneClass, std::vector<JudgedRow>>;

/// Sets `front` of each row.
void mark_front(std::vector<JudgedRow>& rows);

/// Value of each row in the quantity with that index, as said above.
std::vector<Estimate> estimates(const std::vector<Row>& rows, std::size_t quantity);

/// The limit of one quantity; `power` for md.
RigidLimit limit_of(const std::vector<Row>& rows, std::size_t quantity, double power);

/// Rows of each class that has any, judged.
std::vector<JudgedClass> judge(const std::vector<SceneClass>& classes, const std::vector<Row>& rows);

/// Cost of an engine to reach that error: the front, joined by straight lines in logarithms; NaN where it does not.
double cost_at(const std::vector<JudgedRow>& rows, EngineKind engine, double error);

/// The cheapest row of an engine that reaches that error, or none.
const JudgedRow* cheapest(const std::vector<JudgedRow>& rows, EngineKind engine, double error);

/// md: seconds against kappa, I, steps per contact; cd: against dt and tolerance (laws.cpp).
CsvTable cost_laws(const std::vector<JudgedClass>& judged);

/// Deviations of md from the rigid limit over kappa, and their orders, quantity by quantity (laws.cpp).
CsvTable limit_orders(const std::vector<JudgedClass>& judged);

/// Errors at which one engine overtakes the other, with the interval that the noise of errors and costs leaves
/// (crossings.cpp).
CsvTable crossings(const std::vector<JudgedClass>& judged);

/// Writes work.csv, at_error.csv, crossover.csv, crossings.csv, cost.csv, limit.csv and CLASS.svg into the folder.
void evaluate(const std::vector<SceneClass>& classes, const std::vector<Row>& rows, const std::string& folder);

}  // namespace galet::precision
