// Errors. Input mistakes are collected and reported together (InputError); a run that can't go on names its
// culprit (RunError); `require` states a condition on an argument and is always checked; `GALET_ENSURE` states
// an internal invariant and is checked in builds with GALET_VALIDATE.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace galet {

/// One mistake in an input file. line and column count from 1; 0 when the mistake has no place in a file.
struct Mistake {
  std::string file;
  int line = 0;
  int column = 0;
  std::string message;
};

/// "file:line:column: error: message", the form that editors can follow.
std::string to_string(const Mistake& mistake);

/// Bad input: nothing was run. Carries every mistake that was found.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Mistake> mistakes);
  explicit InputError(const std::string& message);
  const std::vector<Mistake>& mistakes() const { return mistakes_; }

 private:
  std::vector<Mistake> mistakes_;
};

/// A run that had to stop: non-finite state, runaway overlap, lost grain, full disk.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws std::invalid_argument with `message` unless `condition` holds.
inline void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument(message);
}
inline void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

#ifdef GALET_VALIDATE
#define GALET_ENSURE(condition, message)                                                     \
  do {                                                                                       \
    if (!(condition)) throw std::logic_error(std::string("broken invariant: ") + (message)); \
  } while (false)
#else
#define GALET_ENSURE(condition, message) \
  do {                                   \
  } while (false)
#endif

}  // namespace galet
