// The deformable periodic cell: the same motion, described in another way, must come out the same.
//
// Short runs of a sheared sample. Rounding differs between descriptions (1e-15) and grows by a factor of about
// 10 with each collision of a grain; in these runs a grain collides a few times. In cd a gap that an impact closes
// within its step enters as g / dt, which turns rounding of positions into 1e-12 of velocity, again at each such
// impact; measured: up to 5e-8. A wrong image or a wrong velocity of the flow would show as 0.1 and more.
#include <map>

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::lees_edwards_test {
namespace {

constexpr double rate = 0.5;

template <int D>
struct End {
  std::unique_ptr<Engine<D>> engine;
  Snapshot<D> state;
};

template <int D>
End<D> run(EngineKind kind, const Sample<D>& sample, double pressure, double duration = 0.4) {
  Scene scene = sheared_scene<D>(rate, pressure);
  scene.cd.tolerance = 1e-13;  // a looser tolerance would stop sweeping at a residual that depends on rounding
  scene.cd.max_sweeps = 20000;
  set_dt(scene, 1e-3);
  End<D> end{make_engine<D>(kind, scene, sample), {}};
  end.engine->advance(std::lround(duration / 1e-3));
  end.state = end.engine->snapshot();
  return end;
}

template <int D>
Sample<D> sample_of() {
  return sheared_sample<D>(D == 2 ? 5 : 3);
}

/// Positions agree up to lattice vectors and one common shift; velocities up to one common shift.
template <int D>
void expect_same(const Snapshot<D>& a, const Snapshot<D>& b, const Vec<D>& velocity_shift) {
  ASSERT_EQ(a.grains(), b.grains());
  double position = 0, velocity = 0, spin = 0;
  for (int i = 0; i < a.grains(); ++i) {
    const Vec<D> from_first_a = a.position[i] - a.position[0], from_first_b = b.position[i] - b.position[0];
    position = std::max(position, lattice_distance<D>(*a.cell, from_first_a, from_first_b));
    velocity = std::max(velocity, (b.velocity[i] - a.velocity[i] - velocity_shift).norm());
    spin = std::max(spin, spin_norm(a.spin[i] - b.spin[i]));
  }
  const double tolerance = a.engine == "md" ? 1e-9 : 1e-6;
  EXPECT_LT(position, tolerance);
  EXPECT_LT(velocity, tolerance);
  EXPECT_LT(spin, tolerance);
  EXPECT_NEAR(a.cell->volume(), b.cell->volume(), tolerance * a.cell->volume());
}

/// The run must have seen contacts, or the comparison says nothing.
template <int D>
void expect_eventful(const Sample<D>& sample, const Snapshot<D>& end) {
  double change = 0;
  for (int i = 0; i < sample.count(); ++i) change += spin_norm(end.spin[i] - sample.spin[i]) / sample.count();
  EXPECT_GT(change, 0.05);
}

template <class Check>
void for_all(Check check) {
  for (EngineKind kind : both_engines)
    for (double pressure : {0.0, 1.0}) {
      SCOPED_TRACE(to_string(kind) + " pressure " + std::to_string(pressure));
      check.template operator()<2>(kind, pressure);
      SCOPED_TRACE("3D");
      check.template operator()<3>(kind, pressure);
    }
}

TEST(LeesEdwards, MovingFrame) {
  // A velocity along the flow stays what it is (L V = 0 for V along x) and turns up in every fluctuation.
  for_all([]<int D>(EngineKind kind, double pressure) {
    Sample<D> sample = sample_of<D>();
    const End<D> plain = run<D>(kind, sample, pressure);
    expect_eventful<D>(sample, plain.state);
    const Vec<D> shift = 0.7 * Vec<D>::UnitX();
    for (Vec<D>& velocity : sample.velocity) velocity += shift;
    expect_same<D>(plain.state, run<D>(kind, sample, pressure).state, shift);
  });
}

TEST(LeesEdwards, ShiftedOrigin) {
  for_all([]<int D>(EngineKind kind, double pressure) {
    Sample<D> sample = sample_of<D>();
    const End<D> plain = run<D>(kind, sample, pressure);
    for (Vec<D>& position : sample.position) position += sample.cell.box * Vec<D>::Constant(0.37);
    expect_same<D>(plain.state, run<D>(kind, sample, pressure).state, Vec<D>::Zero());
  });
}

TEST(LeesEdwards, GrainsReplacedByTheirImages) {
  for_all([]<int D>(EngineKind kind, double pressure) {
    Sample<D> sample = sample_of<D>();
    const End<D> plain = run<D>(kind, sample, pressure);
    for (int i = 0; i < sample.count(); ++i) {
      Image<D> image;
      for (int a = 0; a < D; ++a) image[a] = (i + 2 * a) % 4 - 1;
      sample.position[i] += lattice<D>(sample.cell.box, image);
    }
    expect_same<D>(plain.state, run<D>(kind, sample, pressure).state, Vec<D>::Zero());
  });
}

TEST(LeesEdwards, EquivalentBox) {
  // Other cell vectors of the same lattice.
  for_all([]<int D>(EngineKind kind, double pressure) {
    Sample<D> sample = sample_of<D>();
    const End<D> plain = run<D>(kind, sample, pressure);
    Mat<D>& box = sample.cell.box;
    box.col(1) += box.col(0);
    if constexpr (D == 3) box.col(2) += box.col(0) - box.col(1);
    expect_same<D>(plain.state, run<D>(kind, sample, pressure).state, Vec<D>::Zero());
  });
}

TEST(LeesEdwards, RemapOfATiltedCellChangesNothing) {
  // Starting at a tilt of 0.49 the cell is remapped soon; the same start from the equivalent tilt of -0.51 is remapped
  // at once or never. (Spacing: a shear of 0.49 brings neighbours of the crystal 10 to 21 % closer.)
  for_all([]<int D>(EngineKind kind, double pressure) {
    Sample<D> sample = sheared_sample<D>(D == 2 ? 5 : 3, D == 2 ? 1.3 : 1.4);
    const double edge = sample.cell.box(0, 0);
    for (Vec<D>& position : sample.position) position.x() += 0.49 * edge / sample.cell.box(1, 1) * position.y();
    sample.cell.box(0, 1) = 0.49 * edge;
    const End<D> plain = run<D>(kind, sample, pressure);
    expect_eventful<D>(sample, plain.state);
    sample.cell.box(0, 1) = -0.51 * edge;
    expect_same<D>(plain.state, run<D>(kind, sample, pressure).state, Vec<D>::Zero());
  });
}

/// A pair that meets in a sheared cell: seen from the laboratory (V = v + L x) no force acts but the contact's, so
/// the outcome is that of free space.
template <int D>
Vec<D> separation_velocity(EngineKind kind, bool sheared, double dt, const Vec<D>& shift, double friction) {
  Scene scene = sheared ? periodic_scene(D, friction, 0.6, 1e5) : free_scene(D, friction, 0.6, 1e5);
  if (sheared) {
    scene.loading.kind = LoadingKind::plane_shear;
    scene.loading.shear_rate = rate;
  }
  scene.cd.tolerance = 1e-13;
  scene.md.allow_unsafe_dt = true;  // the bound is for packings
  set_dt(scene, dt);
  Mat<D> gradient = Mat<D>::Zero();
  if (sheared) gradient(0, 1) = rate;
  const Vec<D> n = generic_direction<D>();
  Sample<D> sample = pair_sample<D>(n, 0.1);
  sample.cell = cube<D>(20, sheared);
  set_relative_velocity<D>(sample, Vec<D>(-n + 0.5 * generic_tangent<D>(n)));
  for (int i = 0; i < 2; ++i) {
    sample.position[i] += shift;
    sample.velocity[i] -= gradient * sample.position[i];
  }
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(std::lround(0.3 / dt));
  const Snapshot<D> state = engine->snapshot();
  // The pair is less than half a cell apart, so its branch is the shortest image vector.
  Vec<D> fraction = state.cell->box.inverse() * (state.position[1] - state.position[0]);
  if (sheared)
    for (int a = 0; a < D; ++a) fraction[a] -= std::round(fraction[a]);
  return state.velocity[1] - state.velocity[0] + gradient * (state.cell->box * fraction);
}

template <int D>
void check_pair(EngineKind kind, double friction) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + " mu = " + std::to_string(friction));
  for (double y : {0.0, -10.4}) {  // in the middle of the cell, and across its boundary
    SCOPED_TRACE(y);
    std::array<double, 2> error;
    const std::array dt{2e-4, 5e-5};
    for (int level = 0; level < 2; ++level) {
      const Vec<D> shift = y * Vec<D>::UnitY();
      const Vec<D> free = separation_velocity<D>(kind, false, dt[level], Vec<D>::Zero(), friction);
      error[level] = (separation_velocity<D>(kind, true, dt[level], shift, friction) - free).norm();
    }
    // Order 1: the flow turns velocities by rate * dt in a step, and (cd) moves the time of impact by up to a step
    // and the normal with it; (md) the jump of the damping force when the contact opens errs by up to
    // 2 zeta w0 dt e = 0.2 * 450 * 2 e-4 * 0.6, at a phase that the flow shifts.
    for (int level = 0; level < 2; ++level) EXPECT_LT(error[level], (kind == EngineKind::cd ? 3 : 60) * dt[level]);
  }
}

TEST(LeesEdwards, PairCollidesAsInFreeSpace) {
  for (EngineKind kind : both_engines)
    for (double friction : {0.0, 0.4}) {
      check_pair<2>(kind, friction);
      check_pair<3>(kind, friction);
    }
}

template <int D>
void check_free_flight(EngineKind kind) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  Scene scene = sheared_scene<D>(rate, 0);
  Sample<D> sample = pair_sample<D>(Vec<D>::UnitX(), 5);
  sample.cell = cube<D>(20, true);
  const Vec<D> lab = Vec<D>::Constant(0.8);
  Mat<D> gradient = Mat<D>::Zero();
  gradient(0, 1) = rate;
  for (int i = 0; i < 2; ++i) sample.velocity[i] = lab - gradient * sample.position[i];
  const double duration = 12;  // a strain of 6: six remaps, and half a cell travelled
  const double dt = 2e-3;
  set_dt(scene, dt);
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(std::lround(duration / dt));
  const Snapshot<D> state = engine->snapshot();
  for (int i = 0; i < 2; ++i) {
    // Velocities differ by images of the flow only: compare v + L x at the unwrapped position.
    const Vec<D> there = sample.position[i] + duration * lab;
    // An integrator of order 1 in dv/dt = -L v (the only force here) errs by rate dt / 2 of the velocity change
    // 0.8 * 6, relative to positions up to that times the duration.
    const double tolerance = rate * dt * 0.8 * 6;
    EXPECT_LT((state.velocity[i] + gradient * there - lab).norm(), tolerance);
    EXPECT_LT(lattice_distance<D>(*state.cell, state.position[i], there), tolerance * duration);
  }
}

TEST(LeesEdwards, FreeFlightIsStraight) {
  for (EngineKind kind : both_engines) {
    check_free_flight<2>(kind);
    check_free_flight<3>(kind);
  }
}

/// In steady shear the fluctuations have no mean profile: their covariance with y vanishes.
void check_profile(EngineKind kind) {
  SCOPED_TRACE(to_string(kind));
  Scene scene = sheared_scene<2>(0.2, 1);
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-3;
  const auto engine = make_engine<2>(kind, scene, sheared_sample<2>(8));
  const long steps = std::lround(0.05 / 0.2 / engine->dt());
  engine->advance(20 * steps);
  std::array<double, 4> mean{}, count{};
  for (int look = 0; look < 60; ++look) {  // 3 units of strain
    engine->advance(steps);
    const Snapshot<2> state = engine->snapshot();
    for (int i = 0; i < state.grains(); ++i) {
      double height = (state.cell->box.inverse() * state.position[i]).y();
      height -= std::floor(height);
      const int layer = std::min(3, static_cast<int>(4 * height));
      mean[layer] += state.velocity[i].x();
      count[layer] += 1;
    }
  }
  // The cell is 14 d high, so its faces move with 14 * 0.2 = 2.8 past each other. A profile of the fluctuations of a
  // tenth of that would be a flow that is visibly not homogeneous; the noise of 60 looks at 32 grains with
  // fluctuations of 0.4 is 0.4 / sqrt(60 * 32 / correlated 10) = 0.03.
  for (int layer = 0; layer < 4; ++layer) EXPECT_LT(std::abs(mean[layer] / count[layer]), 0.14) << layer;
}

TEST(LeesEdwards, FluctuationsHaveNoProfile) {
  for (EngineKind kind : both_engines) check_profile(kind);
}

}  // namespace
}  // namespace galet::test::lees_edwards_test
