// The rows of materials: [material], [[other_material]], [[material_pair]], [[group]].
#include "common/io/scene_table.hpp"

namespace galet::scene_table {

namespace {

void add_surface(Rows& rows) {
  rows.push_back({.path = "material.name",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.name; },
                  .doc = "what groups, grains, planes and pairs call it"});
  rows.push_back({.path = "material.friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.friction; },
                  .symbol = "mu",
                  .range = at_least(0),
                  .doc = "Coulomb coefficient; 0: frictionless grains, whose rotations are not computed"});
  rows.push_back({.path = "material.restitution",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.restitution; },
                  .symbol = "e",
                  .range = between(0, 1),
                  .fallback = "needed, or `damping_ratio`",
                  .doc = "normal restitution of a head-on collision of two grains; above 0 for md"});
  rows.push_back({.path = "material.damping_ratio",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.damping_ratio; },
                  .symbol = "zeta",
                  .range = at_least(0),
                  .fallback = "needed, or `restitution`",
                  .doc = "damping constant of a contact / its critical value 2 sqrt(m* K_N(h)); cd uses the "
                         "restitution that follows from it"});
  rows.push_back({.path = "material.tangential_damping_ratio",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.tangential_damping_ratio; },
                  .symbol = "zeta_T",
                  .range = at_least(0),
                  .doc = "the same for sliding: tangential damping constant / its critical value 2 sqrt(m_T K_T), "
                         "1/m_T = 1/m* + R_i^2/I_i + R_j^2/I_j"});
  rows.push_back({.path = "material.tangential_restitution",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.tangential_restitution; },
                  .symbol = "e_T",
                  .range = between(0, 1),
                  .doc = "cd: tangential restitution, of sliding, rolling and pivoting: a contact that sticks in an "
                         "impact leaves with -e_T "
                         "times its tangential velocity"});
  rows.push_back({.path = "material.viscous_convention",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.convention; },
                  .choices = {"elastic", "total"},
                  .doc = "`elastic`: only the elastic parts enter Coulomb's inequality, the total normal force may "
                         "attract; `total`: viscous parts are added before, the repulsive part is clipped at 0"});
}

void add_stiffness(Rows& rows) {
  rows.push_back(
      {.path = "material.normal_law",
       .target = [](Scene& s) -> FieldTarget { return &s.material.normal_law; },
       .choices = {"linear", "hertz"},
       .doc = "`linear`: F_N = K_N h; `hertz`: F_N = (4/3) E* sqrt(R*) h^(3/2), with K_T from Mindlin's theory"});
  rows.push_back({.path = "material.stiffness_level",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.stiffness_level; },
                  .symbol = "kappa",
                  .range = above(0),
                  .fallback = "md: needed, or `normal_stiffness` (hertz: `young_modulus`)",
                  .doc = "K_N / (P d^(D-2)), or (E / ((1 - nu^2) P))^(2/3) with hertz: deflections are about d / "
                         "kappa; needs `loading.pressure`"});
  rows.push_back({.path = "material.normal_stiffness",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.normal_stiffness; },
                  .symbol = "K_N",
                  .quantity = Quantity::stiffness,
                  .range = above(0),
                  .fallback = "linear, md: needed, or `stiffness_level`",
                  .doc = "linear: normal force per deflection"});
  rows.push_back({.path = "material.young_modulus",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.young_modulus; },
                  .symbol = "E",
                  .quantity = Quantity::modulus,
                  .range = above(0),
                  .fallback = "hertz: needed, or `stiffness_level`",
                  .doc = "hertz: Young's modulus"});
  rows.push_back({.path = "material.poisson_ratio",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.poisson_ratio; },
                  .symbol = "nu",
                  .range = {.low = -1, .high = 0.5, .low_open = true},
                  .fallback = "hertz: needed",
                  .doc = "hertz: Poisson's ratio"});
  rows.push_back({.path = "material.tangential_stiffness_ratio",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.tangential_stiffness_ratio; },
                  .range = above(0),
                  .fallback = "0.5; hertz: (2 - 2 nu) / (2 - nu)",
                  .doc = "K_T / K_N"});
}

void add_rolling(Rows& rows) {
  rows.push_back({.path = "material.rolling_friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.rolling_friction; },
                  .symbol = "mu_R",
                  .quantity = Quantity::length,
                  .range = at_least(0),
                  .doc = "rolling torques are bounded by this length times the repulsive force"});
  rows.push_back({.path = "material.pivoting_friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.pivoting_friction; },
                  .symbol = "mu_P",
                  .quantity = Quantity::length,
                  .range = at_least(0),
                  .doc = "3D: the same for rotation about the normal"});
  rows.push_back({.path = "material.rolling_stiffness_ratio",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.rolling_stiffness_ratio; },
                  .range = above(0),
                  .doc = "K_R / (K_N mu_R^2), likewise for pivoting"});
}

void add_cohesion(Rows& rows) {
  rows.push_back({.path = "material.cohesion_law",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.cohesion_law; },
                  .choices = {"constant", "square_root"},
                  .doc = "`constant`: attraction F0 in contact, F0 (1 - g / D0) across a gap g < D0; "
                         "`square_root` (md): sqrt(4 K_N F0 h) in contact (linear law, no range)"});
  rows.push_back({.path = "material.cohesion_force",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.cohesion_force; },
                  .symbol = "F0",
                  .quantity = Quantity::force,
                  .range = above(0),
                  .fallback = "no cohesion",
                  .doc = "largest traction that a contact bears"});
  rows.push_back({.path = "material.cohesion_number",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.cohesion_number; },
                  .symbol = "eta",
                  .range = above(0),
                  .fallback = "no cohesion",
                  .doc = "F0 / (P d^(D-1)), in place of `cohesion_force`; needs `loading.pressure`"});
  rows.push_back({.path = "material.cohesion_range",
                  .target = [](Scene& s) -> FieldTarget { return &s.material.cohesion_range; },
                  .symbol = "D0",
                  .quantity = Quantity::length,
                  .range = at_least(0),
                  .doc = "constant law: length across which grains attract"});
}

}  // namespace

void add_material(Rows& rows) {
  add_surface(rows);
  add_stiffness(rows);
  add_rolling(rows);
  add_cohesion(rows);
}

void add_other_materials(Rows& rows) {
  rows.push_back({.path = "other_material.name",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().name; },
                  .required = true,
                  .doc = "what groups, grains, planes and pairs call it"});
  rows.push_back({.path = "other_material.density",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().density; },
                  .symbol = "rho",
                  .quantity = Quantity::density,
                  .range = above(0),
                  .fallback = "`grains.density`",
                  .doc = "of its grains; needs `grains.density`"});
  rows.push_back({.path = "other_material.friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().friction; },
                  .symbol = "mu",
                  .range = at_least(0),
                  .fallback = "as in [material]",
                  .doc = "Coulomb coefficient"});
  rows.push_back({.path = "other_material.restitution",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().restitution; },
                  .symbol = "e",
                  .range = between(0, 1),
                  .fallback = "as in [material]",
                  .doc = "normal restitution between grains of this material"});
  rows.push_back({.path = "other_material.damping_ratio",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().damping_ratio; },
                  .symbol = "zeta",
                  .range = at_least(0),
                  .fallback = "as in [material]",
                  .doc = "in place of `restitution`"});
  rows.push_back({.path = "other_material.tangential_restitution",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().tangential_restitution; },
                  .symbol = "e_T",
                  .range = between(0, 1),
                  .fallback = "as in [material]",
                  .doc = "cd: tangential restitution between grains of this material"});
  rows.push_back({.path = "other_material.stiffness_level",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().stiffness_level; },
                  .symbol = "kappa",
                  .range = above(0),
                  .fallback = "as in [material]",
                  .doc = "between grains of this material"});
  rows.push_back({.path = "other_material.normal_stiffness",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().normal_stiffness; },
                  .symbol = "K_N",
                  .quantity = Quantity::stiffness,
                  .range = above(0),
                  .fallback = "as in [material]",
                  .doc = "linear: in place of `stiffness_level`"});
  rows.push_back({.path = "other_material.young_modulus",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().young_modulus; },
                  .symbol = "E",
                  .quantity = Quantity::modulus,
                  .range = above(0),
                  .fallback = "as in [material]",
                  .doc = "hertz: Young's modulus"});
  rows.push_back({.path = "other_material.poisson_ratio",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().poisson_ratio; },
                  .symbol = "nu",
                  .range = {.low = -1, .high = 0.5, .low_open = true},
                  .fallback = "as in [material]",
                  .doc = "hertz: Poisson's ratio"});
  rows.push_back(
      {.path = "other_material.tangential_stiffness_ratio",
       .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().tangential_stiffness_ratio; },
       .range = above(0),
       .fallback = "as in [material]",
       .doc = "linear: K_T / K_N"});
  rows.push_back({.path = "other_material.rolling_friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().rolling_friction; },
                  .symbol = "mu_R",
                  .quantity = Quantity::length,
                  .range = at_least(0),
                  .fallback = "as in [material]",
                  .doc = "rolling coefficient"});
  rows.push_back({.path = "other_material.pivoting_friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().pivoting_friction; },
                  .symbol = "mu_P",
                  .quantity = Quantity::length,
                  .range = at_least(0),
                  .fallback = "as in [material]",
                  .doc = "3D: pivoting coefficient"});
  rows.push_back({.path = "other_material.cohesion_force",
                  .target = [](Scene& s) -> FieldTarget { return &s.other_materials.back().cohesion_force; },
                  .symbol = "F0",
                  .quantity = Quantity::force,
                  .range = at_least(0),
                  .fallback = "as in [material]",
                  .doc = "largest traction; 0: none"});
}

void add_pairs(Rows& rows) {
  rows.push_back({.path = "material_pair.between",
                  .target = [](Scene& s) -> FieldTarget { return &s.pairs.back().between; },
                  .required = true,
                  .doc = "two names; twice the same for contacts within a material"});
  rows.push_back({.path = "material_pair.friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.pairs.back().friction; },
                  .symbol = "mu",
                  .range = at_least(0),
                  .fallback = "by the mixing rules",
                  .doc = "Coulomb coefficient"});
  rows.push_back({.path = "material_pair.restitution",
                  .target = [](Scene& s) -> FieldTarget { return &s.pairs.back().restitution; },
                  .symbol = "e",
                  .range = between(0, 1),
                  .fallback = "by the mixing rules",
                  .doc = "normal restitution"});
  rows.push_back({.path = "material_pair.tangential_restitution",
                  .target = [](Scene& s) -> FieldTarget { return &s.pairs.back().tangential_restitution; },
                  .symbol = "e_T",
                  .range = between(0, 1),
                  .fallback = "by the mixing rules",
                  .doc = "cd: tangential restitution"});
  rows.push_back({.path = "material_pair.normal_stiffness",
                  .target = [](Scene& s) -> FieldTarget { return &s.pairs.back().normal_stiffness; },
                  .symbol = "K_N",
                  .quantity = Quantity::stiffness,
                  .range = above(0),
                  .fallback = "by the mixing rules",
                  .doc = "linear: normal stiffness"});
  rows.push_back({.path = "material_pair.rolling_friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.pairs.back().rolling_friction; },
                  .symbol = "mu_R",
                  .quantity = Quantity::length,
                  .range = at_least(0),
                  .fallback = "by the mixing rules",
                  .doc = "rolling coefficient"});
  rows.push_back({.path = "material_pair.pivoting_friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.pairs.back().pivoting_friction; },
                  .symbol = "mu_P",
                  .quantity = Quantity::length,
                  .range = at_least(0),
                  .fallback = "by the mixing rules",
                  .doc = "3D: pivoting coefficient"});
  rows.push_back({.path = "material_pair.cohesion_force",
                  .target = [](Scene& s) -> FieldTarget { return &s.pairs.back().cohesion_force; },
                  .symbol = "F0",
                  .quantity = Quantity::force,
                  .range = at_least(0),
                  .fallback = "by the mixing rules",
                  .doc = "largest traction; 0: none"});
}

void add_groups(Rows& rows) {
  rows.push_back({.path = "group.material",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.groups.back().material; },
                  .required = true,
                  .doc = "name of the group's material"});
  rows.push_back({.path = "group.fraction",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.groups.back().fraction; },
                  .range = {.low = 0, .high = 1, .low_open = true},
                  .required = true,
                  .doc = "share of the grains, by number"});
}

}  // namespace galet::scene_table
