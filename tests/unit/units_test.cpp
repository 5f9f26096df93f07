// Values with units, and names in messages.
#include "common/io/units.hpp"

#include <gtest/gtest.h>

#include "common/core/near_match.hpp"

namespace galet::test::units_test {
namespace {

TEST(Units, AreExactlyTheDecimalInSi) {
  EXPECT_EQ(value_with_unit("3 mm", Quantity::length, 3), 0.003);
  EXPECT_EQ(value_with_unit("0.7 um", Quantity::length, 3), 0.7e-6);
  EXPECT_EQ(value_with_unit("  12cm ", Quantity::length, 2), 0.12);
  EXPECT_EQ(value_with_unit("1e3 ms", Quantity::time, 3), 1);
  EXPECT_EQ(value_with_unit("2 h", Quantity::time, 3), 7200);
  EXPECT_EQ(value_with_unit("-5 g", Quantity::mass, 3), -0.005);
  EXPECT_EQ(value_with_unit("36 1/h", Quantity::rate, 3), 0.01);
  EXPECT_EQ(value_with_unit("3 rad/s", Quantity::angular_velocity, 3), 3);
  EXPECT_EQ(value_with_unit("981 cm/s2", Quantity::acceleration, 3), 9.81);
  EXPECT_EQ(value_with_unit("2 mm/s", Quantity::velocity, 3), 0.002);
  EXPECT_EQ(value_with_unit("2 N/m", Quantity::stiffness, 3), 2);
}

TEST(Units, KnowEverySpelling) {
  for (const char* text : {"2600 kg/m3", "2600 kg/m^3", "2600 kg/m³", "2.6 g/cm3"})
    EXPECT_EQ(value_with_unit(text, Quantity::density, 3), 2600) << text;
  for (const char* text : {"5 um", "5 µm", "5 \u03bcm"})
    EXPECT_EQ(value_with_unit(text, Quantity::length, 3), 5e-6) << text;
}

TEST(Units, OfPressureAndDensityDependOnTheDimension) {
  EXPECT_EQ(value_with_unit("10 kPa", Quantity::pressure, 3), 1e4);
  EXPECT_EQ(value_with_unit("70 GPa", Quantity::pressure, 3), 7e10);
  EXPECT_EQ(value_with_unit("10 kPa", Quantity::pressure, 2), std::nullopt);
  EXPECT_EQ(value_with_unit("10 kN/m", Quantity::pressure, 2), 1e4);
  EXPECT_EQ(value_with_unit("10 kN/m", Quantity::pressure, 3), std::nullopt);
  EXPECT_EQ(value_with_unit("2 g/cm2", Quantity::density, 2), 20);
  EXPECT_EQ(value_with_unit("2 g/cm2", Quantity::density, 3), std::nullopt);
}

TEST(Units, RefuseWhatIsNoAmount) {
  for (const char* text : {"", "mm", "3", "3 mm 4", "3 m m", "three mm", "3 MM", "++3 mm"})
    EXPECT_EQ(value_with_unit(text, Quantity::length, 3), std::nullopt) << text;
  EXPECT_EQ(value_with_unit("3 m", Quantity::number, 3), std::nullopt);
}

TEST(Units, SuggestTheNearest) {
  EXPECT_EQ(near_unit("10 kpa", Quantity::pressure, 3), "10 kPa");
  EXPECT_EQ(near_unit("1e-3 kg/m^2", Quantity::density, 3), "1e-3 kg/m3");
  EXPECT_EQ(near_unit("10 furlong", Quantity::length, 3), std::nullopt);
  EXPECT_EQ(near_unit("10", Quantity::length, 3), std::nullopt);
}

TEST(NearMatch, CountsLettersToChange) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("restituton", "restitution"), 1);
  EXPECT_EQ(edit_distance("cuont", "count"), 1);
  EXPECT_EQ(edit_distance("ab", "ba"), 1);
  EXPECT_EQ(edit_distance("abcd", "badc"), 2);
  EXPECT_EQ(edit_distance("ca", "abc"), 3);  // no letter is changed twice
}

TEST(NearMatch, FindsTheNearestNameOnly) {
  const std::vector<std::string> names = {"friction", "restitution", "stiffness_level", "fraction", "dt"};
  EXPECT_EQ(near_match("fricton", names), "friction");
  EXPECT_EQ(near_match("Fraction", names), "fraction");
  EXPECT_EQ(near_match("stiffness", names), "stiffness_level");  // cut short
  EXPECT_EQ(near_match("DT", names), "dt");
  EXPECT_EQ(near_match("speed", names), std::nullopt);
  EXPECT_EQ(near_match("", names), std::nullopt);
  EXPECT_EQ(near_match("x", {"y"}), std::nullopt);
}

TEST(NearMatch, ListsNames) {
  EXPECT_EQ(alternatives({}), "");
  EXPECT_EQ(alternatives({"a"}), "a");
  EXPECT_EQ(alternatives({"a", "b"}), "a or b");
  EXPECT_EQ(alternatives(in_quotes(std::vector<std::string>{"a", "b", "c"})), "\"a\", \"b\" or \"c\"");
}

}  // namespace
}  // namespace galet::test::units_test
