// Where the interval of strains of type I ends, on the same packings in both engines: does the engine decide, or the
// packing?
//
//   same_packing [N] [SAMPLES] > table.csv        N = 300, SAMPLES = 3
//
// Spheres of state A (the study `triaxial`: Hertz, mu = 0.3, assembled without friction under P) are assembled by md
// (kappa = 39000) and by rigid cd. Each of these packings then comes to rest, without friction, in each of md, elastic
// cd (both at kappa = 39000) and rigid cd, which raises its axial stress slowly from P to 2.6 P. So the packings are
// the same up to deflections of d / kappa, which rigid grains undo.
// Columns: sample; engine that assembled; engine that loads; z*, Phi before; axial strain from q/P = 0.1 to 0.4; q/P
// at axial strains of 1e-3 (the structure has broken) and 1e-2; processor seconds.
// What it can't tell: the strength of large samples; 300 spheres scatter by a tenth from sample to sample.
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "src/simulation.hpp"
#include "src/studies/solid_templates.hpp"
#include "src/studies/triaxial_curve.hpp"

namespace galet {
namespace {

struct Loader {
  const char* name;
  EngineKind engine;
  bool compliance;
};
constexpr Loader soft{"md", EngineKind::md, false}, elastic{"cd_elastic", EngineKind::cd, true},
    rigid{"cd_rigid", EngineKind::cd, false};
/// Rigid packings come to rest so slowly that a larger energy leaves contacts out (z* = 5.86 at 1e-6, 5.97 at 1e-8).
constexpr double at_rest = 1e-8;
constexpr double most_deviator = 1.6, ramp_time = 320;

std::string packing_text(const Loader& loader, int count, int sample) {
  SolidScene scene;
  scene.title = fmt::format("same_packing: {}, sample {}", loader.name, sample);
  scene.engine = loader.engine, scene.compliance = loader.compliance;
  scene.grains = count, scene.seed = sample;
  scene.equilibrium = at_rest;
  scene.tolerance = 1e-6;  // rigid grains creep above that (docs/theory.md, "Rigid limit")
  scene.samples = 400;
  return assembly_scene(scene, 'A');
}

Sample<3> packing(const Loader& loader, int count, int sample) {
  Simulation<3> simulation(parse_scene(packing_text(loader, count, sample), "assembly"), loader.engine);
  if (simulation.run().ending != Ending::equilibrium) fmt::print(stderr, "{} has not come to rest\n", loader.name);
  return simulation.rest_sample();
}

void load(const Loader& maker, const Loader& loader, int count, int sample, const Sample<3>& start) {
  const Scene scene =
      parse_scene(packing_text(loader, count, sample) + ramp_stage(most_deviator, ramp_time), "raised deviator");
  Simulation<3> simulation(scene, loader.engine, start);
  StudyRow row;
  row.run = simulation.run();
  const TriaxialCurve curve = triaxial_curve(row);
  const Measurement& rest = row.run.stages.at(0).last;
  fmt::print("{},{},{},{:.3f},{:.4f},{:.3g},{:.3f},{:.3f},{:.0f}\n", sample, maker.name, loader.name,
             rest[Observable::z_star], rest[Observable::solid_fraction], type_I_strain(curve), deviator_at(curve, 1e-3),
             deviator_at(curve, 1e-2), row.run.cpu_seconds);
  std::fflush(stdout);
}

}  // namespace
}  // namespace galet

int main(int argc, char** argv) {
  using namespace galet;
  const int count = argc > 1 ? std::atoi(argv[1]) : 300, samples = argc > 2 ? std::atoi(argv[2]) : 3;
  fmt::print("sample,assembled_by,loaded_by,z_star,Phi,strain_type_I,qP_at_1e-3,qP_at_1e-2,seconds\n");
  for (int sample = 1; sample <= samples; ++sample)
    for (const Loader& maker : {soft, rigid}) {
      const Sample<3> start = packing(maker, count, sample);
      for (const Loader& loader : {soft, elastic, rigid}) load(maker, loader, count, sample, start);
    }
}
