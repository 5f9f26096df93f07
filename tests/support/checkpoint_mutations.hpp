// Checkpoints of a real run with random damage: each is refused with a message that names the file, or it has the bits
// of the sound one.
#pragma once

#include <string>
#include <vector>

namespace galet::test {

struct DamageCounts {
  long refused = 0;
  long same = 0;                        ///< read, with every bit as it was (damage that changed nothing)
  std::vector<std::string> complaints;  ///< what must not be, at most ten
};

/// Reads `count` damaged copies of one checkpoint; the streams of random numbers are `first`, `first` + 1, ...
DamageCounts read_damaged_checkpoints(long first, long count);

}  // namespace galet::test
