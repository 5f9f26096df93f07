// The state of a run as named columns of plain numbers: what a checkpoint file stores, what a restart reads, and
// what the state hash covers. Anything that influences the future of a run is in here, bit for bit.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace galet {

struct Archive {
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<std::int64_t>> integers;
  std::map<std::string, std::string> texts;

  bool operator==(const Archive&) const = default;
};

/// The column called `name`; throws InputError that names it when it is absent.
const std::vector<double>& real_column(const Archive& archive, const std::string& name);
const std::vector<std::int64_t>& integer_column(const Archive& archive, const std::string& name);

/// 64-bit FNV-1a hash of every name and every bit in the archive, texts excepted (a title is no state).
std::uint64_t state_hash(const Archive& archive);

}  // namespace galet
