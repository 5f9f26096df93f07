#include "src/studies/registry.hpp"

#include <array>
#include <vector>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/near_match.hpp"
#include "common/io/scene_file.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "src/cost.hpp"
#include "src/dimension.hpp"
#include "src/studies/studies.hpp"

namespace galet {

namespace {

constexpr std::array studies = {flow_law_study,       flow_kappa_study,     flow_friction_study, flow_restitution_study,
                                inclined_plane_study, annular_shear_study,  cohesive_flow_study, compression_study,
                                triaxial_study,       critical_state_study, consolidation_study, regimes_study};

}  // namespace

std::span<const Study> all_studies() { return studies; }

const Study& find_study(const std::string& name) {
  std::vector<std::string> names;
  for (const Study& study : studies) {
    if (study.name == name) return study;
    names.emplace_back(study.name);
  }
  throw InputError(fmt::format("no study is called {}{}; expected {}", in_quotes(name), suggestion(name, names),
                               alternatives(in_quotes(names))));
}

double estimate_run(const StudyRun& run) {
  const Scene scene = parse_scene(run.scene, run.name);
  return with_dimension(scene.dimension, [&](auto dimension) {
    const Derived derived = derive(scene, grain_facts(scene, initial_sample<dimension>(scene)));
    return estimate_cost(run.engine, scene, derived).seconds;
  });
}

StudyCost estimate_study(const Study& study, StudySize size) {
  StudyCost cost;
  for (const StudyRun& run : study.plan(size)) {
    ++cost.runs;
    cost.seconds += estimate_run(run);
  }
  return cost;
}

}  // namespace galet
