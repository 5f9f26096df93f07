#include "src/studies/triaxial_curve.hpp"

#include <limits>

namespace galet {

TriaxialCurve triaxial_curve(const StudyRow& row) {
  TriaxialCurve curve;
  const auto& stages = row.run.stages;
  if (stages.size() < 2 || stages.back().name != "triaxial") return curve;
  const double start = stages[stages.size() - 2].time;
  const Measurement& zero = stages[stages.size() - 2].last;
  for (const Measurement& at : row.run.series.rows) {
    if (at[Observable::time] <= start) continue;
    const double lateral = 0.5 * (at[Observable::sigma_xx] + at[Observable::sigma_yy]);
    curve.strain.push_back(at[Observable::eps_zz] - zero[Observable::eps_zz]);
    curve.volume.push_back(at[Observable::eps_v] - zero[Observable::eps_v]);
    curve.deviator.push_back(at[Observable::sigma_zz] / lateral - 1);
  }
  return curve;
}

double mean_deviator(const TriaxialCurve& curve, double least, double most) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < curve.strain.size(); ++k)
    if (curve.strain[k] >= least && curve.strain[k] <= most) sum += curve.deviator[k], ++count;
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace galet
