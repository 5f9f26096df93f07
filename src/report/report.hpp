// One HTML page of what a folder of results holds: scene, derived numbers, warnings, tables with errors, figures,
// pictures, cost, and what made them. The page needs no other file and no network.
#pragma once

#include <string>

#include "src/report/run_folder.hpp"

namespace galet::report {

/// Figures need gnuplot, pictures of spheres VTK's Python: where one is absent the page says so in its place.
std::string report_html(const RunFolder& folder);

}  // namespace galet::report
