// Polar histogram of contact directions as a picture for a page.
#pragma once

#include <string>

#include "common/io/csv.hpp"

namespace galet::report {

/// SVG of the tables md_directions.csv: wedges as long as the density of contacts (1: isotropic, the dashed circle),
/// and the mean normal force by direction as a line in the same scale. Empty without rows.
std::string polar_svg(const NumberTable& directions);

}  // namespace galet::report
