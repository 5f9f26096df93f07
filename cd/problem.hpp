// The contact problem of one step, as plain data: no scene, no neighbour lists, no time.
//
//   find u, r with   M (v - v_free) = H r,   u = H^T v + (terms of the hub),   and at each contact
//   0 <= u_N + offset  perp  r_N >= 0,      norm(r_T) <= mu r_N, r_T opposite to u_T when sliding.
//
// H is never formed: disks and spheres need the normal, the lever arms and the distance of each contact. The block of
// the Delassus operator W = H^T M^-1 H of one contact is diagonal for disks and spheres (W_NN and W_TT times the
// identity), so that one contact's problem has a closed form.
//
// The stress-driven cell is a hub: a body that every contact touches. Its velocity is L = sum of rate_k G_k over its
// modes, u contains L b with b = distance * n, and an impulse r changes rate_k by (r (x) b) : G_k / inertia_k.
//
// Contacts are stored grouped by colour (common/graph/colouring.hpp). Units: those of the scene; impulses are
// force * time, offset is a velocity. Signs: core/conventions.hpp.
#pragma once

#include <vector>

#include "common/core/column.hpp"
#include "common/core/layout.hpp"
#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"

namespace galet::cd {

/// The impulse of one contact. Frictionless: r_N. Disks: (r_N, r_T along the tangent (-n_y, n_x)). Spheres: the
/// vector itself in the fixed frame, so that no tangent frame is needed.
template <Layout Y>
struct ReactionOf {
  using type = Vec<Y.dim>;
};
template <>
struct ReactionOf<Layout{2, false}> {
  using type = Vec<1>;
};
template <>
struct ReactionOf<Layout{3, false}> {
  using type = Vec<1>;
};
template <Layout Y>
using Reaction = typename ReactionOf<Y>::type;

/// A stress-driven mode of the cell inside the problem.
template <int D>
struct HubMode {
  Mat<D> direction;        ///< G
  double inverse_inertia;  ///< 1 / (mass * length^2)
};

template <Layout Y>
struct Problem {
  static constexpr int D = Y.dim;

  // Bodies: the grains, then the planes (inverse mass 0).
  Column<double> inverse_mass;
  Column<double, Y.friction> inverse_inertia;
  std::vector<HubMode<D>> hub;

  // Contacts.
  double friction = 0;  ///< mu
  Column<int> i, j;
  Column<Vec<D>> normal;                    ///< n
  Column<double> distance;                  ///< |b|
  Column<double> offset;                    ///< u_N + offset >= 0
  Column<double> wn, inverse_wn;            ///< W_NN and 1 / W_NN (both 0 where nothing can move the contact)
  Column<double, Y.friction> inverse_wt;    ///< 1 / W_TT
  Column<double, Y.friction> arm_i, arm_j;  ///< l_i, l_j
  std::vector<int> group;                   ///< contacts group[c] .. group[c + 1] have one colour
  bool sequential_tail = false;             ///< the last group's contacts share bodies

  std::size_t size() const { return i.size(); }

  /// Memory for this many contacts.
  void reserve(std::size_t contacts) {
    i.reserve(contacts), j.reserve(contacts), normal.reserve(contacts), distance.reserve(contacts);
    offset.reserve(contacts), wn.reserve(contacts), inverse_wn.reserve(contacts), inverse_wt.reserve(contacts);
    arm_i.reserve(contacts), arm_j.reserve(contacts);
  }

  void resize(std::size_t contacts) {
    i.resize(contacts), j.resize(contacts), normal.resize(contacts), distance.resize(contacts);
    offset.resize(contacts), wn.resize(contacts), inverse_wn.resize(contacts), inverse_wt.resize(contacts);
    arm_i.resize(contacts), arm_j.resize(contacts);
  }
};

/// What changes while a problem is solved: impulses and the velocities that follow from them.
template <Layout Y>
struct Iterate {
  static constexpr int D = Y.dim;
  Column<Vec<D>> velocity;  ///< of the bodies, planes included
  Column<Spin<D>, Y.friction> spin;
  std::vector<double> hub_rate;      ///< of the hub's modes
  Mat<D> gradient = Mat<D>::Zero();  ///< L: rate-driven part and hub
  Column<Reaction<Y>> reaction;
};

/// Relative velocity u of contact k, spin terms included, for the velocity gradient L of the cell.
template <Layout Y>
inline Vec<Y.dim> relative_velocity(const Problem<Y>& problem, const Iterate<Y>& iterate, const Mat<Y.dim>& gradient,
                                    std::size_t k) {
  constexpr int D = Y.dim;
  const int i = problem.i[k], j = problem.j[k];
  const Vec<D>& n = problem.normal[k];
  Vec<D> u = iterate.velocity[j] - iterate.velocity[i] + problem.distance[k] * (gradient * n);
  if constexpr (Y.friction) {
    const Spin<D> rolling = problem.arm_i[k] * iterate.spin[i] + problem.arm_j[k] * iterate.spin[j];
    u -= cross(rolling, n);
  }
  return u;
}

/// The impulse of contact k as a vector.
template <Layout Y>
inline Vec<Y.dim> impulse_vector(const Vec<Y.dim>& normal, const Reaction<Y>& reaction) {
  if constexpr (!Y.friction)
    return reaction[0] * normal;
  else if constexpr (Y.dim == 2)
    return Vec<2>(reaction[0] * normal + reaction[1] * Vec<2>(-normal.y(), normal.x()));
  else
    return reaction;
}

/// Adds the impulse p (on j, -p on i) of contact k to the velocities of its bodies; the hub is the caller's.
template <Layout Y>
inline void add_impulse(const Problem<Y>& problem, Iterate<Y>& iterate, std::size_t k, const Vec<Y.dim>& p) {
  const int i = problem.i[k], j = problem.j[k];
  iterate.velocity[i] -= problem.inverse_mass[i] * p;
  iterate.velocity[j] += problem.inverse_mass[j] * p;
  if constexpr (Y.friction) {
    const Spin<Y.dim> turn = cross(problem.normal[k], p);
    iterate.spin[i] -= (problem.arm_i[k] * problem.inverse_inertia[i]) * turn;
    iterate.spin[j] -= (problem.arm_j[k] * problem.inverse_inertia[j]) * turn;
  }
}

/// Adds the hub's answer to the impulses whose sum of p (x) b is `virial`.
template <Layout Y>
inline void add_to_hub(const Problem<Y>& problem, Iterate<Y>& iterate, const Mat<Y.dim>& virial) {
  for (std::size_t m = 0; m < problem.hub.size(); ++m) {
    const HubMode<Y.dim>& mode = problem.hub[m];
    const double change = virial.cwiseProduct(mode.direction).sum() * mode.inverse_inertia;
    iterate.hub_rate[m] += change;
    iterate.gradient += change * mode.direction;
  }
}

}  // namespace galet::cd
