// The rules that depend on whether a field was written: a Scene can't tell a default from the same value written.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/scene/check.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Fields written in vain, and defaults that a scene in SI may not rely on. `written(path)`: the file has that field.
std::vector<Finding> check_presence(const Scene& scene, const std::function<bool(const std::string&)>& written);

}  // namespace galet
