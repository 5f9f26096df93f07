#include "common/measure/force_distribution.hpp"

namespace galet {

namespace {

/// Divides the values by their mean, and returns it; drops them where it is not above 0.
double scale_by_mean(std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  const double mean = values.empty() ? 0 : sum / static_cast<double>(values.size());
  if (!(mean > 0)) values.clear();
  for (double& value : values) value /= mean;
  return mean;
}

}  // namespace

template <int D>
ForceDistribution force_distribution(const Snapshot<D>& snapshot, double largest, int intervals) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  std::vector<double> normal, tangential;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!contacts.touches(c) || contacts.j[c] >= snapshot.grains()) continue;
    normal.push_back(contacts.force[c].dot(contacts.normal[c]));
    tangential.push_back((contacts.force[c] - normal.back() * contacts.normal[c]).norm());
  }
  ForceDistribution result;
  result.mean_normal = scale_by_mean(normal);
  result.mean_tangential = scale_by_mean(tangential);
  result.normal = histogram(normal, 0, largest, intervals);
  result.tangential = histogram(tangential, 0, largest, intervals);
  return result;
}

template ForceDistribution force_distribution<2>(const Snapshot<2>&, double, int);
template ForceDistribution force_distribution<3>(const Snapshot<3>&, double, int);

}  // namespace galet
