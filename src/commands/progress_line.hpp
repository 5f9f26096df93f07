// One line on stderr that is written over and over. Silent unless stderr is a terminal.
#pragma once

#include <string>

namespace galet::cli {

class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool shown() const { return terminal_; }
  void show(const std::string& text);
  void clear();

 private:
  bool terminal_;
  bool dirty_ = false;
};

}  // namespace galet::cli
