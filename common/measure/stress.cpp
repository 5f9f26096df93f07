#include "common/measure/stress.hpp"

namespace galet {

// Both sums run in the order of the columns, on one thread: the result has the same bits for any thread count.
template <int D>
StressParts<D> stress(const Snapshot<D>& snapshot) {
  StressParts<D> parts;
  const ContactColumns<D>& contacts = *snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) parts.contact += contacts.force[c] * contacts.branch[c].transpose();
  for (int i = 0; i < snapshot.grains(); ++i)
    parts.kinetic += snapshot.mass[i] * snapshot.velocity[i] * snapshot.velocity[i].transpose();
  const double volume = snapshot.cell->volume();
  parts.contact /= volume;
  parts.kinetic /= volume;
  return parts;
}

template StressParts<2> stress<2>(const Snapshot<2>&);
template StressParts<3> stress<3>(const Snapshot<3>&);

}  // namespace galet
