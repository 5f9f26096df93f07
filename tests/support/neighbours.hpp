// Neighbour lists against a search over all pairs and images.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "common/neighbour/verlet_list.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test {

template <int D>
using Pair = std::tuple<int, int, Image<D>>;

/// i < j always; for i == j the first non-zero lattice coordinate is positive.
template <int D>
bool canonical(int i, int j, const Image<D>& image) {
  if (i != j) return i < j;
  for (int coordinate : image)
    if (coordinate != 0) return coordinate > 0;
  return false;
}

/// Calls body(image) for every lattice vector with coordinates within +-reach in periodic directions.
template <int D, class Body>
void for_images(const Cell<D>& cell, int reach, const Body& body) {
  Image<D> image;
  image.fill(0);
  const std::function<void(int)> choose = [&](int axis) {
    if (axis == D) return body(image);
    const int bound = cell.periodic[axis] ? reach : 0;
    for (image[axis] = -bound; image[axis] <= bound; ++image[axis]) choose(axis + 1);
    image[axis] = 0;
  };
  choose(0);
}

/// All pairs, planes included, whose gap is below `range`.
template <int D>
std::set<Pair<D>> all_pairs(const Sample<D>& sample, double range) {
  std::set<Pair<D>> found;
  // Enough images: a pair reaches 2 R_max + range, a wrapped cell's vectors are at least its face distances apart.
  const double largest = *std::ranges::max_element(sample.radius);
  const double reach = 2 * largest + range;
  const int images = 1 + static_cast<int>(std::ceil(reach / face_distances<D>(sample.cell.box).minCoeff()));
  for (int i = 0; i < sample.count(); ++i) {
    for (int j = 0; j < sample.count(); ++j)
      for_images<D>(sample.cell, images, [&](const Image<D>& image) {
        if (!canonical<D>(i, j, image)) return;
        const Vec<D> branch = sample.position[j] + lattice<D>(sample.cell.box, image) - sample.position[i];
        if (branch.norm() - sample.radius[i] - sample.radius[j] < range) found.insert({i, j, image});
      });
    for (std::size_t p = 0; p < sample.planes.size(); ++p) {
      const double height = (sample.position[i] - sample.planes[p].point).dot(sample.planes[p].normal);
      Image<D> zero;
      zero.fill(0);
      if (height - sample.radius[i] < range) found.insert({i, sample.count() + static_cast<int>(p), zero});
    }
  }
  return found;
}

template <int D>
std::set<Pair<D>> listed(const VerletList<D>& list) {
  std::set<Pair<D>> pairs;
  for (std::size_t row = 0; row < list.size(); ++row)
    pairs.insert({list.pairs().i[row], list.pairs().j[row], list.pairs().image[row]});
  EXPECT_EQ(pairs.size(), list.size()) << "a pair is listed twice";
  return pairs;
}

/// Pairs of the brute search at gap below range + skin are what a fresh list holds. A gap within rounding of the
/// limit may go either way, so limits slightly inside and outside are compared.
template <int D>
void expect_fresh(const VerletList<D>& list, const Sample<D>& sample, double range) {
  const std::set<Pair<D>> rows = listed<D>(list);
  const double limit = range + list.skin();
  for (const Pair<D>& pair : all_pairs<D>(sample, limit * (1 - 1e-12))) EXPECT_TRUE(rows.contains(pair));
  const std::set<Pair<D>> outer = all_pairs<D>(sample, limit * (1 + 1e-12));
  for (const Pair<D>& pair : rows) EXPECT_TRUE(outer.contains(pair)) << std::get<0>(pair) << " " << std::get<1>(pair);
}

/// The compressed rows point where they say.
template <int D>
void expect_rows(const VerletList<D>& list, int grains) {
  const auto& pairs = list.pairs();
  ASSERT_EQ(list.first().size(), static_cast<std::size_t>(grains) + 1);
  ASSERT_EQ(list.second().size(), static_cast<std::size_t>(grains) + 1);
  EXPECT_EQ(list.first()[grains], static_cast<int>(list.size()));
  for (int i = 0; i < grains; ++i) {
    for (int row = list.first()[i]; row < list.first()[i + 1]; ++row) EXPECT_EQ(pairs.i[row], i);
    for (int k = list.second()[i]; k < list.second()[i + 1]; ++k) {
      EXPECT_EQ(pairs.j[list.rows_of_second()[k]], i);
      if (k > list.second()[i]) {
        EXPECT_LT(list.rows_of_second()[k - 1], list.rows_of_second()[k]);
      }
    }
  }
  long with_grain = std::ranges::count_if(pairs.j, [&](int j) { return j < grains; });
  EXPECT_EQ(list.second()[grains], with_grain);
  for (std::size_t row = 1; row < pairs.size(); ++row)
    EXPECT_LT(std::tie(pairs.i[row - 1], pairs.j[row - 1], pairs.image[row - 1]),
              std::tie(pairs.i[row], pairs.j[row], pairs.image[row]));
}

}  // namespace galet::test
