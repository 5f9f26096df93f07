#include "src/simulation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/scene/packing.hpp"
#include "src/engines.hpp"
#include "src/restart.hpp"

namespace galet {

namespace {

void save_report(Archive& archive, const std::optional<CompressionReport>& report) {
  if (!report) return;
  archive.reals["run.compression"] = {report->time, report->kinetic_per_grain, report->pressure, report->solid_fraction,
                                      report->z,    report->cpu_seconds};
  archive.integers["run.compression"] = {report->steps, report->equilibrium ? 1 : 0};
}

std::optional<CompressionReport> stored_report(const Archive& archive) {
  if (!archive.reals.contains("run.compression")) return std::nullopt;
  const auto& reals = real_column(archive, "run.compression");
  const auto& integers = integer_column(archive, "run.compression");
  return CompressionReport{reals.at(0), integers.at(0), reals.at(1),         reals.at(2),
                           reals.at(3), reals.at(4),    integers.at(1) != 0, reals.at(5)};
}

/// Steps in which forces change: a rigid grain's impulses are new in each step; a soft contact lasts tau_c.
long sample_interval(EngineKind kind, const Derived& derived, double dt) {
  if (kind == EngineKind::cd || !derived.collision_time) return 1;
  return std::max(1L, std::lround(0.5 * *derived.collision_time / dt));
}

}  // namespace

// ---- Construction ----

template <int D>
Simulation<D>::Simulation(const Scene& scene, EngineKind kind, std::vector<Override> overrides)
    : scene_(scene), kind_(kind), overrides_(std::move(overrides)) {
  const Sample<D> sample = initial_sample<D>(scene_);
  derived_ = derive(scene_, grain_facts(scene_, sample));
  if (scene_.initial.kind == InitialKind::compressed_gas)
    compression_ = std::make_unique<Simulation>(compression_scene(scene_, derived_), kind_, sample);
  else
    start_run(sample);
}

template <int D>
Simulation<D>::Simulation(const Scene& scene, EngineKind kind, const Sample<D>& start) : scene_(scene), kind_(kind) {
  start_run(start);
}

template <int D>
Simulation<D>::Simulation(const Scene& scene, EngineKind kind, std::vector<Override> overrides, const Archive& archive)
    : scene_(scene), kind_(kind), overrides_(std::move(overrides)) {
  const Sample<D> sample = stored_sample<D>(archive);
  derived_ = derive(scene_, grain_facts(scene_, sample));
  const bool compressing = archive.integers.contains("run.compressing");
  if (compressing && scene_.initial.kind == InitialKind::compressed_gas) {
    compression_.reset(new Simulation(compression_scene(scene_, derived_), kind_, {}, archive));
  } else {
    start_run(sample);
    restore(archive);
  }
}

template <int D>
Simulation<D> Simulation<D>::resume(const Scene& scene, const Archive& archive, const std::vector<Override>& more) {
  std::vector<Override> overrides = stored_overrides(archive);
  overrides.insert(overrides.end(), more.begin(), more.end());
  return Simulation(scene, stored_engine(archive), std::move(overrides), archive);
}

template <int D>
void Simulation<D>::start_run(const Sample<D>& start) {
  start_ = start;
  derived_ = derive(scene_, grain_facts(scene_, start_));
  engine_ = make_engine<D>(kind_, scene_, derived_, start_);
  if (scene_.run.equilibrium) equilibrium_.emplace(scene_, derived_, start_, *scene_.run.equilibrium);
  scale_ = measure_scale(derived_, kind_ == EngineKind::cd);
  scale_.energy_at_start = engine_->energy().total();
  scale_.asked = MeasureSet(scene_.output.measures);
  for (std::size_t a = 0; a < scene_.loading.gravity.size(); ++a) scale_.gravity[a] = scene_.loading.gravity[a];
  for (const int wall : start_.wall) scale_.held.push_back(wall >= 0 ? 1 : 0);
  guard_.emplace(scene_, derived_, start_, kind_);
  total_steps_ = steps_for(derived_.duration, engine_->dt());
  schedule_ = make_schedule(total_steps_, scene_.run.samples, sample_interval(kind_, derived_, engine_->dt()));
  if (scene_.output.frames > 0)
    schedule_.steps_per_frame = static_cast<double>(total_steps_) / std::min<long>(scene_.output.frames, total_steps_);
  series_.dimension = D;
  series_.asked = scale_.asked;
  series_.budget = kind_ == EngineKind::md && scene_.md.energy_budget;
}

// ---- Checkpoints ----

template <int D>
Archive Simulation<D>::checkpoint() const {
  if (compression_) {
    Archive archive = compression_->checkpoint();
    archive.integers["run.compressing"] = {1};
    save_scene(archive, scene_, kind_, overrides_);
    return archive;
  }
  Archive archive;
  engine_->save(archive);
  save_scene(archive, scene_, kind_, overrides_);
  save_sample(archive, start_);
  save_report(archive, compression_report_);
  schedule_.save(archive);
  series_.save(archive);
  row_.save(archive);
  profile_.save(archive);
  archive.reals["run.last"].assign(last_.values.begin(), last_.values.end());
  archive.integers["run.settled"] = {settled_};
  archive.reals["run.seconds"] = {cpu_seconds_, wall_seconds_};
  return archive;
}

template <int D>
void Simulation<D>::restore(const Archive& archive) {
  engine_->restore(archive);
  if (engine_->steps() > total_steps_)
    throw InputError(fmt::format("the checkpoint is at time {:g}, beyond the end of the run at {:g}: lengthen run.{}",
                                 engine_->time(), derived_.duration, scene_.run.strain ? "strain" : "duration"));
  compression_report_ = stored_report(archive);
  schedule_.restore(archive);
  samples_ = schedule_.samples_until(engine_->steps());
  series_.restore(archive);
  row_.restore(archive);
  profile_.restore(archive);
  const auto& last = real_column(archive, "run.last");
  std::copy_n(last.begin(), std::min<std::size_t>(last.size(), observable_count), last_.values.begin());
  settled_ = integer_column(archive, "run.settled").at(0);
  const auto& seconds = real_column(archive, "run.seconds");
  cpu_seconds_ = seconds.at(0), wall_seconds_ = seconds.at(1);
}

// ---- The stage before ----

template <int D>
Sample<D> Simulation<D>::present_sample() {
  const Snapshot<D> snapshot = engine().snapshot();
  Sample<D> sample;
  sample.resize(snapshot.grains());
  sample.cell = *snapshot.cell;
  sample.planes.assign(snapshot.planes.begin(), snapshot.planes.end());
  sample.position.assign(snapshot.position.begin(), snapshot.position.end());
  sample.velocity.assign(snapshot.velocity.begin(), snapshot.velocity.end());
  if (!snapshot.spin.empty()) sample.spin.assign(snapshot.spin.begin(), snapshot.spin.end());
  sample.radius.assign(snapshot.radius.begin(), snapshot.radius.end());
  sample.mass.assign(snapshot.mass.begin(), snapshot.mass.end());
  const Sample<D>& start = compression_ ? compression_->start_ : start_;
  sample.material = start.material;
  sample.plane_material = start.plane_material;
  return sample;
}

template <int D>
Sample<D> Simulation<D>::rest_sample() {
  Sample<D> sample = present_sample();
  sample.cell.rate.setZero();
  std::fill(sample.velocity.begin(), sample.velocity.end(), Vec<D>::Zero());
  std::fill(sample.spin.begin(), sample.spin.end(), zero_spin<D>());
  return sample;
}

template <int D>
bool Simulation<D>::prepare(const RunControl& control, RunResult& result) {
  if (!compression_) return true;
  RunControl stage = control;
  stage.stage = "compression";
  stage.most_steps = std::numeric_limits<long>::max();
  if (control.checkpoint) stage.checkpoint = [&](const Archive&) { control.checkpoint(checkpoint()); };
  return settle(compression_->run(stage), result);
}

/// Takes the compressed gas over, if it is one, as the start of the run proper.
template <int D>
bool Simulation<D>::settle(const RunResult& gas, RunResult& result) {
  const double pressure = *derived_.pressure;
  result = gas;
  result.notes = {"this was the compression of the gas, before the run proper"};
  if (gas.ending == Ending::interrupted) return false;
  if (gas.ending == Ending::failed) {
    result.failure = "while the gas was compressed: " + gas.failure;
    return false;
  }
  if (std::abs(gas.last[Observable::pressure] - pressure) > compression_stress_limit * pressure) {
    result.ending = Ending::failed;
    result.failure = fmt::format("the gas was compressed for {:g}, and its mean stress is {:.3g} instead of {:.3g}",
                                 gas.time, gas.last[Observable::pressure], pressure);
    return false;
  }
  compression_report_ = CompressionReport{gas.time,
                                          gas.steps,
                                          gas.last[Observable::kinetic_per_grain],
                                          gas.last[Observable::pressure],
                                          gas.last[Observable::solid_fraction],
                                          gas.last[Observable::z],
                                          gas.ending == Ending::equilibrium,
                                          gas.cpu_seconds};
  start_run(compression_->rest_sample());
  compression_.reset();
  return true;
}

// ---- The run ----

template <int D>
RunResult Simulation<D>::run(const RunControl& control) {
  RunResult result;
  if (!prepare(control, result)) return result;
  Pace pace(control, engine_->steps(), total_steps_);
  try {
    if (pace.copy_due()) keep_last_good();
    result.ending = loop(control, pace);
  } catch (const RunError& error) {
    result.ending = Ending::failed;
    result.failure = error.what();
    result.last_good = std::move(last_good_);
  }
  report(result);
  return result;
}

template <int D>
Ending Simulation<D>::loop(const RunControl& control, Pace& pace) {
  const long allowed = std::min(total_steps_ - engine_->steps(), control.most_steps);
  const long last = engine_->steps() + std::max(0L, allowed), every = scene_.guard.every;
  const bool frames = control.frame && schedule_.steps_per_frame > 0;
  if (frames && engine_->steps() == 0) write_frame(control);
  while (engine_->steps() < last) {
    const long step = engine_->steps(), sample_step = schedule_.step_of(samples_ + 1);
    const long frame_step = frames ? schedule_.step_of_frame(schedule_.frame_after(step)) : last;
    const long guard_step = (step / every + 1) * every;
    take_steps(std::min({sample_step, frame_step, guard_step, last, step + pace.bite()}) - step);
    pace.reached(engine_->steps());
    const bool saves = pace.checkpoint_due();
    if (engine_->steps() == guard_step || engine_->steps() == last || saves) guard_->check(engine_->snapshot());
    if (engine_->steps() == sample_step && take_sample(pace)) return Ending::equilibrium;
    if (frames && engine_->steps() == frame_step) write_frame(control);
    if (saves) control.checkpoint(checkpoint());
    if (control.stop && engine_->steps() < total_steps_ && control.stop()) return Ending::interrupted;
  }
  return engine_->steps() < total_steps_ ? Ending::interrupted : Ending::finished;
}

/// Keeps the present state, if it is sound.
template <int D>
void Simulation<D>::keep_last_good() {
  guard_->check(engine_->snapshot());
  last_good_ = checkpoint();
}

template <int D>
void Simulation<D>::write_frame(const RunControl& control) {
  Frame frame{engine_->steps(), {}};
  for (long k = 0; schedule_.step_of_frame(k) <= engine_->steps(); ++k)
    frame.times.push_back(static_cast<double>(schedule_.step_of_frame(k)) * engine_->dt());
  control.frame(frame);
}

template <int D>
void Simulation<D>::take_steps(long count) {
  const double wall = wall_seconds(), cpu = thread_seconds();
  engine_->advance(count);
  wall_seconds_ += wall_seconds() - wall;
  cpu_seconds_ += thread_seconds() - cpu;
}

/// True when the samples have shown, for one inertial time, the equilibrium that the scene asks for.
template <int D>
bool Simulation<D>::take_sample(Pace& pace) {
  last_ = measure(*engine_, scale_);
  ++samples_;
  row_.add(last_);
  if (row_.samples() == schedule_.samples_per_row) {
    series_.rows.push_back(row_.finish(scale_));
    if (scale_.asked.has(MeasureKind::profile) &&
        static_cast<double>(engine_->steps()) > scene_.run.average_from * static_cast<double>(total_steps_))
      profile_.add(layer_profile(engine_->snapshot(), scene_.output.profile_layers,
                                 static_cast<int>(scene_.output.profile_direction)));
    if (pace.copy_due()) keep_last_good();
  }
  if (!equilibrium_) return false;
  settled_ = equilibrium_->reached(last_, engine_->snapshot()) ? settled_ + 1 : 0;
  const double interval = schedule_.steps_per_sample * engine_->dt();
  return static_cast<double>(settled_) * interval >= *derived_.inertial_time;
}

// ---- What is handed back ----

template <int D>
void Simulation<D>::report(RunResult& result) const {
  result.engine = kind_;
  result.layout = engine_->layout();
  result.dt = engine_->dt();
  result.time = engine_->time();
  result.strain = scale_.shear_rate * engine_->time();
  result.steps = engine_->steps();
  result.total_steps = total_steps_;
  result.series = series_;
  const bool ended = result.ending == Ending::finished || result.ending == Ending::equilibrium;
  // The samples since the last row are shown as a row, and kept as samples: a run that is lengthened completes it.
  if (RowAverager rest = row_; ended && rest.samples() > 0) result.series.rows.push_back(rest.finish(scale_));
  result.averages = averages(result.series, scale_, scene_.run.average_from);
  result.last = last_;
  if (ended) result.measures = final_measures(scene_, derived_, start_, engine_->snapshot(), profile_);
  result.solver = engine_->solver_summary();
  result.cpu_seconds = cpu_seconds_;
  result.wall_seconds = wall_seconds_;
  for (std::size_t k = 0; k < result.stage_seconds.size(); ++k)
    result.stage_seconds[k] = engine_->profile().seconds(static_cast<Stage>(k));
  result.compression = compression_report_;
  if (result.ending != Ending::failed) {
    Archive state;
    engine_->save(state);
    result.state_hash = state_hash(state);
  }
  add_notes(result);
}

template <int D>
std::optional<std::string> Simulation<D>::compression_note() const {
  if (!compression_report_ || compression_report_->equilibrium) return std::nullopt;
  return fmt::format(
      "the compression stopped at its limit of {:g} inertial times, short of equilibrium: kinetic energy per grain "
      "{:.2g}, mean stress {:.4g}",
      compression_limit, compression_report_->kinetic_per_grain, compression_report_->pressure);
}

template <int D>
void Simulation<D>::add_notes(RunResult& result) const {
  if (const auto note = compression_note()) result.notes.push_back(*note);
  if (equilibrium_ && result.ending == Ending::finished)
    result.notes.push_back(
        fmt::format("the run ended before equilibrium: kinetic energy per grain of the backbone {:.2g} P d^D (asked: "
                    "below {:.2g}), "
                    "stress {}",
                    equilibrium_->backbone_energy(engine_->snapshot()), *scene_.run.equilibrium,
                    equilibrium_->balanced(last_) ? "within 1 %" : "off by more than 1 %"));
  if (result.solver.missed > 0)
    result.notes.push_back(
        fmt::format("the contact solver missed its tolerance in {} of {} steps (worst residual {:.2g}): raise "
                    "cd.max_sweeps or lower cd.dt_factor",
                    result.solver.missed, result.solver.steps, result.solver.worst_residual));
  if (result.solver.penetration > scene_.cd.penetration)
    result.notes.push_back(
        fmt::format("the largest penetration, {:.2g} d, is above cd.penetration = {:.2g}: lower cd.tolerance or cd.dt",
                    result.solver.penetration, scene_.cd.penetration));
  const EnergyParts energy = engine_->energy();
  const double scale = result.solver.dissipated + energy.kinetic + energy.rotational + energy.cell;
  if (result.solver.gained > 0.01 * scale)
    result.notes.push_back(fmt::format(
        "contacts have made energy: {:.3g}, {:.1f} % of what they dissipated and what moves now. Impacts of "
        "several contacts at once do so where restitutions differ, or tangential from normal ones: lower "
        "cd.dt, or compare with one restitution",
        result.solver.gained, 100 * result.solver.gained / scale));
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace galet
