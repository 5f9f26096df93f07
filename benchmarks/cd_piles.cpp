// The contact solver of cd on single steps of sphere packings under gravity, from a cold start and from the solution of
// a problem that differs a little.
//
//   cd_piles OUT [FILE]      FILE: the geometry of pile3d (benchmarks/pile_problem.hpp), solved too where it is given
//
// Writes OUT/growth.csv and OUT/growth (time to errS = 1e-4 against the number of contacts, cubes cut out of a repeated
// packing) and, with FILE, OUT/pile3d.csv: times and sweeps to errS 1e-4, errP 1e-3 and errP 1e-4 from seven perturbed
// starts, and to errS 1e-4 and errP 1e-4 after a change of the load. Processor time of one thread, loading included,
// without the checks that only this program makes; empty where 14000 sweeps did not reach the error.
#include <array>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "benchmarks/dense_sample.hpp"
#include "benchmarks/pile_problem.hpp"
#include "cd/solvers/nsgs.hpp"
#include "common/core/clock.hpp"
#include "common/io/figure.hpp"
#include "common/io/files.hpp"

namespace galet {
namespace {

using bench::Pile;

struct Goal {
  bool siconos;  ///< errP, else errS
  double error;
};
struct Hit {
  int sweeps = 0;
  double seconds = std::numeric_limits<double>::infinity();
};

/// Sweeps that are watched: the true errors are measured now and then, with the clock stopped.
class Watched {
 public:
  Watched(const Pile& pile, const cd::Iterate<Pile::Y>& start, std::vector<Goal> goals)
      : hits(goals.size()), pile_(pile), goals_(std::move(goals)), at_(start), started_(thread_seconds()) {
    sweeps_.load(pile.problem, start, std::numeric_limits<std::size_t>::max());
  }
  cd::ResidualParts sweep(double beta) { return after(sweeps_.sweep(beta)); }
  cd::ResidualParts sweep_along(double beta) { return after(sweeps_.sweep_along(beta)); }
  double residual() {
    const double value = sweeps_.residual();
    measure();
    return done() ? 0 : value;
  }
  void restart() { sweeps_.restart(); }
  void keep() { sweeps_.keep(); }
  void return_to_kept() { sweeps_.return_to_kept(); }
  cd::Iterate<Pile::Y> impulses() {
    sweeps_.unload(at_);
    return at_;
  }

  std::vector<Hit> hits;

 private:
  cd::ResidualParts after(const cd::ResidualParts& change) {
    ++count_;
    if (count_ < 64 && (count_ < 8 || count_ % 8 == 0)) measure();
    return change;
  }
  void measure() {
    const double paused = thread_seconds();
    sweeps_.unload(at_);
    const bench::PileErrors errors = bench::pile_errors(pile_, at_);
    for (std::size_t g = 0; g < goals_.size(); ++g)
      if (hits[g].sweeps == 0 && (goals_[g].siconos ? errors.siconos : errors.scaled) <= goals_[g].error)
        hits[g] = {count_, paused - started_ - pauses_};
    pauses_ += thread_seconds() - paused;
  }
  bool done() const {
    return std::all_of(hits.begin(), hits.end(), [](const Hit& hit) { return hit.sweeps > 0; });
  }

  const Pile& pile_;
  std::vector<Goal> goals_;
  cd::Iterate<Pile::Y> at_;
  cd::PlainSweeps<Pile::Y> sweeps_;
  double started_, pauses_ = 0;
  int count_ = 0;
};

std::vector<Hit> solve(const Pile& pile, const cd::Iterate<Pile::Y>& start, const std::vector<Goal>& goals,
                       int most = 14000, cd::Iterate<Pile::Y>* solution = nullptr) {
  Watched sweeps(pile, start, goals);
  cd::Iteration(sweeps, cd::SolverOptions{0, most}).run();
  if (solution) *solution = sweeps.impulses();
  return sweeps.hits;
}

std::string text_of(const std::vector<Hit>& hits) {
  std::string text;
  for (const Hit& hit : hits) text += hit.sweeps > 0 ? fmt::format(",{},{:.4f}", hit.sweeps, hit.seconds) : ",,";
  return text;
}

void grow(const std::filesystem::path& out) {
  const Sample<3> packing = bench::dense_sample<3>(2000, 0.4);
  std::string table = "contacts,grains,sweeps,seconds\n";
  Series times{.label = "momentum", .x = {}, .y = {}, .y_error = {}, .line = true};
  for (const double side : {6.5, 8.0, 10.0, 13.0, 16.0, 20.0, 24.0, 29.0}) {
    const Pile pile = bench::pile_of_packing(packing, side, 0.4, 0.01);
    const auto hits = solve(pile, pile.free, {{false, 1e-4}});
    table += fmt::format("{},{}{}\n", pile.problem.size(), pile.problem.grains, text_of(hits));
    times.x.push_back(static_cast<double>(pile.problem.size())), times.y.push_back(hits[0].seconds);
  }
  const double rate = std::log(times.y.back() / times.y[1]) / std::log(times.x.back() / times.x[1]);
  fmt::print("{}time ~ contacts^{:.2f}\n", table, rate);
  write_file((out / "growth.csv").string(), table);
  Figure figure;
  figure.title = fmt::format("Time to errS = 1e-4, cold start: contacts^{{{:.2f}}}", rate);
  figure.x_label = "contacts", figure.y_label = "seconds";
  figure.log_x = figure.log_y = true;
  figure.series = {times};
  write_figure((out / "growth").string(), figure);
}

/// The impulses of another problem as the start of this one.
cd::Iterate<Pile::Y> warm(const Pile& pile, const cd::Iterate<Pile::Y>& solution) {
  cd::Iterate<Pile::Y> start = pile.free;
  Mat<3> virial = Mat<3>::Zero();
  for (std::size_t k = 0; k < pile.problem.size(); ++k) {
    start.reaction[k] = solution.reaction[k];
    cd::add_reaction(pile.problem, start, k, start.reaction[k], virial);
  }
  return start;
}

/// Of cold starts (pile_problem.hpp): about a hundredth of the rms impulse. Starts that differ by much less part from
/// one another only after thousands of sweeps, and count as one.
constexpr double perturbation = 2e-5;

void solve_file(const std::string& file, const std::filesystem::path& out) {
  const Pile pile = bench::pile_of_file(file, 0.5);
  const std::vector<Goal> cold{{false, 1e-4}, {true, 1e-3}, {true, 1e-4}}, again{{false, 1e-4}, {true, 1e-4}};
  std::string table = "start,sweeps to errS 1e-4,seconds,sweeps to errP 1e-3,seconds,sweeps to errP 1e-4,seconds\n";
  for (std::uint64_t seed = 1; seed <= 7; ++seed)
    table +=
        fmt::format("cold {}{}\n", seed, text_of(solve(pile, bench::perturbed_start(pile, perturbation, seed), cold)));
  cd::Iterate<Pile::Y> solution = pile.free;
  solve(pile, pile.free, {{false, 3e-6}}, 30000, &solution);
  // Two changes of the load: each grain's free velocity by 1 % of the root mean square, at random; gravity tilted so
  // that it gains a tenth along x.
  double square = 0;
  for (int b = 0; b < pile.problem.grains; ++b) square += pile.free.velocity[b].squaredNorm() / pile.problem.grains;
  Pile rough = pile, tilted = pile;
  RandomStream stream(11, 1);
  for (int b = 0; b < pile.problem.grains; ++b) {
    const double size = 0.01 * std::sqrt(square / 3);
    rough.free.velocity[b] += size * Vec<3>(stream.normal(), stream.normal(), stream.normal());
    tilted.free.velocity[b].x() += 0.1 * std::sqrt(square);
  }
  const auto add = [&](const char* name, const Pile& changed) {
    const auto hits = solve(changed, warm(changed, solution), again);
    table += fmt::format("{}{},,{}\n", name, text_of({hits[0]}), text_of({hits[1]}));
  };
  add("after 1 % at random", rough), add("after a tilt of 0.1 g", tilted);
  fmt::print("{}", table);
  write_file((out / "pile3d.csv").string(), table);
}

}  // namespace
}  // namespace galet

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    fmt::print(stderr, "usage: cd_piles OUT [FILE]\n");
    return 2;
  }
  try {
    std::filesystem::create_directories(argv[1]);
    galet::grow(argv[1]);
    if (argc == 3) galet::solve_file(argv[2], argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "cd_piles: {}\n", error.what());
    return 2;
  }
}
