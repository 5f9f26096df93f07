// The settings of momentum on sweeps (cap, growth; cd/discrete/iterations.hpp), chosen on one half of the FCLIB
// problems of a folder and looked at on the other.
//
//   solver_settings FOLDER > solver_settings.csv      about a minute of processor time
//
// Halves: every other file by name. Each row: kind of sweep, settings, and for both halves how many problems came to
// errS = 1e-6 in half a second, and the geometric mean of the times (a problem that did not come counts as twice that).
// The last rows say which settings are best in one half, and where they rank in the other.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "cd/discrete/fclib.hpp"
#include "cd/discrete/iterations.hpp"
#include "cd/discrete/sweeps.hpp"
#include "common/core/error.hpp"

namespace {

using namespace galet;

constexpr double limit = 0.5, wanted = 1e-6;
constexpr std::array<const char*, 2> kinds{"exact", "projected"};

/// Seconds, or twice the limit.
template <int B>
double time_of(const cd::DiscreteProblem& given, int kind, const cd::Momentum& momentum) {
  const cd::ScaledProblem<B> problem(given);
  cd::DiscreteOptions options;
  options.error = wanted, options.seconds = limit;
  auto r = problem.scaled(std::vector<double>(given.q.size(), 0.0));
  cd::Monitor<B> monitor(problem, options, r);
  monitor.begin("sweeps");
  constexpr long endless = 1L << 60;
  if (kind == 0) {
    cd::ExactSweep<B> sweep(problem);
    cd::iterate<B>(sweep, momentum, endless, r, monitor);
  } else {
    cd::ProjectedSweep<B> sweep(problem, 0, r);
    cd::iterate<B>(sweep, momentum, endless, r, monitor);
  }
  return monitor.reached() ? std::max(monitor.seconds(), 1e-5) : 2 * limit;
}

double time_of(const cd::DiscreteProblem& problem, int kind, const cd::Momentum& momentum) {
  if (problem.block == 2) return time_of<2>(problem, kind, momentum);
  if (problem.block == 3) return time_of<3>(problem, kind, momentum);
  return time_of<5>(problem, kind, momentum);
}

struct Row {
  int kind;
  cd::Momentum momentum;
  std::array<int, 2> solved{};
  std::array<double, 2> mean{};  ///< of the logarithms
};

void say_ranks(const std::vector<Row>& rows, int kind) {
  const auto order = [&](int half) {
    std::vector<const Row*> sorted;
    for (const Row& row : rows)
      if (row.kind == kind) sorted.push_back(&row);
    std::sort(sorted.begin(), sorted.end(),
              [half](const Row* a, const Row* b) { return a->mean[half] < b->mean[half]; });
    return sorted;
  };
  for (const int half : {0, 1}) {
    const Row* best = order(half)[0];
    const auto other = order(1 - half);
    const auto place = std::find(other.begin(), other.end(), best) - other.begin() + 1;
    fmt::print(
        "# {}: best in half {}: cap {} growth {}; in half {} its mean is {:.3f} times that of the best there (place {} "
        "of {})\n",
        kinds[kind], half + 1, best->momentum.cap, best->momentum.growth, 2 - half,
        std::exp(best->mean[1 - half] - other[0]->mean[1 - half]), place, other.size());
  }
}

void run(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".hdf5") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  require(files.size() >= 2, "expected a folder of FCLIB files");
  std::vector<cd::DiscreteProblem> problems;
  for (const auto& file : files) problems.push_back(cd::read_fclib(file.string()).problem);
  std::vector<Row> rows;
  fmt::print("sweep,cap,growth,solved in half 1,geometric mean (s),solved in half 2,geometric mean (s)\n");
  for (const int kind : {0, 1})
    for (const double cap : {0.8, 0.9, 0.95})
      for (const double growth : {1.05, 1.5}) {
        Row row{kind, {cap, growth}};
        for (std::size_t p = 0; p < problems.size(); ++p) {
          const double seconds = time_of(problems[p], kind, row.momentum);
          const double half_size = static_cast<double>((problems.size() + 1 - p % 2) / 2);
          row.solved[p % 2] += seconds <= limit + 0.1, row.mean[p % 2] += std::log(seconds) / half_size;
        }
        fmt::print("{},{},{},{},{:.3g},{},{:.3g}\n", kinds[kind], cap, growth, row.solved[0], std::exp(row.mean[0]),
                   row.solved[1], std::exp(row.mean[1]));
        std::fflush(stdout);
        rows.push_back(row);
      }
  for (const int kind : {0, 1}) say_ranks(rows, kind);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: solver_settings FOLDER\n");
    return 2;
  }
  try {
    run(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "solver_settings: {}\n", error.what());
    return 1;
  }
  return 0;
}
