#include "benchmarks/peers/lammps_run.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "common/io/lammps.hpp"

namespace galet::bench {
namespace {

/// The restitution that makes LAMMPS's fit (Tsuji et al. 1992; its pair_granular) of alpha / sqrt(m* k) a given number.
double tsuji_restitution(double damping) {
  const auto fit = [](double e) {
    return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
  };
  double low = 0, high = 1;  // the fit falls with e
  if (damping > fit(low) || damping < fit(high)) throw std::runtime_error("damping outside of LAMMPS's fit");
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (fit(middle) > damping ? low : high) = middle;
  }
  return low;
}

std::string hertz_pair(LammpsPair kind, const PairLaw& law, double mass, double diameter, double force) {
  // LAMMPS: F_N = k a h and K_T = k_t a with the contact radius a = sqrt(R* h); K_N = 3/2 k a.
  const double k = 4.0 / 3 * law.stiffness, k_t = 1.5 * k * law.tangential_ratio;
  if (kind == LammpsPair::granular)
    return fmt::format(
        "pair_style granular\npair_coeff * * hertz {:.17g} {:.17g} tangential mindlin_rescale/force {:.17g} 0 {:.17g} "
        "damping tsuji limit_damping\n",
        k, tsuji_restitution(2 * law.damping_ratio * std::sqrt(1.5)), k_t, law.friction);
  const double deflection = std::pow(force / (k * std::sqrt(diameter / 4)), 2.0 / 3);
  const double gamma = 2 * law.damping_ratio * std::sqrt(1.5 * k / (mass / 2 * std::sqrt(diameter / 4 * deflection)));
  return fmt::format(
      "pair_style gran/hertz/history {:.17g} {:.17g} {:.17g} 0.0 {:.17g} 0 limit_damping\npair_coeff * *\n", k, k_t,
      gamma, law.friction);
}

std::string hooke_pair(LammpsPair kind, const PairLaw& law, double mass) {
  const double k_t = law.tangential_ratio * law.stiffness;
  if (kind == LammpsPair::granular)
    return fmt::format(
        "pair_style granular\npair_coeff * * hooke {:.17g} {:.17g} tangential linear_history {:.17g} 0 {:.17g} damping "
        "tsuji limit_damping\n",
        law.stiffness, tsuji_restitution(2 * law.damping_ratio), k_t, law.friction);
  return fmt::format(
      "pair_style gran/hooke/history {:.17g} {:.17g} {:.17g} 0.0 {:.17g} 0 limit_damping\npair_coeff * *\n",
      law.stiffness, k_t, 2 * law.damping_ratio * std::sqrt(law.stiffness / (mass / 2)), law.friction);
}

template <int D>
void write_script(const Sample<D>& sample, const LammpsOptions& options, const std::filesystem::path& folder) {
  std::ofstream input(folder / "in.run");
  fmt::print(input, "units si\natom_style sphere\nnewton {}\ncomm_modify vel yes\n", options.newton ? "on" : "off");
  fmt::print(input, "dimension {}\nboundary p p p\natom_modify sort {} 0.0\n", D, options.sort_every);
  fmt::print(input, "box tilt large\nread_data sample.data\n");
  if constexpr (D == 2)  // else spheres' masses
    fmt::print(input, "set group all density/disc {:.17g}\n", sample.mass[0] / grain_volume<2>(2 * sample.radius[0]));
  fmt::print(input, "{}neighbor {:.17g} bin\nneigh_modify delay 0 every 1 check yes\n", options.pair, options.skin);
  fmt::print(input, "fix move all nve/sphere{}\n", D == 2 ? " disc\nfix plane all enforce2d" : "");
  if (options.rate != 0) {
    const double height = sample.cell.box(1, 1);
    fmt::print(input, "change_box all triclinic\nvelocity all ramp vx 0 {:.17g} y 0 {:.17g} sum yes\n",
               options.rate * height, height);
    fmt::print(input, "fix shear all deform 1 xy erate {:.17g} remap v flip no\n", options.rate);
  }
  fmt::print(input, "compute contact all pressure NULL pair\ncompute touch all contact/atom\n");
  fmt::print(input, "compute z all reduce ave c_touch\nthermo_style custom step");
  for (int k = 1; k <= 6; ++k) fmt::print(input, " c_contact[{}]", k);
  fmt::print(input, " c_z\nthermo_modify norm no format float %.17g\nthermo {}\ntimestep {:.17g}\n",
             std::max(options.warm, options.steps), options.dt);
  if (options.warm > 0) fmt::print(input, "run {}\n", options.warm);
  fmt::print(input, "run {}\nwrite_dump all custom end.dump id x y z vx vy vz modify sort id format float %.17g\n",
             options.steps);
}

/// The last thermo line, and the processor time of the last loop.
template <int D>
void read_log(const std::filesystem::path& folder, EndState<D>& state) {
  std::ifstream log(folder / "log.lammps");
  std::string line, last;
  bool table = false;
  while (std::getline(log, line)) {
    if (line.find("Loop time of") == 0) {
      state.seconds = std::stod(line.substr(13));
      table = false;
    }
    if (line.find("% CPU use") != std::string::npos) state.seconds *= std::stod(line) / 100;
    if (table) last = line;
    if (line.find("Step") != std::string::npos && line.find("c_z") != std::string::npos) table = true;
  }
  std::istringstream row(last);
  double step = 0, xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  row >> step >> xx >> yy >> zz >> xy >> xz >> yz >> state.z;
  if (!row) throw std::runtime_error("LAMMPS wrote no results: see " + (folder / "log.lammps").string());
  Mat<3> sigma;
  sigma << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  state.stress = sigma.topLeftCorner<D, D>();
}

template <int D>
void read_dump(const std::filesystem::path& folder, int count, double rate, EndState<D>& state) {
  std::ifstream dump(folder / "end.dump");
  std::string line;
  while (std::getline(dump, line) && line.find("ITEM: ATOMS") != 0) {
  }
  for (int k = 0; k < count; ++k) {
    int id = 0;
    Vec<3> x, v;
    dump >> id;
    for (int a = 0; a < 3; ++a) dump >> x[a];
    for (int a = 0; a < 3; ++a) dump >> v[a];
    v.x() -= rate * x.y();
    state.position.push_back(x.head<D>());
    state.velocity.push_back(v.head<D>());
  }
  if (!dump) throw std::runtime_error("LAMMPS wrote no positions: see " + (folder / "end.dump").string());
}

}  // namespace

std::string lammps_pair(LammpsPair kind, const PairLaw& law, double mass, double diameter, double force) {
  return law.normal_law == NormalLaw::hertz ? hertz_pair(kind, law, mass, diameter, force)
                                            : hooke_pair(kind, law, mass);
}

bool lammps_installed() { return std::system("command -v lmp >/dev/null 2>&1") == 0; }

template <int D>
EndState<D> run_lammps(const Sample<D>& sample, const LammpsOptions& options, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_lammps_data<D>((folder / "sample.data").string(), sample);
  write_script(sample, options, folder);
  const std::string command =
      "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 lmp -in in.run -screen none >lmp.out 2>&1";
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("lmp failed: see " + (folder / "log.lammps").string());
  EndState<D> state;
  read_log(folder, state);
  read_dump(folder, sample.count(), options.rate, state);
  return state;
}

template <int D>
double rms_distance(const Mat<D>& box, const std::vector<Vec<D>>& a, const std::vector<Vec<D>>& b,
                    const std::vector<char>& weigh) {
  const Mat<D> inverse = box.inverse();
  double sum = 0;
  long count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!weigh.empty() && !weigh[i]) continue;
    ++count;
    Vec<D> fraction = inverse * (a[i] - b[i]);
    for (int k = 0; k < D; ++k) fraction[k] -= std::round(fraction[k]);
    sum += (box * fraction).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(count));
}

template EndState<2> run_lammps<2>(const Sample<2>&, const LammpsOptions&, const std::filesystem::path&);
template EndState<3> run_lammps<3>(const Sample<3>&, const LammpsOptions&, const std::filesystem::path&);
template double rms_distance<2>(const Mat<2>&, const std::vector<Vec<2>>&, const std::vector<Vec<2>>&,
                                const std::vector<char>&);
template double rms_distance<3>(const Mat<3>&, const std::vector<Vec<3>>&, const std::vector<Vec<3>>&,
                                const std::vector<char>&);

}  // namespace galet::bench
