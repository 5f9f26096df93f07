// The layout of a run: what its state has columns for. The smallest layout that the scene's materials need is
// deduced (common/scene/derive.hpp), printed, and is a template parameter of both engines.
#pragma once

#include <string>

namespace galet {

struct Layout {
  int dim;               ///< 2 (disks) or 3 (spheres)
  bool friction;         ///< tangential parts and rotations exist; without friction neither is stored nor computed
  bool rolling = false;  ///< contacts resist rolling (3D: and pivoting); only together with `friction`

  friend bool operator==(const Layout&, const Layout&) = default;
};

inline std::string to_string(const Layout& layout) {
  return std::string(layout.dim == 2 ? "2D" : "3D") + (layout.friction ? " with friction" : " frictionless") +
         (layout.rolling ? " and rolling resistance" : "");
}

}  // namespace galet
