// HDF5 files of other programs as an Archive: a column for each dataset, called by its path ("fclib_local/W/x").
#pragma once

#include <string>
#include <vector>

#include "common/core/archive.hpp"

namespace galet {

/// All datasets below the named groups (those that are absent are passed over): real numbers, integers (both of any
/// size; arrays of any rank, row by row) and single texts. Datasets of other types, and what links lead to outside of
/// the file, are left out. Texts end at their first null.
/// Throws InputError, with the path and what HDF5 says, when the file is absent, no HDF5 file, truncated, or claims
/// more than it holds.
Archive read_hdf5(const std::string& path, const std::vector<std::string>& groups);

/// Writes the columns as datasets of 64-bit reals, 32-bit integers (an integer beyond them throws
/// std::invalid_argument) and null-terminated texts. Equal archives give equal files. Throws RunError when the file
/// can't be written; an earlier file of that name is then as it was.
void write_hdf5(const std::string& path, const Archive& archive);

}  // namespace galet
