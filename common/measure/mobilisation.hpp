// How much of the friction the contacts use.
//   mobilised friction of a contact   M = |F_T| / (mu F_b), in [0, 1]
//   sliding contact                   M = 1
// F_b is what Coulomb's bound refers to in the engine that ran: the repulsive part of the normal force, without
// attraction (md, `elastic`: without its viscous part either). Engines fill ContactColumns::mobilised by their own
// laws. Contacts with planes count; pairs without friction and pairs that don't touch do not.
// The mean is 0 and the share 0 without such contacts. Source: chapter, eq. coulomb. Cost: one pass.
#pragma once

#include "common/engine/snapshot.hpp"

namespace galet {

struct Mobilisation {
  double mean = 0;     ///< <M>
  double sliding = 0;  ///< share of the contacts that slide
  long contacts = 0;
};

/// Projections and returns onto the bound end on it to rounding, which later turns of the contact, and the difference
/// of two nearly equal distances in a soft deflection of 1e-6 d, make 1e-10; nothing physical is that near to it.
inline constexpr double sliding_tolerance = 1e-8;

template <int D>
Mobilisation mobilisation(const Snapshot<D>& snapshot);

extern template Mobilisation mobilisation<2>(const Snapshot<2>&);
extern template Mobilisation mobilisation<3>(const Snapshot<3>&);

}  // namespace galet
