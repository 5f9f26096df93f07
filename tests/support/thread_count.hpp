#pragma once

#include "common/core/parallel.hpp"

namespace galet::test {

/// Puts the number of threads back, also when an assertion leaves the test early.
class ThreadCount {
 public:
  ThreadCount() = default;
  ~ThreadCount() { set_thread_count(before_); }
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

 private:
  int before_ = thread_count();
};

}  // namespace galet::test
