// What the cases of `galet verify` share: small scenes, and an engine that runs one of them. Reduced units: a grain has
// diameter and mass 1, gravity is 1 where there is any.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/engine/engine.hpp"
#include "common/scene/check.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "src/engines.hpp"
#include "src/verify/case.hpp"

namespace galet::verify {

inline constexpr double pi = std::numbers::pi;

/// Grains listed one by one in a cell that is no boundary, without loading. `restitution`: of all contacts.
inline Scene free_scene(int dim, double friction, double restitution, double stiffness) {
  Scene scene;
  scene.dimension = dim;
  scene.initial.kind = InitialKind::listed;
  scene.cell.periodic.assign(dim, false);
  scene.material.friction = friction;
  scene.material.restitution = restitution;
  scene.material.normal_stiffness = stiffness;
  scene.run.duration = 1;
  return scene;
}

/// `count` grains in a cell that is periodic in each direction, without loading.
inline Scene periodic_scene(int dim, int count, double friction, double restitution, double stiffness) {
  Scene scene = free_scene(dim, friction, restitution, stiffness);
  scene.initial.kind = InitialKind::gas;
  scene.cell.periodic.assign(dim, true);
  scene.grains.count = count;
  return scene;
}

inline void add_grain(Scene& scene, std::vector<double> position, std::vector<double> velocity = {},
                      double diameter = 1, const std::string& material = "") {
  ListedGrain grain;
  grain.position = std::move(position), grain.velocity = std::move(velocity);
  grain.diameter = diameter, grain.material = material;
  scene.grains.listed.push_back(std::move(grain));
  scene.grains.count = static_cast<int>(scene.grains.listed.size());
}

inline void add_plane(Scene& scene, std::vector<double> point, std::vector<double> normal,
                      const std::string& material = "") {
  scene.planes.push_back({.point = std::move(point), .normal = std::move(normal), .material = material});
}

/// A plane y = 0 (2D) or z = 0 (3D) below, and gravity along -y or -z.
inline void add_floor(Scene& scene, double gravity = 1, const std::string& material = "") {
  const int dim = scene.dimension;
  std::vector<double> up(dim, 0.0), down(dim, 0.0);
  up.back() = 1, down.back() = -gravity;
  add_plane(scene, std::vector<double>(dim, 0.0), up, material);
  scene.loading.gravity = down;
}

/// The scene for that engine, checked by the rules that a user's scene is checked by.
inline Scene checked(EngineKind kind, Scene scene) {
  scene.engine = kind;
  std::vector<Mistake> mistakes;
  for (const Finding& finding : check(scene)) mistakes.push_back({"", 0, 0, finding.message});
  if (!mistakes.empty()) throw InputError(mistakes);
  return scene;
}

/// An engine on a scene; its steps count for the report.
template <int D>
class Trial {
 public:
  Trial(Report& report, EngineKind kind, const Scene& scene)
      : Trial(report, kind, scene, initial_sample<D>(checked(kind, scene))) {}
  /// Starts from `start`, whatever the scene says about its grains.
  Trial(Report& report, EngineKind kind, const Scene& scene, const Sample<D>& start)
      : report_(report), kind_(kind), scene_(checked(kind, scene)), start_(start) {
    scene_.grains.count = start_.count();
    engine_ = make_engine<D>(kind, scene_, derived(scene_), start_);
  }
  ~Trial() { report_.add_steps(engine_->steps()); }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  Engine<D>& engine() { return *engine_; }
  const Sample<D>& start() const { return start_; }
  Snapshot<D> state() { return engine_->snapshot(); }
  Vec<D> position(int grain) { return engine_->snapshot().position[grain]; }
  Vec<D> velocity(int grain) { return engine_->snapshot().velocity[grain]; }
  double dt() const { return engine_->dt(); }
  double time() const { return engine_->time(); }
  void advance(long steps) { engine_->advance(steps); }
  /// To the whole step that is nearest to `time`.
  void run_to(double time) {
    const long steps = std::lround(time / dt()) - engine_->steps();
    if (steps > 0) advance(steps);
  }
  /// Goes on under the loading and friction of `scene`.
  void change(const Scene& scene) {
    scene_ = checked(kind_, scene);
    scene_.grains.count = start_.count();
    engine_->change(scene_, derived(scene_));
  }
  /// Largest speed of a grain.
  double fastest() {
    double largest = 0;
    for (const Vec<D>& v : state().velocity) largest = std::max(largest, v.norm());
    return largest;
  }

 private:
  Derived derived(const Scene& scene) const { return derive(scene, grain_facts<D>(scene, start_)); }

  Report& report_;
  EngineKind kind_;
  Scene scene_;
  Sample<D> start_;
  std::unique_ptr<Engine<D>> engine_;
};

template <int D>
double kinetic_energy(Trial<D>& trial) {
  const EnergyParts energy = trial.engine().energy();
  return energy.kinetic + energy.rotational;
}

/// Of translations.
template <int D>
double kinetic_energy_of(const Snapshot<D>& state) {
  double sum = 0;
  for (int i = 0; i < state.grains(); ++i) sum += 0.5 * state.mass[i] * state.velocity[i].squaredNorm();
  return sum;
}

template <int D>
Vec<D> momentum(const Snapshot<D>& state) {
  Vec<D> sum = Vec<D>::Zero();
  for (int i = 0; i < state.grains(); ++i) sum += state.mass[i] * state.velocity[i];
  return sum;
}

}  // namespace galet::verify
