// Sweeps and time that Gauss-Seidel needs from a cold start, plain and with momentum, on one step of a dense
// frictional packing at rest under pressure (every contact closed): the hard case of a rigid engine.
// Prints one CSV row per (dimension, grains, solver, tolerance). Processor time; ratios within one run count.
#include <ctime>

#include <fmt/format.h>

#include "benchmarks/dense_sample.hpp"
#include "cd/assembly.hpp"
#include "cd/solvers/nsgs.hpp"

namespace galet {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The contact problem of the packing's next step under P = 1, and the free velocities it starts from.
template <Layout Y>
struct ColdProblem {
  static constexpr int D = Y.dim;
  cd::Problem<Y> problem;
  cd::Iterate<Y> start;

  explicit ColdProblem(int count) {
    constexpr double dt = 0.01, friction = 0.4;
    const Sample<D> sample = bench::dense_sample<D>(count, friction);
    const Scene scene = bench::dense_scene(D, count, friction);
    const Derived derived = derive(scene, grain_facts<D>(scene, sample));
    Bodies<Y> bodies;
    bodies.start(scene, derived, sample);
    VerletList<D> list;
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
    cd::Assembly<Y> assembly;
    assembly.measure(bodies, list);
    assembly.activate(list, start.velocity, dt, 1e-3);
    assembly.fill(bodies, list, derived.laws, {dt}, start, problem);
    start.reaction.assign(problem.size(), cd::Reaction<Y>::Zero());
  }
};

template <Layout Y>
void measure(int count) {
  const ColdProblem<Y> cold(count);
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    for (const double momentum : {0.0, 0.9}) {
      cd::Iterate<Y> iterate = cold.start;
      cd::Nsgs<Y> solver;
      const double before = cpu_seconds();
      const cd::SolveReport report = solver.solve(cold.problem, {tolerance, 20000, momentum}, iterate);
      const double seconds = cpu_seconds() - before;
      fmt::print("{},{},{},{},{},{},{:.3g},{:.4f},{:.1f}\n", Y.dim, count, cold.problem.size(),
                 momentum > 0 ? "momentum" : "plain", tolerance, report.sweeps, report.residual, seconds,
                 1e9 * seconds / (static_cast<double>(report.sweeps) * static_cast<double>(cold.problem.size())));
    }
  }
}

}  // namespace
}  // namespace galet

int main() {
  fmt::print("dimension,grains,contacts,solver,tolerance,sweeps,residual,seconds,ns_per_contact_and_sweep\n");
  galet::measure<galet::Layout{2, true}>(500);
  galet::measure<galet::Layout{2, true}>(2000);
  galet::measure<galet::Layout{3, true}>(500);
  galet::measure<galet::Layout{3, true}>(2000);
}
