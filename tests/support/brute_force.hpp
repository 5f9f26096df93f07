// Contacts and overlaps by trying every pair in every image: slow, short, and hard to get wrong.
#pragma once

#include <limits>

#include "common/engine/snapshot.hpp"
#include "common/scene/sample.hpp"

namespace galet::test {

/// Calls visit(i, j, image, b) for every pair i <= j and every image of j within `reach` cells along the periodic
/// directions; of a grain and its own images, only one of each opposite pair.
template <int D, class Visit>
void each_pair(const Sample<D>& sample, const Visit& visit, int reach = 1) {
  int images = 1;
  for (int a = 0; a < D; ++a) images *= 2 * reach + 1;
  for (int code = 0; code < images; ++code) {
    Image<D> image;
    bool possible = true;
    for (int a = 0, rest = code; a < D; ++a, rest /= 2 * reach + 1) {
      image[a] = rest % (2 * reach + 1) - reach;
      possible = possible && (image[a] == 0 || sample.cell.periodic[a]);
    }
    if (!possible) continue;
    const Vec<D> shift = lattice<D>(sample.cell.box, image);
    for (int i = 0; i < sample.count(); ++i)
      for (int j = code > images / 2 ? i : i + 1; j < sample.count(); ++j)
        visit(i, j, image, Vec<D>(sample.position[j] + shift - sample.position[i]));
  }
}

/// Contacts of all pairs with a gap below `least_gap`, with the force force(i, j, gap) along the normal.
template <int D, class Force>
ContactColumns<D> brute_force_contacts(const Sample<D>& sample, double least_gap, const Force& force) {
  ContactColumns<D> contacts;
  each_pair<D>(sample, [&](int i, int j, const Image<D>& image, const Vec<D>& b) {
    const double gap = b.norm() - sample.radius[i] - sample.radius[j];
    if (gap >= least_gap) return;
    contacts.i.push_back(i);
    contacts.j.push_back(j);
    contacts.image.push_back(image);
    contacts.normal.push_back(b.normalized());
    contacts.branch.push_back(b);
    contacts.gap.push_back(gap);
    contacts.force.push_back(force(i, j, gap) * b.normalized());
  });
  return contacts;
}

/// The smallest gap between any two grains, images included.
template <int D>
double least_gap(const Sample<D>& sample) {
  double least = std::numeric_limits<double>::infinity();
  each_pair<D>(sample, [&](int i, int j, const Image<D>&, const Vec<D>& b) {
    least = std::min(least, b.norm() - sample.radius[i] - sample.radius[j]);
  });
  return least;
}

/// A snapshot of a sample at rest in memory; both must outlive it.
template <int D>
Snapshot<D> snapshot_of(const Sample<D>& sample, const ContactColumns<D>& contacts) {
  Snapshot<D> snapshot;
  snapshot.engine = "md";
  snapshot.cell = &sample.cell;
  snapshot.planes = sample.planes;
  snapshot.position = sample.position;
  snapshot.velocity = sample.velocity;
  snapshot.spin = sample.spin;
  snapshot.radius = sample.radius;
  snapshot.mass = sample.mass;
  snapshot.contacts = &contacts;
  return snapshot;
}

}  // namespace galet::test
