// What a caller may ask of a run beyond its scene, and what the run says while it goes. None of this changes the
// state that the run reaches.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/archive.hpp"

namespace galet {

struct Progress {
  std::string_view stage;  ///< its name; "run" without stages, "compression" of the gas that the run starts from
  long step = 0;
  long steps = 0;  ///< of the stage; an upper bound when it may stop at equilibrium
  double steps_per_second = 0;
  double seconds_left = 0;  ///< of wall time, at the pace so far
};

/// A state that is to be written (output.frames).
struct Frame {
  long step = 0;
  std::vector<double> times;  ///< of the frames from the first to this one: its index is the last of them
  std::vector<long> steps;    ///< of the same frames
};

struct RunControl {
  std::string_view stage = "run";                  ///< what progress calls a run without stages
  std::function<void(const Progress&)> progress;   ///< called several times per second at most
  std::function<bool()> stop;                      ///< true: stop after the current steps (a fraction of a second)
  std::function<void(const Frame&)> frame;         ///< called at output.frames + 1 states, the start among them
  std::function<void(const Archive&)> checkpoint;  ///< called every `checkpoint_every` seconds of wall time
  /// Of a scene with stages: called at the end of each one with its number (from 1), its name and the state.
  std::function<void(int, const std::string&, const Archive&)> stage_end;
  double checkpoint_every = std::numeric_limits<double>::infinity();
  long most_steps = std::numeric_limits<long>::max();  ///< stop after so many steps (of the run proper)
  bool keep_last_good = true;                          ///< keep a copy of the state in memory, for RunResult::last_good
};

}  // namespace galet
