// A discrete contact problem solved by Siconos (Debian package python3-siconos), through FCLIB files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cd/discrete/problem.hpp"

namespace galet::bench {

struct SiconosAnswer {
  double tolerance = 0;  ///< that Siconos was asked for: errP by its own count
  double seconds = 0;    ///< processor time of its solver alone, its own tests of the error included
  long iterations = 0;   ///< by its own count
  std::vector<double> r;
};

/// Names of its solvers that run_siconos takes for problems of `block` numbers per contact; empty where there is no
/// Python with Siconos, SciPy and h5py.
std::vector<std::string> siconos_solvers(int block);

/// One answer for each tolerance from 1e-3 on, by tens, that it reached within `seconds` (of processor time each), all
/// from r = 0. Files are made in `folder`. Throws std::runtime_error with what Python said when that fails.
std::vector<SiconosAnswer> run_siconos(const cd::DiscreteProblem& problem, const std::string& solver, double seconds,
                                       const std::filesystem::path& folder);

}  // namespace galet::bench
