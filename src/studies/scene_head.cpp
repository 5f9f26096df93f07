#include "src/studies/scene_head.hpp"

#include <fmt/format.h>

#include "src/engines.hpp"

namespace galet {

std::string scene_head(const SceneHead& head) {
  return fmt::format(R"(title = "{}"
dimension = {}
seed = {}
units = "reduced"  # {}
engine = "{}"

[grains]
count = {}
diameter = {}
mass = 1.0

[material]
friction = {}
restitution = {}
)",
                     head.title, head.dimension, head.seed, head.units, engine_name(head.engine), head.grains,
                     head.diameter, head.friction, head.restitution);
}

}  // namespace galet
