// Two disks meet head on, in both engines; each must part with the restitution that the scene asks for.
#include <cmath>
#include <cstdio>

#include <galet/galet.hpp>

// Relative velocity after the collision over the one before.
double rebound(galet::Engine<2>& engine, double duration) {
  engine.advance(static_cast<long>(std::ceil(duration / engine.dt())));
  const auto velocity = engine.snapshot().velocity;
  return (velocity[1].x() - velocity[0].x()) / 2;
}

int main() {
  galet::Scene scene;
  scene.cell.periodic = {false, false};
  scene.cell.size = {6, 6};
  scene.material.restitution = 0.5;
  scene.material.normal_stiffness = 1e4;
  scene.initial.kind = galet::InitialKind::listed;
  scene.grains.listed = {{.position = {2.4, 3}, .velocity = {1, 0}, .spin = {}},
                         {.position = {3.6, 3}, .velocity = {-1, 0}, .spin = {}}};
  scene.run.duration = 0.5;
  for (const galet::Finding& finding : galet::check(scene))
    std::printf("%s: %s\n", finding.path.c_str(), finding.message.c_str());

  const auto sample = galet::initial_sample<2>(scene);
  const auto derived = galet::derive(scene, galet::grain_facts(scene, sample));
  const double soft = rebound(*galet::md::make_engine(scene, derived, sample), derived.duration);
  const double rigid = rebound(*galet::cd::make_engine(scene, derived, sample), derived.duration);
  std::printf("restitution 0.5: md %.4f, cd %.4f\n", soft, rigid);
  return std::abs(soft - 0.5) < 0.01 && std::abs(rigid - 0.5) < 0.01 ? 0 : 1;
}
