// Progress on stderr: one line that is written over and over where that is a terminal; else nothing, or lines of their
// own from time to time, for the log of a batch job.
#pragma once

#include <chrono>
#include <string>

namespace galet::cli {

class ProgressLine {
 public:
  enum class Style { terminal_only, everywhere, off };
  static constexpr double seconds_between_lines = 10;  ///< where stderr is no terminal

  explicit ProgressLine(Style style = Style::terminal_only);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool shown() const { return style_ == Style::everywhere || (terminal_ && style_ != Style::off); }
  void show(const std::string& text);
  void clear();

 private:
  void show_line(const std::string& text);

  Style style_;
  bool terminal_;
  bool dirty_ = false;
  std::chrono::steady_clock::time_point next_{};  ///< when the next line of its own is due
};

}  // namespace galet::cli
