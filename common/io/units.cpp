#include "common/io/units.hpp"

#include <charconv>
#include <utility>

#include "common/core/near_match.hpp"

namespace galet {

namespace {

/// value in SI = value * times / over. Two factors, so that "3 mm" is the double nearest to 0.003.
struct Unit {
  std::string name;
  double times = 1;
  double over = 1;
};

std::vector<Unit> density_units(int dimension) {
  if (dimension == 2) return {{"kg/m2"}, {"g/cm2", 10}, {"g/mm2", 1e3}};
  return {{"kg/m3"}, {"g/cm3", 1e3}};
}

std::vector<Unit> pressure_units(int dimension) {
  if (dimension == 2) return {{"N/m"}, {"kN/m", 1e3}, {"MN/m", 1e6}, {"GN/m", 1e9}};
  return {{"Pa"}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}};
}

std::vector<Unit> units(Quantity quantity, int dimension) {
  switch (quantity) {
    case Quantity::number:
      return {};
    case Quantity::length:
      return {{"um", 1, 1e6}, {"mm", 1, 1e3}, {"cm", 1, 1e2}, {"m"}};
    case Quantity::time:
      return {{"us", 1, 1e6}, {"ms", 1, 1e3}, {"s"}, {"min", 60}, {"h", 3600}};
    case Quantity::mass:
      return {{"mg", 1, 1e6}, {"g", 1, 1e3}, {"kg"}};
    case Quantity::velocity:
      return {{"mm/s", 1, 1e3}, {"cm/s", 1, 1e2}, {"m/s"}};
    case Quantity::acceleration:
      return {{"mm/s2", 1, 1e3}, {"cm/s2", 1, 1e2}, {"m/s2"}};
    case Quantity::rate:
      return {{"1/h", 1, 3600}, {"1/min", 1, 60}, {"1/s"}};
    case Quantity::angular_velocity:
      return {{"rad/s"}, {"1/s"}};
    case Quantity::density:
      return density_units(dimension);
    case Quantity::pressure:
      return pressure_units(dimension);
    case Quantity::stiffness:
      return {{"N/m"}, {"kN/m", 1e3}, {"MN/m", 1e6}, {"GN/m", 1e9}};
    case Quantity::force:
      return {{"nN", 1, 1e9}, {"uN", 1, 1e6}, {"mN", 1, 1e3}, {"N"}, {"kN", 1e3}};
    case Quantity::torque:
      return {{"nN m", 1, 1e9}, {"uN m", 1, 1e6}, {"mN m", 1, 1e3}, {"N m"}, {"kN m", 1e3}};
    case Quantity::inertia:
      return {{"g mm2", 1, 1e9}, {"g cm2", 1, 1e7}, {"kg m2"}};
    case Quantity::modulus:
      return pressure_units(3);
  }
  return {};
}

/// The spellings of a unit brought to one: m/s^2 and m/s² to m/s2, µ to u.
std::string one_spelling(std::string_view unit) {
  static const std::vector<std::pair<std::string_view, std::string_view>> spellings = {
      {"^", ""}, {"²", "2"}, {"³", "3"}, {"\u00b5", "u"}, {"\u03bc", "u"}};
  std::string plain(unit);
  for (const auto& [from, to] : spellings)
    for (auto at = plain.find(from); at != std::string::npos; at = plain.find(from)) plain.replace(at, from.size(), to);
  return plain;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

struct Amount {
  double value = 0;
  std::string_view number;  ///< as written
  std::string unit;
};

std::optional<Amount> split(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Amount amount;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), amount.value);
  if (error != std::errc()) return std::nullopt;
  const auto digits = static_cast<std::size_t>(end - text.data());
  amount.number = text.substr(0, digits);
  amount.unit = one_spelling(trimmed(text.substr(digits)));
  return amount;
}

}  // namespace

std::string with_article(Quantity quantity) {
  switch (quantity) {
    case Quantity::number:
      return "a number";
    case Quantity::length:
      return "a length";
    case Quantity::time:
      return "a time";
    case Quantity::mass:
      return "a mass";
    case Quantity::velocity:
      return "a velocity";
    case Quantity::acceleration:
      return "an acceleration";
    case Quantity::rate:
      return "a rate";
    case Quantity::angular_velocity:
      return "an angular velocity";
    case Quantity::density:
      return "a density";
    case Quantity::pressure:
      return "a pressure";
    case Quantity::stiffness:
      return "a stiffness";
    case Quantity::force:
      return "a force";
    case Quantity::torque:
      return "a torque";
    case Quantity::inertia:
      return "an inertia";
    case Quantity::modulus:
      return "a modulus";
  }
  return "";
}

std::vector<std::string> unit_names(Quantity quantity, int dimension) {
  std::vector<std::string> names;
  for (const Unit& unit : units(quantity, dimension)) names.push_back(unit.name);
  return names;
}

std::string expected_units(Quantity quantity, int dimension) {
  std::string text = with_article(quantity) + " in " + alternatives(unit_names(quantity, dimension));
  if (dimension == 2 && quantity == Quantity::pressure) text += " (in 2D a force per length)";
  if (dimension == 2 && quantity == Quantity::density) text += " (in 2D a mass per area)";
  return text;
}

std::optional<double> value_with_unit(std::string_view text, Quantity quantity, int dimension) {
  const std::optional<Amount> amount = split(text);
  if (!amount) return std::nullopt;
  for (const Unit& unit : units(quantity, dimension))
    if (unit.name == amount->unit) return amount->value * unit.times / unit.over;
  return std::nullopt;
}

std::optional<std::string> near_unit(std::string_view text, Quantity quantity, int dimension) {
  const std::optional<Amount> amount = split(text);
  if (!amount || amount->unit.empty()) return std::nullopt;
  const std::optional<std::string> unit = near_match(amount->unit, unit_names(quantity, dimension));
  if (!unit) return std::nullopt;
  return std::string(amount->number) + ' ' + *unit;
}

}  // namespace galet
