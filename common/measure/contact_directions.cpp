#include "common/measure/contact_directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/core/error.hpp"

namespace galet {

template <int D>
std::vector<DirectionRow> contact_directions(const Snapshot<D>& snapshot, int sectors, std::array<int, 2> axes) {
  require(sectors > 0, "a histogram of directions needs sectors");
  require(axes[0] != axes[1] && std::min(axes[0], axes[1]) >= 0 && std::max(axes[0], axes[1]) < D,
          "a histogram of directions needs two axes of the space");
  const ContactColumns<D>& contacts = *snapshot.contacts;
  std::vector<DirectionRow> rows(static_cast<std::size_t>(sectors));
  long count = 0;
  double normal_sum = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!contacts.touches(c) || contacts.j[c] >= snapshot.grains()) continue;
    const Vec<D>&normal = contacts.normal[c], &force = contacts.force[c];
    const Vec<2> flat(normal[axes[0]], normal[axes[1]]), across(force[axes[0]], force[axes[1]]);
    if (!(flat.norm() > 0)) continue;
    double angle = std::atan2(flat.y(), flat.x());
    if (angle < 0) angle += std::numbers::pi;
    const int sector = std::min(static_cast<int>(angle / std::numbers::pi * sectors), sectors - 1);
    // -n with -F is the same contact seen from its other grain: t turns with n, so both are even.
    const Vec<2> turned = Vec<2>(-flat.y(), flat.x()) / flat.norm();
    const double along = force.dot(normal);
    const Vec<2> rest = across - along * flat;
    DirectionRow& row = rows[static_cast<std::size_t>(angle >= std::numbers::pi ? 0 : sector)];
    ++row.contacts;
    row.normal_force += along;
    row.tangential_force += rest.dot(turned);
    normal_sum += along;
    ++count;
  }
  if (count == 0) return {};
  const double mean = normal_sum / static_cast<double>(count);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    DirectionRow& row = rows[k];
    row.angle = (static_cast<double>(k) + 0.5) * std::numbers::pi / sectors;
    row.density = static_cast<double>(row.contacts) * sectors / static_cast<double>(count);
    const double scale = mean > 0 && row.contacts > 0 ? 1 / (mean * static_cast<double>(row.contacts))
                                                      : std::numeric_limits<double>::quiet_NaN();
    row.normal_force *= scale;
    row.tangential_force *= scale;
  }
  return rows;
}

template std::vector<DirectionRow> contact_directions<2>(const Snapshot<2>&, int, std::array<int, 2>);
template std::vector<DirectionRow> contact_directions<3>(const Snapshot<3>&, int, std::array<int, 2>);

}  // namespace galet
