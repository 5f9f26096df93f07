// Contact laws with many terms at once, for tests of what must hold whatever the law.
#pragma once

#include <string>
#include <vector>

#include "tests/support/scenes.hpp"

namespace galet::test {

/// A change of a scene's laws (of stiffness about 1e3), and of the materials of its grains.
struct RichLaw {
  std::string name;
  void (*change)(Scene&);
};

/// Between them every term of md, in layouts with rolling and without.
inline const std::vector<RichLaw>& rich_laws() {
  static const std::vector<RichLaw> laws = {
      {"Hertz, rolling, pivoting, cohesion with range, energy account",
       [](Scene& scene) {
         scene.material.normal_law = NormalLaw::hertz;
         scene.material.normal_stiffness.reset();
         scene.material.young_modulus = 2e4;
         scene.material.poisson_ratio = 0.2;
         scene.material.rolling_friction = 0.02;
         if (scene.dimension == 3) scene.material.pivoting_friction = 0.01;
         scene.material.cohesion_force = 0.2;
         scene.material.cohesion_range = 0.03;
         scene.md.energy_budget = true;
       }},
      {"total, tangential viscosity, square-root cohesion, two materials",
       [](Scene& scene) {
         scene.material.convention = DampingConvention::total;
         scene.material.tangential_damping_ratio = 0.2;
         scene.material.cohesion_law = CohesionLaw::square_root;
         scene.material.cohesion_force = 0.1;
         scene.other_materials.push_back({.name = "other", .friction = 0.2, .restitution = 0.7});
         scene.pairs.push_back({.between = {"other", "default"}, .friction = 0.6});
       }},
  };
  return laws;
}

/// Grains of the scene's materials by turns.
template <int D>
void mix_materials(const Scene& scene, Sample<D>& sample) {
  const int materials = static_cast<int>(scene.other_materials.size()) + 1;
  for (int i = 0; i < sample.count(); ++i) sample.material[i] = i % materials;
}

}  // namespace galet::test
