// galet run: one scene with one engine, from its start or from a checkpoint.
#include <cctype>
#include <filesystem>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/parallel.hpp"
#include "common/io/checkpoint.hpp"
#include "src/commands/arguments.hpp"
#include "src/commands/commands.hpp"
#include "src/commands/dump_problem.hpp"
#include "src/commands/interrupt.hpp"
#include "src/commands/progress_line.hpp"
#include "src/dimension.hpp"
#include "src/engines.hpp"
#include "src/frame_files.hpp"
#include "src/restart.hpp"
#include "src/run_files.hpp"
#include "src/text_table.hpp"

namespace galet::cli {

namespace {

/// What a run says: what went wrong; its results too; its progress too where there is no terminal.
enum class LogLevel { warnings, results, progress };

const std::map<std::string, LogLevel> log_levels = {
    {"warnings", LogLevel::warnings}, {"results", LogLevel::results}, {"progress", LogLevel::progress}};

struct RunArguments {
  SceneArguments scene;
  std::string engine;  ///< empty: the scene's
  std::string out;
  std::string resume;
  int threads = 1;
  double checkpoint_every = 300;
  std::optional<long> dump_step;  ///< write the contact problem of this step, and stop
  std::string dump_file;
  cd::ProblemForm dump_form = cd::ProblemForm::local;
  bool json = false;
  LogLevel log = LogLevel::results;
};

const std::map<std::string, cd::ProblemForm> problem_forms = {{"local", cd::ProblemForm::local},
                                                              {"global", cd::ProblemForm::global}};

/// What is to be run, and what it is called.
struct Job {
  Scene scene;
  EngineKind engine = EngineKind::md;
  std::vector<Override> changes;
  std::optional<Archive> archive;  ///< to go on from
  std::string title;
  std::string directory;
};

/// The checkpoint must belong to the scene and engine that are named beside it, if any are.
void check_against_checkpoint(const RunArguments& arguments, const Job& job) {
  if (!arguments.engine.empty() && engine_kind(arguments.engine) != job.engine)
    throw InputError(fmt::format("--engine {}: the checkpoint was written by {}, and only it can go on from there",
                                 arguments.engine, engine_name(job.engine)));
  if (!arguments.scene.path.empty() && read_scene(arguments.scene.path).source != job.scene.source)
    throw InputError(fmt::format("{} is not the scene in the checkpoint {}: leave it out to go on with that one",
                                 arguments.scene.path, arguments.resume));
}

Job resumed_job(const RunArguments& arguments) {
  Job job;
  job.archive = read_checkpoint(arguments.resume);
  job.changes = overrides(arguments.scene);
  job.scene = stored_scene(*job.archive, job.changes);
  job.engine = stored_engine(*job.archive);
  check_against_checkpoint(arguments, job);
  const std::string beside = std::filesystem::path(arguments.resume).parent_path().string();
  const std::string out = arguments.out.empty() ? (beside.empty() ? "." : beside) : arguments.out;
  job.directory = output_directory(out, arguments.resume);
  job.title = job.scene.title.empty() ? arguments.resume : job.scene.title;
  return job;
}

Job new_job(const RunArguments& arguments) {
  if (arguments.scene.path.empty()) throw InputError("name a scene file, or a checkpoint with --resume");
  Job job;
  job.changes = overrides(arguments.scene);
  job.scene = load(arguments.scene);
  job.engine = arguments.engine.empty() ? job.scene.engine : engine_kind(arguments.engine);
  job.directory = output_directory(arguments.out, arguments.scene.path);
  job.title = job.scene.title.empty() ? arguments.scene.path : job.scene.title;
  return job;
}

/// A stage's name as a part of a file's: what is no letter, digit, point or sign becomes "_".
std::string file_part(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view(".+-").find(c) == std::string_view::npos)
      c = '_';
  return name;
}

RunControl control_of(const RunArguments& arguments, const Job& job, const std::string& checkpoint_path,
                      ProgressLine& line) {
  RunControl control;
  control.stop = interrupted;
  control.checkpoint_every = arguments.checkpoint_every;
  control.checkpoint = [checkpoint_path](const Archive& archive) { write_checkpoint(checkpoint_path, archive); };
  control.stage_end = [&job](int number, const std::string& name, const Archive& archive) {
    const std::string file = fmt::format("{}_stage_{}_{}.h5", engine_name(job.engine), number, file_part(name));
    write_checkpoint(path_in(job.directory, file), archive);
  };
  if (line.shown())
    control.progress = [&line](const Progress& at) {
      const double percent = 100.0 * static_cast<double>(at.step) / static_cast<double>(at.steps);
      line.show(fmt::format("{} {:.1f} %, {:.0f} steps/s, {} left", at.stage, percent, at.steps_per_second,
                            duration_text(at.seconds_left)));
    };
  return control;
}

/// What became of the files of a run's end.
struct Written {
  std::vector<std::string> files;
  std::vector<std::string> problems;  ///< what could not be written, and why
  std::string checkpoint, last_good;  ///< their paths; empty: not written
};

/// The state first, as it can't be had again; what one file lacks (a full disk) doesn't keep the others from being
/// tried.
template <int D>
Written write_results(const RunResult& result, Simulation<D>& simulation, const Job& job, const FrameFiles& frames,
                      const std::string& checkpoint_path, const std::string& last_good_path) {
  Written written;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const RunError& error) {
      written.problems.emplace_back(error.what());
    }
  };
  attempt([&] {
    if (result.ending != Ending::failed) {
      write_checkpoint(checkpoint_path, simulation.checkpoint());
      written.checkpoint = checkpoint_path;
    } else if (result.last_good) {
      write_checkpoint(last_good_path, *result.last_good);
      written.last_good = last_good_path;
    }
  });
  attempt([&] { written.files = write_run(result, simulation, job.title, job.directory); });
  if (simulation.scene().output.frames > 0) {
    const std::vector<std::string> opened = frames.opened();
    written.files.insert(written.files.end(), opened.begin(), opened.end());
  }
  if (!written.checkpoint.empty()) written.files.push_back(written.checkpoint);
  return written;
}

/// Says on stderr how the run ended, when it didn't end well, and gives the exit code. Paths that are empty were not
/// written.
int say_ending(const RunResult& result, const std::string& checkpoint_path, const std::string& last_good_path) {
  for (const std::string& note : result.notes) fmt::print(stderr, "note: {}\n", note);
  if (result.ending == Ending::interrupted) {
    fmt::print(stderr, "galet: stopped after step {}", result.steps);
    if (!checkpoint_path.empty()) fmt::print(stderr, "; go on with: galet run --resume {}", checkpoint_path);
    fmt::print(stderr, "\n");
    return 1;
  }
  if (result.ending == Ending::failed) {
    fmt::print(stderr, "galet: {}\n", result.failure);
    if (!last_good_path.empty()) fmt::print(stderr, "galet: the last sound state is in {}\n", last_good_path);
    return 1;
  }
  return 0;
}

template <int D>
int run_job(const RunArguments& arguments, const Job& job) {
  const std::string engine = engine_name(job.engine);
  const std::string checkpoint_path = path_in(job.directory, engine + "_checkpoint.h5");
  const std::string last_good_path = path_in(job.directory, engine + "_last_good.h5");
  Simulation<D> simulation = job.archive ? Simulation<D>::resume(job.scene, *job.archive, job.changes)
                                         : Simulation<D>(job.scene, job.engine, job.changes);
  if (arguments.dump_step) {
    const std::string file = arguments.dump_file.empty()
                                 ? path_in(job.directory, fmt::format("problem_{}.hdf5", *arguments.dump_step))
                                 : arguments.dump_file;
    catch_interrupts();
    RunControl control;
    control.stop = interrupted;
    return dump_problem(simulation, {*arguments.dump_step, file, job.title, arguments.dump_form}, control);
  }
  const bool results = !arguments.json && arguments.log != LogLevel::warnings;
  if (results)
    fmt::print("{}\n{} engine, {}, {} grains\n", job.title, engine, to_string(simulation.derived().layout),
               simulation.derived().grains.count);
  std::fflush(stdout);

  catch_interrupts();
  ProgressLine line(arguments.log == LogLevel::warnings   ? ProgressLine::Style::off
                    : arguments.log == LogLevel::progress ? ProgressLine::Style::everywhere
                                                          : ProgressLine::Style::terminal_only);
  RunControl control = control_of(arguments, job, checkpoint_path, line);
  const FrameFiles frames(path_in(job.directory, engine), simulation.scene().output.formats, simulation.material(),
                          !simulation.scene().reduced_units);
  control.frame = [&](const Frame& frame) { frames.write(frame, simulation.engine().snapshot()); };
  const RunResult result = simulation.run(control);
  line.clear();

  const Written written = write_results(result, simulation, job, frames, checkpoint_path, last_good_path);
  if (arguments.json) {
    fmt::print("{}\n", to_json(result, job.title));
  } else if (results) {
    fmt::print("{}", summary(result));
    for (const std::string& file : written.files) fmt::print("wrote {}\n", file);
  }
  std::fflush(stdout);
  for (const std::string& problem : written.problems) fmt::print(stderr, "galet: {}\n", problem);
  const int code = say_ending(result, written.checkpoint, written.last_good);
  return written.problems.empty() ? code : 1;
}

int run_scene(const RunArguments& arguments) {
  set_thread_count(arguments.threads);
  const Job job = arguments.resume.empty() ? new_job(arguments) : resumed_job(arguments);
  return with_dimension(job.scene.dimension, [&](auto dimension) { return run_job<dimension>(arguments, job); });
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("run", "Run a scene with one engine");
  auto arguments = std::make_shared<RunArguments>();
  add_scene_arguments(*command, arguments->scene)->required(false);
  command->add_option("--engine", arguments->engine, "md (soft spheres) or cd (rigid grains); default: the scene's")
      ->check(CLI::IsMember({"md", "cd"}));
  command->add_option("--out", arguments->out, "folder for results (default: out/<scene name>)");
  command->add_option("--threads", arguments->threads, "threads of the run; results don't depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option(
      "--resume", arguments->resume,
      "go on from a checkpoint; SCENE may be left out, and --set may only change run.*, output.* and guard.*");
  command->add_option("--checkpoint-every", arguments->checkpoint_every, "seconds between checkpoints")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI::Option* dump = command
                          ->add_option("--dump-problem", arguments->dump_step,
                                       "write the contact problem of this step (1: the first) as an FCLIB file, with "
                                       "cd's impulses as its solution, and stop there")
                          ->type_name("STEP")
                          ->check(CLI::PositiveNumber);
  command
      ->add_option("--dump-file", arguments->dump_file, "that file (default: problem_STEP.hdf5 in the results' folder)")
      ->needs(dump);
  command
      ->add_option("--dump-form", arguments->dump_form,
                   "form of that problem: local (W and q, the default) or global (M, H, f and w)")
      ->needs(dump)
      ->transform(CLI::CheckedTransformer(problem_forms));
  command->add_flag("--json", arguments->json, "print one JSON object")->excludes(dump);
  command
      ->add_option("--log", arguments->log,
                   "what is said: warnings (and errors), results (the default; progress on a terminal only), progress "
                   "(also a line every ten seconds where there is no terminal)")
      ->transform(CLI::CheckedTransformer(log_levels));
  command->callback([&action, arguments] { action = [arguments] { return run_scene(*arguments); }; });
}

}  // namespace galet::cli
