// What holds between two materials: every constant of the contact law, found from the forces that a pair (or a grain
// and a plane) shows. Without [[material_pair]]:
//   linear   K_N = 2 K_i K_j / (K_i + K_j), K_T likewise from K_T,i = ratio_i K_i
//   hertz    1/E* = sum (1 - nu^2)/E, 1/G* = sum 2 (2 - nu)(1 + nu)/E, K_T/K_N = 4 G*/E*
//   mu, mu_R, mu_P the smaller one, zeta the mean, F0 the geometric mean
#include <gtest/gtest.h>

#include "tests/support/impact.hpp"

namespace galet::test::materials_test {
namespace {

/// One material in full.
struct Material {
  std::string name;
  double friction, zeta, rolling, pivoting, cohesion;
  double stiffness, ratio;  ///< linear: K_N, K_T / K_N
  Elastic matter;           ///< hertz
};

// No two orders agree: neither of the numbers with each other nor with the order of the materials.
const std::array materials{Material{"a", 0.30, 0.10, 0.020, 0.031, 0.010, 1.0, 0.50, {10, 0.10}},
                           Material{"b", 0.50, 0.40, 0.013, 0.043, 0.040, 3.0, 0.25, {35, 0.45}},
                           Material{"c", 0.21, 0.25, 0.037, 0.022, 0.020, 0.4, 0.80, {4, 0.30}}};

constexpr double heavy = 1e20;  // grains of this mass keep their velocities and spins

Scene table_scene(NormalLaw law) {
  const Material& first = materials[0];
  Scene scene = law == NormalLaw::linear ? linear_scene(3, first.friction, first.stiffness)
                                         : hertz_scene(3, first.friction, first.matter.young, first.matter.poisson);
  scene.material.name = first.name;
  scene.material.restitution.reset();
  scene.material.damping_ratio = first.zeta;
  scene.material.rolling_friction = first.rolling;
  scene.material.pivoting_friction = first.pivoting;
  scene.material.cohesion_force = first.cohesion;
  if (law == NormalLaw::linear) scene.material.tangential_stiffness_ratio = first.ratio;
  for (int k = 1; k < 3; ++k) {
    const Material& from = materials[k];
    OtherMaterial to = other(from.name);
    to.friction = from.friction;
    to.damping_ratio = from.zeta;
    to.rolling_friction = from.rolling;
    to.pivoting_friction = from.pivoting;
    to.cohesion_force = from.cohesion;
    if (law == NormalLaw::linear) {
      to.normal_stiffness = from.stiffness;
      to.tangential_stiffness_ratio = from.ratio;
    } else {
      to.young_modulus = from.matter.young;
      to.poisson_ratio = from.matter.poisson;
    }
    scene.other_materials.push_back(to);
  }
  return scene;
}

/// The constants of a contact. `normal`: K_N (linear) or E* (hertz).
struct Constants {
  double normal, ratio, zeta, friction, rolling, pivoting, cohesion;
};

Constants mixed(NormalLaw law, int i, int j) {
  const Material &a = materials[i], &b = materials[j];
  const auto series = [](double x, double y) { return 2 * x * y / (x + y); };
  Constants c{};
  if (law == NormalLaw::linear) {
    c.normal = series(a.stiffness, b.stiffness);
    c.ratio = series(a.ratio * a.stiffness, b.ratio * b.stiffness) / c.normal;
  } else {
    c.normal = contact_modulus(a.matter, b.matter);
    c.ratio = 4 * contact_shear_modulus(a.matter, b.matter) / c.normal;
  }
  c.zeta = (a.zeta + b.zeta) / 2;
  c.friction = std::min(a.friction, b.friction);
  c.rolling = std::min(a.rolling, b.rolling);
  c.pivoting = std::min(a.pivoting, b.pivoting);
  c.cohesion = std::sqrt(a.cohesion * b.cohesion);
  return c;
}

/// Who touches whom: two grains, or (plane) grain 0 and a plane.
struct Who {
  int first, second;
  bool plane;
};

constexpr double deflection = 0.03;
constexpr std::array radii{0.3, 0.6};
const Vec<3> n = generic_direction<3>();
const Vec<3> t = generic_tangent<3>(generic_direction<3>());

Sample<3> touching(const Who& who, double mass) {
  if (who.plane) {
    Sample<3> sample = ball_apart<3>(n, -deflection, radii[0], mass);
    sample.material = {who.first};
    sample.plane_material = {who.second};
    return sample;
  }
  Sample<3> sample = pair_apart<3>(n, -deflection, radii, {mass, 3 * mass});
  sample.material = {who.first, who.second};
  return sample;
}

double reduced_radius(const Who& who) { return who.plane ? radii[0] : reduced(radii[0], radii[1]); }

double elastic_force(NormalLaw law, const Who& who, const Constants& c) {
  if (law == NormalLaw::linear) return c.normal * deflection;
  return hertz_coefficient(c.normal, reduced_radius(who)) * std::pow(deflection, 1.5);
}
double tangent(NormalLaw law, const Who& who, const Constants& c) {
  if (law == NormalLaw::linear) return c.normal;
  return 1.5 * hertz_coefficient(c.normal, reduced_radius(who)) * std::sqrt(deflection);
}

struct Contact {
  double normal, tangential, rolling, pivoting;
};

/// The contact of heavy grains after `steps` of dt, with grain 0 spinning. Without dashpots: at such masses the least
/// velocity would show in them.
Contact after(Scene scene, Sample<3> sample, const Vec<3>& spin, double dt, long steps) {
  scene.material.damping_ratio = 0;
  for (OtherMaterial& material : scene.other_materials) material.damping_ratio = 0;
  set_dt(scene, dt);
  sample.spin[0] = spin;
  const auto engine = make_engine<3>(EngineKind::md, scene, sample);
  engine->advance(steps);
  const Snapshot<3> state = engine->snapshot();
  const Vec<3> normal = state.contacts->normal.at(0), force = state.contacts->force.at(0);
  const Vec<3> torque = state.contacts->torque.at(0);
  const double along = force.dot(normal), pivot = torque.dot(normal);
  return {along, (force - along * normal).norm(), (torque - pivot * normal).norm(), std::abs(pivot)};
}

/// Rounding of positions of order 10, 1e-14, in h = 0.03, some times over.
constexpr double rounding = 5e-12;

void check_heavy(NormalLaw law, const Scene& scene, const Who& who, const Constants& c) {
  const Sample<3> sample = touching(who, heavy);
  const double elastic = elastic_force(law, who, c), kn = tangent(law, who, c);
  const double spin = 1e-3, lever = radii[0] * (who.plane ? 1 - deflection / radii[0] : 1 - deflection / 0.9);
  const Vec<3> slip = spin * n.cross(t);
  // Springs: a quarter of the time in which the tangential one (dt counted from the first or second step: 400) or the
  // rolling ones yield; slipping and rolling at once. The first step may be counted by half or not.
  const auto quarter = [](double bound, double stiffness, double speed) { return bound / (stiffness * speed) / 4; };
  const double slide = quarter(c.friction * elastic, c.ratio * kn, spin * lever);
  Contact seen = after(scene, sample, slip, slide / 400, 400);
  EXPECT_NEAR(seen.normal, elastic - c.cohesion, rounding * elastic);
  EXPECT_NEAR(seen.tangential / (c.friction * elastic), 0.25, 0.26 / 400);
  const double roll = quarter(c.rolling * elastic, kn * c.rolling * c.rolling, spin);
  seen = after(scene, sample, slip, roll / 400, 400);
  EXPECT_NEAR(seen.rolling / (c.rolling * elastic), 0.25, 0.26 / 400);
  const double pivot = quarter(c.pivoting * elastic, kn * c.pivoting * c.pivoting, spin);
  seen = after(scene, sample, spin * n, pivot / 400, 400);
  EXPECT_NEAR(seen.pivoting / (c.pivoting * elastic), 0.25, 0.26 / 400);
  EXPECT_LT(seen.tangential, rounding * elastic);
  // Bounds: after twice the time that each takes.
  const double longest = 8 * std::max({slide, roll, pivot});
  seen = after(scene, sample, slip + spin * n, longest / 400, 400);
  EXPECT_NEAR(seen.tangential / (c.friction * elastic), 1, rounding);
  EXPECT_NEAR(seen.rolling / (c.rolling * elastic), 1, rounding);
  EXPECT_NEAR(seen.pivoting / (c.pivoting * elastic), 1, rounding);
}

/// zeta, from the damping force of grains that approach.
void check_damping(NormalLaw law, const Scene& scene, const Who& who, const Constants& c) {
  const double mass = who.plane ? 0.7 : reduced(0.7, 2.1);
  Sample<3> sample = touching(who, 0.7);
  set_relative_velocity<3>(sample, -0.5 * n);
  const Probe<3> seen = probe<3>(scene, sample, 1e-12);
  const double alpha = c.zeta * 2 * std::sqrt(mass * tangent(law, who, c));
  const double expected = elastic_force(law, who, c) - c.cohesion + alpha * 0.5;
  // 3 steps of 1e-12 change the velocity by 1e-12 times F / m (up to 10).
  EXPECT_NEAR(seen.normal_force, expected, 1e-10);
}

template <class Check>
void for_all_pairs(Check check) {
  for (NormalLaw law : both_laws)
    for (bool plane : {false, true})
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const Who who{i, j, plane};
          SCOPED_TRACE(to_string(law) + " " + materials[i].name + " " + materials[j].name +
                       (plane ? ", plane" : ", pair"));
          check(law, who);
        }
}

TEST(Materials, MixingRules) {
  for_all_pairs([](NormalLaw law, const Who& who) {
    const Constants c = mixed(law, who.first, who.second);
    check_heavy(law, table_scene(law), who, c);
    check_damping(law, table_scene(law), who, c);
  });
}

TEST(Materials, TotalConventionMixesAlike) {
  // One look at the other convention: the same constants.
  Scene scene = table_scene(NormalLaw::linear);
  scene.material.convention = DampingConvention::total;
  const Constants c = mixed(NormalLaw::linear, 1, 2);
  check_damping(NormalLaw::linear, scene, {1, 2, false}, c);
  check_damping(NormalLaw::linear, scene, {2, 1, true}, c);
}

/// A table in which [[material_pair]] says everything about b and c, and some of a with itself.
Scene overridden_scene(NormalLaw law) {
  Scene scene = table_scene(law);
  MaterialPair pair;
  pair.between = {"c", "b"};
  pair.friction = 0.77;
  pair.rolling_friction = 0.051;
  pair.pivoting_friction = 0.017;
  pair.cohesion_force = 0.005;
  if (law == NormalLaw::linear) pair.normal_stiffness = 2.2;
  scene.pairs.push_back(pair);
  MaterialPair self;
  self.between = {"a", "a"};
  self.friction = 0.11;
  scene.pairs.push_back(self);
  return scene;
}

TEST(Materials, PairsReplaceTheMixingRules) {
  for_all_pairs([](NormalLaw law, const Who& who) {
    Constants c = mixed(law, who.first, who.second);
    if (std::min(who.first, who.second) == 1 && std::max(who.first, who.second) == 2) {
      c.friction = 0.77, c.rolling = 0.051, c.pivoting = 0.017, c.cohesion = 0.005;
      // K_T / K_N stays what mixing makes of it.
      if (law == NormalLaw::linear) c.normal = 2.2;
    }
    if (who.first == 0 && who.second == 0) c.friction = 0.11;
    check_heavy(law, overridden_scene(law), who, c);
    check_damping(law, overridden_scene(law), who, c);
  });
}

/// Restitution of a head-on impact of materials i and j, without cohesion.
double impact_restitution(Scene scene, NormalLaw law, const Who& who, double duration) {
  scene.material.cohesion_force.reset();
  for (OtherMaterial& material : scene.other_materials) material.cohesion_force.reset();
  const Vec<3> away = who.plane ? Vec<3>(deflection * n) : Vec<3>(-deflection * n);
  Sample<3> sample = touching(who, 0.7);
  sample.position[who.plane ? 0 : 1] -= away;
  // 2e4 steps per contact: e within 1e-4, see restitution_law_test.cpp.
  const double speed = law == NormalLaw::linear ? 0.02 : 0.05;
  return head_on<3>(scene, sample, speed, duration / 2e4, 0.37, 50 * duration).restitution;
}

double contact_duration(NormalLaw law, const Who& who, const Constants& c) {
  const double mass = who.plane ? 0.7 : reduced(0.7, 2.1);
  if (law == NormalLaw::linear) return pi * std::sqrt(mass / c.normal);
  return hertz_impact(hertz_coefficient(c.normal, reduced_radius(who)), mass, 0.05).duration;
}

/// exp(-pi z / sqrt(1 - z^2)), z = zeta (linear) or sqrt(6/5) zeta (hertz); the `elastic` convention.
double restitution_of(NormalLaw law, double zeta) {
  const double z = law == NormalLaw::linear ? zeta : std::sqrt(1.2) * zeta;
  return std::exp(-pi * z / std::sqrt(1 - z * z));
}

TEST(Materials, RestitutionOfAPairIsExact) {
  for (NormalLaw law : both_laws)
    for (bool plane : {false, true})
      for (DampingConvention convention : both_conventions) {
        SCOPED_TRACE(to_string(law) + (plane ? ", plane, " : ", pair, ") + to_string(convention));
        Scene scene = table_scene(law);
        scene.material.convention = convention;
        MaterialPair pair;
        pair.between = {"b", "c"};
        pair.restitution = 0.33;
        scene.pairs.push_back(pair);
        const Who who{2, 1, plane};
        const double duration = contact_duration(law, who, mixed(law, 1, 2));
        EXPECT_NEAR(impact_restitution(scene, law, who, duration), 0.33, 1e-4);
      }
}

TEST(Materials, RestitutionOfMixedMaterials) {
  // Between a and b: zeta is the mean of theirs; so it is when materials say e instead of zeta.
  for (NormalLaw law : both_laws)
    for (bool by_restitution : {false, true}) {
      SCOPED_TRACE(to_string(law) + (by_restitution ? ", e" : ", zeta"));
      Scene scene = table_scene(law);
      if (by_restitution) {
        scene.material.damping_ratio.reset();
        scene.material.restitution = restitution_of(law, materials[0].zeta);
        for (int k = 1; k < 3; ++k) {
          scene.other_materials[k - 1].damping_ratio.reset();
          scene.other_materials[k - 1].restitution = restitution_of(law, materials[k].zeta);
        }
      }
      const Who who{0, 1, false};
      const Constants c = mixed(law, 0, 1);
      EXPECT_NEAR(impact_restitution(scene, law, who, contact_duration(law, who, c)), restitution_of(law, c.zeta),
                  1e-4);
    }
}

TEST(Materials, WhatAMaterialLeavesOutIsAsInTheFirst) {
  for (NormalLaw law : both_laws) {
    SCOPED_TRACE(to_string(law));
    Scene scene = table_scene(law);
    scene.other_materials = {other("copy"), other("smooth")};
    scene.other_materials[1].friction = 0.05;
    const Constants same = mixed(law, 0, 0);
    Constants smooth = same;
    smooth.friction = 0.05;
    for (bool plane : {false, true}) {
      check_heavy(law, scene, {1, 1, plane}, same);
      check_damping(law, scene, {0, 1, plane}, same);
      check_heavy(law, scene, {2, 2, plane}, smooth);
      check_heavy(law, scene, {1, 2, plane}, smooth);
      check_damping(law, scene, {2, 0, plane}, smooth);
    }
  }
}

TEST(Materials, APlaneWithoutMaterialIsOfTheFirst) {
  for (NormalLaw law : both_laws) {
    Sample<3> sample = touching({1, 0, true}, heavy);
    sample.plane_material.clear();
    const Constants c = mixed(law, 1, 0);
    const Contact seen = after(table_scene(law), sample, Vec<3>::Zero(), 1e-6, 3);
    const double elastic = elastic_force(law, {1, 0, true}, c);
    EXPECT_NEAR(seen.normal, elastic - c.cohesion, rounding * elastic);
  }
}

TEST(Materials, ThreeGrainsAndTwoPlanesAtOnce) {
  // Each contact of one sample has its own constants, wherever it stands in the list.
  for (NormalLaw law : both_laws) {
    SCOPED_TRACE(to_string(law));
    Sample<3> sample;
    sample.cell = cube<3>(20, false);
    sample.resize(3);
    const double h = deflection;
    const Vec<3> up = Vec<3>::UnitZ();
    for (int i = 0; i < 3; ++i) {
      sample.position[i] = Vec<3>(10, 10, 5) + (0.5 - h + i * (1 - h)) * up;
      sample.mass[i] = heavy;
    }
    sample.material = {2, 0, 1};
    sample.planes = {{Vec<3>(10, 10, 5), up, Vec<3>::Zero()},
                     {Vec<3>(10, 10, 5) + (3 - 4 * h) * up, -up, Vec<3>::Zero()}};
    sample.plane_material = {1, 0};
    Scene scene = table_scene(law);
    set_dt(scene, 1e-6);
    const auto engine = make_engine<3>(EngineKind::md, scene, sample);
    engine->advance(3);
    const Snapshot<3> state = engine->snapshot();
    ASSERT_EQ(state.contacts->size(), 4u);
    const auto material = [&](int body) { return body < 3 ? sample.material[body] : sample.plane_material[body - 3]; };
    for (std::size_t c = 0; c < 4; ++c) {
      const int i = state.contacts->i[c], j = state.contacts->j[c];
      SCOPED_TRACE(std::to_string(i) + " " + std::to_string(j));
      const Constants expected = mixed(law, material(i), material(j));
      const double radius = j < 3 ? 0.25 : 0.5;
      const double elastic = law == NormalLaw::linear ? expected.normal * h
                                                      : hertz_coefficient(expected.normal, radius) * std::pow(h, 1.5);
      EXPECT_NEAR(state.contacts->force[c].dot(state.contacts->normal[c]), elastic - expected.cohesion,
                  rounding * elastic);
    }
  }
}

}  // namespace
}  // namespace galet::test::materials_test
