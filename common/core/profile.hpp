// Stage profiler: where the time of a step goes. Stages carry the names that the head comments of the steppers use.
#pragma once

#include <array>
#include <chrono>
#include <string_view>

namespace galet {

enum class Stage { neighbours, contacts, solve, grains, drives, count };

inline constexpr std::array<std::string_view, static_cast<int>(Stage::count)> stage_names = {
    "neighbours", "contacts", "solve", "grains", "drives"};

class Profile {
 public:
  using Clock = std::chrono::steady_clock;
  void add(Stage stage, Clock::duration time) { times_[static_cast<int>(stage)] += time; }
  double seconds(Stage stage) const { return std::chrono::duration<double>(times_[static_cast<int>(stage)]).count(); }

 private:
  std::array<Clock::duration, static_cast<int>(Stage::count)> times_{};
};

/// Adds the time between its construction and its destruction to one stage.
class StageTimer {
 public:
  StageTimer(Profile& profile, Stage stage) : profile_(profile), stage_(stage), start_(Profile::Clock::now()) {}
  ~StageTimer() { profile_.add(stage_, Profile::Clock::now() - start_); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  Profile& profile_;
  Stage stage_;
  Profile::Clock::time_point start_;
};

}  // namespace galet
