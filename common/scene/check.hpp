// Every rule that a scene must satisfy beyond the type and range of its single fields. All broken rules are
// reported at once, each with the path of the field that a user would change ("grains.count", "drive[0].rate").
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace galet {

struct Finding {
  std::string path;
  std::string message;             ///< names the fields itself
  std::vector<std::string> reads;  ///< the other fields that the rule looked at: a finding says nothing new when
                                   ///< one of them was refused on its own
};

/// Empty when the scene is sound. Expects single fields of the right type and range, as the reader leaves them.
std::vector<Finding> check(const Scene& scene);

}  // namespace galet
