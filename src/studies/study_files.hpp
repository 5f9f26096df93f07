// What a study tells: on the terminal, as JSON, and as files.
#pragma once

#include <string>
#include <vector>

#include "src/studies/run_study.hpp"

namespace galet {

/// Head, table of the runs, findings (ours, published, verdict), costs of the engines at equal error, remarks.
std::string study_text(const Study& study, const StudyOutcome& outcome);

/// One JSON object: the same.
std::string study_json(const Study& study, const StudyOutcome& outcome);

/// Writes report.txt, runs.csv, findings.csv, study.json and the figures into `directory`, which must exist. Returns
/// the files' paths.
std::vector<std::string> write_study(const Study& study, const StudyOutcome& outcome, const std::string& directory);

}  // namespace galet
