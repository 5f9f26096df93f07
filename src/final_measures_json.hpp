// The measures at the end of a run as JSON, as text and as tables.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/io/csv.hpp"
#include "src/final_measures.hpp"
#include "src/measure.hpp"

namespace galet {

/// Numbers and short lists by name; an empty object when nothing was asked for. Not numbers become null.
nlohmann::ordered_json measures_json(const FinalMeasures& measures);

/// One line per measure, empty when nothing was asked for.
std::string measures_text(const FinalMeasures& measures);

/// A table and the end of its file's name.
struct NamedTable {
  std::string name;
  CsvTable table;
};

/// "forces", "gaps", "profile", "voronoi": those that were asked for. `scale`: what I refers to.
std::vector<NamedTable> measure_tables(const FinalMeasures& measures, const MeasureScale& scale);

}  // namespace galet
