#include "common/measure/mobilisation.hpp"

#include <cmath>

namespace galet {

template <int D>
Mobilisation mobilisation(const Snapshot<D>& snapshot) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  Mobilisation result;
  for (std::size_t c = 0; c < contacts.mobilised.size(); ++c) {
    const double used = contacts.mobilised[c];
    if (!contacts.touches(c) || std::isnan(used)) continue;
    ++result.contacts;
    result.mean += used;
    if (used >= 1 - sliding_tolerance) ++result.sliding;
  }
  if (result.contacts == 0) return result;
  result.mean /= static_cast<double>(result.contacts);
  result.sliding /= static_cast<double>(result.contacts);
  return result;
}

template Mobilisation mobilisation<2>(const Snapshot<2>&);
template Mobilisation mobilisation<3>(const Snapshot<3>&);

}  // namespace galet
