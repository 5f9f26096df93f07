// Neighbour lists of grains of widely different sizes: every pair of a brute search, at 1:10 and 1:50, in tilted and
// narrow cells with their self-images, in open cells with planes, and while grains and cell move.
#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "tests/support/neighbours.hpp"

namespace galet::test::neighbour_sizes_test {
namespace {

/// Grains of diameters 1, 1 / ratio and in between, none touching, at random in the cell and up to one cell outside.
template <int D>
Sample<D> unlike_sample(const Mat<D>& box, double ratio, std::array<int, 3> counts, std::uint64_t seed) {
  Sample<D> sample;
  sample.cell.box = box;
  sample.cell.periodic.fill(true);
  std::vector<double> radii(counts[0], 0.5);
  for (int k = 0; k < counts[1]; ++k) radii.push_back(0.5 * std::pow(ratio, -RandomStream(seed, k).uniform(0.1, 0.9)));
  radii.insert(radii.end(), counts[2], 0.5 / ratio);
  sample.resize(static_cast<int>(radii.size()));
  int trial = 0;
  for (int i = 0; i < sample.count(); ++i)
    for (bool free = false; !free; ++trial) {
      if (trial > 200000) throw std::runtime_error("too dense for random insertion");
      RandomStream random(seed, 5000 + trial);
      Vec<D> fraction;
      for (int a = 0; a < D; ++a) fraction[a] = random.uniform(-1, 2);
      sample.position[i] = box * fraction;
      free = true;
      for (int other = 0; other < i && free; ++other) {
        Vec<D> apart = sample.position[i] - sample.position[other];
        const Vec<D> nearest = (box.inverse() * apart).array().round();
        apart -= box * nearest;
        for_images<D>(sample.cell, 2, [&](const Image<D>& image) {
          if ((apart + lattice<D>(box, image)).norm() < radii[i] + radii[other]) free = false;
        });
      }
    }
  // Numbers that say nothing about sizes: pairs of a large and a small grain in either order.
  for (int i = 0; i < sample.count(); ++i) {
    const int from = (7 * i + 3) % sample.count();
    sample.radius[i] = radii[from];
  }
  std::vector<Vec<D>> moved = sample.position;
  for (int i = 0; i < sample.count(); ++i) moved[i] = sample.position[(7 * i + 3) % sample.count()];
  sample.position = moved;
  return sample;
}

template <int D>
Mat<D> tilted_box(double edge, double tilt) {
  Mat<D> box = edge * Mat<D>::Identity();
  box(0, 1) = tilt * edge;
  if constexpr (D == 3) box(1, 2) = -0.3 * tilt * edge;
  return box;
}

// Prime totals, so that the shuffle above is one: 2 + 5 + 90 = 97 and 2 + 5 + 52 = 59.
template <int D>
constexpr std::array<int, 3> counts = D == 2 ? std::array{2, 5, 90} : std::array{2, 5, 52};

template <int D>
void check_fresh(double ratio, double narrow, double wide) {
  for (const double edge : {narrow, wide})
    for (const double tilt : {0.0, 0.4, -0.49, 1.3}) {
      SCOPED_TRACE("ratio " + std::to_string(ratio) + " edge " + std::to_string(edge) + " tilt " +
                   std::to_string(tilt));
      // One large grain only in the narrow cell.
      std::array<int, 3> number = counts<D>;
      if (edge < 2) number[0] -= 1, number[1] += 1;
      Sample<D> sample = unlike_sample<D>(tilted_box<D>(edge, tilt), ratio, number, 71);
      for (const double skin : {0.01, 1.0}) {
        VerletList<D> list;
        list.configure(0.003, skin);
        list.build(sample.position, sample.radius, sample.cell, sample.planes);
        expect_fresh<D>(list, sample, 0.003);
        expect_rows<D>(list, sample.count());
      }
    }
}

TEST(UnlikeSizes, HoldExactlyThePairsOfABruteSearch2D) {
  check_fresh<2>(4, 5, 6);
  check_fresh<2>(10, 2.6, 4);
  check_fresh<2>(50, 1.9, 4);
}
TEST(UnlikeSizes, HoldExactlyThePairsOfABruteSearch3D) {
  check_fresh<3>(4, 5, 6);
  check_fresh<3>(10, 2.6, 4);
  check_fresh<3>(50, 1.9, 4);
}

template <int D>
void check_self_images() {
  // The only large grain is nearer to its own images than the skin.
  Sample<D> sample = unlike_sample<D>(tilted_box<D>(1.3, 0.3), 50, {1, 0, 58}, 73);
  VerletList<D> list;
  list.configure(0, 0.4);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  expect_fresh<D>(list, sample, 0);
  const std::set<Pair<D>> pairs = listed<D>(list);
  EXPECT_TRUE(std::ranges::any_of(pairs, [](const Pair<D>& pair) { return std::get<0>(pair) == std::get<1>(pair); }));
}

TEST(UnlikeSizes, MeetTheirOwnImages) {
  check_self_images<2>();
  check_self_images<3>();
}

template <int D>
void check_open() {
  Sample<D> sample = unlike_sample<D>(tilted_box<D>(4, 0), 50, counts<D>, 75);
  for (const bool periodic_x : {false, true}) {
    sample.cell.periodic.fill(false);
    sample.cell.periodic[0] = periodic_x;
    sample.planes = {{Vec<D>::Constant(-4.6), up<D>(), Vec<D>::Zero()},
                     {Vec<D>::Constant(8.6), -up<D>(), Vec<D>::Zero()}};
    VerletList<D> list;
    list.configure(0, 1.1);
    list.build(sample.position, sample.radius, sample.cell, sample.planes);
    expect_fresh<D>(list, sample, 0);
    expect_rows<D>(list, sample.count());
    const std::set<Pair<D>> pairs = listed<D>(list);
    EXPECT_TRUE(std::ranges::any_of(
        pairs, [&](const Pair<D>& pair) { return std::get<1>(pair) >= static_cast<int>(sample.count()); }));
  }
}

TEST(UnlikeSizes, InOpenCellsWithPlanes) {
  check_open<2>();
  check_open<3>();
}

/// Lists follow a sample that is sheared and shaken, through wraps and remaps: fresh ones are complete, old ones hold
/// every pair within range as long as they say that they do, and rows that stay lead to their old ones.
template <int D>
void check_motion() {
  Sample<D> sample = unlike_sample<D>(tilted_box<D>(3, 0.3), 10, counts<D>, 77);
  VerletList<D> list;
  list.configure(0.002, 0.05);
  list.build(sample.position, sample.radius, sample.cell, sample.planes);
  Mat<D> step = Mat<D>::Identity();
  step(0, 1) = 0.004;
  sample.cell.rate(0, 1) = 1;
  int builds = 0, carried = 0;
  for (int k = 0; k < 120; ++k) {
    sample.cell.box = step * sample.cell.box;
    for (Vec<D>& x : sample.position) x = step * x;
    if (!list.expired(sample.position, sample.cell, sample.planes)) {
      const std::set<Pair<D>> rows = listed<D>(list);
      for (const Pair<D>& pair : all_pairs<D>(sample, 0.002)) EXPECT_TRUE(rows.contains(pair)) << "step " << k;
      continue;
    }
    // Sheared grains come to overlap: only the geometry of the list is looked at, with radii out of the way.
    try {
      list.build(sample.position, sample.radius, sample.cell, sample.planes);
    } catch (const RunError&) {
      break;
    }
    ++builds;
    expect_fresh<D>(list, sample, 0.002);
    carried += static_cast<int>(std::ranges::count_if(list.origin(), [](int row) { return row >= 0; }));
  }
  EXPECT_GT(builds, 0);
  EXPECT_GT(carried, 0);
}

TEST(UnlikeSizes, FollowASampleInMotion) {
  check_motion<2>();
  check_motion<3>();
}

/// A pair that overlaps too much is reported in the order of its numbers, whichever grain finds it.
TEST(UnlikeSizes, DeepOverlapsAreRefused) {
  for (const bool large_first : {false, true}) {
    Sample<2> sample = pair_sample<2>(Vec<2>(1, 0), -0.04, {large_first ? 0.5 : 0.05, large_first ? 0.05 : 0.5});
    VerletList<2> list;
    list.configure(0, 0.1);
    try {
      list.build(sample.position, sample.radius, sample.cell, sample.planes);
      ADD_FAILURE() << "an overlap of 0.04 of a grain of radius 0.05 passed";
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find("grains 0 and 1 overlap by 0.04"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace galet::test::neighbour_sizes_test
