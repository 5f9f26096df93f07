// The contact problem of one step, as plain data: no scene, no neighbour lists, no time.
//
//   find u, r with   M (v - v_free) = H r,   u = H^T v + (terms of the hub),   and at each contact
//   0 <= u_N + offset + C_N r_N  perp  r_N >= 0
//   norm(r_T) <= mu r_N,        r_T opposite to   u_T + lag_T + C_T r_T          when sliding (zero when sticking)
//   norm(gamma_R) <= mu_R r_N,  gamma_R opposite to the rotation w_j - w_i + lag + C_R gamma in the tangent plane
//   |gamma_P| <= mu_P r_N       the same about the normal (spheres)
//
// gamma: impulse of the torque on j (-gamma on i). mu_R and mu_P are lengths. Rigid contacts have no C (compliance);
// lag holds what is known of the tangential motion: e_T times the one before the step, or the elastic impulse before
// it (cd/laws/compliance.hpp). Attraction is not in the problem: it is an external force of known size, and r the
// repulsive part, so that bounds refer to r (cd/laws/attraction.hpp).
//
// H is never formed: disks and spheres need the normal, the lever arms and the distance of each contact. The block of
// the Delassus operator W = H^T M^-1 H of one contact is diagonal for disks and spheres (W_NN and W_TT times the
// identity), but for one number: with c = l_i/I_i - l_j/I_j, rolling turns u_T and friction turns the spins,
//   n x u_T += c gamma_R,   rotation += c n x r_T       (c = 0 between equal grains).
//
// The stress-driven cell is a hub: a body that every contact touches. Its velocity is L = sum of rate_k G_k over its
// modes, u contains L b with b = distance * n, and an impulse r changes rate_k by (r (x) b) : G_k / inertia_k.
//
// Planes, and then rigid bodies, are bodies after the grains. Where forces may move them they have a mobility, a
// symmetric matrix: n (x) n / M of a plane that is free along its normal, diagonal for a rigid body. Grains that are
// glued to a rigid body are no bodies of the problem: their contacts are the rigid body's. Where one turns, its
// contacts have a lever of their own, from its centre to the contact point, and their block of W is full:
//   u = v_j + w_j x lever_j - v_i - w_i x lever_i + L b,   dw = A (lever x p + gamma),  A the body's rotational
//   mobility
// They come after the other contacts (`first_turning`), so that those keep their closed form and their cost.
//
// Contacts are stored grouped by colour (common/graph/colouring.hpp), those of disks and spheres first. Units: those of
// the scene; impulses are force * time, offset is a velocity. Signs: core/conventions.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/core/column.hpp"
#include "common/core/layout.hpp"
#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"
#include "common/geometry/rigid_body.hpp"

namespace galet::cd {

/// Numbers that an impulse has: 1 frictionless, D with friction; rolling adds 1 (disks) or 3 (spheres).
constexpr int block_size(Layout layout) {
  if (!layout.friction) return 1;
  return layout.dim + (layout.rolling ? (layout.dim == 2 ? 1 : 3) : 0);
}

/// The impulse of one contact. Frictionless: r_N. Disks: (r_N, r_T along the tangent (-n_y, n_x)[, gamma]). Spheres:
/// the vectors r [and gamma] themselves in the fixed frame, so that no tangent frame is needed.
template <Layout Y>
using Reaction = Vec<block_size(Y)>;

/// Impulse, or motion, of a contact by direction. Tangential and rolling parts are scalars for disks (the tangential
/// one along (-n_y, n_x)) and vectors of the tangent plane for spheres.
template <Layout Y>
struct Components {
  double normal = 0;
  Spin<Y.dim> tangential = zero_spin<Y.dim>();
  Spin<Y.dim> rolling = zero_spin<Y.dim>();
  double pivoting = 0;
};

/// The bounds of a pair of materials.
struct ContactLaw {
  double friction = 0;  ///< mu
  double rolling = 0;   ///< mu_R (length)
  double pivoting = 0;  ///< mu_P (length)
};

/// C: motion that an impulse of one unit leaves in an elastic contact (1 / mass, rotations 1 / inertia).
struct Compliance {
  double normal = 0, tangential = 0, rolling = 0, pivoting = 0;
};

/// A stress-driven mode of the cell inside the problem.
template <int D>
struct HubMode {
  Mat<D> direction;        ///< G
  double inverse_inertia;  ///< 1 / (mass * length^2)
};

/// A contact of a body that turns. W: the block of the Delassus operator by the contact's own directions
/// (laws/turning_contact.hpp). branch: from the centre of body i to that of body j.
template <Layout Y>
struct TurningContact {
  static constexpr int D = Y.dim;
  using Block = Eigen::Matrix<double, block_size(Y), block_size(Y), Eigen::RowMajor>;
  Vec<D> branch = Vec<D>::Zero();
  Vec<D> lever_i = Vec<D>::Zero(), lever_j = Vec<D>::Zero();
  Block w = Block::Zero();
};

/// Directions across a normal, by column: (-n_y, n_x); in 3D any one and then n x t1.
template <int D>
inline Eigen::Matrix<double, D, D - 1> across(const Vec<D>& n) {
  Eigen::Matrix<double, D, D - 1> tangents;
  if constexpr (D == 2) {
    tangents = Vec<2>(-n.y(), n.x());
  } else {
    tangents.col(0) = n.unitOrthogonal();
    tangents.col(1) = n.cross(tangents.col(0));
  }
  return tangents;
}

template <Layout Y>
struct Problem {
  static constexpr int D = Y.dim;

  // Bodies: the grains, the planes, the rigid bodies (the latter two with inverse mass 0 and the mobility below).
  int grains = 0;
  Column<double> inverse_mass;
  Column<double, Y.friction> inverse_inertia;
  std::vector<HubMode<D>> hub;
  std::vector<Mat<D>> mobility;     ///< of planes and rigid bodies; empty: forces move none of them
  std::vector<SpinMap<D>> turning;  ///< A of planes and rigid bodies; empty: none of them turns, or none freely

  // Contacts. W holds the compliance where there is one.
  std::vector<ContactLaw> laws;  ///< by pair of materials
  bool lagged = false;           ///< `lag` holds something
  bool compliant = false;        ///< `compliance` holds something
  Column<int> i, j;
  Column<Vec<D>> normal;                    ///< n
  Column<double> distance;                  ///< |b|
  Column<double> offset;                    ///< of u_N
  Column<double> wn, inverse_wn;            ///< W_NN and 1 / W_NN (both 0 where nothing can move the contact)
  Column<std::uint8_t, Y.friction> law;     ///< index into `laws`
  Column<double, Y.friction> inverse_wt;    ///< 1 / W_TT
  Column<double, Y.friction> arm_i, arm_j;  ///< l_i, l_j
  Column<double, Y.rolling> wr, wp;         ///< W of rolling and pivoting (0 where nothing can turn the contact)
  Column<double, Y.rolling> coupling;       ///< c
  Column<Reaction<Y>, Y.friction> lag;      ///< of the tangential motion; its normal part is not used
  Column<Compliance> compliance;
  std::size_t first_turning = SIZE_MAX;        ///< contacts from here on are those of bodies that turn
  Column<TurningContact<Y>, Y.friction> bent;  ///< of contact first_turning + k
  std::vector<int> group;                      ///< contacts group[c] .. group[c + 1] have one colour
  std::array<int, 2> shared = {-1, -1};        ///< groups that are no colour: their contacts share bodies (-1: none)

  std::size_t size() const { return i.size(); }
  bool mobile(int body) const { return body >= grains && !mobility.empty(); }
  /// Whether impulses turn the plane or rigid body.
  bool spun(int body) const { return body >= grains && !turning.empty(); }
  bool turns(std::size_t k) const { return k >= first_turning; }

  /// Memory for this many contacts.
  void reserve(std::size_t contacts) {
    each_column([&](auto& column) { column.reserve(contacts); });
  }
  void resize(std::size_t contacts) {
    each_column([&](auto& column) { column.resize(contacts); });
    if (!lagged) lag.clear();
    if (!compliant) compliance.clear();
  }

 private:
  template <class Visit>
  void each_column(const Visit& visit) {
    visit(i), visit(j), visit(normal), visit(distance), visit(offset), visit(wn), visit(inverse_wn), visit(law);
    visit(inverse_wt), visit(arm_i), visit(arm_j), visit(wr), visit(wp), visit(coupling);
    if (lagged) visit(lag);
    if (compliant) visit(compliance);
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

// Functions of a contact below have a parameter MayTurn: false where the caller knows that the contact is none of a
// body that turns, as in the sweeps of the solver, whose speed it decides.

/// b of contact k: what the cell moves apart, from centre to centre of the two bodies.
template <Layout Y, bool MayTurn = true>
inline Vec<Y.dim> branch_of(const Problem<Y>& problem, std::size_t k) {
  if constexpr (Y.friction && MayTurn)
    if (problem.turns(k)) [[unlikely]]
      return problem.bent[k - problem.first_turning].branch;
  return problem.distance[k] * problem.normal[k];
}

/// Relative velocity u of contact k, spin terms included, for the velocity gradient L of the cell.
template <Layout Y, bool MayTurn = true>
inline Vec<Y.dim> relative_velocity(const Problem<Y>& problem, const Iterate<Y>& iterate, const Mat<Y.dim>& gradient,
                                    std::size_t k) {
  constexpr int D = Y.dim;
  const int i = problem.i[k], j = problem.j[k];
  const Vec<D>& n = problem.normal[k];
  if constexpr (Y.friction && MayTurn) {
    if (problem.turns(k)) [[unlikely]] {
      const TurningContact<Y>& bent = problem.bent[k - problem.first_turning];
      return iterate.velocity[j] - iterate.velocity[i] + gradient * bent.branch + cross(iterate.spin[j], bent.lever_j) -
             cross(iterate.spin[i], bent.lever_i);
    }
  }
  Vec<D> u = iterate.velocity[j] - iterate.velocity[i] + problem.distance[k] * (gradient * n);
  if constexpr (Y.friction) {
    const Spin<D> rolling = problem.arm_i[k] * iterate.spin[i] + problem.arm_j[k] * iterate.spin[j];
    u -= cross(rolling, n);
  }
  return u;
}

/// The impulse of a contact as a vector.
template <Layout Y>
inline Vec<Y.dim> impulse_vector(const Vec<Y.dim>& normal, const Reaction<Y>& reaction) {
  if constexpr (!Y.friction)
    return reaction[0] * normal;
  else if constexpr (Y.dim == 2)
    return Vec<2>(reaction[0] * normal + reaction[1] * Vec<2>(-normal.y(), normal.x()));
  else
    return reaction.template head<3>();
}

/// The torque impulse of a contact on j.
template <Layout Y>
inline Spin<Y.dim> torque_impulse(const Reaction<Y>& reaction) {
  if constexpr (!Y.rolling)
    return zero_spin<Y.dim>();
  else if constexpr (Y.dim == 2)
    return reaction[2];
  else
    return reaction.template tail<3>();
}

template <Layout Y>
inline Components<Y> components(const Vec<Y.dim>& normal, const Reaction<Y>& reaction) {
  Components<Y> parts;
  if constexpr (Y.friction && Y.dim == 3) {
    const Vec<3> p = reaction.template head<3>();
    parts.normal = normal.dot(p);
    parts.tangential = p - parts.normal * normal;
    if constexpr (Y.rolling) {
      const Vec<3> gamma = reaction.template tail<3>();
      parts.pivoting = normal.dot(gamma);
      parts.rolling = gamma - parts.pivoting * normal;
    }
  } else {
    parts.normal = reaction[0];
    if constexpr (Y.friction) parts.tangential = reaction[1];
    if constexpr (Y.rolling) parts.rolling = reaction[2];
  }
  return parts;
}

template <Layout Y>
inline Reaction<Y> composed(const Vec<Y.dim>& normal, const Components<Y>& parts) {
  Reaction<Y> reaction;
  if constexpr (Y.friction && Y.dim == 3) {
    reaction.template head<3>() = parts.normal * normal + parts.tangential;
    if constexpr (Y.rolling) reaction.template tail<3>() = parts.pivoting * normal + parts.rolling;
  } else {
    reaction[0] = parts.normal;
    if constexpr (Y.friction) reaction[1] = parts.tangential;
    if constexpr (Y.rolling) reaction[2] = parts.rolling;
  }
  return reaction;
}

/// |r_T| over its bound mu r_N, at most 1; not a number without friction.
template <Layout Y>
inline double mobilised_friction(const Vec<Y.dim>& normal, const Reaction<Y>& reaction, double friction) {
  if (!(friction > 0)) return std::numeric_limits<double>::quiet_NaN();
  const Components<Y> parts = components<Y>(normal, reaction);
  const double tangential = std::sqrt(squared(parts.tangential));
  return tangential > 0 ? tangential / std::max(friction * parts.normal, tangential) : 0;
}

/// Relative motion of contact k by direction, for the velocity gradient L of the cell.
template <Layout Y, bool MayTurn = true>
inline Components<Y> relative_motion(const Problem<Y>& problem, const Iterate<Y>& iterate, const Mat<Y.dim>& gradient,
                                     std::size_t k) {
  const Vec<Y.dim>& n = problem.normal[k];
  const Vec<Y.dim> u = relative_velocity<Y, MayTurn>(problem, iterate, gradient, k);
  Components<Y> motion;
  motion.normal = n.dot(u);
  if constexpr (Y.friction) {
    if constexpr (Y.dim == 2)
      motion.tangential = cross(n, u);
    else
      motion.tangential = u - motion.normal * n;
  }
  if constexpr (Y.rolling) {
    motion.rolling = iterate.spin[problem.j[k]] - iterate.spin[problem.i[k]];
    if constexpr (Y.dim == 3) {
      motion.pivoting = n.dot(motion.rolling);
      motion.rolling -= motion.pivoting * n;
    }
  }
  return motion;
}

/// The motion that the laws are about: with offset, lag and compliance. `r` is the contact's impulse.
template <Layout Y, bool MayTurn = true>
inline Components<Y> law_motion(const Problem<Y>& problem, const Iterate<Y>& iterate, const Mat<Y.dim>& gradient,
                                std::size_t k, const Components<Y>& r) {
  Components<Y> motion = relative_motion<Y, MayTurn>(problem, iterate, gradient, k);
  motion.normal += problem.offset[k];
  if constexpr (Y.friction) {
    if (problem.lagged) {
      const Components<Y> lag = components<Y>(problem.normal[k], problem.lag[k]);
      motion.tangential += lag.tangential;
      if constexpr (Y.rolling) motion.rolling += lag.rolling, motion.pivoting += lag.pivoting;
    }
  }
  if (!problem.compliant) return motion;
  const Compliance& compliance = problem.compliance[k];
  motion.normal += compliance.normal * r.normal;
  if constexpr (Y.friction) motion.tangential += compliance.tangential * r.tangential;
  if constexpr (Y.rolling) {
    motion.rolling += compliance.rolling * r.rolling;
    motion.pivoting += compliance.pivoting * r.pivoting;
  }
  return motion;
}

/// Squared norm of an impulse with the weight of the contact's block: twice an energy.
template <Layout Y>
inline double weighted_square(const Problem<Y>& problem, std::size_t k, const Reaction<Y>& reaction) {
  if constexpr (!Y.rolling) {
    return reaction.squaredNorm() * problem.wn[k];
  } else {
    constexpr int D = Y.dim;
    return reaction.template head<D>().squaredNorm() * problem.wn[k] +
           reaction.template tail<block_size(Y) - D>().squaredNorm() * problem.wr[k];
  }
}

/// Adds the impulse p to the velocity of a body.
template <Layout Y>
inline void push(const Problem<Y>& problem, Iterate<Y>& iterate, int body, const Vec<Y.dim>& p) {
  if (body < problem.grains)
    iterate.velocity[body] += problem.inverse_mass[body] * p;
  else if (problem.mobile(body))
    iterate.velocity[body] += problem.mobility[body - problem.grains] * p;
}

/// Adds the torque impulse gamma to the spin of a body.
template <Layout Y>
inline void twist(const Problem<Y>& problem, Iterate<Y>& iterate, int body, const Spin<Y.dim>& gamma) {
  if (body < problem.grains)
    iterate.spin[body] += problem.inverse_inertia[body] * gamma;
  else if (problem.spun(body))
    iterate.spin[body] += problem.turning[body - problem.grains] * gamma;
}

/// Adds the impulse p that acts at `lever` from the centre of a body to its velocity and spin.
template <Layout Y>
inline void push_at(const Problem<Y>& problem, Iterate<Y>& iterate, int body, const Vec<Y.dim>& lever,
                    const Vec<Y.dim>& p) {
  push(problem, iterate, body, p);
  if constexpr (Y.friction) twist(problem, iterate, body, cross(lever, p));
}

/// Adds the impulse p (on j, -p on i) of contact k to the velocities of its bodies; the hub is the caller's.
template <Layout Y, bool MayTurn = true>
inline void add_impulse(const Problem<Y>& problem, Iterate<Y>& iterate, std::size_t k, const Vec<Y.dim>& p) {
  const int i = problem.i[k], j = problem.j[k];
  if constexpr (Y.friction && MayTurn) {
    if (problem.turns(k)) [[unlikely]] {
      const TurningContact<Y>& bent = problem.bent[k - problem.first_turning];
      push_at(problem, iterate, i, bent.lever_i, Vec<Y.dim>(-p));
      return push_at(problem, iterate, j, bent.lever_j, p);
    }
  }
  push(problem, iterate, i, Vec<Y.dim>(-p));
  push(problem, iterate, j, p);
  if constexpr (Y.friction) {
    const Spin<Y.dim> turn = cross(problem.normal[k], p);
    iterate.spin[i] -= (problem.arm_i[k] * problem.inverse_inertia[i]) * turn;
    iterate.spin[j] -= (problem.arm_j[k] * problem.inverse_inertia[j]) * turn;
  }
}

/// Adds the torque impulse gamma (on j, -gamma on i) of contact k to the spins of its bodies.
template <Layout Y, bool MayTurn = true>
inline void add_torque(const Problem<Y>& problem, Iterate<Y>& iterate, std::size_t k, const Spin<Y.dim>& gamma) {
  static_assert(Y.rolling, "only layouts with rolling have torques");
  if constexpr (MayTurn) {
    if (problem.turns(k)) [[unlikely]] {
      twist(problem, iterate, problem.i[k], Spin<Y.dim>(-gamma));
      return twist(problem, iterate, problem.j[k], gamma);
    }
  }
  iterate.spin[problem.i[k]] -= problem.inverse_inertia[problem.i[k]] * gamma;
  iterate.spin[problem.j[k]] += problem.inverse_inertia[problem.j[k]] * gamma;
}

/// Adds a whole impulse of contact k to its bodies and p (x) b to the virial that the hub will be given.
template <Layout Y, bool MayTurn = true>
inline void add_reaction(const Problem<Y>& problem, Iterate<Y>& iterate, std::size_t k, const Reaction<Y>& reaction,
                         Mat<Y.dim>& virial) {
  const Vec<Y.dim> p = impulse_vector<Y>(problem.normal[k], reaction);
  add_impulse<Y, MayTurn>(problem, iterate, k, p);
  if constexpr (Y.rolling) add_torque<Y, MayTurn>(problem, iterate, k, torque_impulse<Y>(reaction));
  virial += p * branch_of<Y, MayTurn>(problem, k).transpose();
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
