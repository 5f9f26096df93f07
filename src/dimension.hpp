// From a dimension known at run time to a template parameter: once per run, outside every loop.
#pragma once

#include <type_traits>

#include "common/core/error.hpp"

namespace galet {

/// Calls function(std::integral_constant<int, D>) with D = 2 or 3.
template <class Function>
decltype(auto) with_dimension(int dimension, Function&& function) {
  if (dimension == 2) return function(std::integral_constant<int, 2>{});
  require(dimension == 3, "a scene has 2 or 3 dimensions");
  return function(std::integral_constant<int, 3>{});
}

}  // namespace galet
