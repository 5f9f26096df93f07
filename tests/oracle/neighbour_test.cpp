// The Verlet list against a search over all pairs and images.
#include <map>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "tests/support/neighbours.hpp"

namespace galet::test::neighbour_test {
namespace {

/// Points at random, also outside of the cell, for grains of diameter 0.4 (1 +- spread) that overlap by 10 % at most.
template <int D>
Sample<D> random_sample(int count, const Mat<D>& box, double spread, std::uint64_t seed) {
  Sample<D> sample;
  sample.cell.box = box;
  sample.cell.periodic.fill(true);
  sample.resize(count);
  vary_sizes<D>(sample, spread, seed);
  for (double& radius : sample.radius) radius *= 0.4;
  int placed = 0;
  for (int trial = 0; placed < count; ++trial) {
    if (trial > 100000) throw std::runtime_error("too dense for random insertion");
    RandomStream random(seed, 77777 + trial);
    Vec<D> fraction;
    for (int a = 0; a < D; ++a) fraction[a] = random.uniform(-1, 2);
    sample.position[placed] = box * fraction;
    bool free = true;
    for (int other = 0; other < placed && free; ++other) {
      const double reach = 0.9 * (sample.radius[placed] + sample.radius[other]);
      // Within +-3 of the nearest lattice point by rounding: enough for tilts up to 2.5.
      Vec<D> apart = sample.position[placed] - sample.position[other];
      const Vec<D> nearest = (box.inverse() * apart).array().round();
      apart -= box * nearest;
      for_images<D>(sample.cell, 3, [&](const Image<D>& image) {
        if ((apart + lattice<D>(box, image)).norm() < reach) free = false;
      });
    }
    placed += free;
  }
  return sample;
}

template <int D>
Mat<D> tilted_box(double edge, double tilt) {
  Mat<D> box = edge * Mat<D>::Identity();
  box(0, 1) = tilt * edge;
  if constexpr (D == 3) box(1, 2) = -0.3 * tilt * edge;
  return box;
}

template <int D>
void check_fresh_lists() {
  for (double edge : {0.5, 1.1, 2.0, 4.0})  // grains of 0.4: the smallest cell is hardly wider than one
    for (double tilt : {0.0, 0.37, -0.49, 2.2})
      for (double spread : {0.0, 0.5}) {
        SCOPED_TRACE("edge " + std::to_string(edge) + " tilt " + std::to_string(tilt));
        const double room = std::pow(edge, D) / grain_volume<D>(0.4);
        const int count = std::clamp(static_cast<int>(0.2 * room), 1, 60);
        // A single grain in a narrow cell must fit: no overlap with its own image.
        Sample<D> sample = random_sample<D>(count, tilted_box<D>(edge, tilt), spread, 3);
        VerletList<D> list;
        const double range = 0.05, skin = 0.3;
        list.configure(range, skin);
        list.build(sample.position, sample.radius, sample.cell, sample.planes);
        expect_fresh<D>(list, sample, range);
        expect_rows<D>(list, sample.count());
      }
}

TEST(VerletList, HoldsExactlyThePairsOfABruteSearch2D) { check_fresh_lists<2>(); }
TEST(VerletList, HoldsExactlyThePairsOfABruteSearch3D) { check_fresh_lists<3>(); }

template <int D>
void check_open_cell() {
  Sample<D> sample = random_sample<D>(40, tilted_box<D>(3, 0.0), 0.5, 5);
  for (bool periodic_x : {false, true}) {
    sample.cell.periodic.fill(false);
    sample.cell.periodic[0] = periodic_x;
    sample.planes = {{Vec<D>::Constant(-3.3), up<D>(), Vec<D>::Zero()},
                     {Vec<D>::Constant(6.4), -up<D>(), Vec<D>::Zero()}};
    VerletList<D> list;
    list.configure(0, 0.4);
    list.build(sample.position, sample.radius, sample.cell, sample.planes);
    expect_fresh<D>(list, sample, 0);
    expect_rows<D>(list, sample.count());
    const std::set<Pair<D>> pairs = listed<D>(list);
    EXPECT_TRUE(std::ranges::any_of(pairs, [&](const Pair<D>& pair) { return std::get<1>(pair) >= 40; }));
  }
}

TEST(VerletList, WorksInOpenDirectionsAndWithPlanes) {
  check_open_cell<2>();
  check_open_cell<3>();
}

/// Moves grains and cell in small random steps. A list that says it is valid must hold every pair within range.
template <int D>
void check_expiry(double strain_step, double jump) {
  SCOPED_TRACE("strain " + std::to_string(strain_step) + " jump " + std::to_string(jump));
  Sample<D> sample = random_sample<D>(D == 2 ? 16 : 50, tilted_box<D>(D == 2 ? 2.4 : 2.0, 0.2), 0.4, 9);
  const double range = 0.02;
  VerletList<D> list;
  list.configure(range, 0.15);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  Mat<D> step = Mat<D>::Identity();
  step(0, 1) = strain_step;
  step(1, 1) = 1 - 0.3 * strain_step;
  int valid = 0;
  for (int k = 0; k < 200; ++k) {
    sample.cell.box = step * sample.cell.box;
    for (int i = 0; i < sample.count(); ++i) {
      RandomStream random(13 + k, i);
      sample.position[i] = step * sample.position[i];
      for (int a = 0; a < D; ++a) sample.position[i][a] += jump * random.normal();
    }
    if (list.expired(sample.position, sample.cell, sample.planes)) {
      // A fresh list of these overlapping random walkers would be refused: start over.
      sample = random_sample<D>(sample.count(), sample.cell.box, 0.4, 100 + k);
      list.build(sample.position, sample.radius, sample.cell, sample.planes);
      continue;
    }
    ++valid;
    const std::set<Pair<D>> rows = listed<D>(list);
    for (const Pair<D>& pair : all_pairs<D>(sample, range)) {
      EXPECT_TRUE(rows.contains(pair)) << std::get<0>(pair) << " " << std::get<1>(pair) << " step " << k;
    }
  }
  EXPECT_GT(valid, 100);  // nor does it expire for nothing: the skin is worth many of these steps
  EXPECT_GT(list.builds(), 1);
}

TEST(VerletList, ExpiresBeforeItMissesAPair) {
  for (double strain_step : {0.0, 2e-3, -5e-3})
    for (double jump : {0.0, 3e-3}) {
      if (strain_step == 0 && jump == 0) continue;
      check_expiry<2>(strain_step, jump);
      check_expiry<3>(strain_step, jump);
    }
}

/// A homogeneous rotation-free flow of the whole cell leaves the list valid for a while; a reserve shortens it.
TEST(VerletList, ReserveAsksForTheFuture) {
  Sample<2> sample = random_sample<2>(16, tilted_box<2>(2.4, 0), 0.2, 15);
  VerletList<2> list;
  list.configure(0, 0.1);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  EXPECT_FALSE(list.expired(sample.position, sample.cell, sample.planes));
  EXPECT_FALSE(list.expired(sample.position, sample.cell, sample.planes, 0.0999));
  EXPECT_TRUE(list.expired(sample.position, sample.cell, sample.planes, 0.1001));
  // One grain displaced by s spends 2 s of the skin (another might have done the same the other way).
  sample.position[7] += Vec<2>(0.03, 0);
  EXPECT_FALSE(list.expired(sample.position, sample.cell, sample.planes, 0.0399));
  EXPECT_TRUE(list.expired(sample.position, sample.cell, sample.planes, 0.0401));
}

/// Pairs that stay keep their rows: origin() leads from a pair to the same physical pair of the list before, whatever
/// the wrapping and the remap of the tilted cell did to the images.
template <int D>
void check_origin() {
  Sample<D> sample = random_sample<D>(D == 2 ? 5 : 15, tilted_box<D>(1.3, 0.45), 0.3, 17);
  VerletList<D> list;
  list.configure(0, 0.5);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  const PairColumns<D> before = list.pairs();
  std::vector<Vec<D>> branch_before(before.size());
  for (std::size_t row = 0; row < before.size(); ++row)
    branch_before[row] = sample.position[before.j[row]] + lattice<D>(sample.cell.box, before.image[row]) -
                         sample.position[before.i[row]];
  // A strain of 0.2 remaps the cell (tilt 0.65 -> -0.35); a common displacement wraps many grains. Rows are compared
  // by their branch vectors, which only the strain changes.
  Mat<D> strain = Mat<D>::Identity();
  strain(0, 1) = 0.2;
  sample.cell.rate(0, 1) = 1;  // the flow that does it: cells are mended along the flow
  sample.cell.box = strain * sample.cell.box;
  for (Vec<D>& x : sample.position) x = strain * x + sample.cell.box * Vec<D>::Constant(0.61);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  EXPECT_LT(std::abs(sample.cell.box(0, 1)), 0.5 * 1.3 + 1e-12);
  int kept = 0;
  for (std::size_t row = 0; row < list.size(); ++row) {
    const int i = list.pairs().i[row], j = list.pairs().j[row];
    const Vec<D> branch =
        sample.position[j] + lattice<D>(sample.cell.box, list.pairs().image[row]) - sample.position[i];
    // The row of the old list with the same branch vector, up to the strain and the direction of a self-image pair.
    int expected = -1;
    bool reversed = false;
    for (std::size_t old = 0; old < before.size(); ++old) {
      if (before.i[old] != i || before.j[old] != j) continue;
      const bool same = (strain * branch_before[old] - branch).norm() < 1e-9;
      const bool opposite = i == j && (strain * branch_before[old] + branch).norm() < 1e-9;
      if (same || opposite) expected = static_cast<int>(old), reversed = opposite;
    }
    EXPECT_EQ(list.origin()[row], expected) << "row " << row;
    if (expected >= 0) {
      EXPECT_EQ(list.flipped(row), reversed) << "row " << row;
    }
    kept += expected >= 0;
  }
  EXPECT_GT(kept, static_cast<int>(before.size()) / 2);
}

TEST(VerletList, CarriesRowsThroughWrappingAndRemap) {
  check_origin<2>();
  check_origin<3>();
}

/// Each row of the list leads back to the same pair in `before`, or was not there.
template <int D>
void expect_origins(const VerletList<D>& list, const PairColumns<D>& before) {
  std::map<Pair<D>, int> rows;
  for (std::size_t row = 0; row < before.size(); ++row)
    rows[{before.i[row], before.j[row], before.image[row]}] = static_cast<int>(row);
  for (std::size_t row = 0; row < list.size(); ++row) {
    const auto found = rows.find({list.pairs().i[row], list.pairs().j[row], list.pairs().image[row]});
    EXPECT_EQ(list.origin()[row], found == rows.end() ? -1 : found->second);
    EXPECT_FALSE(list.flipped(row));
  }
}

/// Takes a list anew from its outer one, and so does one that was saved and restored: both are those of a search.
template <int D>
void expect_narrowed(VerletList<D>& list, const Sample<D>& sample, double range, double skin) {
  const PairColumns<D> before = list.pairs();
  Archive archive;
  list.save(archive);
  VerletList<D> other;
  other.restore(archive, sample.count());
  for (VerletList<D>* each : {&list, &other}) {
    each->configure(range, skin, 0.2);
    ASSERT_TRUE(each->narrow(sample.position, sample.radius, sample.cell, sample.planes));
    expect_fresh<D>(*each, sample, range);
    expect_rows<D>(*each, sample.count());
    expect_origins<D>(*each, before);
  }
  EXPECT_EQ(listed<D>(list), listed<D>(other));
  EXPECT_EQ(list.narrowings(), other.narrowings());
}

/// Grains that wander for a while, from several starts, in a cell that deforms or above a plane.
template <int D>
void check_narrowing(bool plane) {
  SCOPED_TRACE(plane ? "plane" : "cell");
  Mat<D> step = Mat<D>::Identity();
  if (!plane) step(0, 1) = 1e-3, step(1, 1) = 1 - 5e-4;
  const double range = 0.02;
  VerletList<D> list;
  for (int start = 0; start < 8; ++start) {
    Sample<D> sample = random_sample<D>(D == 2 ? 16 : 50, tilted_box<D>(D == 2 ? 2.4 : 2.0, 0.2), 0.4, 9 + start);
    if (plane) {
      sample.cell.periodic.fill(false);
      sample.planes = {{Vec<D>::Constant(-3.3), up<D>(), Vec<D>::Zero()}};
    }
    list.configure(range, 0.03, 0.2);
    list.build(sample.position, sample.radius, sample.cell, sample.planes);
    expect_fresh<D>(list, sample, range);
    for (int k = 0; k < 25; ++k) {
      sample.cell.box = step * sample.cell.box;
      for (int i = 0; i < sample.count(); ++i) {
        RandomStream random(13 + k, i);
        sample.position[i] = step * sample.position[i];
        for (int a = 0; a < D; ++a) sample.position[i][a] += 2e-3 * random.normal();
      }
      if (list.expired(sample.position, sample.cell, sample.planes))
        expect_narrowed<D>(list, sample, range, 0.02 + 5e-4 * k);
    }
  }
  EXPECT_GT(list.narrowings(), 8);
  EXPECT_EQ(list.builds(), 8);
}

TEST(VerletList, TakenFromTheOuterListAreThoseOfASearch) {
  for (const bool plane : {false, true}) {
    check_narrowing<2>(plane);
    check_narrowing<3>(plane);
  }
}

TEST(VerletList, WithoutAnOuterListThereIsNothingToTake) {
  Sample<2> sample = random_sample<2>(16, tilted_box<2>(2.4, 0), 0.2, 15);
  VerletList<2> list;
  EXPECT_FALSE(list.narrow(sample.position, sample.radius, sample.cell, sample.planes));
  list.configure(0, 0.1);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  EXPECT_FALSE(list.narrow(sample.position, sample.radius, sample.cell, sample.planes));
  EXPECT_THROW(list.configure(0, 0.1, 0.05), std::exception);
}

TEST(VerletList, RefusesUnsoundStates) {
  const auto build = [](Sample<2> sample) {
    VerletList<2> list;
    list.configure(0, 0.1);
    list.build(sample.position, sample.radius, sample.cell, sample.planes);
  };
  const Sample<2> good = column_sample<2>(3);
  EXPECT_NO_THROW(build(good));
  Sample<2> bad = good;
  bad.position[1].x() = NAN;
  EXPECT_THROW(build(bad), RunError);
  bad = good;
  bad.position[1] = good.position[0] + Vec<2>(0, 0.7);  // overlap 0.3 > 0.25
  EXPECT_THROW(build(bad), RunError);
  bad = good;
  bad.position[0].y() = good.planes[0].point.y() - 0.6;
  EXPECT_THROW(build(bad), RunError);
  bad = good;
  bad.position[2].y() = 1e30;  // beyond what images can count
  EXPECT_THROW(build(bad), RunError);
}

TEST(VerletList, IsEmptyAfterASearchThatFailed) {
  Sample<2> sample = column_sample<2>(3);
  VerletList<2> list;
  list.configure(0, 0.1);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  ASSERT_GT(list.size(), 0U);
  sample.position[1].x() = NAN;
  EXPECT_THROW(list.build(sample.position, sample.radius, sample.cell, sample.planes), RunError);
  EXPECT_EQ(list.size(), 0U);
  EXPECT_EQ(list.first().back(), 0);
}

}  // namespace
}  // namespace galet::test::neighbour_test
