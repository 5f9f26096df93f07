#include "src/studies/triaxial_curve.hpp"

#include <algorithm>
#include <limits>

namespace galet {

namespace {

/// y where x first reaches `at` from below, on straight lines between the points; NaN where it does not.
double first_crossing(const std::vector<double>& x, const std::vector<double>& y, double at) {
  for (std::size_t k = 1; k < x.size(); ++k)
    if (x[k] >= at && x[k - 1] < at) return y[k - 1] + (at - x[k - 1]) / (x[k] - x[k - 1]) * (y[k] - y[k - 1]);
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

TriaxialCurve triaxial_curve(const StudyRow& row) {
  TriaxialCurve curve;
  const auto& stages = row.run.stages;
  const auto stage = std::find_if(stages.begin(), stages.end(), [](auto& one) { return one.name == "triaxial"; });
  if (stage == stages.end() || stage == stages.begin()) return curve;
  const double start = std::prev(stage)->time, end = stage->time;
  const Measurement& zero = std::prev(stage)->last;
  for (const Measurement& at : row.run.series.rows) {
    if (at[Observable::time] <= start || at[Observable::time] > end) continue;
    const double lateral = 0.5 * (at[Observable::sigma_xx] + at[Observable::sigma_yy]);
    curve.strain.push_back(at[Observable::eps_zz] - zero[Observable::eps_zz]);
    curve.volume.push_back(at[Observable::eps_v] - zero[Observable::eps_v]);
    curve.deviator.push_back(at[Observable::sigma_zz] / lateral - 1);
  }
  return curve;
}

double deviator_at(const TriaxialCurve& curve, double strain) {
  return first_crossing(curve.strain, curve.deviator, strain);
}

double strain_at(const TriaxialCurve& curve, double deviator) {
  return first_crossing(curve.deviator, curve.strain, deviator);
}

double type_I_strain(const TriaxialCurve& curve) { return strain_at(curve, 0.4) - strain_at(curve, 0.1); }

double mean_deviator(const TriaxialCurve& curve, double least, double most) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < curve.strain.size(); ++k)
    if (curve.strain[k] >= least && curve.strain[k] <= most) sum += curve.deviator[k], ++count;
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace galet
