// The runs of a study, side by side, each kept in the study's folder as soon as it is finished: a study that was
// stopped goes on with the runs that are missing.
#pragma once

#include <string>
#include <vector>

#include "src/side_by_side.hpp"
#include "src/studies/study.hpp"

namespace galet {

struct StudyOptions : SideBySideOptions {
  StudySize size = StudySize::full;
  std::string directory;  ///< of the results; made when absent
  bool fresh = false;     ///< runs again what the folder has
};

struct StudyOutcome {
  std::vector<StudyRow> rows;  ///< in the order of the plan; without those that were interrupted
  StudyReport report;          ///< of the usable rows
  StudySize size = StudySize::full;
  int planned = 0, kept = 0;
  int jobs = 1;
  bool interrupted = false;
  double wall_seconds = 0;  ///< of this call
  bool failed() const;      ///< a run failed or is missing
};

/// Writes scenes/NAME.toml and rows/NAME.json of each run below options.directory, and evaluates.
StudyOutcome run_study(const Study& study, const StudyOptions& options);

}  // namespace galet
