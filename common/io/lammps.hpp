// LAMMPS data files (write_data, read_data) of atom_style sphere, without bonds:
//   Atoms:      id type diameter density x y z [ix iy iz]      Velocities:  id vx vy vz wx wy wz
// with the box in "xlo xhi" .. and the optional tilt line "xy xz yz"; sections in any order, comments anywhere.
// Sections of force field coefficients and masses per type say nothing about a sample and are skipped; any other
// section is an error. Grains come in the order of their ids. The cell's origin moves to 0.
//
// Atom type t is material t - 1 of the sample (0: the scene's [material]).
//
// Mass: density times the volume of the grain in D dimensions. LAMMPS itself gives a sphere's mass, density pi d^3/6,
// to the grains of a 2D run unless they are set to discs: the 2D masses of such a file differ from LAMMPS's.
// In 2D, z, vz, wx, wy and the box along z are ignored.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "common/scene/sample.hpp"

namespace galet {

template <int D>
constexpr std::array<bool, D> all_periodic() {
  std::array<bool, D> periodic{};
  periodic.fill(true);
  return periodic;
}

/// Reads a file. A data file does not say which directions are periodic: the caller does, and positions are brought
/// into the cell along those. Throws InputError with file:line:column.
template <int D>
Sample<D> read_lammps_data(const std::string& path, const std::array<bool, D>& periodic = all_periodic<D>());

/// The same for a text; `name` stands for the file in messages.
template <int D>
Sample<D> parse_lammps_data(std::string_view text, const std::string& name,
                            const std::array<bool, D>& periodic = all_periodic<D>());

/// Writes a sample, whole or not at all. The box must be upper triangular (LAMMPS knows no other): first cell vector
/// along x, second in the plane (x, y). Velocities are the column's: fluctuations. Planes are not written.
template <int D>
void write_lammps_data(const std::string& path, const Sample<D>& sample);

extern template Sample<2> read_lammps_data<2>(const std::string&, const std::array<bool, 2>&);
extern template Sample<3> read_lammps_data<3>(const std::string&, const std::array<bool, 3>&);
extern template Sample<2> parse_lammps_data<2>(std::string_view, const std::string&, const std::array<bool, 2>&);
extern template Sample<3> parse_lammps_data<3>(std::string_view, const std::string&, const std::array<bool, 3>&);
extern template void write_lammps_data<2>(const std::string&, const Sample<2>&);
extern template void write_lammps_data<3>(const std::string&, const Sample<3>&);

}  // namespace galet
