#include "benchmarks/work_precision/isostatic.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/measure/equilibrium_matrix.hpp"
#include "src/verify/trial.hpp"

namespace galet::precision {

ContactMap contacts_of(const Snapshot<2>& state) {
  ContactMap map;
  const ContactColumns<2>& c = *state.contacts;
  for (std::size_t k = 0; k < c.size(); ++k)
    map[{c.i[k], c.j[k], c.image[k]}] = {c.force[k].dot(c.normal[k]), c.branch[k].norm(), c.force[k]};
  return map;
}

Scene loaded_scene(int count, double friction) {
  Scene scene = verify::periodic_scene(2, count, friction, 0.3, 1e4);
  scene.material.convention = DampingConvention::total;
  scene.grains.diameter = {SizeKind::uniform, 1, 0.2, {}, {}};
  scene.initial.solid_fraction = 0.5;
  scene.loading.kind = LoadingKind::drives;
  scene.loading.pressure = 1;
  scene.loading.drives = {{.component = "xx", .stress = 1.0}, {.component = "yy", .stress = 1.0}};
  return scene;
}

void scale(Sample<2>& sample, double factor) {
  sample.cell.box *= factor;
  for (Vec<2>& x : sample.position) x *= factor;
}

Sample<2> at_rest(const Snapshot<2>& state, const Sample<2>& like) {
  Sample<2> sample = like;
  sample.cell = *state.cell;
  sample.cell.rate.setZero();
  sample.cell.strain.setZero();
  sample.position.assign(state.position.begin(), state.position.end());
  for (Vec<2>& velocity : sample.velocity) velocity.setZero();
  for (double& spin : sample.spin) spin = 0;
  return sample;
}

Sample<2> soft_packing(int count, std::uint64_t seed) {
  verify::Report report;
  Scene scene = loaded_scene(count, 0);
  scene.seed = seed;
  scene.initial.speed = 0.1;
  scene.md.drag = 0.5;
  Sample<2> sample = initial_sample<2>(verify::checked(EngineKind::md, scene));
  verify::Trial<2> trial(report, EngineKind::md, scene, sample);
  trial.run_to(150);
  sample = at_rest(trial.state(), sample);
  scale(sample, 1 + 1e-4);  // about what the pressure presses them together
  return sample;
}

namespace {

/// The same put to rest by cd.
Sample<2> rigid_packing(int count, std::uint64_t seed) {
  verify::Report report;
  const Sample<2> sample = soft_packing(count, seed);
  Scene scene = loaded_scene(count, 0);
  scene.cd.dt = 0.05, scene.cd.tolerance = 1e-10, scene.cd.max_sweeps = 1000000, scene.cd.penetration = 1e-9;
  verify::Trial<2> trial(report, EngineKind::cd, scene, sample);
  trial.run_to(20);
  return at_rest(trial.state(), sample);
}

}  // namespace

std::vector<double> IsostaticPacking::forces(double x) const {
  std::vector<double> all(isotropic.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = isotropic[k] + x * deviatoric[k];
  return all;
}

IsostaticPacking isostatic_packing() {
  IsostaticPacking packing;
  packing.start = rigid_packing(40, 11);
  verify::Report report;
  Scene scene = loaded_scene(packing.start.count(), 0);
  scene.cd.dt = 0.02, scene.cd.tolerance = 1e-11, scene.cd.max_sweeps = 1000000;
  verify::Trial<2> trial(report, EngineKind::cd, scene, packing.start);
  trial.advance(1);
  const Snapshot<2> state = trial.state();
  const std::vector<Mat<2>> all = unit_strains<2>(), strains{all[0], all[1]};
  const Indeterminacy network = indeterminacy<2>(state, {.friction = false}, strains);
  if (network.indeterminacy() != 0 || network.mechanisms() != 2)
    throw RunError(fmt::format("the packing is not isostatic: indeterminacy {}, mechanisms {} (2 translations)",
                               network.indeterminacy(), network.mechanisms()));
  const EquilibriumMatrix<2> g = equilibrium_matrix<2>(state, {.friction = false}, strains);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr{Eigen::MatrixXd(g.matrix)};
  const auto solve = [&](double xx, double yy) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(g.matrix.rows());
    load[g.grain_freedoms] = xx * state.cell->volume(), load[g.grain_freedoms + 1] = yy * state.cell->volume();
    const Eigen::VectorXd forces = qr.solve(load);
    return std::vector<double>(forces.begin(), forces.end());
  };
  packing.isotropic = solve(1, 1), packing.deviatoric = solve(1, -1);
  packing.largest_deviator = 1;
  for (std::size_t k = 0; k < g.contact.size(); ++k) {
    const int c = g.contact[k];
    packing.key.push_back({state.contacts->i[c], state.contacts->j[c], state.contacts->image[c]});
    packing.branch.push_back(state.contacts->branch[c].norm());
    if (packing.deviatoric[k] < 0)
      packing.largest_deviator = std::min(packing.largest_deviator, -packing.isotropic[k] / packing.deviatoric[k]);
  }
  return packing;
}

}  // namespace galet::precision
