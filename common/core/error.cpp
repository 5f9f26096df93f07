#include "common/core/error.hpp"

#include <fmt/format.h>

namespace galet {

std::string to_string(const Mistake& mistake) {
  if (mistake.file.empty()) return fmt::format("error: {}", mistake.message);
  if (mistake.line == 0) return fmt::format("{}: error: {}", mistake.file, mistake.message);
  return fmt::format("{}:{}:{}: error: {}", mistake.file, mistake.line, mistake.column, mistake.message);
}

namespace {
std::string join(const std::vector<Mistake>& mistakes) {
  std::vector<std::string> lines;
  for (const Mistake& mistake : mistakes) lines.push_back(to_string(mistake));
  return fmt::format("{}", fmt::join(lines, "\n"));
}
}  // namespace

InputError::InputError(std::vector<Mistake> mistakes)
    : std::runtime_error(join(mistakes)), mistakes_(std::move(mistakes)) {}

InputError::InputError(const std::string& message) : InputError(std::vector<Mistake>{{"", 0, 0, message}}) {}

}  // namespace galet
