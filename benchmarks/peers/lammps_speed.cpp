// Grain-steps per second of processor time of LAMMPS and of the md engine, in turn, on the same packing, law, step and
// one core; and of the md engine on two threads against one.
//
//   lammps_speed FOLDER cases [CASE...]     CSV, a row per case (default: all; 20 to 90 s each)
//   lammps_speed FOLDER threads             CSV, 4096 and 32768 spheres, wall time; beside the speedup of two threads
//                                           that of two runs which share nothing (`side_by_side`): what the machine,
//                                           whose processors may be threads of one core, has to give
//   lammps_speed FOLDER packings            only makes the packings
//
// Packings: benchmarks/peers/packings.hpp, kept in FOLDER. `hold`: the cell does not move; `shear`: constant volume,
// L_xy = 1e-4 sqrt(K_N / m), about 1 % of strain under the clock, lists rebuilt on both sides. dt = tau_c / 55.
//
// LAMMPS is given the best of: pair styles (`history` styles are quicker; they damp and keep springs a little otherwise
// for unequal grains and Hertz contacts, see lammps_run.hpp), skins of the list, newton on and off, sorting of atoms
// never, every 100 or 1000 steps. They are tried one after the other on shorter runs. `processors` has nothing to
// choose on one core. Its time is that of its loop times its CPU use, ours the processor time of the thread.
// `ratio_usual`: against LAMMPS set as in its own granular example (examples/pour): newton off, a skin of 0.2 d, atoms
// sorted every 1000 steps as is its default; what who doesn't tune it sees.
//
// That both do the same work is checked on the end of a shorter run with the pair style whose law is ours (`granular`
// where grains are unequal or the law is Hertz'): stress, coordination, kinetic energy and positions. They can't be
// equal: half-step velocities, lever arms and springs differ (lammps_run.hpp), and contacts of loose grains decide
// later ones. The exit code is 1 when a difference is above what those account for (`sound`).
#include <algorithm>
#include <barrier>
#include <cstdio>
#include <cstring>
#include <thread>

#include <fmt/format.h>

#include "benchmarks/peers/lammps_run.hpp"
#include "benchmarks/peers/packings.hpp"
#include "common/core/clock.hpp"
#include "common/core/parallel.hpp"

namespace galet::bench {
namespace {

struct Case {
  const char* name;
  int dim, count, copies;
  bool hertz, shear;
  long steps;  ///< under the clock
  int pairs() const { return copies == 1 ? 5 : 3; }
};

constexpr Case cases[] = {
    {"linear_4096_hold", 3, 4096, 1, false, false, 3000}, {"linear_4096_shear", 3, 4096, 1, false, true, 3000},
    {"hertz_4096_hold", 3, 4096, 1, true, false, 3000},   {"hertz_4096_shear", 3, 4096, 1, true, true, 3000},
    {"linear_32768_hold", 3, 4096, 2, false, false, 400}, {"linear_32768_shear", 3, 4096, 2, false, true, 600},
    {"disks_2025_shear", 2, 2025, 1, false, true, 6000},
};
constexpr double steps_per_collision = 55;
constexpr long warm = 300;
// The ends of longer runs differ by what single contacts decided on the way (Lyapunov growth), in either code.
constexpr long check_steps = 1000;

/// What both codes run.
template <int D>
struct Work {
  Scene scene;
  Sample<D> sample;
  Derived derived;
  double rate = 0;
  long steps = 0;
  std::filesystem::path folder;
};

template <int D>
Work<D> work_of(const Case& which, const std::filesystem::path& folder) {
  Work<D> work;
  work.scene = peer_scene(D, which.count, which.hertz);
  work.sample = replicated<D>(peer_packing<D>(which.count, which.hertz, folder), which.copies);
  const Derived under_pressure = derive(work.scene, grain_facts<D>(work.scene, work.sample));
  work.scene.md.dt = *under_pressure.collision_time / steps_per_collision;
  work.scene.loading = LoadingSpec{};
  work.scene.loading.pressure = 1;  // what the stiffness level refers to
  if (which.shear) {
    work.rate = 1e-4 * std::sqrt(*under_pressure.contact_stiffness / under_pressure.grains.mean_mass);
    work.scene.loading.kind = LoadingKind::drives;
    work.scene.loading.drives = {{"xy", work.rate, std::nullopt}};
  }
  work.derived = derive(work.scene, grain_facts<D>(work.scene, work.sample));
  work.steps = which.steps;
  work.folder = folder / which.name;
  return work;
}

template <int D>
EndState<D> run_galet(const Work<D>& work, double (*clock)() = thread_seconds) {
  auto engine = md::make_engine<D>(work.scene, work.derived, work.sample);
  engine->advance(warm);
  const double start = clock();
  engine->advance(work.steps);
  const double seconds = clock() - start;
  EndState<D> end = end_of<D>(*engine);
  end.seconds = seconds;
  return end;
}

template <int D>
LammpsOptions options_of(const Work<D>& work, LammpsPair pair) {
  const GrainFacts& grains = work.derived.grains;
  LammpsOptions options;
  options.pair = lammps_pair(pair, work.derived.laws.at(0, 0), grains.mean_mass, grains.mean_diameter, 1);
  options.rate = work.rate;
  options.dt = *work.derived.md_dt;
  options.warm = warm;
  options.steps = work.steps;
  return options;
}

const char* style_name(const LammpsOptions& options) {
  return options.pair.find("granular") == std::string::npos ? "history" : "granular";
}

/// The settings of LAMMPS's own granular example.
template <int D>
LammpsOptions usual(const Work<D>& work) {
  LammpsOptions options = options_of(work, LammpsPair::history);
  options.newton = false, options.skin = 0.2, options.sort_every = 1000;
  return options;
}

/// The best settings, one after the other; a third of the steps each.
template <int D>
LammpsOptions tuned(const Work<D>& work) {
  LammpsOptions best;
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](LammpsOptions options) {
    options.steps = work.steps / 3;
    const double seconds = run_lammps<D>(work.sample, options, work.folder).seconds;
    if (seconds >= least) return;
    least = seconds;
    best = options;
  };
  const auto variants = [&](auto change, auto... values) {
    const LammpsOptions base = best;
    (
        [&] {
          LammpsOptions options = base;
          change(options, values);
          attempt(options);
        }(),
        ...);
  };
  best = usual(work);
  variants([](LammpsOptions& o, double skin) { o.skin = skin; }, 0.01, 0.025, 0.05, 0.1, 0.2);
  variants([](LammpsOptions& o, bool newton) { o.newton = newton; }, true);
  variants([](LammpsOptions& o, int every) { o.sort_every = every; }, 0, 100);
  variants([&](LammpsOptions& o, LammpsPair pair) { o.pair = options_of(work, pair).pair; }, LammpsPair::granular);
  best.steps = work.steps;
  return best;
}

struct Spread {
  double median, least, most;
};

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

template <int D>
double kinetic_energy(const Sample<D>& sample, const EndState<D>& end) {
  double sum = 0;
  for (int i = 0; i < sample.count(); ++i) sum += 0.5 * sample.mass[i] * end.velocity[i].squaredNorm();
  return sum;
}

/// How far the ends of the two codes lie apart.
struct Difference {
  double stress;    ///< largest component, over the largest one
  double z;         ///< relative
  double energy;    ///< kinetic, relative; only in shear does it last
  double position;  ///< rms, over the rms non-affine displacement of the run
};

template <int D>
Difference difference(const Work<D>& work, const EndState<D>& ours, const EndState<D>& theirs) {
  const double strain = work.rate * *work.derived.md_dt * static_cast<double>(warm + work.steps);
  Mat<D> box = work.sample.cell.box;
  box(0, 1) += strain * box(1, 1);
  std::vector<Vec<D>> affine = work.sample.position;
  for (Vec<D>& x : affine) x.x() += strain * x.y();
  const double moved = rms_distance<D>(box, affine, ours.position);
  const double energy = kinetic_energy(work.sample, ours);
  return {(ours.stress - theirs.stress).cwiseAbs().maxCoeff() / ours.stress.cwiseAbs().maxCoeff(),
          std::abs(theirs.z / ours.z - 1), std::abs(kinetic_energy(work.sample, theirs) / energy - 1),
          rms_distance<D>(box, ours.position, theirs.position) / moved};
}

template <int D>
bool run_case(const Case& which, const std::filesystem::path& folder) {
  const Work<D> work = work_of<D>(which, folder);
  const LammpsOptions options = tuned<D>(work);
  std::vector<double> ours, theirs, ratios, usual_ratios;
  EndState<D> end;
  const double work_done = static_cast<double>(work.sample.count()) * static_cast<double>(work.steps);
  for (int k = 0; k < which.pairs(); ++k) {
    const double seconds = run_lammps<D>(work.sample, options, work.folder).seconds;
    const double usual_seconds = run_lammps<D>(work.sample, usual(work), work.folder).seconds;
    end = run_galet<D>(work);
    usual_ratios.push_back(usual_seconds / end.seconds);
    theirs.push_back(1e-6 * work_done / seconds);
    ours.push_back(1e-6 * work_done / end.seconds);
    ratios.push_back(ours.back() / theirs.back());
  }
  LammpsOptions same = options;
  same.pair = options_of(work, D == 2 || which.hertz ? LammpsPair::granular : LammpsPair::history).pair;
  Work<D> check = work;
  check.steps = same.steps = std::min(work.steps, check_steps);
  const Difference apart = difference<D>(check, run_galet<D>(check), run_lammps<D>(work.sample, same, work.folder));
  const Spread ratio = spread(ratios);
  // What the difference of first order in dt makes of positions at this step is 0.01 (lammps.cpp); the rest is room for
  // the loose grains. Disks have unequal neighbours: more contacts open and close on the way.
  const bool sound =
      apart.stress < 0.02 && apart.z < 0.02 && apart.position < 0.05 && (!which.shear || apart.energy < 0.1);
  fmt::print("{},{},{},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{},{},{:g},{},{:.4f},{:.1e},{:.1e},{:.1e},{:.1e},{}\n",
             which.name, work.sample.count(), work.steps, spread(ours).median, spread(theirs).median, ratio.median,
             ratio.least, ratio.most, spread(usual_ratios).median, style_name(options), options.newton ? "on" : "off",
             options.skin, options.sort_every, end.z, apart.stress, apart.z, apart.energy, apart.position,
             sound ? "yes" : "NO");
  std::fflush(stdout);
  return sound;
}

int run_cases(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  if (!lammps_installed()) {
    fmt::print("skipped: there is no program lmp (Debian: apt-get install lammps)\n");
    return 0;
  }
  for (const std::string& name : names)
    if (std::none_of(std::begin(cases), std::end(cases), [&](const Case& c) { return name == c.name; })) {
      std::string known;
      for (const Case& which : cases) known += std::string(" ") + which.name;
      throw std::runtime_error(fmt::format("no case called {}; there are{}", name, known));
    }
  fmt::print(
      "case,grains,steps,galet_M_per_s,lammps_M_per_s,ratio_median,ratio_min,ratio_max,ratio_usual,lammps_style,newton,"
      "skin,"
      "sort,z,stress_difference,z_difference,energy_difference,position_difference,sound\n");
  bool sound = true;
  for (const Case& which : cases) {
    if (!names.empty() && std::find(names.begin(), names.end(), which.name) == names.end()) continue;
    sound &= which.dim == 2 ? run_case<2>(which, folder) : run_case<3>(which, folder);
  }
  return sound ? 0 : 1;
}

/// Wall seconds of two runs of one thread each at the same time, from the start of both to the end of the later one.
double seconds_side_by_side(const Work<3>& work) {
  std::barrier both(2);
  double seconds[2];
  const auto run = [&](double& mine) {
    auto engine = md::make_engine<3>(work.scene, work.derived, work.sample);
    engine->advance(warm);
    both.arrive_and_wait();
    const double start = wall_seconds();
    engine->advance(work.steps);
    mine = wall_seconds() - start;
  };
  std::thread other(run, std::ref(seconds[1]));
  run(seconds[0]);
  other.join();
  return std::max(seconds[0], seconds[1]);
}

int run_threads(const std::filesystem::path& folder) {
  fmt::print("case,grains,steps,one_M_per_s,two_M_per_s,speedup_median,speedup_min,speedup_max,side_by_side\n");
  for (const Case& which : cases) {
    if (which.dim == 2 || which.hertz) continue;
    const Work<3> work = work_of<3>(which, folder);
    std::vector<double> one, two, gain, side_by_side;
    const double work_done = 1e-6 * static_cast<double>(work.sample.count()) * static_cast<double>(work.steps);
    for (int k = 0; k < which.pairs(); ++k) {
      set_thread_count(1);
      one.push_back(work_done / run_galet<3>(work, wall_seconds).seconds);
      set_thread_count(2);
      two.push_back(work_done / run_galet<3>(work, wall_seconds).seconds);
      gain.push_back(two.back() / one.back());
      set_thread_count(1);
      side_by_side.push_back(2 * work_done / seconds_side_by_side(work) / one.back());
    }
    const Spread speedup = spread(gain);
    fmt::print("{},{},{},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f}\n", which.name, work.sample.count(), work.steps,
               spread(one).median, spread(two).median, speedup.median, speedup.least, speedup.most,
               spread(side_by_side).median);
    std::fflush(stdout);
  }
  return 0;
}

int run(const std::filesystem::path& folder, const std::string& what, const std::vector<std::string>& names) {
  if (what == "threads") return run_threads(folder);
  if (what == "cases") return run_cases(folder, names);
  if (what != "packings") throw std::runtime_error("expected cases, threads or packings, found " + what);
  peer_packing<3>(4096, false, folder);
  peer_packing<3>(4096, true, folder);
  peer_packing<2>(2025, false, folder);
  return 0;
}

}  // namespace
}  // namespace galet::bench

int main(int argc, char** argv) try {
  if (argc < 3) {
    fmt::print(stderr, "usage: lammps_speed FOLDER cases|threads|packings [CASE...]\n");
    return 2;
  }
  return galet::bench::run(argv[1], argv[2], std::vector<std::string>(argv + 3, argv + argc));
} catch (const std::exception& error) {
  fmt::print(stderr, "lammps_speed: {}\n", error.what());
  return 1;
}
