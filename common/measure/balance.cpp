#include "common/measure/balance.hpp"

#include <limits>

namespace galet {

namespace {

double norm(double value) { return std::abs(value); }
double norm(const Vec<3>& value) { return value.norm(); }

}  // namespace

template <int D>
Balance unbalance(const Snapshot<D>& snapshot, const std::vector<char>& loose, const Vec<D>& gravity) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  const int grains = snapshot.grains();
  std::vector<Vec<D>> force(grains, Vec<D>::Zero());
  std::vector<Spin<D>> torque(grains, zero_spin<D>());
  double contact_sum = 0;
  long ends = 0;
  const auto add = [&](int grain, const Vec<D>& f, const Spin<D>& couple) {
    if (grain >= grains || loose[grain]) return;
    force[grain] += f;
    torque[grain] += couple;
    contact_sum += f.norm();
    ++ends;
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const int i = contacts.i[c], j = contacts.j[c];
    const Vec<D>&n = contacts.normal[c], &f = contacts.force[c];
    const double length = contacts.branch[c].norm(), ri = snapshot.radius[i];
    const double rj = j < grains ? snapshot.radius[j] : 0;
    const Spin<D> arm = -length / (ri + rj) * cross(n, f);  // torque per unit of radius, the same sign on both
    const Spin<D> rolling = contacts.torque.empty() ? zero_spin<D>() : contacts.torque[c];
    add(i, -f, ri * arm - rolling);
    add(j, f, rj * arm + rolling);
  }
  double force_sum = 0, torque_sum = 0, radius_sum = 0;
  long counted = 0;
  for (int i = 0; i < grains; ++i) {
    if (loose[i]) continue;
    ++counted;
    radius_sum += snapshot.radius[i];
    force_sum += (force[i] + snapshot.mass[i] * gravity).norm();
    torque_sum += norm(torque[i]);
  }
  if (!(contact_sum > 0)) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  const double count = static_cast<double>(counted), mean = contact_sum / static_cast<double>(ends);
  Balance result{force_sum / (count * mean), 0};
  if (!snapshot.spin.empty()) result.torque = torque_sum / (mean * radius_sum);
  return result;
}

template Balance unbalance<2>(const Snapshot<2>&, const std::vector<char>&, const Vec<2>&);
template Balance unbalance<3>(const Snapshot<3>&, const std::vector<char>&, const Vec<3>&);

}  // namespace galet
