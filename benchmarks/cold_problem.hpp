// The contact problem of one step of a dense frictional packing at rest under pressure, every contact closed, from
// velocities and impulses that know nothing of it: the hard case of a rigid engine.
#pragma once

#include "benchmarks/dense_sample.hpp"
#include "cd/assembly.hpp"

namespace galet::bench {

/// The contact problem of the packing's next step under P = 1, and the free velocities it starts from.
template <Layout Y>
struct ColdProblem {
  static constexpr int D = Y.dim;
  static constexpr double dt = 0.01, friction = 0.4, margin = 1e-3;
  LawTable laws;
  Bodies<Y> bodies;
  VerletList<D> list;
  cd::Assembly<Y> assembly;
  cd::Problem<Y> problem;
  cd::Iterate<Y> start;

  explicit ColdProblem(int count) {
    const Sample<D> sample = dense_sample<D>(count, friction);
    const Scene scene = dense_scene(D, count, friction);
    const Derived derived = derive(scene, grain_facts<D>(scene, sample));
    laws = derived.laws;
    bodies.start(scene, derived, sample);
    list.configure(0, 0.1);
    list.build(bodies.position, bodies.radius, bodies.cell, bodies.planes);
    problem.laws = {{friction, 0, 0}};
    problem.grains = count;
    for (int i = 0; i < count; ++i) {
      problem.inverse_mass.push_back(1 / bodies.mass[i]);
      problem.inverse_inertia.push_back(1 / bodies.inertia[i]);
    }
    const CellMode<D>& mode = bodies.modes[0];
    problem.hub.push_back({mode.direction, 1 / mode.inertia});
    start.velocity.assign(count, Vec<D>::Zero());
    start.spin.assign(count, zero_spin<D>());
    // The load: the hub is pushed inwards as by the pressure over one step.
    start.hub_rate.push_back(-dt * bodies.cell.volume() * mode.load / mode.inertia);
    start.gradient = start.hub_rate[0] * mode.direction;
    assemble();
    start.reaction.assign(problem.size(), cd::Reaction<Y>::Zero());
  }

  /// Frames, choice of the pairs, colours and columns of the problem, as a step of cd makes them.
  void assemble() {
    assembly.measure(bodies, list);
    assembly.activate(list, start.velocity, dt, margin);
    assembly.fill(bodies, list, laws, {dt}, start, problem);
  }
};

}  // namespace galet::bench
