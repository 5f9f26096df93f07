// Reads one value of a scene file into its place in the Scene, or says what was expected there instead.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/io/scene_fields.hpp"
#include "common/io/toml_tree.hpp"

namespace galet {

/// What the reading of a number with a unit depends on.
struct UnitContext {
  bool reduced = true;
  std::optional<int> dimension;  ///< empty when the file's own is wrong: then units of both 2D and 3D pass
};

/// Stores `node` in `scene`, as the field says. `path` is the field's name in messages, with the index of its list
/// entry. Returns the mistakes; with any, the scene keeps the value that it had.
std::vector<Mistake> read_field(const SceneField& field, const std::string& path, const TreeNode& node,
                                const UnitContext& units, Scene& scene);

}  // namespace galet
