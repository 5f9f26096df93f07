// What becomes of a run that is stopped, killed, or left without room on its disk: whatever was written stays readable,
// and the run goes on from it with the same bits.
//
// GALET_KILLS=200 makes KilledAtAnyMoment as long as the number says (default: 6).
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/io/checkpoint.hpp"
#include "common/io/files.hpp"
#include "common/io/hdf5_tree.hpp"
#include "src/restart.hpp"
#include "tests/command/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::faults_test {
namespace {

namespace fs = std::filesystem;

/// A shear flow of a second or two of either engine.
std::string scene_of(const std::string& engine, double duration) {
  return fmt::format(R"(title = "faults"
engine = "{}"
grains.count = 100
material = {{friction = 0.4, restitution = 0.1, stiffness_level = 1e3}}
initial = {{kind = "gas", solid_fraction = 0.45}}
loading = {{kind = "plane_shear", pressure = 1, inertial_number = 0.2}}
cd = {{dt_factor = 0.02, tolerance = 1e-2}}
run = {{duration = {}, samples = 200}}
output = {{frames = 40, formats = ["paraview", "xyz"]}}
)",
                     engine, duration);
}

double duration_of(const std::string& engine) { return engine == "md" ? 60 : 40; }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Every file of the folder that a name says is finished is whole.
void expect_whole_files(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (has(name, ".tmp-")) continue;  // of a write that was cut short
    const std::string path = entry.path().string(), text = read_file(path);
    if (name.ends_with("_series.h5")) {
      EXPECT_NO_THROW(read_hdf5(path, {})) << name;  // HDF5 sees where a file ends too early
    } else if (name.ends_with(".h5")) {
      EXPECT_NO_THROW(stored_scene(read_checkpoint(path))) << name;
    } else if (name.ends_with(".vtp") || name.ends_with(".pvd")) {
      EXPECT_TRUE(text.ends_with("</VTKFile>\n")) << name;
    } else if (name.ends_with(".xyz")) {
      EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 102) << name;
    }
    if (!name.ends_with(".pvd")) continue;
    for (std::size_t at = text.find("file=\""); at != std::string::npos; at = text.find("file=\"", at + 1)) {
      const std::size_t begin = at + 6, end = text.find('"', begin);
      EXPECT_TRUE(fs::is_regular_file(folder / text.substr(begin, end - begin))) << name;
    }
  }
}

class Faults : public testing::TestWithParam<const char*> {
 protected:
  std::string engine() const { return GetParam(); }
  std::string in(const std::string& name) const { return folder_.file(name); }
  /// The run without disturbance: its state's hash, and how long it took.
  std::string hash_of_whole_run() {
    write_file(in("scene.toml"), scene_of(engine(), duration_of(engine())));
    const double start = wall_seconds();
    EXPECT_EQ(run_galet({"run", in("scene.toml"), "--out", in("whole")}, in("whole.log")), 0)
        << read_file(in("whole.log"));
    seconds_ = wall_seconds() - start;
    return hash_in(in("whole/" + engine() + "_summary.json"));
  }
  /// Runs on from the checkpoint of `out` to the end: its state's hash.
  std::string hash_after_going_on(const std::string& out) {
    EXPECT_EQ(run_galet({"run", "--resume", in(out + "/" + engine() + "_checkpoint.h5")}, in("on.log")), 0)
        << read_file(in("on.log"));
    return hash_in(in(out + "/" + engine() + "_summary.json"));
  }

  TemporaryFolder folder_;
  double seconds_ = 0;  ///< of the whole run, on this machine as busy as it is
};

const auto name_of = [](const auto& info) { return std::string(info.param); };
INSTANTIATE_TEST_SUITE_P(Engines, Faults, testing::Values("md", "cd"), name_of);

TEST_P(Faults, SignalsStopAtACheckpoint_restart) {
  const std::string whole = hash_of_whole_run();
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string out = fmt::format("signal_{}", signal), log = in(out + ".log");
    RunningProgram program({"run", in("scene.toml"), "--out", in(out)}, log);
    ASSERT_TRUE(wait_for_file(in(out + "/" + engine() + "_000000.xyz")));  // the run proper has begun
    program.send(signal);
    EXPECT_EQ(program.wait(), 1);
    const std::string said = read_file(log);
    EXPECT_TRUE(has(said, "stopped after step")) << said;
    EXPECT_TRUE(has(said, "--resume " + in(out + "/" + engine() + "_checkpoint.h5"))) << said;
    EXPECT_TRUE(has(read_file(in(out + "/" + engine() + "_summary.json")), "\"ending\": \"interrupted\""));
    expect_whole_files(in(out));
    EXPECT_EQ(hash_after_going_on(out), whole);
    expect_whole_files(in(out));
  }
}

TEST_P(Faults, KilledAtAnyMoment_restart) {
  const char* asked = std::getenv("GALET_KILLS");
  const int kills = asked != nullptr ? std::atoi(asked) : 6;
  const std::string whole = hash_of_whole_run();
  int killed = 0, finished = 0, resumed = 0;
  for (int attempt = 0; killed < kills && attempt < 10 * kills; ++attempt) {
    const std::string out = fmt::format("killed_{}", finished),
                      checkpoint = in(out + "/" + engine() + "_checkpoint.h5");
    std::vector<std::string> arguments = {"run", "--checkpoint-every", "0.02", "--out", in(out)};
    if (fs::exists(checkpoint))
      arguments.insert(arguments.end(), {"--resume", checkpoint}), ++resumed;
    else
      arguments.push_back(in("scene.toml"));
    RandomStream random(99, static_cast<std::uint64_t>(attempt));
    RunningProgram program(arguments, in("killed.log"));
    sleep_for(random.uniform(0.0, seconds_));
    if (!program.ended()) {
      program.send(SIGKILL);
      if (program.wait() == -SIGKILL) ++killed;
    }
    if (fs::exists(in(out))) expect_whole_files(in(out));
    if (!fs::exists(in(out + "/" + engine() + "_summary.json"))) continue;
    if (program.ended() && program.wait() == 0) {
      EXPECT_EQ(hash_in(in(out + "/" + engine() + "_summary.json")), whole);
      ++finished;
    }
  }
  EXPECT_EQ(killed, kills);
  EXPECT_GT(resumed, 0) << "no run lived long enough for a checkpoint";
  const std::string last = fmt::format("killed_{}", finished);
  if (fs::exists(in(last + "/" + engine() + "_checkpoint.h5"))) {
    EXPECT_EQ(hash_after_going_on(last), whole);
  }
  fmt::print("{} kills, {} runs resumed, {} finished in between\n", killed, resumed, finished);
}

/// A file system of its own with `bytes` of room, while it lives. Needs the right to mount one.
class SmallFileSystem {
 public:
  SmallFileSystem(std::string path, int kilobytes) : path_(std::move(path)) {
    fs::create_directory(path_);
    there_ = ::mount("tmpfs", path_.c_str(), "tmpfs", 0, fmt::format("size={}k", kilobytes).c_str()) == 0;
  }
  ~SmallFileSystem() {
    if (there_) ::umount2(path_.c_str(), MNT_DETACH);
  }
  SmallFileSystem(const SmallFileSystem&) = delete;
  SmallFileSystem& operator=(const SmallFileSystem&) = delete;
  bool there() const { return there_; }

 private:
  std::string path_;
  bool there_ = false;
};

// The room suffices for checkpoints and some frames, not for all of them.
TEST_P(Faults, AFullFileSystem_restart) {
  const std::string whole = hash_of_whole_run();
  const SmallFileSystem disk(in("disk"), 1200);
  if (!disk.there()) GTEST_SKIP() << "no right to mount a small file system: run as root to test a full one";
  const std::string log = in("full.log"), checkpoint = in("disk/out/" + engine() + "_checkpoint.h5");
  EXPECT_EQ(run_galet({"run", in("scene.toml"), "--out", in("disk/out"), "--checkpoint-every", "0.02"}, log), 1);
  const std::string said = read_file(log);
  EXPECT_TRUE(has(said, "No space left on device")) << said;
  EXPECT_TRUE(has(said, "can't write '" + in("disk/out/"))) << said;
  expect_whole_files(in("disk/out"));
  ASSERT_TRUE(fs::exists(checkpoint)) << said;
  // With room elsewhere the run goes on from what was saved.
  EXPECT_EQ(run_galet({"run", "--resume", checkpoint, "--out", in("on")}, in("on.log")), 0) << read_file(in("on.log"));
  EXPECT_EQ(hash_in(in("on/" + engine() + "_summary.json")), whole);
}

// The same with files that may not grow beyond a size, which needs no right: frames are small, checkpoints too large.
TEST_P(Faults, FilesThatMayNotGrow) {
  write_file(in("scene.toml"), scene_of(engine(), 2));
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{48 * 1024, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const int code = run_galet({"run", in("scene.toml"), "--out", in("out"), "--set", "run.samples=10"}, in("small.log"));
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(code, 1);
  const std::string said = read_file(in("small.log"));
  EXPECT_TRUE(has(said, "can't write '" + in("out/" + engine() + "_checkpoint.h5"))) << said;
  EXPECT_TRUE(has(said, "File too large")) << said;
  // What has room was written all the same.
  EXPECT_FALSE(hash_in(in("out/" + engine() + "_summary.json")).empty());
  expect_whole_files(in("out"));
  for (const auto& entry : fs::directory_iterator(in("out")))
    EXPECT_FALSE(has(entry.path().string(), ".tmp-")) << entry.path();
}

}  // namespace
}  // namespace galet::test::faults_test
