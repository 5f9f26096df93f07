// Other programs (gnuplot, rsvg-convert, Python), run without a shell: no word of theirs is ever expanded.
#pragma once

#include <string>
#include <vector>

namespace galet {

struct ProgramEnd {
  bool found = false;    ///< whether there is such a program
  int code = -1;         ///< its exit code; -1 when it was not found or a signal ended it
  std::string messages;  ///< what it wrote to standard error

  bool well() const { return found && code == 0; }
};

/// Runs arguments[0], looked for along PATH, with these arguments in `folder` (empty: the present one), and waits. Its
/// standard input and output are empty. Throws RunError when the system can't start any program.
ProgramEnd run_program(std::vector<std::string> arguments, const std::string& folder = "");

}  // namespace galet
