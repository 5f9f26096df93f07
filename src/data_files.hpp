// Files that the program reads besides its input. They are installed in share/galet; in a build folder they are at
// the same place seen from the program.
#pragma once

#include <string>

namespace galet {

/// The path of that file: in the folder that the environment's GALET_DATA names, if it does; else in share/galet beside
/// the folder of the running program. Throws RunError naming where it was looked for.
std::string data_file(const std::string& name);

}  // namespace galet
