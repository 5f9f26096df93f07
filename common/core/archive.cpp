#include "common/core/archive.hpp"

#include <cstring>
#include <span>

#include "common/core/error.hpp"

namespace galet {

const std::vector<double>& real_column(const Archive& archive, const std::string& name) {
  const auto found = archive.reals.find(name);
  if (found == archive.reals.end()) throw InputError("the checkpoint has no real column '" + name + "'");
  return found->second;
}

const std::vector<std::int64_t>& integer_column(const Archive& archive, const std::string& name) {
  const auto found = archive.integers.find(name);
  if (found == archive.integers.end()) throw InputError("the checkpoint has no integer column '" + name + "'");
  return found->second;
}

namespace {

void add_bytes(std::uint64_t& hash, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t k = 0; k < size; ++k) {
    hash ^= bytes[k];
    hash *= 0x100000001b3ULL;
  }
}

template <class Columns>
void add_columns(std::uint64_t& hash, const Columns& columns) {
  for (const auto& [name, values] : columns) {
    add_bytes(hash, name.data(), name.size());
    const std::uint64_t count = values.size();
    add_bytes(hash, &count, sizeof count);
    add_bytes(hash, values.data(), values.size() * sizeof(values[0]));
  }
}

}  // namespace

std::uint64_t state_hash(const Archive& archive) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  add_columns(hash, archive.reals);
  add_columns(hash, archive.integers);
  return hash;
}

}  // namespace galet
