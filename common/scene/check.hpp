// Every rule that a scene must satisfy beyond the type and range of its single fields. All broken rules are
// reported at once, each with the path of the field that a user would change ("grains.count").
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace galet {

struct Finding {
  std::string path;
  std::string message;
};

std::vector<Finding> check(const Scene& scene);

}  // namespace galet
