// Contact pass: one force per listed pair, from positions and the velocities that contacts see.
//
// Each row is written by its own iteration only; sums over contacts (the contact part of V sigma, powers) are kept per
// chunk and added in the order of the chunks. So the result has the same bits for any number of threads.
#pragma once

#include <span>

#include "common/core/parallel.hpp"
#include "common/engine/bodies.hpp"
#include "common/geometry/contact_frame.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/contacts.hpp"
#include "md/laws/normal.hpp"
#include "md/laws/spring.hpp"

namespace galet::md {

/// What contacts see of the motion: velocities predicted for the time of the positions.
template <Layout Y>
struct Seen {
  Column<Vec<Y.dim>> velocity;
  Column<Spin<Y.dim>, Y.friction> spin;
  Mat<Y.dim> gradient = Mat<Y.dim>::Zero();  ///< L
};

/// The laws of one pass.
struct PassLaw {
  std::span<const PairTerms> terms;  ///< by pair of materials
  double range;                      ///< largest D0
  double half_before;                ///< half the time since the last pass (0 at the very start)
  double half_after;                 ///< half the time to the next one
  Kernel kernel;
};

/// Sums over the contacts of one pass.
template <int D>
struct PassSums {
  Mat<D> virial = Mat<D>::Zero();  ///< contact part of V sigma, sum of F (x) b
  Losses normal, sliding, rolling, pivoting;
  double plane_power = 0;  ///< of moving planes on the grains

  void add(const PassSums& other) {
    virial += other.virial;
    plane_power += other.plane_power;
    add(normal, other.normal), add(sliding, other.sliding);
    add(rolling, other.rolling), add(pivoting, other.pivoting);
  }

 private:
  static void add(Losses& to, const Losses& from) {
    to.viscous += from.viscous, to.plastic += from.plastic, to.unloading += from.unloading;
  }
};

template <Layout Y>
class ContactPass {
 public:
  static constexpr int D = Y.dim;

  /// Writes the rows of `contacts`.
  PassSums<D> run(const Bodies<Y>& bodies, const Seen<Y>& seen, const VerletList<D>& list, const PassLaw& law,
                  Contacts<Y>& contacts) {
    const std::size_t rows = list.size();
    refill(partial_, chunk_count(rows), PassSums<D>{});
    if (law.kernel.account)
      evaluate<Kernel{true, false, true}>(bodies, seen, list, law, contacts);
    else if (law.kernel.general)
      evaluate<Kernel{true, false, false}>(bodies, seen, list, law, contacts);
    else if (law.kernel.hertz)
      evaluate<Kernel{false, true, false}>(bodies, seen, list, law, contacts);
    else
      evaluate<Kernel{false, false, false}>(bodies, seen, list, law, contacts);
    PassSums<D> sums;
    for (const PassSums<D>& part : partial_) sums.add(part);
    return sums;
  }

 private:
  template <Kernel K>
  void evaluate(const Bodies<Y>& bodies, const Seen<Y>& seen, const VerletList<D>& list, const PassLaw& law,
                Contacts<Y>& contacts) {
    parallel_chunks(list.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      Row<K> state{bodies, seen, law, contacts, {}};
      for (std::size_t row = begin; row < end; ++row) state.evaluate(list.pairs(), row);
      partial_[chunk] = state.sums;
    });
  }

  /// The evaluation of rows, one after the other, with the sums over them.
  template <Kernel K>
  struct Row {
    const Bodies<Y>& bodies;
    const Seen<Y>& seen;
    const PassLaw& law;
    Contacts<Y>& contacts;
    PassSums<D> sums;

    double range() const { return K.general ? law.range : 0; }
    const PairTerms& terms_of(std::size_t row) const { return law.terms[K.general ? contacts.law[row] : 0]; }
    bool varying() const { return K.general ? contacts.varying_stiffness : K.hertz; }

    GALET_INLINE void evaluate(const PairColumns<D>& pairs, std::size_t row) {
      const int i = pairs.i[row], j = pairs.j[row], grains = bodies.grains();
      if (j < grains) {
        const Vec<D> branch = bodies.position[j] - bodies.position[i] + lattice<D>(bodies.cell.box, pairs.image[row]);
        const double distance_squared = branch.squaredNorm();
        const double reach = bodies.radius[i] + bodies.radius[j] + range();
        if (distance_squared >= reach * reach) return part(row);
        const auto frame = grain_frame<D>(branch, distance_squared, bodies.radius[i], bodies.radius[j]);
        if (K.general && law.range > 0 && frame.gap >= 0) return attract(frame, row);
        touch(frame, seen.velocity[j] - seen.velocity[i] + seen.gradient * branch, i, j, row);
      } else {
        const Plane<D>& plane = bodies.planes[j - grains];
        const auto frame = plane_frame<D>(bodies.position[i], bodies.radius[i], plane);
        if (frame.gap >= range()) return part(row);
        if (K.general && law.range > 0 && frame.gap >= 0) {
          attract(frame, row);
        } else {
          touch(frame, plane.velocity - seen.velocity[i] - seen.gradient * bodies.position[i], i, j, row);
        }
        if constexpr (K.account) sums.plane_power -= contacts.force[row].dot(plane.velocity);
      }
    }

    /// The pair carries no force; what its springs still held is lost.
    void part(std::size_t row) {
      if (!contacts.acts(row)) return;  // already zero
      open(row);
      contacts.set(row, RowState::apart);
      contacts.force[row].setZero();
    }

    /// Ends a contact: no springs, no tangential force. Their rest is below the limit of a vanishing normal force.
    void open(std::size_t row) {
      if (!contacts.touches(row)) return;
      if constexpr (Y.friction) {
        if constexpr (K.account) account_for_rest(row);
        contacts.twist[row] = zero_spin<D>(), contacts.spring[row] = zero_spin<D>();
      }
      if constexpr (Y.rolling) contacts.torque[row] = zero_spin<D>(), contacts.rolling[row] = zero_spin<D>();
      if constexpr (Contacts<Y>::pivots) contacts.pivoting[row] = 0;
    }

    void account_for_rest(std::size_t row) {
      const PairTerms& terms = terms_of(row);
      const double stiffness = varying() ? contacts.stiffness_before[row] : contacts.coefficient[row];
      const double rate = 0.5 * stiffness / (law.half_before + law.half_after);
      sums.sliding.plastic += rate * terms.tangential_ratio * squared(contacts.spring[row]);
      if constexpr (Y.rolling) sums.rolling.plastic += rate * terms.rolling_stiffness * squared(contacts.rolling[row]);
      if constexpr (Contacts<Y>::pivots)
        sums.pivoting.plastic += rate * terms.pivoting_stiffness * squared(contacts.pivoting[row]);
    }

    /// A pair within the range D0 of a cohesion, but not touching.
    void attract(const ContactFrame<D>& frame, std::size_t row) {
      const PairTerms& terms = terms_of(row);
      if (frame.gap >= terms.range) return part(row);
      open(row);
      contacts.set(row, RowState::attracted);
      contacts.force[row] = distant_force(terms, frame.gap) * frame.normal;
      sums.virial += contacts.force[row] * frame.branch.transpose();
    }

    /// What the springs' limits and stiffness will be half a step ahead, by the present opening velocity.
    struct Ahead {
      double bound;
      double softening;
    };

    Ahead look_ahead(const NormalForce& normal, double deflection, double opening) const {
      const double moved = opening * law.half_after;
      Ahead ahead{std::max(0.0, normal.bound - normal.stiffness * moved), 1};
      if (varying() && opening > 0) ahead.softening = std::sqrt(std::max(0.01, 1 - moved / deflection));
      return ahead;
    }

    /// Applies the laws to a touching pair; `centres` is the relative velocity of the centres.
    GALET_INLINE void touch(const ContactFrame<D>& frame, const Vec<D>& centres, int i, int j, std::size_t row) {
      const PairTerms& terms = terms_of(row);
      const double opening = frame.normal.dot(centres), coefficient = contacts.coefficient[row];
      const NormalForce normal = normal_force<K>(terms, coefficient, contacts.critical[row], -frame.gap, opening);
      if constexpr (K.account) {
        // The conservative part is what is left without damping.
        const double conservative = normal_force<K>(terms, coefficient, 0, -frame.gap, 0).force;
        sums.normal.viscous += (conservative - normal.force) * opening;
      }
      Vec<D> force = normal.force * frame.normal;
      if constexpr (Y.friction) {
        const Ahead ahead = look_ahead(normal, -frame.gap, opening);
        const bool grain_j = j < bodies.grains();
        if (contacts.touches(row)) carry_springs(frame, normal.stiffness, terms, i, j, row);
        if constexpr (Y.rolling) roll(frame, normal, ahead, terms, i, j, row);
        // l_i w_i + l_j w_j with l = stretch R.
        Spin<D> turning = bodies.radius[i] * seen.spin[i];
        if (grain_j) turning += bodies.radius[j] * seen.spin[j];
        turning *= frame.stretch;
        const SpringTerms spring{terms.tangential_ratio * normal.stiffness,
                                 terms.friction * normal.bound,
                                 terms.friction * ahead.bound,
                                 ahead.softening,
                                 terms.tangential_viscosity * normal.critical,
                                 terms.total,
                                 law.half_before,
                                 law.half_after};
        Losses& losses = sums.sliding;
        if constexpr (D == 2) {
          const Vec<2> along = tangent(frame.normal);
          const double tangential =
              -spring_force<K>(spring, along.dot(centres) - turning, contacts.spring[row], losses);
          force += tangential * along;
          contacts.twist[row] = frame.stretch * tangential;
        } else {
          const Vec<3> slip = centres - opening * frame.normal - turning.cross(frame.normal);
          const Vec<3> tangential = -spring_force<K>(spring, slip, contacts.spring[row], losses);
          force += tangential;
          contacts.twist[row] = frame.stretch * frame.normal.cross(tangential);
          contacts.normal[row] = frame.normal;
        }
        if (varying()) contacts.stiffness_before[row] = normal.stiffness;
      }
      contacts.set(row, RowState::touching);
      contacts.force[row] = force;
      sums.virial += force * frame.branch.transpose();
    }

    /// Brings the springs of a contact from the last step's frame and stiffness to the present ones.
    GALET_INLINE void carry_springs(const ContactFrame<D>& frame, double stiffness, const PairTerms& terms, int i,
                                    int j, std::size_t row) {
      if constexpr (D == 3) {
        const Vec<3> spins = j < bodies.grains() ? Vec<3>(seen.spin[i] + seen.spin[j]) : seen.spin[i];
        const Vec<3> turn = law.half_before * spins;
        const Vec<3>& before = contacts.normal[row];
        contacts.spring[row] = transport(contacts.spring[row], before, frame.normal, turn);
        if constexpr (Y.rolling) contacts.rolling[row] = transport(contacts.rolling[row], before, frame.normal, turn);
      }
      if (!varying()) return;
      const double before = contacts.stiffness_before[row], step = law.half_before + law.half_after;
      const auto adapt = [&](double factor, auto& stored, Losses& losses) {
        adapt_spring<K>(factor * before, factor * stiffness, step, stored, losses);
      };
      adapt(terms.tangential_ratio, contacts.spring[row], sums.sliding);
      if constexpr (Y.rolling) adapt(terms.rolling_stiffness, contacts.rolling[row], sums.rolling);
      if constexpr (Contacts<Y>::pivots) adapt(terms.pivoting_stiffness, contacts.pivoting[row], sums.pivoting);
    }

    /// Rolling and pivoting torque on j, from the relative rotation w_j - w_i.
    GALET_INLINE void roll(const ContactFrame<D>& frame, const NormalForce& normal, const Ahead& ahead,
                           const PairTerms& terms, int i, int j, std::size_t row) {
      const auto spring = [&](double factor, double reach) {
        return SpringTerms{
            factor * normal.stiffness, reach * normal.bound, reach * ahead.bound, ahead.softening, 0, false,
            law.half_before,           law.half_after};
      };
      Spin<D> rate = -seen.spin[i];
      if (j < bodies.grains()) rate += seen.spin[j];
      Spin<D> torque = zero_spin<D>();
      const SpringTerms rolls = spring(terms.rolling_stiffness, terms.rolling_friction);
      if constexpr (D == 2) {
        if (terms.rolling_friction > 0) torque = -spring_force<K>(rolls, rate, contacts.rolling[row], sums.rolling);
      } else {
        const double about = rate.dot(frame.normal);
        if (terms.rolling_friction > 0)
          torque = -spring_force<K>(rolls, Vec<3>(rate - about * frame.normal), contacts.rolling[row], sums.rolling);
        if (terms.pivoting_friction > 0) {
          const SpringTerms pivots = spring(terms.pivoting_stiffness, terms.pivoting_friction);
          torque -= spring_force<K>(pivots, about, contacts.pivoting[row], sums.pivoting) * frame.normal;
        }
      }
      contacts.torque[row] = torque;
    }
  };

  std::vector<PassSums<D>> partial_;
};

}  // namespace galet::md
