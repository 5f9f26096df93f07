// Parts of the study `triaxial`: how slow is slow enough, creep, and the interval of strains of type I.
#pragma once

#include <functional>
#include <vector>

#include "src/studies/solid_templates.hpp"
#include "src/studies/study.hpp"
#include "src/studies/triaxial_curve.hpp"

namespace galet::triaxial {

inline constexpr double reference_level = 8400, stiff_level = 39000;

std::vector<int> seeds_of(bool quick);
/// I of the runs that go to the peak.
double usual_rate(bool quick);
/// A packing of the study, with mu = 0.3; `level` = 0: rigid grains.
SolidScene solid_sample(EngineKind engine, double level, int seed, bool quick);

/// Mean over rows of a number of their curves, with the error of the scatter.
Estimate over_seeds(const std::vector<const StudyRow*>& rows,
                    const std::function<double(const TriaxialCurve&)>& number);

/// State A at other rates and another restitution, to a strain of 0.02 (md; parameters I, e, seed).
void add_quasistatic_runs(std::vector<StudyRun>& runs, bool quick);
/// q/P of these, over the usual ones.
void report_quasistatic(StudyReport& report, const std::vector<StudyRow>& rows);

/// State A compressed to a strain of 0.002 at two rates, then left under its stress (both engines; parameters
/// creep_after: I before, seed).
void add_creep_runs(std::vector<StudyRun>& runs, bool quick);
/// The strain of creep: how large, and smaller after slower compression.
void report_creep(StudyReport& report, const std::vector<StudyRow>& rows);

/// State A whose axial stress is raised slowly (md at two kappa, rigid and elastic cd; parameters ramp = 1, kappa,
/// seed).
void add_ramp_runs(std::vector<StudyRun>& runs, bool quick);
/// Type I: strains go as 1/kappa, elastic cd has those of md, rigid cd none; and where it ends.
void report_ramps(StudyReport& report, const std::vector<StudyRow>& rows);
/// q/P against kappa strain.
Figure ramp_figure(const std::vector<StudyRow>& rows);

}  // namespace galet::triaxial
