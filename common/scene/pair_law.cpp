#include "common/scene/pair_law.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"
#include "common/scene/materials.hpp"
#include "common/scene/restitution.hpp"

namespace galet {

namespace {

/// One material with everything that [material] lends it.
struct Material {
  double friction, rolling_friction, pivoting_friction, cohesion;
  double zeta;
  std::optional<double> restitution;  ///< as written
  double stiffness = 0;               ///< linear: K_N; hertz: E
  double poisson = 0;
  double tangential_ratio = 0.5;  ///< linear only
  bool stiff = false;
  double tangential_restitution = 0;
};

double power_of(double base, int exponent) { return std::pow(base, exponent); }

/// zeta of a material that gives e or zeta. e = 0 asks for a contact that never opens again: critical damping.
double damping_ratio(const MaterialSpec& laws, std::optional<double> restitution, std::optional<double> zeta) {
  if (restitution && *restitution > 0) return damping_of_restitution(*restitution, laws.convention, laws.normal_law);
  if (restitution) return 1;
  return zeta.value_or(0);
}

Material base_material(const Scene& scene, std::optional<double> pressure, double d) {
  const MaterialSpec& spec = scene.material;
  Material material{spec.friction, spec.rolling_friction, spec.pivoting_friction, 0, 0, spec.restitution};
  material.zeta = damping_ratio(spec, spec.restitution, spec.damping_ratio);
  material.tangential_restitution = spec.tangential_restitution;
  if (spec.cohesion_force) material.cohesion = *spec.cohesion_force;
  if (spec.cohesion_number && pressure)
    material.cohesion = *spec.cohesion_number * *pressure * power_of(d, scene.dimension - 1);
  return material;
}

/// Stiffness from whichever of the three fields is given; a further material falls back on `base`.
void set_stiffness(const Scene& scene, std::optional<double> pressure, double d, std::optional<double> level,
                   std::optional<double> direct, Material& material) {
  const bool hertz = scene.material.normal_law == NormalLaw::hertz;
  if (direct) {
    material.stiffness = *direct;
  } else if (level && pressure) {
    material.stiffness = hertz ? (1 - material.poisson * material.poisson) * std::pow(*level, 1.5) * *pressure *
                                     power_of(d, scene.dimension - 3)
                               : *level * *pressure * power_of(d, scene.dimension - 2);
  } else {
    return;
  }
  material.stiff = true;
}

std::vector<Material> materials_of(const Scene& scene, std::optional<double> pressure, double d) {
  const MaterialSpec& spec = scene.material;
  const bool hertz = spec.normal_law == NormalLaw::hertz;
  Material base = base_material(scene, pressure, d);
  base.poisson = spec.poisson_ratio.value_or(0);
  base.tangential_ratio = spec.tangential_stiffness_ratio.value_or(0.5);
  set_stiffness(scene, pressure, d, spec.stiffness_level, hertz ? spec.young_modulus : spec.normal_stiffness, base);
  std::vector<Material> materials{base};
  for (const OtherMaterial& other : scene.other_materials) {
    Material material = base;
    material.friction = other.friction.value_or(base.friction);
    material.tangential_restitution = other.tangential_restitution.value_or(base.tangential_restitution);
    material.rolling_friction = other.rolling_friction.value_or(base.rolling_friction);
    material.pivoting_friction = other.pivoting_friction.value_or(base.pivoting_friction);
    material.cohesion = other.cohesion_force.value_or(base.cohesion);
    material.poisson = other.poisson_ratio.value_or(base.poisson);
    material.tangential_ratio = other.tangential_stiffness_ratio.value_or(base.tangential_ratio);
    if (other.restitution || other.damping_ratio) {
      material.restitution = other.restitution;
      material.zeta = damping_ratio(spec, other.restitution, other.damping_ratio);
    }
    set_stiffness(scene, pressure, d, other.stiffness_level, hertz ? other.young_modulus : other.normal_stiffness,
                  material);
    materials.push_back(material);
  }
  return materials;
}

void mix_stiffness(const Material& a, const Material& b, PairLaw& law) {
  if (!a.stiff || !b.stiff) return;
  if (law.normal_law == NormalLaw::hertz) {
    const auto plane_strain = [](const Material& m) { return (1 - m.poisson * m.poisson) / m.stiffness; };
    const auto shear = [](const Material& m) { return 2 * (2 - m.poisson) * (1 + m.poisson) / m.stiffness; };
    law.stiffness = 1 / (plane_strain(a) + plane_strain(b));
    law.tangential_ratio = 4 / (shear(a) + shear(b)) / law.stiffness;
    return;
  }
  const auto in_series = [](double x, double y) { return 2 * x * y / (x + y); };
  law.stiffness = in_series(a.stiffness, b.stiffness);
  law.tangential_ratio = in_series(a.tangential_ratio * a.stiffness, b.tangential_ratio * b.stiffness) / law.stiffness;
}

PairLaw mix(const MaterialSpec& spec, const Material& a, const Material& b) {
  PairLaw law;
  law.normal_law = spec.normal_law;
  law.convention = spec.convention;
  law.cohesion_law = spec.cohesion_law;
  mix_stiffness(a, b, law);
  law.damping_ratio = 0.5 * (a.zeta + b.zeta);
  law.tangential_damping_ratio = spec.tangential_damping_ratio;
  // Between like materials the restitution is the one written, to the last bit.
  law.restitution = a.restitution && a.restitution == b.restitution
                        ? *a.restitution
                        : restitution_of_damping(law.damping_ratio, law.convention, law.normal_law);
  law.tangential_restitution = std::min(a.tangential_restitution, b.tangential_restitution);
  law.friction = std::min(a.friction, b.friction);
  law.rolling_friction = std::min(a.rolling_friction, b.rolling_friction);
  law.pivoting_friction = std::min(a.pivoting_friction, b.pivoting_friction);
  law.rolling_ratio = spec.rolling_stiffness_ratio;
  law.cohesion = a.cohesion == b.cohesion ? a.cohesion : std::sqrt(a.cohesion * b.cohesion);
  return law;
}

void apply(const MaterialSpec& spec, const MaterialPair& pair, PairLaw& law) {
  if (pair.friction) law.friction = *pair.friction;
  if (pair.tangential_restitution) law.tangential_restitution = *pair.tangential_restitution;
  if (pair.rolling_friction) law.rolling_friction = *pair.rolling_friction;
  if (pair.pivoting_friction) law.pivoting_friction = *pair.pivoting_friction;
  if (pair.cohesion_force) law.cohesion = *pair.cohesion_force;
  if (pair.normal_stiffness && law.normal_law == NormalLaw::linear) law.stiffness = *pair.normal_stiffness;
  if (pair.restitution) {
    law.restitution = *pair.restitution;
    law.damping_ratio = damping_ratio(spec, pair.restitution, std::nullopt);
  }
}

}  // namespace

LawTable law_table(const Scene& scene, std::optional<double> pressure, double diameter) {
  const std::vector<Material> materials = materials_of(scene, pressure, diameter);
  LawTable table;
  table.materials = static_cast<int>(materials.size());
  table.stiff = std::all_of(materials.begin(), materials.end(), [](const Material& m) { return m.stiff; });
  for (const Material& a : materials)
    for (const Material& b : materials) table.pairs.push_back(mix(scene.material, a, b));
  for (const MaterialPair& pair : scene.pairs) {
    require(pair.between.size() == 2, "a material pair has two names");
    const int a = material_index(scene, pair.between[0]), b = material_index(scene, pair.between[1]);
    apply(scene.material, pair, table.pairs[a * table.materials + b]);
    table.pairs[b * table.materials + a] = table.at(a, b);
  }
  for (PairLaw& law : table.pairs)
    if (law.cohesion > 0) law.cohesion_range = scene.material.cohesion_range;
  return table;
}

double LawTable::cohesion_range() const {
  double range = 0;
  for (const PairLaw& law : pairs) range = std::max(range, law.cohesion_range);
  return range;
}

bool LawTable::any_rotation() const {
  return std::any_of(pairs.begin(), pairs.end(), [](const PairLaw& law) { return law.rotates(); });
}

bool LawTable::any_rolling() const {
  return std::any_of(pairs.begin(), pairs.end(),
                     [](const PairLaw& law) { return law.rolling_friction > 0 || law.pivoting_friction > 0; });
}

bool LawTable::any_cohesion() const {
  return std::any_of(pairs.begin(), pairs.end(), [](const PairLaw& law) { return law.cohesion > 0; });
}

bool LawTable::any_tangential_restitution() const {
  return std::any_of(pairs.begin(), pairs.end(), [](const PairLaw& law) { return law.tangential_restitution > 0; });
}

double normal_coefficient(const PairLaw& law, double reduced_radius) {
  return law.normal_law == NormalLaw::linear ? law.stiffness : 4.0 / 3 * law.stiffness * std::sqrt(reduced_radius);
}

double deflection_under(NormalLaw law, double coefficient, double force) {
  return law == NormalLaw::linear ? force / coefficient : std::pow(force / coefficient, 2.0 / 3);
}

double tangent_stiffness(NormalLaw law, double coefficient, double deflection) {
  return law == NormalLaw::linear ? coefficient : 1.5 * coefficient * std::sqrt(deflection);
}

double impact_force(NormalLaw law, double coefficient, double reduced_mass, double speed) {
  const double energy = 0.5 * reduced_mass * speed * speed;
  if (law == NormalLaw::linear) return std::sqrt(2 * energy * coefficient);
  return coefficient * std::pow(2.5 * energy / coefficient, 0.6);
}

double stiffness_level(const PairLaw& law, int dim, double pressure, double diameter) {
  if (law.normal_law == NormalLaw::linear) return law.stiffness / (pressure * power_of(diameter, dim - 2));
  return std::pow(2 * law.stiffness / (pressure * power_of(diameter, dim - 3)), 2.0 / 3);
}

}  // namespace galet
