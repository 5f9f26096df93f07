// Contact laws of cd with many terms at once, for tests of what must hold whatever the law.
#pragma once

#include "tests/support/laws.hpp"

namespace galet::test {

/// Between them every term of cd, in layouts with rolling and without.
inline const std::vector<RichLaw>& rich_rigid_laws() {
  static const std::vector<RichLaw> laws = {
      {"rolling, pivoting, cohesion with range",
       [](Scene& scene) {
         scene.material.rolling_friction = 0.02;
         if (scene.dimension == 3) scene.material.pivoting_friction = 0.01;
         scene.material.cohesion_force = 0.2;
         scene.material.cohesion_range = 0.03;
       }},
      {"two materials, tangential restitution, cohesion without range, theta",
       [](Scene& scene) {
         scene.material.tangential_restitution = 0.3;
         scene.material.cohesion_force = 0.1;
         scene.other_materials.push_back({.name = "other", .friction = 0.2, .restitution = 0.7});
         scene.pairs.push_back({.between = {"other", "default"}, .friction = 0.6, .tangential_restitution = 0.1});
         scene.cd.theta = 0.75;
       }},
      {"Hertz compliance with rolling and pivoting",
       [](Scene& scene) {
         scene.material.normal_law = NormalLaw::hertz;
         scene.material.normal_stiffness.reset();
         scene.material.young_modulus = 2e4;
         scene.material.poisson_ratio = 0.2;
         scene.material.convention = DampingConvention::total;
         scene.material.rolling_friction = 0.02;
         if (scene.dimension == 3) scene.material.pivoting_friction = 0.01;
         scene.cd.compliance = true;
       }},
      {"linear compliance, cohesion",
       [](Scene& scene) {
         scene.material.convention = DampingConvention::total;
         scene.material.cohesion_force = 0.2;
         scene.cd.compliance = true;
       }},
  };
  return laws;
}

}  // namespace galet::test
