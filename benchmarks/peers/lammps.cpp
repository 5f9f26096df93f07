// The same packing and the same contact law in LAMMPS (pair_style gran/hooke/history) and in the md engine.
//
//   lammps_peer FOLDER [N]      writes its inputs to FOLDER, runs `lmp` there, prints a CSV table and verdicts
//
// A packing of N = 500 equal spheres, assembled without friction at stiffness level kappa and at rest, is sheared at
// constant volume by a strain of 0.3 / kappa in 200 collision times, with mu = 0.3, K_T = 2/7 K_N and the `total`
// viscous convention (LAMMPS: limit_damping). At tau_c / 50 these are 1e4 steps. The two codes differ in three known
// ways:
//   - LAMMPS takes velocities of the half step in forces and springs, an error of first order in dt;
//   - its tangential velocity and torques have the lever arms R, ours |b| R / (R_i + R_j), a difference of 1 / kappa;
//   - it projects springs on the tangent plane, we rotate them: of second order in the rotation of a contact.
// So its final state must approach ours at first order in dt, down to a rest that falls like 1 / kappa. This shows as
// long as both have the same contacts: in larger packings (N = 1000 at kappa = 1e4) a contact of a loosely held grain
// opens or not according to the step, in either code, and differences stay at 1e-3 of the non-affine displacement.
// Speeds are of one core, in one run on one machine; only their ratio says something.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "benchmarks/dense_sample.hpp"
#include "benchmarks/peers/lammps_run.hpp"
#include "common/core/clock.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/stress.hpp"

namespace galet::bench {
namespace {

/// What our runs end with.
struct Final : EndState<3> {
  std::vector<char> bearing;  ///< grains that carry force
};

struct Case {
  double kappa = 0;
  Scene scene;
  Sample<3> packing;
  Derived derived;
  double rate = 0, duration = 0;
};

constexpr double collisions = 200, strain_times_kappa = 0.3;

Case make_case(double kappa, int count) {
  Case made;
  made.kappa = kappa;
  Scene scene = dense_scene(3, count, 0);
  scene.material.stiffness_level = kappa;
  const Sample<3> gas = initial_sample<3>(scene);
  auto engine = md::make_engine<3>(scene, derive(scene, grain_facts<3>(scene, gas)), gas);
  engine->advance(static_cast<long>(40 / engine->dt()));
  // A drag finishes what contacts hardly damp.
  scene.md.drag = 1;
  const Sample<3> dense = at_rest<3>(*engine, gas);
  engine = md::make_engine<3>(scene, derive(scene, grain_facts<3>(scene, dense)), dense);
  engine->advance(static_cast<long>(100 / engine->dt()));
  made.packing = at_rest<3>(*engine, gas);
  scene.md.drag = 0;
  scene.material.friction = 0.3;
  scene.material.convention = DampingConvention::total;
  made.derived = derive(scene, grain_facts<3>(scene, made.packing));
  made.duration = collisions * *made.derived.collision_time;
  made.rate = strain_times_kappa / kappa / made.duration;
  scene.loading = LoadingSpec{};
  scene.loading.kind = LoadingKind::drives;
  scene.loading.pressure = 1;
  scene.loading.drives = {{"xy", made.rate, std::nullopt}};
  made.scene = scene;
  return made;
}

long steps_of(int steps_per_contact) { return std::lround(collisions * steps_per_contact); }

Final run_galet(const Case& which, int steps_per_contact) {
  Scene scene = which.scene;
  const long steps = steps_of(steps_per_contact);
  scene.md.dt = which.duration / static_cast<double>(steps);
  auto engine = md::make_engine<3>(scene, derive(scene, grain_facts<3>(scene, which.packing)), which.packing);
  const double start = thread_seconds();
  engine->advance(steps);
  Final state;
  state.seconds = thread_seconds() - start;
  const Snapshot<3> snapshot = engine->snapshot();
  state.position.assign(snapshot.position.begin(), snapshot.position.end());
  state.stress = stress<3>(snapshot).contact;
  state.z = coordination<3>(snapshot, true).z;
  for (const char rattler : rattlers<3>(snapshot, true)) state.bearing.push_back(!rattler);
  return state;
}

EndState<3> run_lammps(const Case& which, int steps_per_contact, const std::filesystem::path& folder) {
  const PairLaw& law = which.derived.laws.at(0, 0);
  LammpsOptions options;
  options.pair = lammps_pair(LammpsPair::history, law, which.derived.grains.mean_mass, 1, 1);
  options.rate = which.rate;
  options.steps = steps_of(steps_per_contact);
  options.dt = which.duration / static_cast<double>(options.steps);
  return bench::run_lammps<3>(which.packing, options, folder);
}

/// Rms distance of two states in the sheared cell, over the grains that carry force at the end of our run: what a
/// loose grain does when it is hit tells nothing about the packing.
double distance(const Case& which, const std::vector<Vec<3>>& a, const std::vector<Vec<3>>& b, const Final& reference) {
  Mat<3> box = which.packing.cell.box;
  box(0, 1) += which.rate * which.duration * box(1, 1);
  return rms_distance<3>(box, a, b, reference.bearing);
}

/// Rms displacement of the grains beyond the affine one.
double non_affine(const Case& which, const Final& end) {
  std::vector<Vec<3>> affine;
  for (const Vec<3>& x : which.packing.position)
    affine.push_back(x + which.rate * which.duration * x.y() * Vec<3>::UnitX());
  return distance(which, affine, end.position, end);
}

double stress_difference(const Mat<3>& a, const Mat<3>& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

struct Row {
  double kappa;
  int steps_per_contact;
  double galet, lammps;  ///< rms position errors over the non-affine displacement
};

std::vector<Row> compare(double kappa, int count, const std::filesystem::path& folder) {
  const Case which = make_case(kappa, count);
  const std::vector<int> resolutions{50, 100, 200, 400};
  const Final reference = run_galet(which, 2 * resolutions.back());
  const double scale = non_affine(which, reference);
  std::vector<Row> rows;
  for (const int n : resolutions) {
    const Final ours = run_galet(which, n);
    const EndState<3> theirs = run_lammps(which, n, folder / fmt::format("kappa_{:g}_{}", kappa, n));
    rows.push_back({kappa, n, distance(which, ours.position, reference.position, reference) / scale,
                    distance(which, theirs.position, reference.position, reference) / scale});
    const double work = static_cast<double>(count) * static_cast<double>(steps_of(n));
    fmt::print("{:g},{},{},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g},{:.4f},{:.4f},{:.2f}\n", kappa, n, steps_of(n), scale,
               rows.back().galet, rows.back().lammps, stress_difference(ours.stress, reference.stress),
               stress_difference(theirs.stress, reference.stress), ours.z, theirs.z,
               (work / ours.seconds) / (work / theirs.seconds));
    std::fflush(stdout);
  }
  return rows;
}

bool verdict(const std::string& claim, bool holds) {
  fmt::print("# {}: {}\n", claim, holds ? "yes" : "NO");
  return holds;
}

int run(const std::filesystem::path& folder, int count) {
  fmt::print(
      "kappa,steps_per_contact,steps,non_affine,position_galet,position_lammps,stress_galet,stress_lammps,"
      "z_galet,z_lammps,speed_galet_over_lammps\n");
  bool sound = true;
  std::vector<double> rest;
  for (const double kappa : {1e3, 1e4, 1e5}) {
    const std::vector<Row> rows = compare(kappa, count, folder);
    // What is left of the difference when the error of first order is taken out.
    rest.push_back(std::abs(2 * rows[3].lammps - rows[2].lammps));
    sound &= verdict(fmt::format("kappa = {:g}: LAMMPS within 2 % of the non-affine displacement at tau_c/50", kappa),
                     rows[0].lammps < 0.02);
    // First order down to a rest: successive differences halve.
    const double order = std::log2((rows[0].lammps - rows[1].lammps) / (rows[1].lammps - rows[2].lammps));
    sound &= verdict(fmt::format("kappa = {:g}: LAMMPS approaches galet as dt falls, at order {:.2f}", kappa, order),
                     order > 0.7);
    sound &= verdict(fmt::format("kappa = {:g}: galet's own error at tau_c/50 is below a third of LAMMPS's", kappa),
                     rows[0].galet < rows[0].lammps / 3);
  }
  fmt::print("# rest at dt -> 0: {:.2g}, {:.2g}, {:.2g}\n", rest[0], rest[1], rest[2]);
  sound &= verdict("the rest falls with kappa", rest[2] < rest[0]);
  return sound ? 0 : 1;
}

}  // namespace
}  // namespace galet::bench

int main(int argc, char** argv) try {
  if (argc < 2) {
    fmt::print(stderr, "usage: lammps_peer FOLDER [N]\n");
    return 2;
  }
  return galet::bench::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 500);
} catch (const std::exception& error) {
  fmt::print(stderr, "lammps_peer: {}\n", error.what());
  return 1;
}
