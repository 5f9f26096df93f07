// The parts of a report.
#pragma once

#include <string>

#include "src/report/run_folder.hpp"

namespace galet::report {

/// Everything of one engine's run.
std::string engine_section(const EngineRun& run);

/// Rows of a comparison with their errors, rigid limits, and the pictures that galet compare made.
std::string comparison_section(const RunFolder& folder);

}  // namespace galet::report
