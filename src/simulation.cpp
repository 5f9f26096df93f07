#include "src/simulation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/io/checkpoint_sample.hpp"
#include "common/scene/loading.hpp"
#include "common/scene/packing.hpp"
#include "common/scene/stages.hpp"
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

bool asked_for_equilibrium(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.stages.size(); ++k)
    if (stage_name(scene, k) == name) return scene.stages[k].equilibrium || scene.stages[k].unbalanced;
  return false;
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
    start_run(sample, 0), take_over_checkpoint();
}

template <int D>
Simulation<D>::Simulation(const Scene& scene, EngineKind kind, const Sample<D>& start) : scene_(scene), kind_(kind) {
  start_run(start, 0);
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
    start_run(sample, StageCourse<D>::stage_in(archive));
    restore(archive);
  }
}

template <int D>
Simulation<D> Simulation<D>::resume(const Scene& scene, const Archive& archive, const std::vector<Override>& more) {
  std::vector<Override> overrides = stored_overrides(archive);
  overrides.insert(overrides.end(), more.begin(), more.end());
  return Simulation(scene, stored_engine(archive), std::move(overrides), archive);
}

/// The engine of the stage, at the start of the run (a restart brings it to the state of its checkpoint).
template <int D>
void Simulation<D>::start_run(const Sample<D>& start, std::size_t stage) {
  start_ = start;
  const GrainFacts facts = grain_facts(scene_, start_);
  derived_ = derive(scene_, facts);
  course_ = StageCourse<D>(scene_, facts, stage);
  engine_ = make_engine<D>(kind_, course_.scene(), course_.derived(), start_);
  guard_.emplace(scene_, derived_, start_, kind_);
  begin_course();
  const long total = course_.total_steps();
  if (scene_.output.frames > 0)
    schedule_.steps_per_frame =
        static_cast<double>(total) / static_cast<double>(std::min<long>(scene_.output.frames, total));
  series_.dimension = D;
  series_.asked = scale_.asked;
  series_.budget = kind_ == EngineKind::md && scene_.md.energy_budget;
}

template <int D>
void Simulation<D>::begin_course() {
  scale_.energy_at_start = engine_->energy().total();
  course_.begin(*engine_);
  start_stage();
}

/// What the contacts of another run's checkpoint remember, if the scene starts from one.
template <int D>
void Simulation<D>::take_over_checkpoint() {
  if (scene_.initial.kind != InitialKind::checkpoint || scene_.initial.fresh_contacts) return;
  Archive fresh;
  engine_->save(fresh);
  engine_->restore(with_contacts_of(std::move(fresh), kind_, initial_checkpoint(scene_)));
  engine_->change(course_.scene(), course_.derived());
  begin_course();
}

/// What belongs to a stage and not to its engine's state.
template <int D>
void Simulation<D>::start_stage() {
  const double energy_at_start = scale_.energy_at_start;
  scale_ = measure_scale(course_.derived(), kind_ == EngineKind::cd);
  scale_.energy_at_start = energy_at_start;
  scale_.asked = MeasureSet(scene_.output.measures);
  const std::vector<double> gravity = gravity_of(course_.scene().loading);
  for (std::size_t a = 0; a < gravity.size(); ++a) scale_.gravity[a] = gravity[a];
  for (const int body : start_.body) scale_.held.push_back(body >= 0 ? 1 : 0);
  const double steps_per_frame = schedule_.steps_per_frame;
  schedule_ = make_schedule(course_.last_step() - course_.first_step(), scene_.run.samples,
                            sample_interval(kind_, course_.derived(), engine_->dt()));
  schedule_.steps_per_frame = steps_per_frame;  // frames go on through all stages
  samples_ = 0;
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
  course_.save(archive);
  archive.reals["run.energy_at_start"] = {scale_.energy_at_start};
  archive.reals["run.seconds"] = {cpu_seconds_, wall_seconds_};
  return archive;
}

template <int D>
void Simulation<D>::restore(const Archive& archive) {
  engine_->restore(archive);
  course_.restore(archive);
  if (engine_->steps() > course_.last_step())
    throw InputError(fmt::format("the checkpoint is at time {:g}, beyond the end of the run at {:g}: lengthen run.{}",
                                 engine_->time(), derived_.duration, scene_.run.strain ? "strain" : "duration"));
  compression_report_ = stored_report(archive);
  schedule_.restore(archive);
  samples_ = schedule_.samples_until(engine_->steps() - course_.first_step());
  series_.restore(archive);
  row_.restore(archive);
  profile_.restore(archive);
  const auto& last = real_column(archive, "run.last");
  std::copy_n(last.begin(), std::min<std::size_t>(last.size(), observable_count), last_.values.begin());
  scale_.energy_at_start = real_column(archive, "run.energy_at_start").at(0);
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
  sample.cell.strain.setZero();
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
  start_run(compression_->rest_sample(), 0);
  compression_.reset();
  return true;
}

// ---- The run ----

template <int D>
RunResult Simulation<D>::run(const RunControl& control) {
  RunResult result;
  if (!prepare(control, result)) return result;
  Pace pace(control, engine_->steps());
  try {
    if (pace.copy_due()) keep_last_good();
    result.ending = loop(control, pace);
  } catch (const RunError& error) {
    result.ending = Ending::failed;
    result.failure = error.what();
    if (!scene_.stages.empty()) result.failure = fmt::format("in {}: {}", course_.name(), result.failure);
    result.last_good = std::move(last_good_);
  }
  report(result);
  return result;
}

template <int D>
Ending Simulation<D>::loop(const RunControl& control, Pace& pace) {
  const long allowed = std::min(course_.total_steps() - engine_->steps(), control.most_steps);
  const long last = engine_->steps() + std::max(0L, allowed);
  for (;;) {
    if (course_.ended()) {
      course_.next(*engine_);
      start_stage();
    }
    const Ending ending = run_stage(control, pace, last);
    if (ending == Ending::interrupted) return ending;
    const bool over = course_.is_last();
    finish_stage(ending, control);
    if (over) return ending;
  }
}

/// To the end of the present stage, or to the step `last`.
template <int D>
Ending Simulation<D>::run_stage(const RunControl& control, Pace& pace, long last) {
  const long end = std::min(course_.last_step(), last), every = scene_.guard.every;
  pace.start_stage(scene_.stages.empty() ? control.stage : std::string_view(course_.name()), course_.first_step(),
                   course_.last_step());
  const bool frames = control.frame && schedule_.steps_per_frame > 0;
  if (frames && engine_->steps() == 0) write_frame(control);
  while (engine_->steps() < end) {
    const long now = engine_->steps(), sample_step = course_.first_step() + schedule_.step_of(samples_ + 1);
    const long frame_step = frames ? schedule_.step_of_frame(schedule_.frame_after(now)) : end;
    const long guard_step = (now / every + 1) * every;
    take_steps(std::min({sample_step, frame_step, guard_step, end, course_.next_turn(), now + pace.bite()}) - now);
    pace.reached(engine_->steps());
    course_.turn(*engine_);
    const bool saves = pace.checkpoint_due();
    if (engine_->steps() == guard_step || engine_->steps() == end || saves) guard_->check(engine_->snapshot());
    if (frames && engine_->steps() == frame_step) write_frame(control);
    if (engine_->steps() == sample_step)
      if (const std::optional<Ending> ending = take_sample(pace)) return *ending;
    if (saves) control.checkpoint(checkpoint());
    const bool going_on = engine_->steps() < course_.last_step() || !course_.is_last();
    if (control.stop && going_on && control.stop()) return Ending::interrupted;
  }
  return engine_->steps() < course_.last_step() ? Ending::interrupted : Ending::finished;
}

/// A stage that another one follows is closed: its last row, its report. Each stage hands out its state.
template <int D>
void Simulation<D>::finish_stage(Ending ending, const RunControl& control) {
  if (!course_.is_last()) {
    if (row_.samples() > 0) series_.rows.push_back(row_.finish(scale_));
    course_.end(ending, last_, *engine_);
  }
  if (scene_.stages.empty() || !control.stage_end) return;
  const int number = static_cast<int>(course_.reports().size()) + (course_.is_last() ? 1 : 0);
  control.stage_end(number, course_.name(), checkpoint());
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

/// The ending, when the samples have shown what the stage waits for.
template <int D>
std::optional<Ending> Simulation<D>::take_sample(Pace& pace) {
  last_ = measure(*engine_, scale_);
  ++samples_;
  row_.add(last_);
  if (row_.samples() == schedule_.samples_per_row) {
    series_.rows.push_back(row_.finish(scale_));
    const long first = course_.first_step(), length = course_.last_step() - first;
    if (scale_.asked.has(MeasureKind::profile) && course_.is_last() &&
        static_cast<double>(engine_->steps() - first) > scene_.run.average_from * static_cast<double>(length))
      profile_.add(scene_profile(scene_, engine_->snapshot()));
    if (pace.copy_due()) keep_last_good();
  }
  const double interval = schedule_.steps_per_sample * engine_->dt();
  return course_.look(last_, engine_->snapshot(), interval);
}

// ---- What is handed back ----

template <int D>
void Simulation<D>::report(RunResult& result) const {
  result.engine = kind_;
  result.layout = engine_->layout();
  result.dt = engine_->dt();
  result.time = engine_->time();
  result.strain = engine_->snapshot().cell->strain(0, 1);
  result.steps = engine_->steps();
  result.total_steps = course_.total_steps();
  result.series = series_;
  const bool ended = result.ending != Ending::interrupted && result.ending != Ending::failed;
  // The samples since the last row are shown as a row, and kept as samples: a run that is lengthened completes it.
  if (RowAverager rest = row_; ended && rest.samples() > 0) result.series.rows.push_back(rest.finish(scale_));
  if (!scene_.stages.empty()) {
    result.stage = course_.name();
    result.stages = course_.reports();
    if (ended) result.stages.push_back(course_.report(result.ending, last_, *engine_));
  }
  const double stage_start = static_cast<double>(course_.first_step()) * engine_->dt();
  result.averages = averages(result.series, scale_, scene_.run.average_from, stage_start);
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
  for (const StageReport& stage : course_.reports())
    if (stage.ending == Ending::finished && asked_for_equilibrium(scene_, stage.name))
      result.notes.push_back(fmt::format("{} ended at its limit of time, before equilibrium", stage.name));
  if (const auto& test = course_.equilibrium(); test && result.ending == Ending::finished)
    result.notes.push_back(fmt::format(
        "the run ended before equilibrium: kinetic energy per grain of the backbone {:.2g} P d^D, unbalanced force "
        "ratio {:.2g}, stress {} {:g} %",
        test->backbone_energy(engine_->snapshot()), test->unbalanced(engine_->snapshot()),
        test->balanced(last_) ? "within" : "off by more than", 100 * test->stress_tolerance()));
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
