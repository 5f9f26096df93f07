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
#include "common/io/lammps.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "benchmarks/dense_sample.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/stress.hpp"
#include "src/clock.hpp"

namespace galet::bench {
namespace {

/// What a run ends with.
struct Final {
  std::vector<Vec<3>> position;
  std::vector<double> stress;  ///< xx, yy, zz, xy, xz, yz of the contact part
  double z = 0;
  double seconds = 0;
  std::vector<char> rattler;  ///< of our runs
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
  const Mat<3> sigma = stress<3>(snapshot).contact;
  state.stress = {sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(0, 2), sigma(1, 2)};
  state.z = coordination<3>(snapshot, true).z;
  state.rattler = rattlers<3>(snapshot, true);
  return state;
}

/// The input script of one run. LAMMPS damps by gamma_n m*, so gamma_n = 2 zeta sqrt(K_N / m*).
void write_input(const Case& which, int steps_per_contact, const std::filesystem::path& folder) {
  const PairLaw& law = which.derived.laws.at(0, 0);
  const long steps = steps_of(steps_per_contact);
  const double gamma = 2 * law.damping_ratio * std::sqrt(law.stiffness / (which.derived.grains.mean_mass / 2));
  std::ofstream input(folder / "in.shear");
  const Mat<3>& box = which.packing.cell.box;
  fmt::print(input, "units si\natom_style sphere\nboundary p p p\nnewton off\ncomm_modify vel yes\n");
  fmt::print(input, "box tilt large\nread_data packing.data\nchange_box all triclinic\n");
  fmt::print(input,
             "pair_style gran/hooke/history {:.17g} {:.17g} {:.17g} 0.0 {:.17g} 0 limit_damping\npair_coeff * *\n",
             law.stiffness, law.tangential_ratio * law.stiffness, gamma, law.friction);
  fmt::print(input, "neighbor 0.15 bin\nneigh_modify delay 0 every 1 check yes\n");
  fmt::print(input, "velocity all ramp vx 0 {:.17g} y 0 {:.17g}\n", which.rate * box(1, 1), box(1, 1));
  fmt::print(input, "fix move all nve/sphere\nfix shear all deform 1 xy erate {:.17g} remap v flip no\n", which.rate);
  fmt::print(input, "compute contact all pressure NULL pair\ncompute touch all contact/atom\n");
  fmt::print(input, "compute z all reduce ave c_touch\n");
  fmt::print(input,
             "thermo_style custom step c_contact[1] c_contact[2] c_contact[3] c_contact[4] c_contact[5] "
             "c_contact[6] c_z\nthermo_modify format float %.17g\nthermo {}\n",
             steps);
  fmt::print(input, "timestep {:.17g}\n", which.duration / static_cast<double>(steps));
  fmt::print(input, "dump end all custom {} end.dump id x y z\ndump_modify end sort id format float %.17g\nrun {}\n",
             steps, steps);
}

/// Reads the last thermo line, the loop time and the dump of the last step.
Final read_final(const std::filesystem::path& folder, int count) {
  Final state;
  std::ifstream log(folder / "log.lammps");
  std::string line, last;
  bool table = false;
  while (std::getline(log, line)) {
    if (line.find("Loop time of") == 0) {
      state.seconds = std::stod(line.substr(13));
      table = false;
    }
    if (table) last = line;
    if (line.find("Step") != std::string::npos && line.find("c_z") != std::string::npos) table = true;
  }
  std::istringstream row(last);
  double step = 0;
  row >> step;
  state.stress.resize(6);
  for (double& component : state.stress) row >> component;
  row >> state.z;
  if (!row) throw std::runtime_error("LAMMPS wrote no results: see log.lammps");
  std::ifstream dump(folder / "end.dump");
  std::string text;
  while (std::getline(dump, line)) text = line.find("ITEM: TIMESTEP") == 0 ? "" : text + line + "\n";
  std::istringstream atoms(text.substr(text.find("ITEM: ATOMS")));
  std::getline(atoms, line);
  state.position.resize(count);
  for (int k = 0, id = 0; k < count; ++k) {
    atoms >> id;
    for (int a = 0; a < 3; ++a) atoms >> state.position.at(id - 1)[a];
  }
  if (!atoms) throw std::runtime_error("LAMMPS wrote no positions: see end.dump");
  return state;
}

Final run_lammps(const Case& which, int steps_per_contact, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_lammps_data<3>(folder / "packing.data", which.packing);
  write_input(which, steps_per_contact, folder);
  const std::string command =
      "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 lmp -in in.shear -screen none > lmp.out 2>&1";
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("lmp failed: see " + (folder / "log.lammps").string());
  return read_final(folder, which.packing.count());
}

/// Rms distance of two states in the sheared cell, over the grains that carry force in `reference`: what a loose grain
/// does when it is hit tells nothing about the packing.
double distance(const Case& which, const Final& a, const Final& b, const Final& reference) {
  Cell<3> cell = which.packing.cell;
  cell.box(0, 1) += which.rate * which.duration * cell.box(1, 1);
  const Mat<3> inverse = cell.box.inverse();
  double sum = 0;
  long count = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    if (reference.rattler[i]) continue;
    ++count;
    Vec<3> fraction = inverse * (a.position[i] - b.position[i]);
    for (int k = 0; k < 3; ++k) fraction[k] -= std::round(fraction[k]);
    sum += (cell.box * fraction).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(count));
}

/// Rms displacement of the grains beyond the affine one.
double non_affine(const Case& which, const Final& end) {
  Final affine;
  for (const Vec<3>& x : which.packing.position)
    affine.position.push_back(x + which.rate * which.duration * x.y() * Vec<3>::UnitX());
  return distance(which, affine, end, end);
}

double stress_difference(const Final& a, const Final& b) {
  double difference = 0, scale = 0;
  for (int k = 0; k < 6; ++k) {
    difference = std::max(difference, std::abs(a.stress[k] - b.stress[k]));
    scale = std::max(scale, std::abs(b.stress[k]));
  }
  return difference / scale;
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
    const Final theirs = run_lammps(which, n, folder / fmt::format("kappa_{:g}_{}", kappa, n));
    rows.push_back({kappa, n, distance(which, ours, reference, reference) / scale,
                    distance(which, theirs, reference, reference) / scale});
    const double work = static_cast<double>(count) * static_cast<double>(steps_of(n));
    fmt::print("{:g},{},{},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g},{:.4f},{:.4f},{:.2f}\n", kappa, n, steps_of(n), scale,
               rows.back().galet, rows.back().lammps, stress_difference(ours, reference),
               stress_difference(theirs, reference), ours.z, theirs.z, (work / ours.seconds) / (work / theirs.seconds));
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
