#include "src/studies/flow_fit.hpp"

#include <cmath>
#include <limits>

namespace galet {

namespace {

LineFit fit(const std::vector<const StudyRow*>& rows, Observable observable, double least, double most, int& count) {
  std::vector<LinePoint> points;
  for (const StudyRow* row : rows) {
    const double inertial_number = (*row)[Observable::inertial_number].value;
    const Estimate& value = (*row)[observable];
    if (inertial_number < least || inertial_number > most || !std::isfinite(value.value)) continue;
    points.push_back({inertial_number, value});
  }
  count = static_cast<int>(points.size());
  if (count < 2) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {{none, none}, {none, none}, 0};
  }
  return with_scatter(fit_line(points), points.size());
}

}  // namespace

FlowFit fit_flow(const std::vector<const StudyRow*>& rows, double least, double most) {
  FlowFit flow;
  const LineFit friction = fit(rows, Observable::mu_star, least, most, flow.points);
  const LineFit dilatancy = fit(rows, Observable::solid_fraction, least, most, flow.points);
  flow.mu_min = friction.intercept, flow.b = friction.slope;
  flow.solid_fraction_max = dilatancy.intercept;
  flow.a = {-dilatancy.slope.value, dilatancy.slope.error};
  return flow;
}

Series published_line(const std::string& label, const Estimate& value, const Estimate& slope, double least,
                      double most) {
  constexpr int points = 60;
  Series series;
  series.label = label;
  series.band = true;
  for (int k = 0; k <= points; ++k) {
    const double x = least * std::pow(most / least, static_cast<double>(k) / points);
    series.x.push_back(x);
    series.y.push_back(value.value + slope.value * x);
    series.y_error.push_back(std::hypot(value.error, slope.error * x));
  }
  return series;
}

}  // namespace galet
