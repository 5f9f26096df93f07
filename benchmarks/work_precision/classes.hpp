// The scene classes of the work-precision benchmark. In each, both engines answer one question about rigid grains, at
// several settings of their numerical parameters; the answer is exact, or the limit that both tend to.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmarks/work_precision/rows.hpp"

namespace galet::precision {

/// Where the truth comes from that errors are measured against.
enum class Truth {
  exact,  ///< the first quantity of a row is its error
  limit   ///< the rigid limit of all rows together (src/rigid_limit.hpp)
};

struct SceneClass {
  std::string name, question;
  Truth truth = Truth::exact;
  double power = 1;    ///< md tends to the limit as kappa^-power
  std::string extent;  ///< what a cost is counted per
  std::vector<Setting> plan;
  std::function<Row(const Setting&)> run;
};

SceneClass impact_class();
SceneClass column_class();
SceneClass packing_class();
SceneClass gas_class();
/// Dense flow at that inertial number.
SceneClass flow_class(double inertial_number);
SceneClass biaxial_class();
SceneClass triaxial_class();

/// Every class, cheap ones first.
std::vector<SceneClass> all_classes();

}  // namespace galet::precision
