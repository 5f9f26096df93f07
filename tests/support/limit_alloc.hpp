// Counts calls of the global operator new while an AllocationCount lives, in all threads. What calls malloc directly
// (the OpenMP runtime, Eigen's dynamic matrices) is not seen.
#pragma once

namespace galet::test {

class AllocationCount {
 public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  /// Allocations since construction.
  long count() const;

 private:
  long start_;
};

}  // namespace galet::test
