#include "src/commands/progress_line.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace galet::cli {

namespace {
constexpr const char* clear_line = "\r\x1b[K";
}

ProgressLine::ProgressLine(Style style) : style_(style), terminal_(isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const std::string& text) {
  if (!shown()) return;
  if (!terminal_) return show_line(text);
  fmt::print(stderr, "{}{}", clear_line, text);
  std::fflush(stderr);
  dirty_ = true;
}

void ProgressLine::show_line(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  fmt::print(stderr, "{}\n", text);
  std::fflush(stderr);
  next_ = now + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                    std::chrono::duration<double>(seconds_between_lines));
}

void ProgressLine::clear() {
  if (!dirty_) return;
  fmt::print(stderr, "{}", clear_line);
  std::fflush(stderr);
  dirty_ = false;
}

}  // namespace galet::cli
