// The real readers of our files, where this machine has them.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "common/io/files.hpp"
#include "common/io/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test {

/// What a script of Python prints, run with the folder's name as its argument; nothing when no Python here has the
/// `modules` ("vtk, numpy"). A script that fails is a failure of the test.
inline std::optional<std::string> said_by_python(const std::string& modules, const std::string& script,
                                                 const TemporaryFolder& folder) {
  // The system's own Python has the system's packages, whatever comes first along PATH.
  for (const std::string python : {"python3", "/usr/bin/python3"}) {
    if (!run_program({python, "-c", "import " + modules}).well()) continue;
    write_file(folder.file("read.py"), "import sys\nsys.stdout = open(sys.argv[1] + '/said', 'w')\n" + script);
    const ProgramEnd end = run_program({python, folder.file("read.py"), folder.path()});
    EXPECT_TRUE(end.well()) << end.messages;
    return end.well() ? read_file(folder.file("said")) : "";
  }
  return std::nullopt;
}

/// Runs a script of LAMMPS in the folder; false when there is no LAMMPS. A script that fails is a failure of the test.
inline bool run_lammps(const std::string& script, const TemporaryFolder& folder) {
  write_file(folder.file("in.lammps"), script);
  const ProgramEnd end =
      run_program({"lmp", "-in", "in.lammps", "-log", "log.lammps", "-screen", "none"}, folder.path());
  EXPECT_TRUE(!end.found || end.code == 0) << end.messages << file_bytes(folder.file("log.lammps"));
  return end.found;
}

}  // namespace galet::test
