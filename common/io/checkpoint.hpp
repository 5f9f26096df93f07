// Checkpoints: an Archive in one HDF5 file, bit for bit, with the scene's text, so that the file alone is enough to
// go on. Written to a temporary name and renamed, so that a killed run leaves the earlier file whole.
#pragma once

#include <string>

#include "common/core/archive.hpp"

namespace galet {

/// Version of the file format; a reader refuses versions that it does not know.
inline constexpr int checkpoint_version = 4;

void write_checkpoint(const std::string& path, const Archive& archive);

/// Throws InputError when the file is absent, truncated, damaged (a stored hash of the columns is compared) or of
/// another version.
Archive read_checkpoint(const std::string& path);

}  // namespace galet
