#include "src/compare.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <future>
#include <map>
#include <mutex>

#include <fmt/format.h>

#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/io/svg.hpp"
#include "common/scene/packing.hpp"
#include "src/cost.hpp"
#include "src/dimension.hpp"
#include "src/engines.hpp"
#include "src/simulation.hpp"

namespace galet {

namespace {

constexpr int profile_layers = 20;

/// Start of the rows that share their engine parameters: the compressed gas, or why there is none.
template <int D>
struct Start {
  std::optional<Sample<D>> sample;
  RunResult failure;
  std::optional<std::string> note;
};

/// Compresses the gas once for each set of engine parameters; a second asker waits for the first.
template <int D>
class Starts {
 public:
  const Start<D>& get(const PlannedRow& row, const RunControl& control) {
    std::promise<Start<D>> promise;
    std::shared_future<Start<D>> future;
    bool mine = false;
    {
      const std::lock_guard lock(mutex_);
      auto& entry = futures_[key(row)];
      mine = !entry.valid();
      if (mine) entry = promise.get_future().share();
      future = entry;
    }
    if (mine) try {
        promise.set_value(make(row, control));
      } catch (...) {
        promise.set_exception(std::current_exception());
      }
    return future.get();
  }

 private:
  using Key = std::tuple<EngineKind, std::optional<double>, std::optional<double>, std::optional<double>>;
  static Key key(const PlannedRow& row) { return {row.engine, row.stiffness_level, row.dt_factor, row.tolerance}; }

  static Start<D> make(const PlannedRow& row, const RunControl& control) {
    Start<D> start;
    Simulation<D> simulation(row.scene, row.engine);
    if (simulation.prepare(control, start.failure)) start.sample = simulation.rest_sample();
    start.note = simulation.compression_note();
    return start;
  }

  std::mutex mutex_;
  std::map<Key, std::shared_future<Start<D>>> futures_;
};

double cost_guess(const PlannedRow& row, const GrainFacts& facts) {
  const Derived derived = derive(row.scene, facts);
  if (row.engine == EngineKind::md && !derived.md_dt) return 0;  // the engine itself says what is missing
  return estimate_cost(row.engine, row.scene, derived).seconds;
}

void fill(CompareRow& row, const RunResult& run) {
  row.ending = run.ending;
  row.failure = run.failure;
  row.notes = run.notes;
  row.dt = run.dt;
  row.steps = run.steps;
  row.time = run.time;
  row.strain = run.strain;
  row.mu_star = run.averages[Observable::mu_star];
  row.solid_fraction = run.averages[Observable::solid_fraction];
  row.z = run.averages[Observable::z];
  row.inertial_number = run.averages[Observable::inertial_number].value;
  row.stiffness_level = run.averages[Observable::stiffness_level].value;
  const bool sheared = run.strain != 0;
  row.pressure = run.averages[sheared ? Observable::sigma_yy : Observable::pressure].value;
  row.peak_penetration = run.averages[Observable::peak_overlap].value;
  row.mean_penetration = run.averages[Observable::largest_overlap].value;
  row.seconds = run.cpu_seconds;
  row.cost = run.cpu_seconds / std::abs(sheared ? run.strain : run.time);
  row.solver = run.solver;
  row.series = run.series;
}

template <int D>
void draw(CompareRow& row, Simulation<D>& simulation) {
  const Snapshot<D> snapshot = simulation.engine().snapshot();
  row.profile = layer_profile(snapshot, profile_layers);
  if constexpr (D == 2) {
    SvgOptions options;
    options.title = simulation.scene().title;
    row.picture = force_chain_svg(snapshot, options);
  }
}

/// The simulation of one row; `starts` are shared by all.
template <int D>
void run_row(CompareRow& row, Starts<D>& starts, const WorkControl& work) {
  RunControl control;
  control.keep_last_good = false;
  control.stop = work.stop;
  if (control.stop()) {
    row.ending = Ending::interrupted;
    return;
  }
  const bool compressed = row.plan.scene.initial.kind == InitialKind::compressed_gas;
  const Start<D>* start = compressed ? &starts.get(row.plan, control) : nullptr;
  if (start && !start->sample) {
    row.ending = start->failure.ending;
    row.failure = start->failure.failure;
    return;
  }
  Simulation<D> simulation(row.plan.scene, row.plan.engine, start ? *start->sample : initial_sample<D>(row.plan.scene));
  control.progress = [&](const Progress& at) {
    work.progress(static_cast<double>(at.step) / static_cast<double>(at.steps));
  };
  fill(row, simulation.run(control));
  if (start && start->note) row.notes.push_back(*start->note);
  if (row.plan.reference && row.usable()) draw(row, simulation);
}

RigidLimit limit_of(const std::vector<const CompareRow*>& rows, Estimate CompareRow::*quantity, double power) {
  std::vector<MdRun> md;
  std::vector<CdRun> cd;
  for (const CompareRow* row : rows) {
    const Estimate& value = row->*quantity;
    if (row->plan.engine == EngineKind::md)
      // The level that the scene asks for or, where it gives K_N itself, the one that was realised.
      md.push_back({row->plan.stiffness_level.value_or(row->stiffness_level), value});
    else
      cd.push_back({row->dt, row->plan.tolerance.value_or(0), value});
  }
  return rigid_limit(md, cd, power);
}

}  // namespace

std::vector<StateLimit> state_limits(const std::vector<CompareRow>& rows) {
  std::vector<std::optional<double>> states;
  for (const CompareRow& row : rows)
    if (std::find(states.begin(), states.end(), row.plan.inertial_number) == states.end())
      states.push_back(row.plan.inertial_number);
  std::vector<StateLimit> limits;
  for (const auto& state : states) {
    std::vector<const CompareRow*> members;
    for (const CompareRow& row : rows)
      if (row.plan.inertial_number == state && row.usable()) members.push_back(&row);
    if (members.empty()) continue;
    // Powers of 1/kappa in which the md limit is taken: see rigid_limit.hpp.
    limits.push_back({state, limit_of(members, &CompareRow::mu_star, 1),
                      limit_of(members, &CompareRow::solid_fraction, 1), limit_of(members, &CompareRow::z, 0.5)});
  }
  return limits;
}

Comparison compare(const Scene& scene, const SideBySideOptions& options) {
  Comparison comparison;
  const double start = wall_seconds();
  for (PlannedRow& plan : compare_plan(scene)) comparison.rows.emplace_back().plan = std::move(plan);
  with_dimension(scene.dimension, [&](auto dimension) {
    constexpr int D = dimension;
    const GrainFacts facts = grain_facts(scene, initial_sample<D>(scene));
    std::vector<double> costs;
    for (const CompareRow& row : comparison.rows) costs.push_back(cost_guess(row.plan, facts));
    Starts<D> starts;
    run_side_by_side(options, costs,
                     [&](std::size_t row, const WorkControl& work) { run_row<D>(comparison.rows[row], starts, work); });
  });

  const auto any_md = [](const CompareRow& row) { return row.plan.engine == EngineKind::md; };
  if (std::none_of(comparison.rows.begin(), comparison.rows.end(), any_md))
    comparison.notes.push_back("no md rows: the scene says nothing about stiffness (material.stiffness_level)");
  const auto stopped = [](const CompareRow& row) { return row.ending == Ending::interrupted; };
  comparison.interrupted = std::erase_if(comparison.rows, stopped) > 0;
  comparison.limits = state_limits(comparison.rows);
  comparison.shear = std::any_of(comparison.rows.begin(), comparison.rows.end(),
                                 [](const CompareRow& row) { return row.strain != 0; });
  comparison.jobs = options.jobs;
  comparison.wall_seconds = wall_seconds() - start;
  return comparison;
}

}  // namespace galet
