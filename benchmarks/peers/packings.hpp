// The packings on which codes are timed and schemes compared: dense, periodic, at rest, assembled with a little
// friction so that coordination is that of a frictional packing (about 5.4 in 3D, 3.6 in 2D) and no grain hangs in a
// symmetric place. Written once to a folder as LAMMPS data files, read from there afterwards.
#pragma once

#include <filesystem>

#include "benchmarks/dense_sample.hpp"
#include "benchmarks/peers/lammps_run.hpp"
#include "common/io/lammps.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/stress.hpp"

namespace galet::bench {

/// Material and grains of the timed runs; units: mean diameter, its mass and the pressure of assembly are 1.
/// Deflections are 1e-4 of a diameter. Spheres: equal, mu = 0.3; disks: diameters within 20 %, mu = 0.4.
inline Scene peer_scene(int dim, int count, bool hertz) {
  Scene scene = dense_scene(dim, count, dim == 2 ? 0.4 : 0.3);
  scene.material.restitution.reset();
  scene.material.damping_ratio = 0.212;  // restitution about 0.5
  scene.material.convention = DampingConvention::total;
  scene.material.stiffness_level = hertz ? 2e4 : 1e4;
  if (hertz) {
    scene.material.normal_law = NormalLaw::hertz;
    scene.material.poisson_ratio = 0.3;
    scene.material.tangential_stiffness_ratio.reset();
  }
  return scene;
}

/// `time`: in inertial times.
template <int D>
Sample<D> assembled(const Scene& scene, const Sample<D>& start, double time) {
  auto engine = md::make_engine<D>(scene, derive(scene, grain_facts<D>(scene, start)), start);
  engine->advance(static_cast<long>(time / engine->dt()));
  return at_rest<D>(*engine, start);
}

/// The packing of `peer_scene(D, count, hertz)` under pressure 1; 30 s at N = 4096 when it must be made.
template <int D>
Sample<D> peer_packing(int count, bool hertz, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto file =
      folder / ("packing_" + std::to_string(D) + "d_" + std::to_string(count) + (hertz ? "h" : "") + ".data");
  if (std::filesystem::exists(file)) return read_lammps_data<D>(file.string());
  Scene scene = peer_scene(D, count, hertz);
  const double stiffness_level = *scene.material.stiffness_level;
  scene.material.friction = D == 2 ? 0.15 : 0.1;
  scene.material.stiffness_level = 1e3;  // the gas collapses faster so
  const Sample<D> loose = assembled<D>(scene, initial_sample<D>(scene), 40);
  // A drag finishes what contacts hardly damp.
  scene.material.stiffness_level = stiffness_level;
  scene.md.drag = 1;
  const Sample<D> packing = assembled<D>(scene, loose, 25);
  write_lammps_data<D>(file.string(), packing);
  return packing;
}

/// Where an engine stands; no time.
template <int D>
EndState<D> end_of(Engine<D>& engine) {
  const Snapshot<D> state = engine.snapshot();
  EndState<D> end;
  end.position.assign(state.position.begin(), state.position.end());
  end.velocity.assign(state.velocity.begin(), state.velocity.end());
  end.stress = stress<D>(state).contact;
  end.z = coordination<D>(state, true).z;
  return end;
}

}  // namespace galet::bench
