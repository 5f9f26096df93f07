#include "src/data_files.hpp"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "common/core/error.hpp"

namespace galet {

namespace fs = std::filesystem;

std::string data_file(const std::string& name) {
  const char* given = std::getenv("GALET_DATA");
  std::error_code error;
  const fs::path folder = given != nullptr && *given != '\0'
                              ? fs::path(given)
                              : fs::read_symlink("/proc/self/exe", error).parent_path() / GALET_DATA_FROM_PROGRAM;
  const fs::path path = folder.lexically_normal() / name;
  if (!fs::is_regular_file(path, error))
    throw RunError(
        fmt::format("can't find '{}': it is installed with galet; the environment variable GALET_DATA may "
                    "name its folder",
                    path.string()));
  return path.string();
}

}  // namespace galet
