// Rows made by hand for tests of what the studies find in them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "src/studies/study.hpp"

namespace galet::test {

/// The first finding whose quantity begins so; null without one.
inline const StudyFinding* finding(const StudyReport& report, const std::string& start) {
  for (const StudyFinding& one : report.findings)
    if (one.quantity.starts_with(start)) return &one;
  return nullptr;
}

inline StudyRow with_parameters(EngineKind engine, std::vector<std::pair<std::string, double>> parameters) {
  StudyRow row;
  row.plan.engine = engine;
  row.plan.parameters = std::move(parameters);
  return row;
}

}  // namespace galet::test
