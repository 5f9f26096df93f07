// Stress tensor of a sample.
//   sigma = (1/V) (sum over contacts of F (x) b + sum over grains of m v (x) v)
// F force on j, b branch vector from i to j, v velocity fluctuation, V volume of the cell; positive in compression.
// Source: Love-Weber average; chapter, eq. for sigma; physics notation in core/conventions.hpp.
// A rigid body that is free in every way counts as one grain: b is between centres of bodies, v and m are the body's.
// Contacts with planes count with the branch from the grain's centre to the contact point. Cost: one pass.
#pragma once

#include "common/engine/snapshot.hpp"

namespace galet {

template <int D>
struct StressParts {
  Mat<D> contact = Mat<D>::Zero();
  Mat<D> kinetic = Mat<D>::Zero();
  Mat<D> total() const { return contact + kinetic; }
};

template <int D>
StressParts<D> stress(const Snapshot<D>& snapshot);

extern template StressParts<2> stress<2>(const Snapshot<2>&);
extern template StressParts<3> stress<3>(const Snapshot<3>&);

}  // namespace galet
