#include "cd/discrete/problem.hpp"

#include <cmath>

#include <fmt/format.h>

namespace galet::cd {

namespace {

bool all_finite(std::span<const double> values) {
  for (const double value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

void check_matrix(const DiscreteProblem& problem, std::vector<std::string>& mistakes) {
  const int rows = problem.rows();
  if (problem.start.size() != static_cast<std::size_t>(rows) + 1 || problem.start.front() != 0 ||
      problem.start.back() != static_cast<std::int64_t>(problem.value.size()) ||
      problem.column.size() != problem.value.size()) {
    mistakes.push_back(fmt::format("W has not the {} rows that {} contacts of {} numbers need", rows,
                                   problem.contacts(), problem.block));
    return;
  }
  for (int a = 0; a < rows; ++a) {
    if (problem.start[a + 1] < problem.start[a]) {
      mistakes.push_back(fmt::format("row {} of W ends before it begins", a));
      return;
    }
    for (std::int64_t k = problem.start[a]; k < problem.start[a + 1]; ++k) {
      const int column = problem.column[k];
      const bool first = k == problem.start[a];
      if (column < 0 || column >= rows || (!first && column <= problem.column[k - 1])) {
        mistakes.push_back(fmt::format("row {} of W: column {} is outside or not above the one before", a, column));
        return;
      }
      if (column == a && problem.value[k] < 0) mistakes.push_back(fmt::format("W({}, {}) is negative", a, a));
    }
  }
  if (!all_finite(problem.value)) mistakes.push_back("W holds values that are not finite");
}

}  // namespace

std::vector<std::string> mistakes_of(const DiscreteProblem& problem) {
  std::vector<std::string> mistakes;
  if (problem.block != 2 && problem.block != 3 && problem.block != 5) {
    mistakes.push_back(fmt::format("contacts of {} numbers: expected 2, 3 or 5", problem.block));
    return mistakes;
  }
  if (problem.q.size() != static_cast<std::size_t>(problem.rows()))
    mistakes.push_back(fmt::format("q has {} numbers: expected {}", problem.q.size(), problem.rows()));
  if (!all_finite(problem.q)) mistakes.push_back("q holds values that are not finite");
  const auto check_bounds = [&](std::span<const double> bounds, const char* name) {
    for (std::size_t c = 0; c < bounds.size(); ++c)
      if (!(bounds[c] >= 0) || !std::isfinite(bounds[c])) {
        mistakes.push_back(fmt::format("{} of contact {} is {}: expected 0 or more", name, c, bounds[c]));
        return;
      }
  };
  check_bounds(problem.mu, "mu");
  check_bounds(problem.mu_r, "mu_r");
  const std::size_t rolling = problem.block == 5 ? problem.mu.size() : 0;
  if (problem.mu_r.size() != rolling)
    mistakes.push_back(fmt::format("mu_r has {} numbers: expected {}", problem.mu_r.size(), rolling));
  check_matrix(problem, mistakes);
  return mistakes;
}

}  // namespace galet::cd
