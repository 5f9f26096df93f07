// Packings as CSV tables, one grain per line:
//   x,y[,z],diameter[,mass][,vx,vy[,vz]][,wz | wx,wy,wz][,material]
// in any order of columns, with optional comment lines "# cell: ..." (the box matrix row by row: D x D numbers, the
// cell vectors are its columns) and "# periodic: 1 0 1" (1: periodic along that cell vector; default all).
// material: 0 for the scene's [material], k for its k-th [[other_material]].
#pragma once

#include <string>
#include <string_view>

#include "common/scene/sample.hpp"

namespace galet {

/// What a packing file gave. Without a cell, the cell's box is the identity; without masses, they are 1.
template <int D>
struct PackingFile {
  Sample<D> sample;
  bool has_cell = false;
  bool has_mass = false;
};

/// Positions are taken as they stand, inside the cell or not. Throws InputError with file:line:column.
template <int D>
PackingFile<D> read_packing_csv(const std::string& path);

/// The same for a text; `name` stands for the file in messages.
template <int D>
PackingFile<D> parse_packing_csv(std::string_view text, const std::string& name);

/// Writes every column that the table above knows, so that reading gives the same bits back. Planes are not written.
template <int D>
void write_packing_csv(const std::string& path, const Sample<D>& sample);

extern template PackingFile<2> read_packing_csv<2>(const std::string&);
extern template PackingFile<3> read_packing_csv<3>(const std::string&);
extern template PackingFile<2> parse_packing_csv<2>(std::string_view, const std::string&);
extern template PackingFile<3> parse_packing_csv<3>(std::string_view, const std::string&);
extern template void write_packing_csv<2>(const std::string&, const Sample<2>&);
extern template void write_packing_csv<3>(const std::string&, const Sample<3>&);

}  // namespace galet
