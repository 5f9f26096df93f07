// Error of the md engine against the time step, beside the usual scheme: collisions (usual_scheme.hpp) and packings
// (LAMMPS, where installed); and the work to reach an error.
//
//   md_accuracy OUT [SPEED.csv]     writes OUT/orders.csv and OUT/work.csv; SPEED.csv: `cases` of lammps_speed
//
// Collisions: two equal spheres that meet at speed v0 at deflections of about 1e-3 d, 24 phases of the first contact in
// the step, tau_c / dt never whole (else errors of opening and closing cancel by luck); root mean squares of
//   restitution   final relative normal velocity / v0; head-on, against the closed form
//   velocity      relative tangential velocity and spins (times R) / v0; 45 degrees, spins across the plane
//   position      relative position / (v0 tau_c); the same
// The last two against md at tau_c / 20000; `check` is how far the usual scheme, extrapolated to dt = 0 at first order
// from tau_c / 10000 and tau_c / 20000, lies from that: two programs, one limit. It bounds what the tables can show.
// Packings: 1000 spheres (peers/packings.hpp), ten collision times: kicked grains; sheared at the rate of
// lammps_speed; the same with mu = 0. Rms position error over the rms non-affine displacement, each code against itself
// at tau_c / 1280 (LAMMPS at 2560: its first-order error there is 1/16 of that at 160), grains that carry force at the
// end. The kicked packing shows the schemes alone; in the sheared ones LAMMPS errs more than its scheme must, probably
// because it moves the cell after the forces, so that images lag by a step (not proven). `order`: between the first and
// the last step, and of the last halving. `reached`: steps per collision at the target error, by interpolation in
// logarithms; ~ marks an extrapolation.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <unistd.h>

#include "benchmarks/peers/packings.hpp"
#include "benchmarks/usual_scheme.hpp"
#include "common/core/random.hpp"
#include "common/scene/restitution.hpp"

namespace galet::bench {
namespace {

constexpr double octaves[] = {10, 20, 40, 80, 160, 320};
constexpr double off_whole = 0.4;  ///< steps per collision = octave + this
constexpr int phases = 24;
constexpr double speed = 1e-3;

/// Errors of one scheme in one quantity, by octave.
struct Line {
  std::string name, quantity, scheme;
  std::vector<double> error;
  double target = 1e-3;
  double check = 0;
};

/// Steps per collision at which the error is `target`.
struct Reached {
  double steps = 0;
  bool extrapolated = false;
};

Reached reached(const Line& line) {
  const auto& e = line.error;
  std::size_t k = 1;
  while (k + 1 < e.size() && e[k] > line.target) ++k;
  const double coarse = octaves[k - 1] + off_whole, fine = octaves[k] + off_whole;
  const double order = std::log(e[k - 1] / e[k]) / std::log(fine / coarse);
  return {fine * std::pow(e[k] / line.target, 1 / order), e.front() < line.target || e.back() > line.target};
}

struct Collision {
  std::string name;
  Scene scene;
  PairLaw law;
  double duration = 0;
  bool oblique = false;
};

Collision collision(NormalLaw law, DampingConvention convention, bool oblique) {
  Collision made;
  made.name =
      fmt::format("{} {} {}", law == NormalLaw::linear ? "linear" : "hertz",
                  convention == DampingConvention::elastic ? "elastic" : "total", oblique ? "oblique" : "head-on");
  Scene& scene = made.scene;
  scene.dimension = 3;
  scene.cell.periodic.assign(3, false);
  scene.material.friction = 0.3;
  scene.material.damping_ratio = 0.212;
  scene.material.normal_law = law;
  scene.material.convention = convention;
  scene.md.allow_unsafe_dt = true;  // the bound is for packings
  scene.md.dt = 1;
  scene.run.duration = 1;
  if (law == NormalLaw::linear) {
    scene.material.normal_stiffness = 1;
    scene.material.tangential_stiffness_ratio = 2.0 / 7;
  } else {
    scene.material.young_modulus = 300;
    scene.material.poisson_ratio = 0.3;
  }
  made.law = law_table(scene, std::nullopt, 1).at(0, 0);
  made.oblique = oblique;
  if (law == NormalLaw::linear) {
    made.duration = collision_duration(made.law.damping_ratio, convention, 0.5, 1);
  } else {  // of the elastic impact
    const double k = 4.0 / 3 * made.law.stiffness * 0.5;
    made.duration = 2.9432 * std::pow(1.25 * 0.5 * speed * speed / k, 0.4) / speed;
  }
  return made;
}

TwoSpheres start_of(const Collision& which, int phase) {
  // The golden ratio spreads the phases evenly.
  const double gap = 0.2 * speed * which.duration * std::fmod(0.5 + phase * 0.6180339887498949, 1.0);
  TwoSpheres start;
  start.position = {Vec<3>(10, 10, 10), Vec<3>(11 + gap, 10, 10)};
  const double across = which.oblique ? speed / 2 : 0;
  start.velocity = {Vec<3>(speed / 2, across, 0), Vec<3>(-speed / 2, -across, 0)};
  start.spin = {Vec<3>(0, across, across), Vec<3>(0, across, across)};
  return start;
}

TwoSpheres run_md(const Collision& which, const TwoSpheres& start, double dt, long steps) {
  Sample<3> sample;
  sample.resize(2);
  sample.cell.box = 20 * Mat<3>::Identity();
  for (int a : {0, 1}) {
    sample.position[a] = start.position[a];
    sample.velocity[a] = start.velocity[a];
    sample.spin[a] = start.spin[a];
  }
  Scene scene = which.scene;
  scene.md.dt = dt;
  auto engine = md::make_engine<3>(scene, derive(scene, grain_facts<3>(scene, sample)), sample);
  engine->advance(steps);
  const Snapshot<3> state = engine->snapshot();
  TwoSpheres end;
  for (int a : {0, 1}) {
    end.position[a] = state.position[a];
    end.velocity[a] = state.velocity[a];
    end.spin[a] = state.spin[a];
  }
  return end;
}

TwoSpheres run_usual(const Collision& which, const TwoSpheres& start, double dt, long steps) {
  UsualScheme scheme(which.law, start, dt);
  scheme.advance(steps);
  return scheme.state();
}

using Scheme = std::function<TwoSpheres(const Collision&, const TwoSpheres&, double, long)>;

TwoSpheres run_phase(const Collision& which, const Scheme& scheme, int phase, double steps_per_collision) {
  const double time = 3 * which.duration, dt = which.duration / steps_per_collision;
  const long steps = static_cast<long>(time / dt);
  TwoSpheres end = scheme(which, start_of(which, phase), dt, steps);
  // They fly freely by then.
  for (int a : {0, 1}) end.position[a] += (time - static_cast<double>(steps) * dt) * end.velocity[a];
  return end;
}

/// What is compared: relative velocity over v0, spins (times R) over v0, relative position over v0 tau_c.
using Outcome = Eigen::Matrix<double, 12, 1>;

Outcome outcome(const Collision& which, const TwoSpheres& end) {
  Outcome all;
  all << (end.velocity[1] - end.velocity[0]) / speed, end.spin[0] / 2 / speed, end.spin[1] / 2 / speed,
      (end.position[1] - end.position[0]) / (speed * which.duration);
  return all;
}

std::vector<Outcome> references(const Collision& which, double& check) {
  std::vector<Outcome> all;
  double sum = 0;
  for (int phase = 0; phase < phases; ++phase) {
    all.push_back(outcome(which, run_phase(which, run_md, phase, 20000)));
    const Outcome coarse = outcome(which, run_phase(which, run_usual, phase, 10000));
    const Outcome fine = outcome(which, run_phase(which, run_usual, phase, 20000));
    sum += (2 * fine - coarse - all.back()).squaredNorm();
  }
  check = std::sqrt(sum / phases);
  return all;
}

/// The lines of one collision: of both schemes, one or two quantities each.
std::vector<Line> collision_lines(const Collision& which) {
  double check = 0;
  std::vector<Outcome> exact = references(which, check);
  const double restitution =
      restitution_of_damping(which.law.damping_ratio, which.law.convention, which.law.normal_law);
  std::vector<Line> lines;
  for (const auto& [name, scheme] : {std::pair<std::string, Scheme>{"md", run_md}, {"usual", run_usual}}) {
    Line velocity{which.name, which.oblique ? "velocity" : "restitution", name, {}, 1e-3, check};
    Line position{which.name, "position", name, {}, 1e-3, check};
    for (const double octave : octaves) {
      double of_velocity = 0, of_position = 0;
      for (int phase = 0; phase < phases; ++phase) {
        const Outcome found = outcome(which, run_phase(which, scheme, phase, octave + off_whole));
        const Outcome error = found - exact[phase];
        of_velocity += which.oblique ? error.segment<8>(1).squaredNorm() : std::pow(found[0] - restitution, 2);
        of_position += error.tail<3>().squaredNorm();
      }
      velocity.error.push_back(std::sqrt(of_velocity / phases));
      position.error.push_back(std::sqrt(of_position / phases));
    }
    lines.push_back(velocity);
    lines.push_back(position);
  }
  return lines;
}

/// A packing and what is done to it for ten collision times.
struct Treatment {
  std::string name;
  double friction = 0.3;
  bool shear = false;
};

struct Packing {
  Treatment treatment;
  Scene scene;
  Sample<3> sample;
  Derived derived;
  double duration = 0, collision_time = 0, rate = 0;
};

Packing treated(const Treatment& treatment, const Sample<3>& sample) {
  Packing made{treatment, peer_scene(3, sample.count(), false), sample, {}, 0, 0, 0};
  made.scene.material.friction = treatment.friction;
  made.scene.md.allow_unsafe_dt = true;  // coarse steps are part of the question
  const Derived under_pressure = derive(made.scene, grain_facts<3>(made.scene, sample));
  made.collision_time = *under_pressure.collision_time;
  made.duration = 10 * made.collision_time;
  const double velocity = 1e-4 * std::sqrt(*under_pressure.contact_stiffness);  // d = m = 1
  made.scene.loading = LoadingSpec{};
  made.scene.loading.pressure = 1;
  if (treatment.shear) {
    made.rate = velocity;
    made.scene.loading.kind = LoadingKind::drives;
    made.scene.loading.drives = {{"xy", made.rate, std::nullopt}};
  } else {
    // Kicks of that speed in a pattern without total momentum that no symmetry favours.
    for (int i = 0; i < sample.count(); ++i)
      made.sample.velocity[i] = velocity * Vec<3>(std::cos(2.0 * i), std::sin(3.0 * i + 1), std::cos(5.0 * i + 2));
  }
  return made;
}

long steps_of(const Packing& which, double steps_per_collision) {
  return std::lround(which.duration / which.collision_time * steps_per_collision);
}

/// The end of a run of md, and the grains that carry force there.
EndState<3> md_end(const Packing& which, double steps_per_collision, std::vector<char>* bearing = nullptr) {
  Scene scene = which.scene;
  const long steps = steps_of(which, steps_per_collision);
  scene.md.dt = which.duration / static_cast<double>(steps);
  auto engine = md::make_engine<3>(scene, derive(scene, grain_facts<3>(scene, which.sample)), which.sample);
  engine->advance(steps);
  if (bearing)  // by the rule of frictional packings: the frictionless one calls all of a sheared sample loose
    for (const char rattler : rattlers<3>(engine->snapshot(), true)) bearing->push_back(!rattler);
  return end_of<3>(*engine);
}

EndState<3> lammps_end(const Packing& which, double steps_per_collision, const std::filesystem::path& folder) {
  const Derived derived = derive(which.scene, grain_facts<3>(which.scene, which.sample));
  LammpsOptions options;
  options.pair = lammps_pair(LammpsPair::history, derived.laws.at(0, 0), 1, 1, 1);
  options.rate = which.rate;
  options.steps = steps_of(which, steps_per_collision);
  options.dt = which.duration / static_cast<double>(options.steps);
  return run_lammps<3>(which.sample, options, folder);
}

std::vector<Line> packing_lines(const Packing& which, const std::filesystem::path& folder) {
  std::vector<char> bearing;
  const EndState<3> reference = md_end(which, 1280, &bearing);
  const double strain = which.rate * which.duration;
  Mat<3> box = which.sample.cell.box;
  box(0, 1) += strain * box(1, 1);
  std::vector<Vec<3>> affine = which.sample.position;
  for (Vec<3>& x : affine) x.x() += strain * x.y();
  const double moved = rms_distance<3>(box, affine, reference.position, bearing);
  Line ours{which.treatment.name, "position", "md", {}, 2e-4, 0};
  Line theirs = ours;
  theirs.scheme = "usual";
  for (const double octave : octaves)
    if (octave < 300)
      ours.error.push_back(
          rms_distance<3>(box, md_end(which, octave + off_whole).position, reference.position, bearing) / moved);
  if (!lammps_installed()) return {ours};
  const EndState<3> limit = lammps_end(which, 2560, folder);
  theirs.check = ours.check = rms_distance<3>(box, limit.position, reference.position, bearing) / moved;
  for (std::size_t k = 0; k < ours.error.size(); ++k)
    theirs.error.push_back(
        rms_distance<3>(box, lammps_end(which, octaves[k] + off_whole, folder).position, limit.position, bearing) /
        moved);
  return {ours, theirs};
}

void print_line(std::ostream& out, const Line& line) {
  fmt::print(out, "{},{},{}", line.name, line.quantity, line.scheme);
  for (const double error : line.error) fmt::print(out, ",{:.1e}", error);
  for (std::size_t k = line.error.size(); k < std::size(octaves); ++k) fmt::print(out, ",");
  const auto& e = line.error;
  const double whole = std::log2(e.front() / e.back()) / static_cast<double>(e.size() - 1);
  const Reached at = reached(line);
  fmt::print(out, ",{:.2f},{:.2f},{:g},{}{:.0f},{:.0e}\n", whole, std::log2(e[e.size() - 2] / e.back()), line.target,
             at.extrapolated ? "~" : "", at.steps, line.check);
}

/// Column ratio_median of a case in the table of lammps_speed; 0 when it has no such row.
double speed_ratio(const std::string& file, const std::string& name) {
  std::ifstream table(file);
  std::string row;
  while (std::getline(table, row)) {
    std::istringstream cells(row);
    std::string cell;
    std::getline(cells, cell, ',');
    if (cell != name) continue;
    for (int k = 0; k < 5; ++k) std::getline(cells, cell, ',');
    return std::stod(cell);
  }
  return 0;
}

/// dt ratio times speed ratio, for each quantity that both schemes have.
void print_work(std::ostream& out, const std::vector<Line>& lines, const std::string& speeds) {
  fmt::print(out, "case,quantity,error,steps_usual,steps_md,dt_ratio,speed_ratio,work_ratio\n");
  for (const Line& ours : lines) {
    const auto theirs = std::find_if(lines.begin(), lines.end(), [&](const Line& line) {
      return line.scheme == "usual" && line.name == ours.name && line.quantity == ours.quantity;
    });
    if (ours.scheme != "md" || theirs == lines.end()) continue;
    const std::string timed = fmt::format("{}_4096_{}", ours.name.find("hertz") == 0 ? "hertz" : "linear",
                                          ours.name.find("shear") != std::string::npos ? "shear" : "hold");
    const double dt_ratio = reached(*theirs).steps / reached(ours).steps;
    const double speed_up = speeds.empty() ? 0 : speed_ratio(speeds, timed);
    fmt::print(out, "{},{},{:g},{:.0f},{:.0f},{:.2f}", ours.name, ours.quantity, ours.target, reached(*theirs).steps,
               reached(ours).steps, dt_ratio);
    if (speed_up > 0)
      fmt::print(out, ",{:.2f},{:.1f}\n", speed_up, dt_ratio * speed_up);
    else
      fmt::print(out, ",,\n");
  }
}

int run(const std::filesystem::path& out, const std::string& speeds) {
  std::filesystem::create_directories(out);
  const auto folder = std::filesystem::temp_directory_path() / ("galet_md_accuracy_" + std::to_string(getpid()));
  std::ofstream orders(out / "orders.csv");
  fmt::print(orders, "case,quantity,scheme");
  for (const double octave : octaves) fmt::print(orders, ",{:.1f}", octave + off_whole);
  fmt::print(orders, ",order,last_order,target,reached,check\n");
  std::vector<Line> lines;
  const auto keep = [&](const std::vector<Line>& made) {
    for (const Line& line : made) print_line(orders, line);
    orders.flush();
    lines.insert(lines.end(), made.begin(), made.end());
  };
  for (const bool oblique : {false, true})
    for (const NormalLaw law : {NormalLaw::linear, NormalLaw::hertz})
      for (const DampingConvention convention : {DampingConvention::elastic, DampingConvention::total})
        keep(collision_lines(collision(law, convention, oblique)));
  const Sample<3> packing = peer_packing<3>(1000, false, folder);
  for (const Treatment& treatment :
       {Treatment{"packing kicked", 0.3, false}, {"packing sheared", 0.3, true}, {"packing sheared mu 0", 0, true}})
    keep(packing_lines(treated(treatment, packing), folder));
  std::ofstream work(out / "work.csv");
  print_work(work, lines, speeds);
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace galet::bench

int main(int argc, char** argv) try {
  if (argc < 2) {
    fmt::print(stderr, "usage: md_accuracy OUT [SPEED.csv]\n");
    return 2;
  }
  return galet::bench::run(argv[1], argc > 2 ? argv[2] : "");
} catch (const std::exception& error) {
  fmt::print(stderr, "md_accuracy: {}\n", error.what());
  return 1;
}
