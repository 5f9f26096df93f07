// What a run hands back.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/layout.hpp"
#include "common/core/profile.hpp"
#include "common/engine/engine.hpp"
#include "common/io/scene_file.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"
#include "src/compression.hpp"
#include "src/final_measures.hpp"
#include "src/time_series.hpp"

namespace galet {

enum class Ending {
  finished,     ///< the whole duration was run
  equilibrium,  ///< the equilibrium that the scene asks for was reached before
  reached,      ///< the stress or strain that the scene asks for (run.until) was reached before
  interrupted,  ///< the caller stopped it; it can be resumed
  failed        ///< the engine found its state unsound; `failure` says where
};

std::string to_string(Ending ending);

/// How a stage went.
struct StageReport {
  std::string name;
  Ending ending = Ending::finished;
  double time = 0;   ///< at its end, since the start of the run
  long steps = 0;    ///< in the stage
  Measurement last;  ///< the latest single sample of the stage
};

/// What was run: with it a summary says by itself what its numbers are of.
struct RunOrigin {
  std::string scene;                 ///< text of the scene file; empty for a scene built in code
  std::vector<Override> changes;     ///< made to it on the command line
  std::vector<DerivedLine> derived;  ///< the numbers that follow from it, as `galet describe` prints them
  int dimension = 2;
  int grains = 0;
  std::uint64_t seed = 0;
  bool reduced_units = true;
};

struct RunResult {
  RunOrigin origin;
  EngineKind engine = EngineKind::md;
  Layout layout{2, false};
  Ending ending = Ending::finished;
  std::string failure;              ///< failed: what the engine said
  std::vector<std::string> notes;   ///< what a user should know, one sentence each
  std::string stage;                ///< of a scene with stages: the one that it ended in
  std::vector<StageReport> stages;  ///< of a scene with stages: those that it went through, the last one included
  double dt = 0;
  double time = 0;
  double strain = 0;
  long steps = 0;
  long total_steps = 0;
  TimeSeries series;
  Averages averages;       ///< of the last stage, from run.average_from on
  Measurement last;        ///< the latest single sample
  FinalMeasures measures;  ///< of the last state: those that output.measures asks for
  SolverSummary solver;
  double cpu_seconds = 0;   ///< of the calling thread, in steps only: measures and files don't count
  double wall_seconds = 0;  ///< of the steps
  std::array<double, static_cast<int>(Stage::count)> stage_seconds{};  ///< by stage_names, since the (re)start
  std::uint64_t state_hash = 0;                                        ///< of the engine's state; 0 when failed
  std::optional<CompressionReport> compression;                        ///< the stage before, when the scene has one
  std::optional<Archive> last_good;                                    ///< failed: the latest sound state that was kept
};

/// One JSON object (2-space indent): the end of the run, averages with errors, last sample, costs, state hash.
std::string to_json(const RunResult& result, const std::string& scene);

/// The same for people: a short table of the averages and one line of costs.
std::string summary(const RunResult& result);

}  // namespace galet
