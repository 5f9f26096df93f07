// Annular shear in both engines: the moment through every ring, the local law beside homogeneous shear at several inner
// radii, and creep where the stress ratio is below mu*_min.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/line_fit.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/flow_fit.hpp"
#include "src/studies/gradient_templates.hpp"
#include "src/studies/published.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::annular_shear {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array engines = {EngineKind::md, EngineKind::cd};
constexpr double from_wall = 2.5;                 ///< rings that a boundary orders
constexpr std::array compared_at = {0.03, 0.06};  ///< I at which the local law is compared
constexpr double creep_ratio = 0.9;               ///< creep is looked for where mu* is below this times mu*_min

std::vector<LocalState> rings_of(const StudyRow& row) {
  std::vector<LocalState> rings = ring_states(row.run.measures.profile);
  if (rings.size() < 2) return {};
  const double inner = row.plan.parameter("R_i"), width = rings[1].position - rings[0].position;
  const double outer = rings.back().position + 0.5 * width;
  std::erase_if(rings, [&](const LocalState& ring) {
    return ring.position < inner + from_wall || ring.position > outer - from_wall;
  });
  return rings;
}

/// NaN of a single sample of that radius: its error is not known.
Estimate over_samples(const std::vector<StudyRow>& rows, EngineKind engine, double radius,
                      const std::function<double(const std::vector<LocalState>&)>& number) {
  const auto samples = rows_with(rows, engine, {{"R_i", radius}});
  if (samples.size() < 2) return {none, none};
  return mean_over(samples, [&](const StudyRow& row) { return number(rings_of(row)); });
}

/// Local minus homogeneous at one I.
Estimate deviation(const std::vector<StudyRow>& rows, EngineKind engine, double radius, double state,
                   Observable observable, double LocalState::*quantity) {
  const Estimate local =
      over_samples(rows, engine, radius, [&](const auto& rings) { return local_at(rings, state, quantity); });
  return local - homogeneous_at(shear_rows(rows, engine), state, observable);
}

/// Standard deviation of shear stress r^2 over the rings, over its mean.
double moment_scatter(const std::vector<LocalState>& rings) {
  double mean = 0, square = 0;
  const double n = static_cast<double>(rings.size());
  for (const LocalState& ring : rings) mean += ring.moment / n;
  for (const LocalState& ring : rings) square += std::pow(ring.moment / mean - 1, 2) / n;
  return std::sqrt(square);
}

/// I in the first ring where mu* is below `bound`.
double creep_of(const std::vector<LocalState>& rings, double bound) {
  for (const LocalState& ring : rings)
    if (ring.mu_star < bound) return ring.inertial_number;
  return none;
}

void report_radius(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine, double radius) {
  const std::string of = fmt::format(", R_i = {:g} d ({})", radius, engine_name(engine));
  report.add("scatter of sigma_r,theta r^2 over the rings, relative" + of,
             over_samples(rows, engine, radius, moment_scatter), "annulus.moment");
  for (const double state : compared_at) {
    const std::string at = fmt::format(" at I = {:g}", state) + of;
    report.add("mu*, local minus homogeneous" + at,
               deviation(rows, engine, radius, state, Observable::mu_star, &LocalState::mu_star), "annulus.local_mu");
    report.add("Phi, local minus homogeneous" + at,
               deviation(rows, engine, radius, state, Observable::solid_fraction, &LocalState::solid_fraction),
               "annulus.local_Phi");
  }
  const double bound = creep_ratio * published("flow.mu_min").value;
  report.add(fmt::format("I where mu* falls below {:.3f}", bound) + of,
             over_samples(rows, engine, radius, [&](const auto& rings) { return creep_of(rings, bound); }),
             "annulus.creep");
}

/// The deviation of mu* on a straight line in 1/R_i, to 0.
void report_limit(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::vector<double> radii = values_of(rows, "R_i");
  for (const double state : compared_at) {
    std::vector<LinePoint> points;
    for (const double radius : radii) {
      const Estimate one = deviation(rows, engine, radius, state, Observable::mu_star, &LocalState::mu_star);
      if (std::isfinite(one.value)) points.push_back({1 / radius, one});
    }
    const std::string at = fmt::format(" at I = {:g} ({})", state, engine_name(engine));
    const LineFit line =
        points.size() > 1 ? with_scatter(fit_line(points), points.size()) : LineFit{{none, none}, {none, none}, 0};
    report.add("mu*, local minus homogeneous, extrapolated to 1/R_i = 0" + at, line.intercept, "annulus.local_mu",
               "a straight line in 1/R_i is a guess, not a law");
    const Estimate first = points.empty() ? Estimate{none, none} : points.front().y;
    const Estimate last = points.empty() ? Estimate{none, none} : points.back().y;
    report.add("|mu*, local minus homogeneous|, smallest less largest R_i" + at,
               Estimate{std::abs(first.value), first.error} - Estimate{std::abs(last.value), last.error},
               "annulus.converges");
  }
}

/// Means over the samples, ring by ring.
std::vector<LocalState> mean_rings(const std::vector<StudyRow>& rows, EngineKind engine, double radius) {
  std::vector<LocalState> mean;
  const auto samples = rows_with(rows, engine, {{"R_i", radius}});
  for (const StudyRow* row : samples) {
    const auto rings = rings_of(*row);
    mean.resize(std::max(mean.size(), rings.size()));
    const double weight = 1.0 / static_cast<double>(samples.size());
    for (std::size_t k = 0; k < rings.size(); ++k) {
      mean[k].position = rings[k].position;
      mean[k].mu_star += weight * rings[k].mu_star, mean[k].inertial_number += weight * rings[k].inertial_number;
      mean[k].solid_fraction += weight * rings[k].solid_fraction;
    }
  }
  return mean;
}

Figure law_figure(const std::vector<StudyRow>& rows, EngineKind engine, Observable observable,
                  double LocalState::*quantity) {
  const bool friction = observable == Observable::mu_star;
  Figure figure{fmt::format("{} ring by ring, and in homogeneous shear ({})", friction ? "Friction" : "Solid fraction",
                            engine_name(engine)),
                "inertial number {/:Italic I}",
                friction ? "mu*" : "Phi",
                true,
                false,
                {}};
  Series shear = series_of("homogeneous shear", shear_rows(rows, engine), "I", observable);
  shear.line = true;
  if (!shear.x.empty()) figure.series.push_back(shear);
  for (const double radius : values_of(rows, "R_i")) {
    Series series{fmt::format("annulus, R_i = {:g} d", radius), {}, {}, {}, false, false};
    for (const LocalState& ring : mean_rings(rows, engine, radius)) {
      if (!(ring.inertial_number > 1e-4)) continue;
      series.x.push_back(ring.inertial_number), series.y.push_back(ring.*quantity);
    }
    if (!series.x.empty()) figure.series.push_back(series);
  }
  return figure;
}

Figure radius_figure(const std::vector<StudyRow>& rows) {
  Figure figure{
      "Deviation from the local law against the radius", "d / R_i", "mu*, local minus homogeneous", false, false, {}};
  for (const EngineKind engine : engines)
    for (const double state : compared_at) {
      Series series{fmt::format("{}, I = {:g}", engine_name(engine), state), {}, {}, {}, false, false};
      for (const double radius : values_of(rows, "R_i")) {
        const Estimate one = deviation(rows, engine, radius, state, Observable::mu_star, &LocalState::mu_star);
        if (!std::isfinite(one.value)) continue;
        series.x.push_back(1 / radius), series.y.push_back(one.value), series.y_error.push_back(one.error);
      }
      if (!series.x.empty()) figure.series.push_back(series);
    }
  return figure;
}

/// The creeping parts of wide annuli are dear to cd, whose contacts there want many sweeps.
std::vector<double> radii_of(EngineKind engine, bool quick) {
  if (!quick) return {12, 25, 50};
  return engine == EngineKind::md ? std::vector<double>{12, 24, 48} : std::vector<double>{12, 24};
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  const double dt = quick ? 0.02 : 0.01;
  std::vector<StudyRun> runs;
  for (const EngineKind engine : engines) {
    for (const double state : {0.02, 0.04, 0.08, 0.16}) {
      ShearScene scene;
      scene.engine = engine;
      scene.grains = quick ? 300 : full_size_disks;
      scene.contact_steps = quick ? 0 : sparing_steps;
      scene.stiffness_level = quick ? 1e3 : 1e4;
      scene.inertial_number = state;
      scene.strain = quick ? 20 : 60;
      scene.cd_dt_factor = dt;
      runs.push_back(shear_row("annular-shear", scene));
    }
    for (const double radius : radii_of(engine, quick))
      for (const int seed : quick ? std::vector{1, 2} : std::vector{1, 2, 3}) {
        AnnulusScene scene;
        scene.engine = engine;
        scene.seed = seed;
        scene.inner_radius = radius;
        scene.gap = std::min(radius, quick ? 16.0 : 25.0);
        scene.stiffness_level = quick ? 1e3 : 1e4;
        scene.duration = quick ? 120 : 600;
        scene.cd_dt_factor = dt;
        const std::string name = fmt::format("{}_R_{:g}_seed_{}", engine_name(engine), radius, seed);
        scene.title = "annular-shear: " + name;
        runs.push_back({name, engine, {{"R_i", radius}, {"seed", seed}}, annulus_scene(scene), false, true});
      }
  }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const EngineKind engine : engines) {
    for (const double radius : values_of(rows, "R_i"))
      if (!rows_with(rows, engine, {{"R_i", radius}}).empty()) report_radius(report, rows, engine, radius);
    report_limit(report, rows, engine);
    const std::string of = "_" + engine_name(engine);
    report.figures.push_back({"mu_star" + of, law_figure(rows, engine, Observable::mu_star, &LocalState::mu_star)});
    report.figures.push_back(
        {"Phi" + of, law_figure(rows, engine, Observable::solid_fraction, &LocalState::solid_fraction)});
  }
  report.figures.push_back({"radius", radius_figure(rows)});
  report.remarks.emplace_back(
      "rings one d wide, at least 2.5 d from either boundary; errors are those of the scatter of the samples and of "
      "the "
      "homogeneous flows; the gap is R_i, at most 25 d (quick size: 16 d)");
  return report;
}

}  // namespace galet::annular_shear
