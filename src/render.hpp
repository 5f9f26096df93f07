// Pictures of spheres: VTK draws them, without a screen, by the script render.py among the program's data.
#pragma once

#include <string>

#include "common/engine/snapshot.hpp"

namespace galet {

enum class GrainColour {
  speed,        ///< of the fluctuation
  coordination  ///< contacts of the grain
};

struct RenderOptions {
  std::string title;
  GrainColour colour = GrainColour::speed;
  int width = 1600;  ///< pixels
};

/// Writes a PNG file: the grains with their radii on the left, the contact forces as tubes on the right; planes and
/// cylinders as clear surfaces, grains of rough walls grey. Returns an empty text, or, when the machine lacks what
/// draws it, what is missing; nothing is written then. Throws RunError when the drawing fails.
std::string render_spheres(const std::string& path, const Snapshot<3>& snapshot, const RenderOptions& options);

}  // namespace galet
