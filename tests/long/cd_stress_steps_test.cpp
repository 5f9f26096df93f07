// The stress of single steps of a stress-controlled cell: isotropic, oedometric and triaxial paths of disks and
// spheres.
//
// In every step, whether the solver has converged or not, the stress of its impulses (with branches, velocities and
// volume of its start) is the target and the cell's own inertia:
//   V (sigma - Sigma) : G = inertia dq/dt (1)
// At rest dq/dt is the solver's error. It ends with a miss m of the natural map, |m| <= tol |r~| (cd/residual.hpp), and
// where no bound is reached the motion u~ of the contacts is m. With W~ = H~^T H~ scaled to unit blocks and r* the
// impulses at equilibrium, 2 E = (r~ - r*) . u~ and |r~ - r*| <= sqrt(2 E / lambda), lambda the least eigenvalue of W~
// that is not zero. So inertia q^2 <= 2 E <= tol^2 |r~|^2 / lambda, and by (1)
//   |sigma - Sigma| <= tol sqrt(inertia / lambda) |r~| / (V dt) (2)
// which is tested with lambda = 1, its largest value. On the way, while contacts slide and meet, dq/dt is that of the
// cell itself and no error: its jumps are of the order of the rate imposed, and what they take from the stress goes
// with the cell's inertia.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::cd_stress_steps_test {
namespace {

constexpr double pressure = 1, dt = 0.01;

template <int D>
Scene path_scene(std::vector<CellDrive> drives, double tolerance, double inertia_factor = 1) {
  Scene scene = periodic_scene(D, 0.3, 0.1, 1e4);
  scene.loading.kind = LoadingKind::drives;
  scene.loading.pressure = pressure;
  scene.loading.drives = std::move(drives);
  scene.cell.inertia_factor = inertia_factor;
  scene.cd.dt = dt;
  scene.cd.tolerance = tolerance;
  scene.cd.max_sweeps = 20000;
  return scene;
}

CellDrive held(int axis, double stress) { return {std::string(2, "xyz"[axis]), std::nullopt, stress}; }

template <int D>
std::vector<CellDrive> isotropic() {
  std::vector<CellDrive> drives;
  for (int a = 0; a < D; ++a) drives.push_back(held(a, pressure));
  return drives;
}
/// The last axis is compressed at `rate`, the others hold their stress.
template <int D>
std::vector<CellDrive> triaxial(double rate) {
  std::vector<CellDrive> drives = isotropic<D>();
  drives.back() = {std::string(2, "xyz"[D - 1]), -rate, std::nullopt};
  return drives;
}

/// What a snapshot shows, kept while the engine goes on.
template <int D>
struct Start {
  Cell<D> cell;
  std::vector<Vec<D>> position, velocity;

  explicit Start(const Snapshot<D>& state)
      : cell(*state.cell),
        position(state.position.begin(), state.position.end()),
        velocity(state.velocity.begin(), state.velocity.end()) {}
};

template <int D>
struct StepStress {
  Mat<D> sigma = Mat<D>::Zero();
  double turned = 0;    ///< what sigma errs by, since forces are shown along the normals of the step's end
  double impulses = 0;  ///< |r~|^2
};

template <int D>
StepStress<D> stress_of_step(const Start<D>& start, const Snapshot<D>& end) {
  const Mat<D> inverse = start.cell.box.inverse();
  StepStress<D> step;
  const ContactColumns<D>& contacts = *end.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const int i = contacts.i[c], j = contacts.j[c];
    Vec<D> branch = start.position[j] - start.position[i];
    branch += start.cell.box * (inverse * (contacts.branch[c] - branch)).array().round().matrix();
    const Vec<D>& force = contacts.force[c];
    step.sigma += force * branch.transpose();
    const double turn = (contacts.normal[c] - branch.normalized()).norm();
    double spin = 0;  // about the normal
    if constexpr (D == 3) spin = 0.5 * dt * std::abs((end.spin[i] + end.spin[j]).dot(contacts.normal[c]));
    step.turned += force.norm() * branch.norm() * (turn + spin);
    const double masses = 1 / end.mass[i] + 1 / end.mass[j];
    const double weight = masses * (1 + (D - 1) / inertia_ratio<D> / D);  // mean of W_NN and W_TT
    step.impulses += weight * dt * dt * force.squaredNorm();
  }
  for (int i = 0; i < end.grains(); ++i) step.sigma += end.mass[i] * start.velocity[i] * start.velocity[i].transpose();
  step.sigma /= start.cell.volume(), step.turned /= start.cell.volume();
  return step;
}

struct Steps {
  double worst = 0;  ///< largest |sigma - Sigma| / P
  double mean_square = 0;
  double allowed = 0;  ///< by the solver's error, in the same units
};

/// Looks at every one of `count` steps; (1) is checked in each.
template <int D>
Steps watch(Engine<D>& engine, const std::vector<CellMode<D>>& modes, int count) {
  Steps seen;
  for (int k = 0; k < count; ++k) {
    const long divided = engine.solver_summary().divided;
    const Start<D> start(engine.snapshot());
    engine.advance(1);
    if (engine.solver_summary().divided > divided) continue;  // forces shown are those of its last part
    const Snapshot<D> end = engine.snapshot();
    const StepStress<D> step = stress_of_step<D>(start, end);
    const double volume = start.cell.volume();
    double worst = 0;
    for (const CellMode<D>& mode : modes) {
      if (!mode.stress_driven) continue;
      const double off = step.sigma.cwiseProduct(mode.direction).sum() - mode.load;
      const double change = (end.cell->rate - start.cell.rate).cwiseProduct(mode.direction).sum();
      const double inertia = mode.inertia * change / (mode.direction.squaredNorm() * volume * dt);
      // Sums of some thousand terms, and rates that are rounded and divided by dt.
      EXPECT_NEAR(off, inertia, 1.01 * step.turned + 1e-11) << "step " << k;
      worst = std::max(worst, std::abs(off) / pressure);
      seen.allowed = std::max(seen.allowed, std::sqrt(mode.inertia * step.impulses) / (volume * dt * pressure));
    }
    seen.worst = std::max(seen.worst, worst);
    seen.mean_square += worst * worst / count;
  }
  return seen;
}

template <int D>
Sample<D> sample_of(const Snapshot<D>& state) {
  Sample<D> sample;
  sample.resize(state.grains());
  sample.cell = *state.cell;
  sample.cell.rate.setZero();
  sample.position.assign(state.position.begin(), state.position.end());
  sample.radius.assign(state.radius.begin(), state.radius.end());
  sample.mass.assign(state.mass.begin(), state.mass.end());
  return sample;
}

/// A path from a sample: its engine, and what its cell is driven by.
template <int D>
struct Path {
  std::unique_ptr<Engine<D>> engine;
  std::vector<CellMode<D>> modes;

  Path(const Scene& scene, const Sample<D>& sample)
      : engine(make_engine<D>(EngineKind::cd, scene, sample)),
        modes(cell_modes<D>(scene, derive_for<D>(scene, sample), sample)) {}
};

/// 256 disks or 216 spheres at rest under the pressure.
template <int D>
const Sample<D>& packing() {
  static const Sample<D> made = [] {
    const Sample<D> gas = gas_sample<D>(D == 2 ? 16 : 6, D == 2 ? 0.54 : 0.28, 0.2, 33, 0.2);
    Path<D> path(path_scene<D>(isotropic<D>(), 1e-4), gas);
    watch<D>(*path.engine, path.modes, 500);  // the way there
    path.engine->advance(D == 2 ? 9000 : 5000);
    return sample_of<D>(path.engine->snapshot());
  }();
  return made;
}

/// Runs a path that comes to rest, and looks at 300 steps there.
template <int D>
void check_rest(const std::string& name, const std::vector<CellDrive>& drives, double tolerance) {
  SCOPED_TRACE(name + ", D = " + std::to_string(D) + ", tolerance " + std::to_string(tolerance));
  Path<D> path(path_scene<D>(drives, tolerance), packing<D>());
  watch<D>(*path.engine, path.modes, 200);  // the approach
  path.engine->advance(1500);
  const Steps steps = watch<D>(*path.engine, path.modes, 300);
  EXPECT_EQ(path.engine->solver_summary().missed, 0);
  EXPECT_LT(steps.worst, tolerance * steps.allowed);
  ::testing::Test::RecordProperty(name + std::to_string(D) + "_per_mille_of_tolerance",
                                  static_cast<int>(1000 * steps.worst / tolerance));
}

template <int D>
void check_paths_that_rest() {
  for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
    check_rest<D>("isotropic", isotropic<D>(), tolerance);
    // At 1e-6 the spheres still settle after this path's 1700 steps, 3e-5 P off their target: that is no state at rest.
    if (D == 3 && tolerance < 1e-5) continue;
    check_rest<D>("oedometric", {held(D - 1, 2 * pressure)}, tolerance);  // no strain along the others
  }
}

TEST(StressOfStepsCd, IsHeldAtRestWithinTheSolversErrorDisks) { check_paths_that_rest<2>(); }
TEST(StressOfStepsCd, IsHeldAtRestWithinTheSolversErrorSpheres) { check_paths_that_rest<3>(); }

/// Triaxial compression: the lateral stress of single steps, with less and less inertia of the cell.
template <int D>
void check_triaxial() {
  SCOPED_TRACE("D = " + std::to_string(D));
  constexpr double rate = 1e-3;
  std::vector<double> deviation;
  for (const double factor : {1.0, 0.1, 0.01}) {
    SCOPED_TRACE(factor);
    Path<D> path(path_scene<D>(triaxial<D>(rate), 1e-4, factor), packing<D>());
    const double inertia = path.modes.back().stress_driven ? path.modes.back().inertia : path.modes.front().inertia;
    const double jump = inertia * rate / (packing<D>().cell.volume() * dt * pressure);
    path.engine->advance(500);
    const Steps steps = watch<D>(*path.engine, path.modes, 500);
    deviation.push_back(std::sqrt(steps.mean_square));
    // No step changes a lateral rate by more than the axial one.
    EXPECT_LT(steps.worst, jump);
    const std::string name = "triaxial" + std::to_string(D) + "_factor_" + std::to_string(factor);
    ::testing::Test::RecordProperty(name + "_worst_ppm", static_cast<int>(1e6 * steps.worst));
    ::testing::Test::RecordProperty(name + "_rms_ppm", static_cast<int>(1e6 * deviation.back()));
  }
  // In proportion to the inertia, but for other paths of the same packing: a factor of two or three.
  EXPECT_LT(deviation[1], deviation[0] / 3);
  EXPECT_LT(deviation[2], deviation[1] / 3);
}

TEST(StressOfStepsCd, FollowsTheCellsInertiaOnTheWayDisks) { check_triaxial<2>(); }
TEST(StressOfStepsCd, FollowsTheCellsInertiaOnTheWaySpheres) { check_triaxial<3>(); }

}  // namespace
}  // namespace galet::test::cd_stress_steps_test
