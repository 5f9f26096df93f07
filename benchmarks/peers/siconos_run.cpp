#include "benchmarks/peers/siconos_run.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "cd/discrete/fclib.hpp"
#include "common/io/hdf5_tree.hpp"
#include "common/io/program.hpp"

namespace galet::bench {

namespace {

/// The first Python that has Siconos; empty: none. The system's own has the system's packages, whatever comes first
/// along PATH.
std::string python_with_siconos() {
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (run_program({python, "-c", "import siconos.numerics, scipy.sparse, h5py"}).well()) return python;
  return "";
}

const std::string& python() {
  static const std::string name = python_with_siconos();
  return name;
}

}  // namespace

std::vector<std::string> siconos_solvers(int block) {
  if (python().empty()) return {};
  if (block == 2) return {"nsgs"};
  if (block == 5) return {"nsgs", "admm"};
  return {"nsgs", "nsn_ac", "admm"};
}

std::vector<SiconosAnswer> run_siconos(const cd::DiscreteProblem& problem, const std::string& solver, double seconds,
                                       const std::filesystem::path& folder) {
  const std::string given = (folder / "problem.hdf5").string(), answers = (folder / "answers.hdf5").string();
  cd::write_fclib(given, {problem, {}, {}});
  const ProgramEnd end =
      run_program({python(), GALET_SICONOS_SCRIPT, given, answers, solver, fmt::format("{}", seconds)});
  if (!end.well()) throw std::runtime_error("siconos_solve.py: " + end.messages);
  const Archive archive = read_hdf5(answers, {"answers"});
  std::vector<SiconosAnswer> list;
  for (int k = 0;; ++k) {
    const auto path = [k](const char* name) { return fmt::format("answers/{}/{}", k, name); };
    if (!archive.reals.contains(path("r"))) return list;
    list.push_back({archive.reals.at(path("tolerance"))[0], archive.reals.at(path("seconds"))[0],
                    static_cast<long>(archive.integers.at(path("iterations"))[0]), archive.reals.at(path("r"))});
  }
}

}  // namespace galet::bench
