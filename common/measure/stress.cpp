#include "common/measure/stress.hpp"

namespace galet {

// Both sums run in the order of the columns, on one thread: the result has the same bits for any thread count.
template <int D>
StressParts<D> stress(const Snapshot<D>& snapshot) {
  StressParts<D> parts;
  const ContactColumns<D>& contacts = *snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Vec<D> branch = contacts.branch[c];
    if (snapshot.in_free_body(contacts.i[c])) branch += snapshot.arm[contacts.i[c]];
    if (snapshot.in_free_body(contacts.j[c])) branch -= snapshot.arm[contacts.j[c]];
    parts.contact += contacts.force[c] * branch.transpose();
  }
  for (int i = 0; i < snapshot.grains(); ++i)
    if (!snapshot.in_free_body(i))
      parts.kinetic += snapshot.mass[i] * snapshot.velocity[i] * snapshot.velocity[i].transpose();
  for (const RigidBody<D>& body : snapshot.bodies)
    if (body.is_free()) parts.kinetic += body.mass * body.velocity * body.velocity.transpose();
  const double volume = snapshot.cell->volume();
  parts.contact /= volume;
  parts.kinetic /= volume;
  return parts;
}

template StressParts<2> stress<2>(const Snapshot<2>&);
template StressParts<3> stress<3>(const Snapshot<3>&);

}  // namespace galet
