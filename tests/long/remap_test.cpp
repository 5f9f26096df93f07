// A sheared cell that is remapped ten thousand times keeps what its contacts remember.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "common/measure/stress.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::remap_test {
namespace {

/// Points near the sites of a lattice (too small to meet), sheared step by step: at every build each pair that was in
/// the list before and still is must lead to its old row, whose branch is the present one before the step (both read
/// with their images).
template <int D>
void check_list(int remaps) {
  Sample<D> sample = lattice_sample<D>(3, 1.0);
  for (int i = 0; i < sample.count(); ++i) {
    sample.radius[i] = 1e-4;
    for (int a = 0; a < D; ++a) sample.position[i][a] += RandomStream(3, i).uniform(-0.1, 0.1);
  }
  sample.cell.rate(0, 1) = 1;
  VerletList<D> list;
  const double limit = 1.2 - 2e-4;  // gaps: first neighbours and some of the second ones, which come and go
  list.configure(0, limit);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  Mat<D> step = Mat<D>::Identity();
  step(0, 1) = 0.05;
  const Mat<D> undo = step.inverse();
  const auto branch_of = [&](std::size_t row) {
    const PairColumns<D>& pairs = list.pairs();
    return Vec<D>(sample.position[pairs.j[row]] + lattice<D>(sample.cell.box, pairs.image[row]) -
                  sample.position[pairs.i[row]]);
  };
  std::vector<Vec<D>> before;
  long carried = 0, begun = 0, lost = 0, wrong = 0;
  int seen = 0;
  while (seen < remaps) {
    before.clear();
    for (std::size_t row = 0; row < list.size(); ++row) before.push_back(branch_of(row));
    sample.cell.box = step * sample.cell.box;
    for (Vec<D>& x : sample.position) x = step * x;
    const double tilt = sample.cell.box(0, 1);
    list.build(sample.position, sample.radius, sample.cell, sample.planes);
    if (sample.cell.box(0, 1) < tilt - 1) ++seen;
    for (std::size_t row = 0; row < list.size(); ++row) {
      const Vec<D> old = undo * branch_of(row);
      const int from = list.origin()[row];
      if (from < 0) {
        ++begun;
        if (old.norm() - 2e-4 < limit * (1 - 1e-9)) ++lost;  // it was there before
      } else {
        ++carried;
        if (!((old - (list.flipped(row) ? -1 : 1) * before[from]).norm() < 1e-9)) ++wrong;
      }
    }
  }
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(begun, remaps);  // pairs do come and go
  EXPECT_GT(carried, 100L * remaps);
}

TEST(Remap, ListKeepsEveryRow2D) { check_list<2>(10000); }
TEST(Remap, ListKeepsEveryRow3D) { check_list<3>(10000); }

// ---- md, against a cell that is never remapped ---------------------------------------------------------------

/// A crystal under pressure in a cell with a tilt of one half of its length; `copies` of it side by side along x are
/// the same system in a cell with a tilt of 1 / (2 copies), which no shear of a few percent remaps.
Sample<2> tilted_crystal(int copies) {
  Sample<2> one = crystal_sample<2>(3, 0.99);
  const double length = one.cell.box(0, 0);
  Sample<2> sample;
  sample.cell = one.cell;
  sample.cell.box(0, 0) = copies * length;
  sample.cell.box(0, 1) = length / 2;
  sample.resize(copies * one.count());
  for (int i = 0; i < sample.count(); ++i)
    sample.position[i] = one.position[i % one.count()] + Vec<2>(length * (i / one.count()), 0);
  // No two rows alike: contacts slide at different times.
  for (int i = 0; i < sample.count(); ++i) sample.radius[i] = 0.5 + 0.002 * std::sin(7.0 * (i % one.count()));
  return sample;
}

/// Forces by the pair of grains of one copy, their branch rounded; of the pairs (i, j) and (j, i) one.
std::map<std::tuple<int, int, long, long>, Vec<2>> forces_of(const Snapshot<2>& snapshot, int grains) {
  std::map<std::tuple<int, int, long, long>, Vec<2>> forces;
  for (std::size_t c = 0; c < snapshot.contacts->size(); ++c) {
    int i = snapshot.contacts->i[c] % grains, j = snapshot.contacts->j[c] % grains;
    Vec<2> branch = snapshot.contacts->branch[c], force = snapshot.contacts->force[c];
    const bool turn = i > j || (i == j && (branch.x() < -1e-3 || (std::abs(branch.x()) < 1e-3 && branch.y() < 0)));
    if (turn) std::swap(i, j), branch = -branch, force = -force;
    forces[{i, j, std::lround(4 * branch.x()), std::lround(4 * branch.y())}] = force;
  }
  return forces;
}

TEST(Remap, ShearedCrystalRemembersAsIfItWereNeverRemapped) {
  Scene scene = periodic_scene(2, 0.4, 0.3, 1e3);
  scene.loading.kind = LoadingKind::drives;
  set_dt(scene, 2e-3);
  constexpr int steps = 300;                  // of one way; lists are made anew every 250 at the latest
  const double rate = 0.02 / (steps * 2e-3);  // a strain of 0.02: contacts slide at each turn
  scene.loading.drives = {{.component = "xy", .rate = -rate}};
  Scene forth = scene;
  forth.loading.drives[0].rate = rate;
  const Sample<2> sample = tilted_crystal(1), pair = tilted_crystal(2);
  const int grains = sample.count();
  const auto one = make_engine<2>(EngineKind::md, scene, sample), two = make_engine<2>(EngineKind::md, scene, pair);
  const Derived derived = derive_for<2>(scene, sample), derived_pair = derive_for<2>(scene, pair);
  one->advance(steps / 2), two->advance(steps / 2);
  long remaps = 0, remaps_pair = 0;
  double tilt = one->snapshot().cell->box(0, 1), tilt_pair = two->snapshot().cell->box(0, 1);
  // Each way crosses a tilt of one half, and the next list after it remaps.
  for (int way = 0; remaps < 10000 && way < 40000; ++way) {
    const Scene& now = way % 2 == 0 ? forth : scene;
    one->change(now, derived), two->change(now, derived_pair);
    one->advance(steps), two->advance(steps);
    const double next = one->snapshot().cell->box(0, 1), next_pair = two->snapshot().cell->box(0, 1);
    if (std::abs(next - tilt) > 1) ++remaps;
    if (std::abs(next_pair - tilt_pair) > 1) ++remaps_pair;
    tilt = next, tilt_pair = next_pair;
  }
  EXPECT_EQ(remaps, 10000);
  EXPECT_EQ(remaps_pair, 0);

  const Snapshot<2> a = one->snapshot(), b = two->snapshot();
  // Rounding of 3e6 steps, kept small by dissipation: 1e-9 of the overlaps' forces (10) and of the stress.
  const Mat<2> sigma = stress<2>(a).total(), sigma_pair = stress<2>(b).total();
  EXPECT_LT((sigma - sigma_pair).norm(), 1e-8 * sigma.norm());
  const auto forces = forces_of(a, grains), forces_pair = forces_of(b, grains);
  ASSERT_GT(forces.size(), 2u * grains);
  EXPECT_EQ(forces.size(), forces_pair.size());
  for (const auto& [key, force] : forces) {
    const auto found = forces_pair.find(key);
    ASSERT_NE(found, forces_pair.end());
    EXPECT_LT((force - found->second).norm(), 1e-7);
  }
  const double tangential = one->energy().elastic_tangential;
  EXPECT_GT(tangential, 1e-3);  // there is something to remember
  EXPECT_NEAR(2 * tangential, two->energy().elastic_tangential, 1e-7 * tangential);
}

}  // namespace
}  // namespace galet::test::remap_test
