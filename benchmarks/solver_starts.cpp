// Contact solvers on one FCLIB problem from seven perturbed starts: what a single run of a chaotic iteration can't
// show.
//
//   solver_starts FILE [SECONDS]      SECONDS: processor time of each solve (default 2)
//
// A row per solver: how many starts came to errS 1e-4, errP 1e-3 and errP 1e-4, and the median and the largest of their
// times (medians over all starts; empty where half of them did not come). Starts: normal impulses of 1 % of the root
// mean square of the solution's, times a random number. Times by benchmarks/solver_profile.cpp's rules.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>

#include "cd/discrete/fclib.hpp"
#include "cd/discrete/solve.hpp"
#include "common/core/error.hpp"
#include "common/io/files.hpp"

namespace {

using namespace galet;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr int starts = 7;
constexpr std::array<const char*, 3> solvers{"auto", "ags", "nncg"};

struct Goal {
  bool siconos;  ///< errP, else errS
  double error;
};
constexpr std::array<Goal, 3> goals{{{false, 1e-4}, {true, 1e-3}, {true, 1e-4}}};

std::array<double, goals.size()> times_of(const cd::DiscreteProblem& problem, cd::DiscreteOptions options) {
  options.error = options.siconos_error = 1e-4;
  options.history = true;
  std::array<double, goals.size()> times;
  times.fill(never);
  for (const cd::DiscreteHistory& at : cd::solve(problem, options).history)
    for (std::size_t g = 0; g < goals.size(); ++g)
      if ((goals[g].siconos ? at.siconos_error : at.error) <= goals[g].error) times[g] = std::min(times[g], at.seconds);
  return times;
}

void run(const std::string& file, double seconds) {
  const cd::DiscreteProblem problem = cd::read_fclib(file).problem;
  cd::DiscreteOptions options;
  options.seconds = seconds;
  options.error = 1e-3;
  const std::vector<double> solution = cd::solve(problem, options).r;
  double square = 0;
  for (const double r : solution) square += r * r / problem.contacts();
  fmt::print("solver");
  for (const Goal& goal : goals)
    fmt::print(",{0} {1:g}: starts,median (s),largest (s)", goal.siconos ? "errP" : "errS", goal.error);
  fmt::print("\n");
  for (const char* solver : solvers) {
    std::array<std::vector<double>, goals.size()> times;
    for (int seed = 1; seed <= starts; ++seed) {
      std::mt19937 random(seed);
      options.solver = solver;
      options.start.assign(problem.q.size(), 0.0);
      for (int c = 0; c < problem.contacts(); ++c)
        options.start[problem.block * c] = 0.01 * std::sqrt(square) * static_cast<double>(random()) / 4294967296.0;
      const auto of_start = times_of(problem, options);
      for (std::size_t g = 0; g < goals.size(); ++g) times[g].push_back(of_start[g]);
    }
    fmt::print("{}", solver);
    for (auto& list : times) {
      std::sort(list.begin(), list.end());
      const auto came = std::count_if(list.begin(), list.end(), [](double time) { return time < never; });
      const auto text = [](double time) { return time < never ? fmt::format("{:.3g}", time) : ""; };
      fmt::print(",{},{},{}", came, text(list[starts / 2]), came > 0 ? text(list[came - 1]) : "");
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    fmt::print(stderr, "usage: solver_starts FILE [SECONDS]\n");
    return 2;
  }
  try {
    const double seconds = argc == 3 ? parse_real(argv[2]).value_or(0) : 2;
    require(seconds > 0, "SECONDS: expected a number above 0");
    run(argv[1], seconds);
  } catch (const std::exception& error) {
    fmt::print(stderr, "solver_starts: {}\n", error.what());
    return 1;
  }
  return 0;
}
