// Contacts by direction: crystals, whose directions are known, and a distribution of known anisotropy.
#include "common/measure/contact_directions.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/lattices.hpp"

namespace galet::test::contact_directions_test {
namespace {

using test::snapshot_of;
constexpr double pi = std::numbers::pi;

// Contacts along 0, 60 and 120 degrees, a third of them each: 18 sectors of 10 degrees, three of them 6 times
// isotropic.
TEST(ContactDirections, TriangularLattice) {
  Sample<2> sample = test::triangular(4);
  ContactColumns<2> contacts = test::touching<2>(sample);
  const std::vector<DirectionRow> rows = contact_directions(snapshot_of(sample, contacts), 18);
  ASSERT_EQ(rows.size(), 18u);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    // Rounding may put a direction of 0, 60 or 120 degrees into the sector below.
    const bool first = k % 6 == 0, second = k % 6 == 5;
    EXPECT_NEAR(rows[k].angle, (static_cast<double>(k) + 0.5) * pi / 18, 1e-14);
    if (!first && !second) {
      EXPECT_EQ(rows[k].contacts, 0) << k;
    }
    if (rows[k].contacts > 0) {
      EXPECT_NEAR(rows[k].normal_force, 1, 1e-12);
      EXPECT_NEAR(rows[k].tangential_force, 0, 1e-12);
    } else {
      EXPECT_TRUE(std::isnan(rows[k].normal_force));
    }
  }
  for (std::size_t k = 0; k < rows.size(); k += 6)
    EXPECT_DOUBLE_EQ(rows[k].density + rows[(k + rows.size() - 1) % rows.size()].density, 6);
}

// Normals on a fine grid of angles with the weight 1 + a cos 2(theta - theta_c) as their number of copies, and forces
// F_N = 1 + b cos 2 theta, F_T = c sin 2 theta: each sector holds the mean of these over its angles, and it does not
// matter which of the two grains is called i.
TEST(ContactDirections, AnisotropyOfKnownSize) {
  constexpr int grid = 720, sectors = 12;
  const double a = 0.4, direction = 0.3, b = 0.25, c = -0.2;
  for (const double sign : {1.0, -1.0}) {
    Sample<2> sample = test::square(2);
    ContactColumns<2> contacts;
    std::vector<double> expected(sectors, 0), normal(sectors, 0), tangential(sectors, 0);
    long all = 0;
    double sum = 0;
    for (int k = 0; k < grid; ++k) {
      const double angle = (k + 0.5) * pi / grid;
      const int copies = static_cast<int>(std::lround(200 * (1 + a * std::cos(2 * (angle - direction)))));
      const double along = 1 + b * std::cos(2 * angle), across = c * std::sin(2 * angle);
      const Vec<2> n(std::cos(angle), std::sin(angle)), t(-n.y(), n.x());
      for (int copy = 0; copy < copies; ++copy) {
        contacts.i.push_back(0), contacts.j.push_back(1);
        contacts.normal.push_back(sign * n);
        contacts.force.push_back(sign * (along * n + across * t));
        const std::size_t sector = static_cast<std::size_t>(k / (grid / sectors));
        ++expected[sector], normal[sector] += along, tangential[sector] += across;
        ++all, sum += along;
      }
    }
    const std::vector<DirectionRow> rows = contact_directions(snapshot_of(sample, contacts), sectors);
    for (std::size_t k = 0; k < sectors; ++k) {
      EXPECT_DOUBLE_EQ(rows[k].density, expected[k] * sectors / static_cast<double>(all));
      EXPECT_NEAR(rows[k].normal_force, normal[k] / expected[k] / (sum / static_cast<double>(all)), 1e-12);
      EXPECT_NEAR(rows[k].tangential_force, tangential[k] / expected[k] / (sum / static_cast<double>(all)), 1e-12);
      // The sector's mean of the law: sin(w) / w with the width w = pi / sectors. Numbers of copies are rounded, by
      // 1/2 at most in 200; the midpoints of 60 angles per sector leave 1e-5.
      const double width = pi / sectors;
      EXPECT_NEAR(rows[k].density, 1 + a * std::cos(2 * (rows[k].angle - direction)) * std::sin(width) / width,
                  2.52e-3);
    }
  }
}

// A simple cubic lattice has two of its three directions in each plane of axes; the third is left out.
TEST(ContactDirections, InAPlaneOfSpace) {
  Sample<3> sample = test::cubic(3);
  ContactColumns<3> contacts = test::touching<3>(sample);
  contacts.i.push_back(0), contacts.j.push_back(sample.count());  // with a plane: no direction of the grains' own
  contacts.normal.push_back(Vec<3>(1, 1, 0).normalized());
  contacts.force.push_back(contacts.normal.back());
  const std::vector<DirectionRow> rows = contact_directions(snapshot_of(sample, contacts), 2, {0, 2});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].contacts + rows[1].contacts, 2 * sample.count());
  EXPECT_THROW(contact_directions(snapshot_of(sample, contacts), 0), std::invalid_argument);
  EXPECT_THROW(contact_directions(snapshot_of(sample, contacts), 4, {1, 1}), std::invalid_argument);
  EXPECT_THROW(contact_directions(snapshot_of(sample, contacts), 4, {0, 3}), std::invalid_argument);
  const ContactColumns<3> none;
  EXPECT_TRUE(contact_directions(snapshot_of(sample, none), 4).empty());
}

}  // namespace
}  // namespace galet::test::contact_directions_test
