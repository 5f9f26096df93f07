// Energy of a soft sample: elastic and cohesive parts of its contacts, and the account of work and dissipation.
//
// Powers are known at the steps; flows are their integrals by the trapezoidal rule, of the same order as the scheme.
#pragma once

#include "common/engine/bodies.hpp"
#include "common/geometry/contact_frame.hpp"
#include "md/contact_pass.hpp"
#include "md/contacts.hpp"
#include "md/pair_terms.hpp"

namespace galet::md {

/// The powers at one step.
struct Powers {
  double work = 0;
  Loss normal, sliding, rolling, pivoting;
  double relaxation = 0;
};

/// -V sigma : L over the rate-driven modes and -V Sigma : L over the stress-driven ones; `virial` = V sigma.
template <int D>
double drive_power(const std::vector<CellMode<D>>& modes, const Mat<D>& virial, double volume) {
  double power = 0;
  for (const CellMode<D>& mode : modes)
    power -= mode.rate * (mode.stress_driven ? volume * mode.load : virial.cwiseProduct(mode.direction).sum());
  return power;
}

/// The integrals of powers since the start.
class EnergyAccount {
 public:
  /// Powers `now` at a step that is `dt` after the one before (0 at the start).
  void add(const Powers& now, double dt) {
    add_half(last_, dt), add_half(now, dt);
    last_ = now;
  }

  /// Another loading between two steps: `given` is the energy that the change itself has put in, `power` by how much
  /// the drives' power jumps.
  void change(double given, double power) {
    flows_.work += given;
    last_.work += power;
  }

  const EnergyFlows& flows() const { return flows_; }

  void save(Archive& archive) const {
    archive.reals["md.flows"] = {flows_.work,     flows_.viscous,    flows_.sliding, flows_.unloading, flows_.rolling,
                                 flows_.pivoting, flows_.relaxation, last_.work,     last_.relaxation};
    std::vector<double>& losses = archive.reals["md.losses"];
    losses.clear();
    for (const Loss* part : {&last_.normal, &last_.sliding, &last_.rolling, &last_.pivoting})
      losses.insert(losses.end(), {part->viscous, part->plastic, part->unloading});
  }

  void restore(const Archive& archive) {
    std::vector<double> flows(9), losses(12);
    take_column(archive, "md.flows", flows);
    take_column(archive, "md.losses", losses);
    flows_ = {flows[0], flows[1], flows[2], flows[3], flows[4], flows[5], flows[6]};
    last_.work = flows[7], last_.relaxation = flows[8];
    const double* from = losses.data();
    for (Loss* part : {&last_.normal, &last_.sliding, &last_.rolling, &last_.pivoting}) {
      *part = {from[0], from[1], from[2]};
      from += 3;
    }
  }

 private:
  void add_half(const Powers& powers, double dt) {
    const double half = 0.5 * dt;
    flows_.work += half * powers.work;
    flows_.relaxation += half * powers.relaxation;
    for (const Loss* part : {&powers.normal, &powers.sliding, &powers.rolling, &powers.pivoting}) {
      flows_.viscous += half * part->viscous;
      flows_.unloading += half * part->unloading;
    }
    flows_.sliding += half * powers.sliding.plastic;
    flows_.rolling += half * powers.rolling.plastic;
    flows_.pivoting += half * powers.pivoting.plastic;
  }

  EnergyFlows flows_;
  Powers last_;
};

/// Adds the energy that row `row` stores. Springs are known half a step ahead: their forces tell their present energy.
template <Layout Y>
void add_contact_energy(const Contacts<Y>& contacts, std::size_t row, const LawKind& kind,
                        const PairTerms<double>& terms, const ContactFrame<Y.dim>& frame, EnergyParts& parts) {
  using C = RowColumns<Y>;
  if (!contacts.acts(row)) return;
  const double coefficient = contacts.coefficient(row);
  parts.cohesive += cohesive_energy(kind, terms, coefficient, frame.gap);
  if (!contacts.touches(row) || frame.gap >= 0) return;
  parts.elastic_normal += elastic_energy(kind, coefficient, -frame.gap);
  if constexpr (Y.friction) {
    const double stiffness = kind.hertz ? contacts.at(row, C::stiffness) : coefficient;
    if (!(stiffness > 0)) return;
    if (terms.tangential_viscosity > 0) {
      // The force holds a viscous part: the spring itself, half a step ahead, is the nearest there is.
      parts.elastic_tangential += 0.5 * terms.tangential_ratio * stiffness * squared(contacts.spring(row));
    } else {
      const Vec<Y.dim> force = contacts.force(row);
      const Vec<Y.dim> tangential = force - force.dot(frame.normal) * frame.normal;
      parts.elastic_tangential += 0.5 * tangential.squaredNorm() / (terms.tangential_ratio * stiffness);
    }
    if constexpr (Y.rolling) {
      const Spin<Y.dim> torque = contacts.torque(row);
      double about = 0;
      if constexpr (Y.dim == 3) about = torque.dot(frame.normal);
      if (terms.rolling_stiffness > 0)
        parts.elastic_rolling += 0.5 * (squared(torque) - about * about) / (terms.rolling_stiffness * stiffness);
      if (terms.pivoting_stiffness > 0)
        parts.elastic_rolling += 0.5 * about * about / (terms.pivoting_stiffness * stiffness);
    }
  }
}

}  // namespace galet::md
