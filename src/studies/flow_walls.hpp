// Part of the study `flow-law`: plane shear between rough walls, as the published runs have it.
#pragma once

#include <vector>

#include "src/studies/study.hpp"

namespace galet::flow_law {

/// Runs between walls (parameters walls = 1, I_walls: speed of the wall over their distance).
void add_wall_runs(std::vector<StudyRun>& runs, EngineKind engine, bool quick);

/// mu* or Phi of the periodic cell, interpolated to I = `number`; the error has that of I, which a law of that slope
/// turns into one of the value.
Estimate cell_at(const std::vector<const StudyRow*>& cell, const Estimate& number, Observable observable, double slope);

/// mu* and Phi in the middle half between the walls: less those of the cell at the same I, and less the published laws.
void report_walls(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine);

/// mu* or Phi of the middle half against its I; empty without rows.
Series wall_series(const std::vector<StudyRow>& rows, EngineKind engine, bool friction);

}  // namespace galet::flow_law
