// Every solver on every FCLIB problem of a folder: processor time to errors 1e-4, 1e-6 and 1e-8 in both measures; those
// of Siconos too where it is installed.
//
//   solver_profile FOLDER OUT [SECONDS]      SECONDS: processor time for each problem and solver (default 5)
//
// Siconos gets the same W, q and mu in a file, and its answers are measured by the same code (cd/discrete/error.hpp).
// As it keeps no history it solves once for each of its tolerances (benchmarks/peers/siconos_solve.py), and the time to
// an error is the least time of an answer below that error; each of these solves may take three times SECONDS.
//
// Writes OUT/times.csv (one row per problem, solver and measure; empty where the error was not reached) and, for each
// measure, OUT/profile_errS and OUT/profile_errP: the share of problems that a solver brought to 1e-6 within a factor
// of the fastest solver's time (performance profile of Dolan and More 2002). Times are those at which an error was
// first seen in one run's history, without the checks themselves; loading is not in them, scaling and factorisations
// are. Times below 10 microseconds count as 10: smaller ones are noise.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "benchmarks/peers/siconos_run.hpp"
#include "cd/discrete/error.hpp"
#include "cd/discrete/fclib.hpp"
#include "cd/discrete/solve.hpp"
#include "common/core/error.hpp"
#include "common/io/figure.hpp"
#include "common/io/files.hpp"
#include "common/io/scratch_folder.hpp"

namespace {

using namespace galet;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::array errors{1e-4, 1e-6, 1e-8};
constexpr const char* measures[] = {"errS", "errP"};

struct Times {
  std::array<std::array<double, errors.size()>, 2> seconds;  ///< by measure and error

  Times() {
    for (auto& row : seconds) row.fill(never);
  }
  void note(std::size_t measure, double error, double at) {
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (error <= errors[k]) seconds[measure][k] = std::min(seconds[measure][k], std::max(at, 1e-5));
  }
};

Times times_of(const cd::FclibContent& content, const std::string& solver, double limit) {
  cd::DiscreteOptions options;
  options.error = options.siconos_error = errors.back();
  options.seconds = limit;
  options.solver = solver;
  options.history = true;
  const cd::DiscreteSolution solution =
      cd::solve(content.problem, options, content.global ? &*content.global : nullptr);
  Times times;
  for (const cd::DiscreteHistory& at : solution.history) {
    times.note(0, at.error, at.seconds);
    times.note(1, at.siconos_error, at.seconds);
  }
  times.note(0, solution.error, solution.seconds);
  times.note(1, solution.siconos_error, solution.seconds);
  return times;
}

template <int B>
cd::DiscreteError error_in_blocks(const cd::DiscreteProblem& problem, const std::vector<double>& r) {
  const cd::ScaledProblem<B> scaled(problem);
  const auto blocks = scaled.scaled(r);
  return cd::discrete_error<B>(scaled, blocks);
}

Times times_of_siconos(const cd::DiscreteProblem& problem, const std::string& solver, double limit,
                       const std::filesystem::path& folder) {
  const auto error_of = problem.block == 2   ? error_in_blocks<2>
                        : problem.block == 3 ? error_in_blocks<3>
                                             : error_in_blocks<5>;
  Times times;
  for (const bench::SiconosAnswer& answer : bench::run_siconos(problem, solver, 3 * limit, folder)) {
    const cd::DiscreteError error = error_of(problem, answer.r);
    times.note(0, error.scaled, answer.seconds);
    times.note(1, error.siconos, answer.seconds);
  }
  return times;
}

/// Eight curves can be told apart: the automatic choice, one of each kind of method, and Siconos.
bool shown(const std::string& solver) {
  const std::array<std::string, 5> own{"auto", "ags", "nncg", "pgs-frozen", "newton"};
  return solver.starts_with("siconos") || std::find(own.begin(), own.end(), solver) != own.end();
}

/// Share of problems solved within each factor of the fastest; a problem that nobody solves counts for nobody.
void write_profile(const std::string& stem, std::size_t measure, const std::map<std::string, std::vector<Times>>& all) {
  const std::size_t level = 1, problems = all.begin()->second.size();
  Figure figure;
  figure.title = fmt::format("Time to {} = {:g}, {} problems", measures[measure], errors[level], problems);
  figure.x_label = "factor of the fastest solver's time";
  figure.y_label = "share of problems solved";
  figure.log_x = true;
  for (const auto& [solver, times] : all) {
    std::vector<double> factors;
    for (std::size_t p = 0; p < problems; ++p) {
      double best = never;
      for (const auto& [other, others] : all) best = std::min(best, others[p].seconds[measure][level]);
      const double own = times[p].seconds[measure][level];
      if (own < never) factors.push_back(own / best);
    }
    std::sort(factors.begin(), factors.end());
    Series series{.label = solver, .x = {}, .y = {}, .y_error = {}, .line = true};
    for (std::size_t k = 0; k < factors.size(); ++k) {
      series.x.insert(series.x.end(), {factors[k], factors[k]});  // a step up
      series.y.push_back(static_cast<double>(k) / static_cast<double>(problems));
      series.y.push_back(static_cast<double>(k + 1) / static_cast<double>(problems));
    }
    if (!factors.empty() && shown(solver)) figure.series.push_back(series);
  }
  if (!figure.series.empty()) write_figure(stem, figure);
}

/// Underscores are subscripts in figures.
std::string dashed(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string rows_of(const std::string& name, const cd::DiscreteProblem& problem, const std::string& solver,
                    const Times& times) {
  std::string rows;
  for (std::size_t measure = 0; measure < 2; ++measure) {
    rows += fmt::format("{},{},{},{},{}", name, problem.contacts(), problem.block, solver, measures[measure]);
    for (const double seconds : times.seconds[measure]) rows += seconds < never ? fmt::format(",{:.3g}", seconds) : ",";
    rows += "\n";
  }
  return rows;
}

int profile(const std::string& folder, const std::string& out, double limit) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".hdf5") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.empty()) throw InputError(fmt::format("{}: no *.hdf5 files", folder));
  std::filesystem::create_directories(out);
  std::string table = "problem,contacts,block,solver,measure";
  for (const double error : errors) table += fmt::format(",seconds to {:g}", error);
  table += "\n";
  std::map<std::string, std::vector<Times>> all;
  const ScratchFolder scratch;
  for (const auto& file : files) {
    const cd::FclibContent content = cd::read_fclib(file.string());
    const cd::DiscreteProblem& problem = content.problem;
    const auto add = [&](const std::string& solver, const Times& times) {
      all[solver].resize(static_cast<std::size_t>(&file - files.data()));  // solvers that some problems have not
      all[solver].push_back(times);
      table += rows_of(file.stem().string(), problem, solver, times);
    };
    for (const std::string_view solver : cd::discrete_solvers())
      if (content.global || !cd::needs_bodies(solver))
        add(std::string(solver), times_of(content, std::string(solver), limit));
    for (const std::string& solver : bench::siconos_solvers(problem.block))
      add("siconos " + dashed(solver), times_of_siconos(problem, solver, limit, scratch.path()));
    fmt::print(stderr, "{}\n", file.stem().string());
  }
  for (auto& [solver, times] : all) times.resize(files.size());
  write_file((std::filesystem::path(out) / "times.csv").string(), table);
  fmt::print("{}", table);
  for (std::size_t measure = 0; measure < 2; ++measure)
    write_profile((std::filesystem::path(out) / fmt::format("profile_{}", measures[measure])).string(), measure, all);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    fmt::print(stderr, "usage: solver_profile FOLDER OUT [SECONDS]\n");
    return 2;
  }
  try {
    const double limit = argc == 4 ? parse_real(argv[3]).value_or(0) : 5;
    require(limit > 0, "SECONDS: expected a number above 0");
    return profile(argv[1], argv[2], limit);
  } catch (const std::exception& error) {
    fmt::print(stderr, "solver_profile: {}\n", error.what());
    return 2;
  }
}
