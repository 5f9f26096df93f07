// Parts of the study `compression`: cycles of loading, and what the assembled state depends on.
#pragma once

#include <string>
#include <vector>

#include "src/studies/study.hpp"

namespace galet::compression {

/// The criterion of rest. Rigid contacts that carry nothing in a single step are not counted; at 1e-6 these are 3 % of
/// those of state A.
inline double rest_of(EngineKind engine) { return engine == EngineKind::md ? 1e-7 : 1e-8; }

/// Mean of an observable at the end of a stage, with the error of the rows' scatter.
Estimate mean_at_stage(const std::vector<const StudyRow*>& rows, const std::string& stage, Observable observable);

/// States A and C loaded and unloaded without lateral strain (md; parameters state, oedometric = 1, seed).
void add_oedometric_runs(std::vector<StudyRun>& runs, bool quick);
/// How z of A grows under axial load, and what part of the strain a cycle leaves, isotropic or oedometric.
void report_cycles(StudyReport& report, const std::vector<StudyRow>& rows);

/// Loose states from a gas compressed at given rates (parameters I, e, N, seed).
void add_assembly_runs(std::vector<StudyRun>& runs, bool quick);
/// Phi and z* of these: the two slowest rates, the two restitutions, the two sizes.
void report_assembly(StudyReport& report, const std::vector<StudyRow>& rows);
/// Phi against I.
Figure assembly_figure(const std::vector<StudyRow>& rows);

}  // namespace galet::compression
