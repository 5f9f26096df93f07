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

std::string md_section(EngineKind engine, int contact_steps) {
  if (engine != EngineKind::md || contact_steps == 0) return "";
  return fmt::format("\n[md]\nsteps_per_contact = {}\n", contact_steps);
}

}  // namespace galet
