// The interface of both engines. One virtual call per advance, none per grain or contact.
#pragma once

#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/layout.hpp"
#include "common/core/memory_use.hpp"
#include "common/core/profile.hpp"
#include "common/engine/snapshot.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Mechanical energy by form. Elastic and cohesive parts are zero in the rigid engine.
struct EnergyParts {
  double kinetic = 0;     ///< sum of m v^2 / 2, fluctuations
  double rotational = 0;  ///< sum of I w^2 / 2
  double cell = 0;        ///< sum of inertia * rate^2 / 2 over the stress-driven modes
  double elastic_normal = 0;
  double elastic_tangential = 0;
  double elastic_rolling = 0;  ///< rolling and pivoting springs
  double cohesive = 0;         ///< of attractive forces, zero for grains out of their range
  double gravity = 0;          ///< - sum of m gravity.x, along directions that are not periodic
  double total() const {
    return kinetic + rotational + cell + elastic_normal + elastic_tangential + elastic_rolling + cohesive + gravity;
  }
};

/// Energy that has entered and left the sample since the start: total() of EnergyParts changes by work - dissipated().
/// Accounted for only where the scene asks for it (md.energy_budget); zero otherwise.
struct EnergyFlows {
  double work = 0;        ///< done on the sample by drives of the cell and by moving planes
  double viscous = 0;     ///< dissipated by normal and tangential dashpots
  double sliding = 0;     ///< dissipated by Coulomb sliding
  double unloading = 0;   ///< tangential elastic energy given up while F_N changes (Mindlin's law)
  double rolling = 0;     ///< dissipated by plastic rolling
  double pivoting = 0;    ///< dissipated by plastic pivoting
  double relaxation = 0;  ///< dissipated by drag and acceleration damping
  double dissipated() const { return viscous + sliding + unloading + rolling + pivoting + relaxation; }
};

/// How the contact problems of a cd run went (all zero in md).
struct SolverSummary {
  long steps = 0;
  long sweeps = 0;
  long missed = 0;  ///< steps that ended above the tolerance
  double worst_residual = 0;
  double residual_sum = 0;  ///< sum over the steps of the residual reached
  long corrections = 0;     ///< steps whose positions were corrected for drift
  long divided = 0;         ///< steps taken in parts because grains moved too far in one
  double penetration = 0;   ///< largest overlap that a step left behind, in units of d (rigid contacts)
  double dissipated = 0;    ///< energy that contacts have taken from the grains' motion (impacts, friction, rolling)
  double gained = 0;        ///< energy that steps have put into it: an artefact of unlike restitutions in one scene
};

template <int D>
class Engine {
 public:
  virtual ~Engine() = default;

  virtual std::string_view name() const = 0;
  virtual Layout layout() const = 0;
  virtual double dt() const = 0;
  virtual double time() const = 0;
  virtual long steps() const = 0;

  /// Takes `count` steps. Throws RunError, naming the grain or contact, when the state is no longer sound.
  virtual void advance(long count) = 0;

  /// Goes on under another loading: the cell's drives, gravity, friction coefficients and restitutions of `scene`, the
  /// same scene in all else. Grains, contacts and what they remember stay; components driven in stress keep their rate.
  virtual void change(const Scene& scene, const Derived& derived) = 0;

  /// State at the end of the last step. Before the first step the contact columns are empty.
  virtual Snapshot<D> snapshot() = 0;
  virtual EnergyParts energy() const = 0;
  virtual EnergyFlows energy_flows() const { return {}; }
  virtual SolverSummary solver_summary() const { return {}; }
  virtual const Profile& profile() const = 0;
  /// What its arrays hold now. Accounted for in md only; zero in cd.
  virtual MemoryUse memory() const { return {}; }

  /// Everything that influences the future, bit for bit; restore() is its inverse for an engine of the same scene.
  virtual void save(Archive& archive) const = 0;
  virtual void restore(const Archive& archive) = 0;
};

}  // namespace galet
