#include "src/stage_course.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"
#include "common/measure/stress.hpp"
#include "common/scene/loading.hpp"
#include "common/scene/stages.hpp"
#include "src/schedule.hpp"

namespace galet {

namespace {

/// A component of a stress or strain by its name; "isotropic": the mean of the normal stresses.
template <int D>
double component_of(const Mat<D>& tensor, const std::string& name) {
  return name == "isotropic" ? tensor.trace() / D : tensor(name[0] - 'x', name[1] - 'x');
}

}  // namespace

template <int D>
StageCourse<D>::StageCourse(const Scene& scene, const GrainFacts& facts, std::size_t present)
    : scenes_(stage_scenes(scene)), derived_(derive_stages(scene, facts)), present_(present) {
  require(present < scenes_.size(), "the checkpoint is in a stage that the scene has not");
  for (std::size_t k = 0; k < scenes_.size(); ++k) names_.push_back(stage_name(scene, k));
}

template <int D>
void StageCourse<D>::begin(Engine<D>& engine) {
  steps_of_.clear();
  for (const Derived& derived : derived_) steps_of_.push_back(steps_for(derived.duration, engine.dt()));
  first_step_ = engine.steps();
  steps_ = steps_of_[present_];
  part_ = 0, ended_ = false, settled_ = 0;
  const Snapshot<D> snapshot = engine.snapshot();
  stress_ = stress(snapshot).total();
  strain_ = snapshot.cell->strain;
  if (!scene().run.until.empty()) mean_ = component_of<D>(stress_, scene().run.until);
  if (present_ > 0 || path_needs_start(scene())) tell(engine);
  prepare_test();
}

template <int D>
void StageCourse<D>::next(Engine<D>& engine) {
  ++present_;
  begin(engine);
}

/// The engine follows the present part of the path.
template <int D>
void StageCourse<D>::tell(Engine<D>& engine) const {
  Scene part = scene();
  part.loading = path_part<D>(scene(), derived(), part_, stress_);
  Derived of_part = derived();
  of_part.duration = static_cast<double>(next_turn() - engine.steps()) * engine.dt();
  engine.change(part, of_part);
}

template <int D>
void StageCourse<D>::prepare_test() {
  equilibrium_.reset();
  if (!scene().run.equilibrium && !scene().run.unbalanced) return;
  Scene part = scene();
  part.loading = path_part<D>(scene(), derived(), 0, stress_);
  equilibrium_.emplace(part, derived());
}

template <int D>
long StageCourse<D>::total_steps() const {
  long total = last_step();
  for (std::size_t k = present_ + 1; k < steps_of_.size(); ++k) total += steps_of_[k];
  return total;
}

template <int D>
long StageCourse<D>::next_turn() const {
  const double share = static_cast<double>(part_ + 1) / path_parts(scene());
  return first_step_ + std::lround(share * static_cast<double>(steps_));
}

template <int D>
void StageCourse<D>::turn(Engine<D>& engine) {
  if (engine.steps() != next_turn() || part_ + 1 >= path_parts(scene())) return;
  ++part_;
  tell(engine);
}

/// Whether the stress or strain that the stage goes to has been reached. Stresses fluctuate: their mean over about one
/// inertial time counts.
template <int D>
bool StageCourse<D>::passed(const Snapshot<D>& snapshot, double interval) {
  const EndSpec& end = scene().run;
  if (end.until_strain) {
    const Mat<D> strain = snapshot.cell->strain - strain_;
    const double volumes = end.until == "isotropic" ? D : 1;
    return std::abs(volumes * component_of<D>(strain, end.until)) >= *end.until_strain;
  }
  const double now = component_of<D>(stress(snapshot).total(), end.until);
  const double share = derived().inertial_time ? std::min(1.0, interval / *derived().inertial_time) : 1;
  mean_ += share * (now - mean_);
  const double from = component_of<D>(stress_, end.until);
  return (*end.until_stress - mean_) * (*end.until_stress - from) <= 0;
}

template <int D>
std::optional<Ending> StageCourse<D>::look(const Measurement& sample, const Snapshot<D>& snapshot, double interval) {
  if (!scene().run.until.empty() && passed(snapshot, interval)) return Ending::reached;
  if (!equilibrium_) return std::nullopt;
  settled_ = equilibrium_->reached(sample, snapshot) ? settled_ + 1 : 0;
  if (static_cast<double>(settled_) * interval < *derived().inertial_time) return std::nullopt;
  return Ending::equilibrium;
}

template <int D>
StageReport StageCourse<D>::report(Ending ending, const Measurement& last, const Engine<D>& engine) const {
  return {name(), ending, engine.time(), engine.steps() - first_step_, last};
}

template <int D>
void StageCourse<D>::end(Ending ending, const Measurement& last, const Engine<D>& engine) {
  reports_.push_back(report(ending, last, engine));
  ended_ = true;
}

// ---- checkpoints -------------------------------------------------------------------------------------------

template <int D>
void StageCourse<D>::save(Archive& archive) const {
  archive.integers["run.stage"] = {static_cast<std::int64_t>(present_), first_step_, steps_, part_, ended_, settled_};
  auto& reals = archive.reals["run.stage"];
  reals.assign(stress_.data(), stress_.data() + D * D);
  reals.insert(reals.end(), strain_.data(), strain_.data() + D * D);
  reals.push_back(mean_);
  auto& ends = archive.integers["run.stage_ends"];
  auto& lasts = archive.reals["run.stage_ends"];
  ends.clear(), lasts.clear();
  for (const StageReport& report : reports_) {
    ends.insert(ends.end(), {static_cast<std::int64_t>(report.ending), report.steps});
    lasts.push_back(report.time);
    lasts.insert(lasts.end(), report.last.values.begin(), report.last.values.end());
  }
}

template <int D>
std::size_t StageCourse<D>::stage_in(const Archive& archive) {
  return static_cast<std::size_t>(integer_column(archive, "run.stage").at(0));
}

/// After begin(): the lengths of the stages are known, and the engine's state is that of the checkpoint.
template <int D>
void StageCourse<D>::restore(const Archive& archive) {
  const auto& numbers = integer_column(archive, "run.stage");
  const auto& reals = real_column(archive, "run.stage");
  if (numbers.size() != 6 || reals.size() != 2 * D * D + 1)
    throw InputError("column 'run.stage' of the checkpoint has the wrong length");
  first_step_ = numbers[1];
  if (path_needs_start(scene()) && numbers[2] != steps_)
    throw InputError("the run follows a path up to its end (stresses that change, cycles): it can't be lengthened");
  part_ = static_cast<int>(numbers[3]), ended_ = numbers[4] != 0, settled_ = numbers[5];
  stress_ = Eigen::Map<const Mat<D>>(reals.data());
  strain_ = Eigen::Map<const Mat<D>>(reals.data() + D * D);
  mean_ = reals.back();
  prepare_test();
  const auto& ends = integer_column(archive, "run.stage_ends");
  const auto& lasts = real_column(archive, "run.stage_ends");
  if (lasts.size() != ends.size() / 2 * (observable_count + 1))
    throw InputError("the checkpoint measures other observables than this version");
  reports_.clear();
  for (std::size_t k = 0; k < ends.size() / 2; ++k) {
    const double* from = lasts.data() + k * (observable_count + 1);
    StageReport report{names_.at(k), static_cast<Ending>(ends[2 * k]), from[0], ends[2 * k + 1], {}};
    std::copy_n(from + 1, observable_count, report.last.values.begin());
    reports_.push_back(report);
  }
}

template class StageCourse<2>;
template class StageCourse<3>;

}  // namespace galet
