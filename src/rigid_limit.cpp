#include "src/rigid_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/core/error.hpp"

namespace galet {

namespace {

std::vector<LinePoint> points_at(std::span<const CdRun> runs, double tolerance) {
  std::vector<LinePoint> points;
  for (const CdRun& run : runs)
    if (run.tolerance == tolerance) points.push_back({run.dt, run.value});
  return points;
}

/// The tightest tolerance, and the one after it.
struct TightestTwo {
  double tightest;
  std::optional<double> second;
};

TightestTwo tightest_two(std::span<const CdRun> runs) {
  std::vector<double> tolerances;
  for (const CdRun& run : runs) tolerances.push_back(run.tolerance);
  std::sort(tolerances.begin(), tolerances.end());
  tolerances.erase(std::unique(tolerances.begin(), tolerances.end()), tolerances.end());
  return {tolerances[0], tolerances.size() > 1 ? std::optional(tolerances[1]) : std::nullopt};
}

template <class Run>
std::vector<Run> finite_runs(std::span<const Run> runs) {
  std::vector<Run> finite;
  for (const Run& run : runs)
    if (std::isfinite(run.value.value) && std::isfinite(run.value.error)) finite.push_back(run);
  return finite;
}

/// Whether points with known errors lie on their line: chi^2 per spare point within three standard errors.
bool on_line(std::span<const LinePoint> points, const LineFit& fit) {
  const int spare = static_cast<int>(points.size()) - 2;
  return spare <= 0 || fit.chi_square <= 9 * spare;
}

/// Mean with weights 1/error^2; when an error is unknown, the plain mean with half the difference as its error.
Estimate combine(const Estimate& a, const Estimate& b) {
  if (a.error <= 0 || b.error <= 0) return {0.5 * (a.value + b.value), 0.5 * std::abs(a.value - b.value)};
  const double weight_a = 1 / (a.error * a.error), weight_b = 1 / (b.error * b.error);
  return {(weight_a * a.value + weight_b * b.value) / (weight_a + weight_b), 1 / std::sqrt(weight_a + weight_b)};
}

}  // namespace

std::optional<EngineLimit> md_limit(std::span<const MdRun> runs, double power) {
  std::vector<LinePoint> points;
  for (const MdRun& run : finite_runs(runs)) points.push_back({std::pow(run.stiffness_level, -power), run.value});
  if (points.empty()) return std::nullopt;
  const LineFit fit = fit_line(points);
  return EngineLimit{fit.intercept, fit.slope, 0, static_cast<int>(points.size()), on_line(points, fit)};
}

std::optional<EngineLimit> cd_limit(std::span<const CdRun> runs) {
  const std::vector<CdRun> usable = finite_runs(runs);
  if (usable.empty()) return std::nullopt;
  const TightestTwo tolerance = tightest_two(usable);
  const std::vector<LinePoint> points = points_at(usable, tolerance.tightest);
  const LineFit fit = fit_line(points);
  EngineLimit limit{fit.intercept, fit.slope, 0, static_cast<int>(points.size()), on_line(points, fit)};
  if (tolerance.second) {
    const LineFit looser = fit_line(points_at(usable, *tolerance.second));
    const double difference = fit.intercept.value - looser.intercept.value;
    const double noise = std::hypot(fit.intercept.error, looser.intercept.error);
    limit.systematic = std::sqrt(std::max(0.0, difference * difference - noise * noise));
    limit.value.error = std::hypot(limit.value.error, limit.systematic);
  }
  return limit;
}

RigidLimit rigid_limit(std::span<const MdRun> md, std::span<const CdRun> cd, double power) {
  RigidLimit limit{md_limit(md, power), cd_limit(cd), {}, {}, {}};
  if (!limit.md && !limit.cd) {
    limit.combined.value = std::numeric_limits<double>::quiet_NaN();
  } else if (limit.md && limit.cd) {
    if (limit.md->on_line && limit.cd->on_line)
      limit.combined = combine(limit.md->value, limit.cd->value);
    else if (limit.md->on_line || limit.cd->on_line)
      limit.combined = limit.md->on_line ? limit.md->value : limit.cd->value;
    else
      limit.combined.value = std::numeric_limits<double>::quiet_NaN();
    limit.difference = deviation(limit.md->value, limit.cd->value);
    if (limit.md->on_line && limit.cd->on_line)
      limit.agree = std::abs(limit.difference->value) <= 2 * limit.difference->error;
  } else {
    limit.combined = limit.md ? limit.md->value : limit.cd->value;
  }
  return limit;
}

Estimate deviation(const Estimate& value, const Estimate& limit) {
  return {value.value - limit.value, std::hypot(value.error, limit.error)};
}

}  // namespace galet
