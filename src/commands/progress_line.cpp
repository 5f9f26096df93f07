#include "src/commands/progress_line.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace galet::cli {

namespace {
constexpr const char* clear_line = "\r\x1b[K";
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const std::string& text) {
  if (!terminal_) return;
  fmt::print(stderr, "{}{}", clear_line, text);
  std::fflush(stderr);
  dirty_ = true;
}

void ProgressLine::clear() {
  if (!dirty_) return;
  fmt::print(stderr, "{}", clear_line);
  std::fflush(stderr);
  dirty_ = false;
}

}  // namespace galet::cli
