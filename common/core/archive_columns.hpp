// Columns of vectors to and from an Archive, component by component.
#pragma once

#include <string>

#include "common/core/archive.hpp"
#include "common/core/error.hpp"
#include "common/core/types.hpp"

namespace galet {

inline void append(std::vector<double>& out, double value) { out.push_back(value); }
template <int N>
void append(std::vector<double>& out, const Eigen::Matrix<double, N, 1>& value) {
  out.insert(out.end(), value.data(), value.data() + N);
}

inline const double* extract(const double* from, double& value) { return value = *from, from + 1; }
template <int N>
const double* extract(const double* from, Eigen::Matrix<double, N, 1>& value) {
  value = Eigen::Map<const Eigen::Matrix<double, N, 1>>(from);
  return from + N;
}

template <class T>
inline constexpr std::size_t components = sizeof(T) / sizeof(double);

template <class Values>
void put_column(Archive& archive, const std::string& name, const Values& values) {
  std::vector<double>& out = archive.reals[name];
  out.clear();
  for (const auto& value : values) append(out, value);
}

/// Fills `values`, whose size is the number of entries expected; InputError when the stored column has another.
template <class Values>
void take_column(const Archive& archive, const std::string& name, Values& values) {
  const std::vector<double>& stored = real_column(archive, name);
  if (stored.size() != values.size() * components<typename Values::value_type>)
    throw InputError("column '" + name + "' of the checkpoint has the wrong length");
  const double* from = stored.data();
  for (auto& value : values) from = extract(from, value);
}

}  // namespace galet
