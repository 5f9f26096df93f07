// A study: a published result from scenes to figures. It is a plan (independent runs, each a scene in TOML text with
// the parameters it stands for) and an evaluation (what the finished runs say about the published numbers). Everything
// between is common to all studies: running side by side, keeping finished rows, tables, files (run_study.hpp,
// study_files.hpp). The registry (registry.hpp) is the list of all.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/io/figure.hpp"
#include "common/measure/block_average.hpp"
#include "common/scene/scene.hpp"
#include "src/observable.hpp"
#include "src/run_result.hpp"
#include "src/studies/verdict.hpp"

namespace galet {

enum class StudySize {
  quick,  ///< fewer grains, shorter averages, fewer states: minutes
  full    ///< the published sizes and durations
};

/// One run that is to be made.
struct StudyRun {
  std::string name;  ///< of its files: letters, digits, "_", "." and "-"
  EngineKind engine = EngineKind::md;
  std::vector<std::pair<std::string, double>> parameters;  ///< what the sweep varies, by name
  std::string scene;                                       ///< TOML text; runs as it is with `galet run`
  bool keep_series = false;                                ///< the evaluation reads the series, not only the averages
  bool keep_profile = false;                               ///< likewise run.measures.profile

  /// NaN when the run has no such parameter.
  double parameter(std::string_view name) const;
};

/// A finished run.
struct StudyRow {
  StudyRun plan;
  RunResult run;      ///< of a kept row: what its file holds (no last state, no measures but the profile)
  bool kept = false;  ///< found finished in the folder and not run again
  bool usable() const { return run.ending != Ending::interrupted && run.ending != Ending::failed; }
  const Estimate& operator[](Observable observable) const { return run.averages[observable]; }
};

/// What the study says about one published number.
struct StudyFinding {
  std::string quantity;
  Estimate ours;
  Published published;
  Verdict verdict = Verdict::open;
  std::string note;  ///< why it may differ, or what was compared
};

struct NamedFigure {
  std::string name;  ///< of its files
  Figure figure;
};

struct StudyReport {
  std::vector<StudyFinding> findings;
  std::vector<NamedFigure> figures;
  std::vector<std::string> remarks;

  /// Adds the verdict on the published number called `key` (published.hpp).
  void add(const std::string& quantity, const Estimate& ours, std::string_view key, const std::string& note = "");
};

struct Study {
  const char* name;
  const char* title;
  const char* source;  ///< of the published result
  const char* about;   ///< material, sizes, protocol: what a reader needs to judge the numbers
  Observable judged;   ///< costs are compared at equal error of this quantity
  std::vector<StudyRun> (*plan)(StudySize size);
  StudyReport (*evaluate)(const std::vector<StudyRow>& rows);  ///< of the usable rows
};

/// The value of a parameter as tables show it: a number, of `state` the letter that it codes.
std::string parameter_text(std::string_view name, double value);

/// Rows of `engine` whose parameters are as given (those that are not named may have any value).
std::vector<const StudyRow*> rows_with(const std::vector<StudyRow>& rows, std::optional<EngineKind> engine,
                                       const std::vector<std::pair<std::string, double>>& parameters);

/// The first of these; null when there is none.
const StudyRow* row_with(const std::vector<StudyRow>& rows, EngineKind engine,
                         const std::vector<std::pair<std::string, double>>& parameters);

/// An average of such a row; NaN without one.
Estimate value_of(const StudyRow* row, Observable observable);

/// The different values of a parameter, in the order of the rows.
std::vector<double> values_of(const std::vector<StudyRow>& rows, std::string_view parameter);

/// Mean of a number over samples (rows that differ in their seed alone), with the error of their scatter: 0 of one
/// sample, NaN of none.
Estimate mean_over(const std::vector<const StudyRow*>& samples, const std::function<double(const StudyRow&)>& number);

/// One line of points with error bars.
Series series_of(const std::string& label, const std::vector<const StudyRow*>& rows, std::string_view parameter,
                 Observable observable);
/// The same, where both engines show a state: in the state's look, with open points for cd.
Series with_look(Series series, std::size_t look, EngineKind engine);

/// The stage called `name`; null when the run has not come to its end.
const StageReport* stage_of(const StudyRow& row, std::string_view name);

}  // namespace galet
