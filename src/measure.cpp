#include "src/measure.hpp"

#include <cmath>
#include <limits>

#include "common/measure/balance.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/fabric.hpp"
#include "common/measure/mobilisation.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/stress.hpp"
#include "common/measure/temperature.hpp"

namespace galet {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

template <int D>
void put_stress(Measurement& row, const Mat<D>& sigma) {
  row[Observable::sigma_xx] = sigma(0, 0);
  row[Observable::sigma_yy] = sigma(1, 1);
  row[Observable::sigma_xy] = sigma(0, 1);
  if constexpr (D == 3) {
    row[Observable::sigma_zz] = sigma(2, 2);
    row[Observable::sigma_xz] = sigma(0, 2);
    row[Observable::sigma_yz] = sigma(1, 2);
  }
}

/// `strain`: integral of the velocity gradient.
template <int D>
void put_strain(Measurement& row, const Mat<D>& strain) {
  row[Observable::strain] = strain(0, 1);
  row[Observable::eps_xx] = 0 - strain(0, 0);  // no -0
  row[Observable::eps_yy] = 0 - strain(1, 1);
  if constexpr (D == 3) row[Observable::eps_zz] = 0 - strain(2, 2);
  row[Observable::eps_v] = 0 - strain.trace();
}

void put_energy(Measurement& row, const EnergyParts& energy, int grains) {
  row[Observable::kinetic] = energy.kinetic;
  row[Observable::rotational] = energy.rotational;
  row[Observable::cell] = energy.cell;
  row[Observable::elastic_normal] = energy.elastic_normal;
  row[Observable::elastic_tangential] = energy.elastic_tangential;
  row[Observable::elastic_rolling] = energy.elastic_rolling;
  row[Observable::cohesive] = energy.cohesive;
  row[Observable::gravity] = energy.gravity;
  row[Observable::kinetic_per_grain] = (energy.kinetic + energy.rotational) / grains;
}

void put_budget(Measurement& row, const EnergyFlows& flows, double change) {
  row[Observable::work] = flows.work;
  row[Observable::dissipated_viscous] = flows.viscous;
  row[Observable::dissipated_sliding] = flows.sliding;
  row[Observable::dissipated_unloading] = flows.unloading;
  row[Observable::dissipated_rolling] = flows.rolling;
  row[Observable::dissipated_pivoting] = flows.pivoting;
  row[Observable::dissipated_relaxation] = flows.relaxation;
  row[Observable::energy_residual] = change - flows.work + flows.dissipated();
}

/// What output.measures asks for at each sample; not a number where it does not.
template <int D>
void put_asked(Measurement& row, const Snapshot<D>& snapshot, const MeasureScale& scale) {
  for (int k = 0; k < observable_count; ++k)
    if (observable_table[k].shown >= Shown::with_fabric) row.values[k] = nothing;
  if (scale.asked.has(MeasureKind::fabric)) {
    const Anisotropies all = anisotropies(fabric(snapshot));
    row[Observable::anisotropy_contact] = all.contact;
    row[Observable::anisotropy_normal] = all.normal;
    row[Observable::anisotropy_tangential] = all.tangential;
    row[Observable::anisotropy_branch] = all.branch;
  }
  if (scale.asked.has(MeasureKind::friction)) {
    const Mobilisation used = mobilisation(snapshot);
    row[Observable::mobilised] = used.mean;
    row[Observable::sliding] = used.sliding;
  }
  if (scale.asked.has(MeasureKind::temperature)) {
    const Temperature temperature = granular_temperature(snapshot);
    row[Observable::temperature] = temperature.translational;
    row[Observable::rotational_temperature] = temperature.rotational;
  }
  if (scale.asked.has(MeasureKind::balance)) {
    std::vector<char> loose = rattlers(snapshot, scale.friction);
    for (std::size_t i = 0; i < scale.held.size(); ++i)
      if (scale.held[i]) loose[i] = 1;
    const Balance rest = unbalance<D>(snapshot, loose, scale.gravity.head<D>());
    row[Observable::unbalanced_force] = rest.force;
    row[Observable::unbalanced_torque] = rest.torque;
  }
}

}  // namespace

MeasureScale measure_scale(const Derived& derived, bool rigid) {
  MeasureScale scale;
  scale.dimension = derived.layout.dim;
  scale.friction = derived.layout.friction;
  scale.diameter = derived.grains.mean_diameter;
  scale.mass = derived.grains.mean_mass;
  scale.shear_rate = derived.shear_rate.value_or(0);
  if (!rigid && derived.laws.stiff) scale.law = derived.laws.at(0, 0);
  return scale;
}

void complete(Measurement& row, const MeasureScale& scale) {
  const double sigma_yy = row[Observable::sigma_yy];
  const double trace = row[Observable::sigma_xx] + sigma_yy + row[Observable::sigma_zz];
  const double pressure = trace / scale.dimension;
  const bool sheared = scale.shear_rate != 0;
  // Shear numbers refer to sigma_yy, the others to the mean normal stress (common/measure/numbers.hpp).
  const double reference = sheared ? sigma_yy : pressure;
  row[Observable::pressure] = pressure;
  row[Observable::mu_star] = sigma_yy > 0 ? std::abs(row[Observable::sigma_xy]) / sigma_yy : nothing;
  row[Observable::inertial_number] =
      sheared && reference > 0
          ? inertial_number(scale.dimension, std::abs(scale.shear_rate), reference, scale.mass, scale.diameter)
          : nothing;
  row[Observable::stiffness_level] =
      scale.law && reference > 0 ? stiffness_level(*scale.law, scale.dimension, reference, scale.diameter) : nothing;
}

template <int D>
Measurement measure(Engine<D>& engine, const MeasureScale& scale) {
  const Snapshot<D> snapshot = engine.snapshot();
  Measurement row;
  row[Observable::time] = engine.time();
  put_strain<D>(row, snapshot.cell->strain);
  put_stress<D>(row, stress(snapshot).total());
  row[Observable::solid_fraction] = solid_fraction(snapshot);

  const Coordination contacts = coordination(snapshot, scale.friction);
  row[Observable::z] = contacts.z;
  row[Observable::z_star] = contacts.z_star;
  row[Observable::rattler_fraction] = contacts.rattler_fraction;

  const Overlap depth = overlap(snapshot);
  row[Observable::mean_overlap] = depth.mean / scale.diameter;
  row[Observable::largest_overlap] = depth.largest / scale.diameter;
  row[Observable::peak_overlap] = depth.largest / scale.diameter;

  const EnergyParts energy = engine.energy();
  put_energy(row, energy, snapshot.grains());
  put_budget(row, engine.energy_flows(), energy.total() - scale.energy_at_start);
  put_asked(row, snapshot, scale);
  complete(row, scale);
  return row;
}

template Measurement measure<2>(Engine<2>&, const MeasureScale&);
template Measurement measure<3>(Engine<3>&, const MeasureScale&);

}  // namespace galet
