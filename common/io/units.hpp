// Units of the values of a scene in SI: "10 kPa", "2600 kg/m3". In two dimensions grains are disks of unit-less
// thickness: a pressure is a force per length and a density a mass per area.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace galet {

/// What a number of a scene measures. `number` has no unit.
enum class Quantity {
  number,
  length,
  time,
  mass,
  velocity,
  acceleration,
  rate,
  angular_velocity,
  density,
  pressure,
  stiffness,
  force,
  torque,
  inertia,
  modulus  ///< of elasticity: a force per area in 2D too
};

/// "a pressure".
std::string with_article(Quantity quantity);

/// The unit names of a quantity, the SI unit among them, small to large.
std::vector<std::string> unit_names(Quantity quantity, int dimension);

/// "a pressure in Pa, kPa, MPa or GPa".
std::string expected_units(Quantity quantity, int dimension);

/// The SI value of a number followed by a unit of that quantity; nothing if `text` is not that. Powers may be
/// written m/s2, m/s^2 or m/s², and micro u or µ.
std::optional<double> value_with_unit(std::string_view text, Quantity quantity, int dimension);

/// The text with its unit replaced by the nearest unit of that quantity ("10 kpa" -> "10 kPa"), if any is near.
std::optional<std::string> near_unit(std::string_view text, Quantity quantity, int dimension);

}  // namespace galet
