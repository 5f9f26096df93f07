#include "common/measure/unbalanced_force.hpp"

#include <limits>

namespace galet {

template <int D>
double unbalanced_force_ratio(const Snapshot<D>& snapshot, const Vec<D>& gravity, const std::vector<char>& left_out) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  const int grains = snapshot.grains();
  std::vector<Vec<D>> left(grains);
  for (int i = 0; i < grains; ++i) left[i] = snapshot.mass[i] * gravity;
  double contact_sum = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    left[contacts.i[c]] -= contacts.force[c];
    if (contacts.j[c] < grains) left[contacts.j[c]] += contacts.force[c];
    contact_sum += contacts.force[c].norm();
  }
  double grain_sum = 0;
  int counted = 0;
  for (int i = 0; i < grains; ++i) {
    if (left_out[i]) continue;
    grain_sum += left[i].norm();
    ++counted;
  }
  if (counted == 0 || !(contact_sum > 0)) return std::numeric_limits<double>::quiet_NaN();
  return grain_sum / counted / (contact_sum / static_cast<double>(contacts.size()));
}

template double unbalanced_force_ratio<2>(const Snapshot<2>&, const Vec<2>&, const std::vector<char>&);
template double unbalanced_force_ratio<3>(const Snapshot<3>&, const Vec<3>&, const std::vector<char>&);

}  // namespace galet
