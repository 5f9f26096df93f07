// The file of a finished run in the folder of a study: what resuming needs. A row belongs to its plan when the hash of
// engine and scene text is the same; anything else is run again.
#pragma once

#include <optional>
#include <string>

#include "src/studies/study.hpp"

namespace galet {

/// 16 hexadecimal digits, of the engine and the text of the scene.
std::string scene_hash(const StudyRun& run);

/// DIRECTORY/rows/NAME.json, whole or not at all.
void write_row(const std::string& directory, const StudyRow& row);

/// None when there is no such file, or it is another scene's, or no longer what write_row() wrote.
std::optional<StudyRow> read_row(const std::string& directory, const StudyRun& run);

}  // namespace galet
