// Coordination numbers of the force-carrying contact network. (Pairs that attract across a gap are no contacts.)
//   z  = (2 N_gg + N_gw) / N          all grains; N_gg grain-grain, N_gw grain-wall contacts
//   z* = the same on the backbone: without rattlers and their contacts, divided by the grains that remain
// A rattler can't be in equilibrium by its contacts alone: it has fewer than D + 1 (frictionless) or fewer than
// 2 (frictional) contacts with planes and with grains that are no rattlers (found by removing them repeatedly).
// Source: chapter, sec. comp; Agnolin and Roux 2007. A self-image contact counts twice for its grain. Cost: a few
// passes.
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

struct Coordination {
  double z = 0;
  double z_star = 0;
  double rattler_fraction = 0;
  long contacts = 0;
};

template <int D>
Coordination coordination(const Snapshot<D>& snapshot, bool friction);

/// For each grain 1 when it is a rattler, else 0.
template <int D>
std::vector<char> rattlers(const Snapshot<D>& snapshot, bool friction);

extern template Coordination coordination<2>(const Snapshot<2>&, bool);
extern template Coordination coordination<3>(const Snapshot<3>&, bool);
extern template std::vector<char> rattlers<2>(const Snapshot<2>&, bool);
extern template std::vector<char> rattlers<3>(const Snapshot<3>&, bool);

}  // namespace galet
