// The rules of materials, and of the relaxers that md may add to their laws.
#include <algorithm>
#include <set>

#include "common/core/near_match.hpp"
#include "common/scene/check_report.hpp"
#include "common/scene/derive.hpp"

namespace galet::scene_check {

bool rotates(const Scene& scene) {
  const auto some = [](const auto& material) {
    const auto above_zero = [](const auto& value) { return std::optional<double>(value).value_or(0) > 0; };
    return above_zero(material.friction) || above_zero(material.rolling_friction) ||
           above_zero(material.pivoting_friction);
  };
  return some(scene.material) || std::any_of(scene.other_materials.begin(), scene.other_materials.end(), some) ||
         std::any_of(scene.pairs.begin(), scene.pairs.end(), some);
}

namespace {

bool hertz(const Scene& scene) { return scene.material.normal_law == NormalLaw::hertz; }

/// Rules of one material's stiffness; `path` is "material." or "other_material[k].".
template <class Spec>
void check_law_fields(Report& report, const std::string& path, const Spec& material) {
  const Scene& scene = report.scene;
  const Paths law = {"material.normal_law"};
  const auto needs = [&](bool given, const char* field, bool has, const char* wanted) {
    report.rule(!given || has, path + field,
                fmt::format("{}{} needs material.normal_law = \"{}\"", path, field, wanted), law);
  };
  needs(material.young_modulus.has_value(), "young_modulus", hertz(scene), "hertz");
  needs(material.poisson_ratio.has_value(), "poisson_ratio", hertz(scene), "hertz");
  needs(material.normal_stiffness.has_value(), "normal_stiffness", !hertz(scene), "linear");
  needs(material.tangential_stiffness_ratio.has_value(), "tangential_stiffness_ratio", !hertz(scene), "linear");
  const char* direct = hertz(scene) ? "young_modulus" : "normal_stiffness";
  const bool both = material.stiffness_level && (hertz(scene) ? material.young_modulus : material.normal_stiffness);
  report.rule(!both, path + direct, fmt::format("{0}stiffness_level and {0}{1} exclude each other", path, direct),
              {path + "stiffness_level", "material.normal_law"});
  report.rule(!material.stiffness_level || scene.loading.pressure, path + "stiffness_level",
              hertz(scene) ? path + "stiffness_level needs loading.pressure: it is (E / ((1 - nu^2) P d^(D-3)))^(2/3)"
                           : path + "stiffness_level needs loading.pressure: it is K_N / (P d^(D-2))",
              {"loading.pressure", "material.normal_law"});
  report.rule(!material.restitution || !material.damping_ratio, path + "damping_ratio",
              fmt::format("{0}restitution and {0}damping_ratio exclude each other", path), {path + "restitution"});
}

/// e = 0 has no finite damping in md.
void check_restitution(Report& report, const std::string& path, std::optional<double> restitution) {
  report.rule(report.scene.engine != EngineKind::md || restitution != 0.0, path + "restitution",
              path + "restitution: md needs a restitution > 0 (give a damping_ratio for stronger damping)", {"engine"});
}

void check_stiffness_given(Report& report) {
  const Scene& scene = report.scene;
  const MaterialSpec& material = scene.material;
  const bool md = scene.engine == EngineKind::md || scene.cd.compliance;
  const std::string_view who = scene.engine == EngineKind::md ? "engine md" : "cd.compliance";
  if (hertz(scene)) {
    report.rule(
        !md || material.stiffness_level || material.young_modulus, "material",
        fmt::format("material.stiffness_level or material.young_modulus is needed by {}", who),
        {"engine", "cd.compliance", "material.normal_law", "material.stiffness_level", "material.young_modulus"});
    report.rule(!md || material.poisson_ratio, "material",
                "material.poisson_ratio is needed with normal_law = \"hertz\"",
                {"engine", "cd.compliance", "material.normal_law", "material.poisson_ratio"});
  } else {
    report.rule(
        !md || material.stiffness_level || material.normal_stiffness, "material",
        fmt::format("material.stiffness_level or material.normal_stiffness is needed by {}", who),
        {"engine", "cd.compliance", "material.normal_law", "material.stiffness_level", "material.normal_stiffness"});
  }
}

bool cohesive(const Scene& scene) {
  const auto some = [](const auto& spec) { return spec.cohesion_force.value_or(0) > 0; };
  return some(scene.material) || scene.material.cohesion_number ||
         std::any_of(scene.other_materials.begin(), scene.other_materials.end(), some) ||
         std::any_of(scene.pairs.begin(), scene.pairs.end(), some);
}

void check_cohesion(Report& report) {
  const Scene& scene = report.scene;
  const MaterialSpec& material = scene.material;
  const bool root = material.cohesion_law == CohesionLaw::square_root;
  const std::string law = "material.cohesion_law";
  report.rule(!material.cohesion_force || !material.cohesion_number, "material.cohesion_number",
              "material.cohesion_force and material.cohesion_number exclude each other", {"material.cohesion_force"});
  report.rule(!material.cohesion_number || scene.loading.pressure, "material.cohesion_number",
              "material.cohesion_number needs loading.pressure: it is F0 / (P d^(D-1))", {"loading.pressure"});
  report.rule(!root || !hertz(scene), law, law + " = \"square_root\" needs normal_law = \"linear\"",
              {"material.normal_law"});
  report.rule(!root || material.cohesion_range == 0, "material.cohesion_range",
              "material.cohesion_range needs cohesion_law = \"constant\": the square-root law ends with the contact",
              {law});
  const Paths sources = {"material.cohesion_force", "material.cohesion_number", "other_material", "material_pair"};
  report.rule(!root || cohesive(scene), law,
              law + " has no effect without a cohesion: give material.cohesion_force or material.cohesion_number",
              sources);
  report.rule(material.cohesion_range == 0 || cohesive(scene), "material.cohesion_range",
              "material.cohesion_range has no effect without a cohesion: give material.cohesion_force or "
              "material.cohesion_number",
              sources);
  for (std::size_t a = 0; a < std::min<std::size_t>(scene.cell.size.size(), 3); ++a)
    report.rule(
        !is_periodic(scene, a) || material.cohesion_range < scene.cell.size[a], "material.cohesion_range",
        fmt::format("material.cohesion_range: {:.6g} is beyond the cell, whose edge in the periodic direction {} "
                    "is {:.6g}",
                    material.cohesion_range, axis(a), scene.cell.size[a]),
        {"cell.size", "cell.periodic"});
}

/// What one engine has a law for and the other has not.
void check_engine_laws(Report& report) {
  const Scene& scene = report.scene;
  const MaterialSpec& material = scene.material;
  const bool rigid = scene.engine == EngineKind::cd;
  report.rule(
      !rigid || material.cohesion_law != CohesionLaw::square_root, "material.cohesion_law",
      "material.cohesion_law: engine cd has the law \"constant\" only: the square root is one of the deflection",
      {"engine"});
  const auto rebound = [&](std::optional<double> value, const std::string& path) {
    report.rule(rigid || value.value_or(0) == 0, path + "tangential_restitution",
                path +
                    "tangential_restitution needs engine = \"cd\": in md it follows from tangential stiffness and "
                    "damping",
                {"engine"});
  };
  rebound(material.tangential_restitution, "material.");
  for (std::size_t k = 0; k < scene.other_materials.size(); ++k)
    rebound(scene.other_materials[k].tangential_restitution, fmt::format("other_material[{}].", k));
  for (std::size_t k = 0; k < scene.pairs.size(); ++k)
    rebound(scene.pairs[k].tangential_restitution, fmt::format("material_pair[{}].", k));
}

/// Elastic contacts of cd.
void check_compliance(Report& report) {
  const Scene& scene = report.scene;
  const MaterialSpec& material = scene.material;
  if (!scene.cd.compliance || scene.engine != EngineKind::cd) return;
  const std::string needs = "cd.compliance";
  report.rule(material.convention == DampingConvention::total, needs,
              "cd.compliance needs material.viscous_convention = \"total\": the implicit contact bounds the repulsive "
              "force as a whole",
              {"material.viscous_convention", "engine"});
  report.rule(material.tangential_damping_ratio == 0, "material.tangential_damping_ratio",
              "material.tangential_damping_ratio: the elastic contacts of cd have no tangential dashpot; leave it out",
              {needs, "engine"});
  report.rule(scene.cd.theta == 1, "cd.theta", "cd.theta below 1 and cd.compliance exclude each other", {needs});
  bool rebounds = material.tangential_restitution > 0;
  for (const OtherMaterial& other : scene.other_materials)
    rebounds = rebounds || other.tangential_restitution.value_or(0) > 0;
  for (const MaterialPair& pair : scene.pairs) rebounds = rebounds || pair.tangential_restitution.value_or(0) > 0;
  report.rule(!rebounds, needs,
              "cd.compliance and a tangential_restitution exclude each other: tangential springs rebound",
              {"material.tangential_restitution", "other_material", "material_pair"});
}

void check_other_material(Report& report, std::size_t k) {
  const Scene& scene = report.scene;
  const OtherMaterial& other = scene.other_materials[k];
  const std::string path = fmt::format("other_material[{}].", k);
  check_law_fields(report, path, other);
  check_restitution(report, path, other.restitution);
  report.rule(!other.density || scene.grains.density, path + "density",
              path + "density needs grains.density: the other grains' masses must be given in the same way",
              {"grains.density"});
  report.rule(scene.dimension == 3 || other.pivoting_friction.value_or(0) == 0, path + "pivoting_friction",
              path + "pivoting_friction needs dimension = 3: disks turn about one axis only", {"dimension"});
}

}  // namespace

void check_material(Report& report) {
  const Scene& scene = report.scene;
  const MaterialSpec& material = scene.material;
  check_law_fields(report, "material.", material);
  report.rule(material.restitution || material.damping_ratio, "material",
              "material.restitution or material.damping_ratio is needed",
              {"material.restitution", "material.damping_ratio"});
  check_restitution(report, "material.", material.restitution);
  check_stiffness_given(report);
  report.rule(scene.dimension == 3 || material.pivoting_friction == 0, "material.pivoting_friction",
              "material.pivoting_friction needs dimension = 3: disks turn about one axis only", {"dimension"});
  check_cohesion(report);
  check_engine_laws(report);
  check_compliance(report);
  for (std::size_t k = 0; k < scene.other_materials.size(); ++k) check_other_material(report, k);
  for (std::size_t k = 0; k < scene.stages.size(); ++k)
    check_restitution(report, fmt::format("stage[{}].", k), scene.stages[k].restitution);
}

// ---- names -------------------------------------------------------------------------------------------------

namespace {

Paths material_names(const Scene& scene) {
  Paths names{scene.material.name};
  for (const OtherMaterial& other : scene.other_materials) names.push_back(other.name);
  return names;
}

void check_reference(Report& report, const std::string& path, const std::string& name) {
  const Paths names = material_names(report.scene);
  const bool known = std::find(names.begin(), names.end(), name) != names.end();
  report.rule(known, path,
              fmt::format("{}: no material is called {}{}; there {} {}", path, in_quotes(name), suggestion(name, names),
                          names.size() == 1 ? "is only" : "are", alternatives(in_quotes(names))),
              {"material.name", "other_material"});
}

void check_groups(Report& report) {
  const Scene& scene = report.scene;
  const auto& groups = scene.grains.groups;
  report.rule(groups.empty() || drawn(scene.initial.kind), "group",
              "[[group]] entries have no effect on listed grains and packings, whose grains name their materials",
              {"initial.kind"});
  double sum = 0;
  std::set<std::string> seen;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const std::string path = fmt::format("group[{}].", k);
    check_reference(report, path + "material", groups[k].material);
    report.rule(seen.insert(groups[k].material).second, path + "material",
                fmt::format("{}material: {} has a group already", path, in_quotes(groups[k].material)));
    sum += groups[k].fraction;
  }
  report.rule(sum <= 1 + 1e-9, "group", fmt::format("group: the fractions sum to {:.6g}, more than 1", sum));
}

void check_pairs(Report& report) {
  const Scene& scene = report.scene;
  std::set<std::set<std::string>> seen;
  for (std::size_t k = 0; k < scene.pairs.size(); ++k) {
    const MaterialPair& pair = scene.pairs[k];
    const std::string path = fmt::format("material_pair[{}].", k), between = path + "between";
    report.rule(pair.between.size() == 2, between,
                fmt::format("{}: expected two names, got {}", between, pair.between.size()));
    for (const std::string& name : pair.between) check_reference(report, between, name);
    const std::set<std::string> both(pair.between.begin(), pair.between.end());
    report.rule(seen.insert(both).second, between, between + ": this pair is there already");
    report.rule(!pair.normal_stiffness || !hertz(scene), path + "normal_stiffness",
                path + "normal_stiffness needs material.normal_law = \"linear\"", {"material.normal_law"});
    check_restitution(report, path, pair.restitution);
    report.rule(scene.dimension == 3 || pair.pivoting_friction.value_or(0) == 0, path + "pivoting_friction",
                path + "pivoting_friction needs dimension = 3: disks turn about one axis only", {"dimension"});
  }
}

}  // namespace

void check_material_names(Report& report) {
  const Scene& scene = report.scene;
  report.rule(!scene.material.name.empty(), "material.name", "material.name is empty");
  std::set<std::string> seen{scene.material.name};
  for (std::size_t k = 0; k < scene.other_materials.size(); ++k) {
    const std::string path = fmt::format("other_material[{}].name", k), &name = scene.other_materials[k].name;
    report.rule(!name.empty(), path, path + " is empty");
    report.rule(name.empty() || seen.insert(name).second, path,
                fmt::format("{}: {} is the name of another material already", path, in_quotes(name)),
                {"material.name"});
  }
  // Rows of pairs are numbered in one byte: 15 materials make 225 of them.
  report.rule(scene.other_materials.size() < 15, "other_material",
              fmt::format("other_material: {} materials, at most 15 are possible", scene.other_materials.size() + 1));
  check_groups(report);
  check_pairs(report);
  for (std::size_t k = 0; k < scene.planes.size(); ++k)
    if (!scene.planes[k].material.empty())
      check_reference(report, fmt::format("plane[{}].material", k), scene.planes[k].material);
  for (std::size_t k = 0; k < scene.cylinders.size(); ++k)
    if (!scene.cylinders[k].material.empty())
      check_reference(report, fmt::format("cylinder[{}].material", k), scene.cylinders[k].material);
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    if (!scene.bodies[k].material.empty())
      check_reference(report, fmt::format("body[{}].material", k), scene.bodies[k].material);
  for (std::size_t k = 0; k < scene.grains.listed.size(); ++k)
    if (!scene.grains.listed[k].material.empty())
      check_reference(report, fmt::format("grain[{}].material", k), scene.grains.listed[k].material);
}

// ---- relaxers ----------------------------------------------------------------------------------------------

void check_relaxers(Report& report) {
  const Scene& scene = report.scene;
  const LoadingSpec& loading = scene.loading;
  const auto nonzero = [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double x) { return x != 0; });
  };
  const bool flows = imposes_flow(scene);
  const bool walls = std::any_of(scene.planes.begin(), scene.planes.end(),
                                 [&](const PlaneSpec& plane) { return nonzero(plane.velocity); });
  const bool turning = std::any_of(scene.cylinders.begin(), scene.cylinders.end(),
                                   [](const CylinderSpec& cylinder) { return surface_speed(cylinder) > 0; });
  const auto refuse = [&](bool on, const char* path) {
    if (!on) return;
    const std::string why = ": it breaks the balance of momentum and may only help to reach an equilibrium";
    report.rule(!nonzero(loading.gravity), path, fmt::format("{} is refused under gravity{}", path, why),
                {"loading.gravity"});
    report.rule(!flows, path, fmt::format("{} is refused with an imposed flow{}", path, why),
                {"loading.kind", "drive", "stage"});
    report.rule(!walls, path, fmt::format("{} is refused with moving planes{}", path, why), {"plane"});
    report.rule(!turning, path, fmt::format("{} is refused with moving cylinders{}", path, why), {"cylinder"});
  };
  refuse(scene.md.drag > 0, "md.drag");
  refuse(scene.md.acceleration_damping > 0, "md.acceleration_damping");
}

}  // namespace galet::scene_check
