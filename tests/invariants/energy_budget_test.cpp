// The energy budget of md closes, for every law: what grains, cell, springs and attraction hold changes by the work of
// drives and planes less what each channel dissipates. Momentum and angular momentum are conserved to rounding.
#include <gtest/gtest.h>

#include "tests/support/sanitized.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::energy_budget_test {
namespace {

struct Case {
  std::string name;
  void (*change)(MaterialSpec&);
};

constexpr double stiffness = 1e4;

void make_hertz(MaterialSpec& material) {
  material.normal_law = NormalLaw::hertz;
  material.normal_stiffness.reset();
  material.young_modulus = 1e5;
  material.poisson_ratio = 0.3;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"linear elastic", [](MaterialSpec&) {}},
      {"linear total", [](MaterialSpec& m) { m.convention = DampingConvention::total; }},
      {"undamped", [](MaterialSpec& m) { m.restitution = 1; }},
      {"tangential viscosity", [](MaterialSpec& m) { m.tangential_damping_ratio = 0.3; }},
      {"total, tangential viscosity",
       [](MaterialSpec& m) { m.convention = DampingConvention::total, m.tangential_damping_ratio = 0.3; }},
      {"hertz", make_hertz},
      {"hertz total", [](MaterialSpec& m) { make_hertz(m), m.convention = DampingConvention::total; }},
      {"rolling", [](MaterialSpec& m) { m.rolling_friction = 0.05, m.pivoting_friction = 0; }},
      {"hertz rolling", [](MaterialSpec& m) { make_hertz(m), m.rolling_friction = 0.05; }},
      {"cohesion", [](MaterialSpec& m) { m.cohesion_force = 1; }},
      {"cohesion with range", [](MaterialSpec& m) { m.cohesion_force = 1, m.cohesion_range = 0.05; }},
      {"hertz cohesion", [](MaterialSpec& m) { make_hertz(m), m.cohesion_force = 1, m.cohesion_range = 0.05; }},
      {"square-root cohesion",
       [](MaterialSpec& m) { m.cohesion_force = 1, m.cohesion_law = CohesionLaw::square_root; }},
  };
  return all;
}

template <int D>
Scene scene_of(const Case& which, double dt) {
  Scene scene = periodic_scene(D, 0.4, 0.3, stiffness);
  which.change(scene.material);
  if (D == 3 && scene.material.rolling_friction > 0) scene.material.pivoting_friction = 0.03;
  scene.md.energy_budget = true;
  scene.md.allow_unsafe_dt = true;
  set_dt(scene, dt);
  return scene;
}

/// Residual of the budget over the energy that has passed through it.
struct Budget {
  double residual = 0, passed = 0;
  EnergyFlows flows;
};

template <int D>
Budget run_budget(const Scene& scene, const Sample<D>& sample, double duration) {
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  const double before = engine->energy().total();
  engine->advance(std::lround(duration / engine->dt()));
  Budget budget;
  budget.flows = engine->energy_flows();
  budget.residual = engine->energy().total() - before - (budget.flows.work - budget.flows.dissipated());
  budget.passed = std::abs(budget.flows.work) + budget.flows.dissipated() + before;
  return budget;
}

/// A gas that is sheared under a held normal stress: both kinds of drives work.
template <int D>
Scene sheared(const Case& which, double dt) {
  Scene scene = scene_of<D>(which, dt);
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.shear_rate = 0.5;
  scene.loading.pressure = 2;
  return scene;
}

/// Runs at three steps: the residual is of second order (trapezoidal sums and velocity Verlet; forces that jump where
/// a damped contact opens do work at one step only, so they do not lower the order of the budget). With sanitizers the
/// coarsest step only, where the residual may be 4^2 times that of the finest.
template <int D>
void check_closure(const std::function<Budget(double)>& run, double finest) {
  const std::array<double, 3> steps{4e-4, 2e-4, 1e-4};
  std::array<double, 3> residual;
  const int runs = sanitized ? 1 : 3;
  for (int k = 0; k < runs; ++k) {
    const Budget budget = run(steps[k]);
    residual[k] = std::abs(budget.residual) / budget.passed;
  }
  if (sanitized) {
    EXPECT_LT(residual[0], 16 * finest);
    return;
  }
  // Observed: 1.9 to 2.2, and more where terms cancel. Residuals scatter with the histories, which are chaotic.
  EXPECT_GT(observed_order(steps, residual), 1.6) << residual[0] << " " << residual[1] << " " << residual[2];
  EXPECT_LT(residual[2], finest);
}

template <int D>
void check_budget() {
  const Sample<D> sample = sheared_sample<D>(D == 2 ? 5 : 3);
  for (const Case& which : cases()) {
    SCOPED_TRACE(which.name + ", D = " + std::to_string(D));
    EnergyFlows flows;
    check_closure<D>(
        [&](double dt) {
          const Budget budget = run_budget<D>(sheared<D>(which, dt), sample, 1.2);
          flows = budget.flows;
          return budget;
        },
        // 60 to 200 steps per contact: errors of (w0 dt)^2 / 10 per collision, w0 dt = 0.014; (w0 dt)^2 where the
        // attraction rises like a root: the velocity then changes within the step that a crossing is corrected in.
        which.name == "square-root cohesion" ? 2e-4 : 1e-4);
    // Each channel that the law has takes its part, and none that it has not.
    const MaterialSpec material = scene_of<D>(which, 1e-4).material;
    const double share = 1e-3 * flows.dissipated();
    EXPECT_GT(flows.sliding, share);
    EXPECT_EQ(flows.viscous > share, material.restitution < 1);
    EXPECT_EQ(flows.unloading > share, material.normal_law == NormalLaw::hertz);
    EXPECT_EQ(flows.rolling > share, material.rolling_friction > 0);
    EXPECT_EQ(flows.pivoting > share, material.pivoting_friction > 0);
    EXPECT_EQ(flows.relaxation, 0);
  }
}

TEST(EnergyBudget, ClosesForEveryLawDisks) { check_budget<2>(); }
TEST(EnergyBudget, ClosesForEveryLawSpheres) { check_budget<3>(); }

/// Grains under gravity in a box whose floor goes up: the floor's work and the weight's.
template <int D>
void check_box() {
  Sample<D> sample;
  sample.cell = cube<D>(6, false);
  sample.resize(12);
  for (int k = 0; k < 12; ++k) {
    sample.position[k] = Vec<D>::Constant(1.5);
    sample.position[k][0] += 1.02 * (k % 4);
    sample.position[k][D - 1] += 1.02 * (k / 4);
  }
  vary_sizes<D>(sample, 0.05, 3);
  shake<D>(sample, 1, 5, 1);
  for (int a = 0; a < D; ++a)
    for (const double side : {1.0, -1.0}) {
      const Vec<D> normal = side * Vec<D>::Unit(a);
      const Vec<D> point = Vec<D>::Constant(side > 0 ? 0.9 : 5.2);
      sample.planes.push_back({point, normal, a == D - 1 && side > 0 ? Vec<D>(0.3 * normal) : Vec<D>(Vec<D>::Zero())});
    }
  check_closure<D>(
      [&](double dt) {
        Scene scene = scene_of<D>({"rolling", [](MaterialSpec& m) { m.rolling_friction = 0.05; }}, dt);
        scene.cell.periodic.assign(D, false);
        scene.loading.gravity.assign(D, 0.0);
        scene.loading.gravity.back() = -3;
        const Budget budget = run_budget<D>(scene, sample, 1.2);
        EXPECT_GT(std::abs(budget.flows.work), 0.1);
        return budget;
      },
      1e-4);
}

TEST(EnergyBudget, ClosesWithGravityAndAMovingFloor) {
  check_box<2>();
  check_box<3>();
}

/// Relaxers take what the budget says that they take.
template <int D>
void check_relaxers(double drag, double acceleration_damping) {
  SCOPED_TRACE("drag " + std::to_string(drag) + ", D = " + std::to_string(D));
  const Sample<D> sample = sheared_sample<D>(D == 2 ? 5 : 3);
  check_closure<D>(
      [&](double dt) {
        Scene scene = scene_of<D>(cases()[0], dt);
        scene.loading.kind = LoadingKind::isotropic;
        scene.loading.pressure = 2;
        scene.md.drag = drag;
        scene.md.acceleration_damping = acceleration_damping;
        const Budget budget = run_budget<D>(scene, sample, 1.2);
        EXPECT_GT(budget.flows.relaxation, 0.05 * budget.flows.dissipated());
        return budget;
      },
      2e-4);
}

TEST(EnergyBudget, ClosesWithRelaxers) {
  check_relaxers<2>(0.5, 0);
  check_relaxers<3>(0.5, 0);
  check_relaxers<2>(0, 0.3);
  check_relaxers<3>(0, 0.3);
}

/// A cluster in free space: total momentum and angular momentum (about the origin, spins included).
template <int D>
std::pair<Vec<D>, Spin<D>> momenta(const Snapshot<D>& state) {
  std::pair<Vec<D>, Spin<D>> total{Vec<D>::Zero(), zero_spin<D>()};
  for (int i = 0; i < state.grains(); ++i) {
    total.first += state.mass[i] * state.velocity[i];
    total.second += state.mass[i] * cross(state.position[i], state.velocity[i]) +
                    inertia_ratio<D> * state.mass[i] * state.radius[i] * state.radius[i] * state.spin[i];
  }
  return total;
}

template <int D>
void check_momenta() {
  Sample<D> sample = sheared_sample<D>(D == 2 ? 4 : 2);
  sample.cell.periodic.fill(false);
  const Vec<D> middle = 0.5 * sample.cell.box.rowwise().sum();
  for (int i = 0; i < sample.count(); ++i) sample.velocity[i] -= 2 * (sample.position[i] - middle);  // they meet
  for (const Case& which : cases()) {
    SCOPED_TRACE(which.name + ", D = " + std::to_string(D));
    Scene scene = scene_of<D>(which, 2e-4);
    scene.cell.periodic.assign(D, false);
    const auto engine = make_engine<D>(EngineKind::md, scene, sample);
    const auto before = momenta<D>(engine->snapshot());
    engine->advance(3000);
    const auto after = momenta<D>(engine->snapshot());
    EXPECT_GT(engine->energy_flows().dissipated(), 1);
    // Sums over 3000 steps of 30 grains of forces of order 10 and lever arms of order 5, each rounded: 1e-16 * 10 * 5 *
    // 3000 * dt in the mean, with a margin of 100.
    EXPECT_LT((after.first - before.first).norm(), 1e-11);
    EXPECT_LT(spin_norm(after.second - before.second), 1e-10);
  }
}

TEST(EnergyBudget, MomentaAreConservedByEveryLaw) {
  check_momenta<2>();
  check_momenta<3>();
}

}  // namespace
}  // namespace galet::test::energy_budget_test
