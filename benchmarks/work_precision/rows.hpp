// Rows of the work-precision benchmark: one scene class, one engine, one setting of its numerical parameters, what was
// measured and what it cost. They are kept in a CSV file as they are made, so that a run that was stopped goes on.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace galet::precision {

/// Numerical parameters of one row; 0 where one has no meaning for the engine. Units: d = m = 1, and P = 1 or the
/// speed 1 of the class.
struct Setting {
  EngineKind engine = EngineKind::md;
  double kappa = 0;              ///< md: K_N, in these units the stiffness level
  double steps_per_contact = 0;  ///< md: tau_c / dt
  double dt = 0;                 ///< cd
  double tolerance = 0;          ///< cd
  bool operator==(const Setting&) const = default;
};

Setting md_setting(double kappa, double steps_per_contact = 50);
Setting cd_setting(double dt, double tolerance);

/// One measured number: an error against an exact answer, or a value of each replicate.
struct Quantity {
  std::string name;
  std::vector<double> values;
  double noise = 0;  ///< standard error of a single value; 0: from the scatter of the replicates
};

struct Row {
  std::string scene;  ///< name of the class
  Setting setting;
  double seconds = 0;  ///< processor time
  long steps = 0;
  long sweeps = 0;                   ///< cd
  long missed = 0;                   ///< cd: steps that ended above the tolerance
  double extent = 0;                 ///< what `seconds` were spent on: strain, time or number of problems
  std::vector<Quantity> quantities;  ///< the first one is what the class is judged by
};

/// The file of all rows: one line per row and quantity.
class RowFile {
 public:
  /// Reads what is there; a last line that was cut short is dropped with its row.
  explicit RowFile(std::string path);
  const std::vector<Row>& rows() const { return rows_; }
  bool has(const std::string& scene, const Setting& setting) const;
  void add(const Row& row);

 private:
  std::string path_;
  std::vector<Row> rows_;
};

}  // namespace galet::precision
