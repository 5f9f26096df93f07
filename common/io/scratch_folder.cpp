#include "common/io/scratch_folder.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "common/core/error.hpp"

namespace galet {

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "galet-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw RunError(fmt::format("can't make a temporary folder '{}': {}", pattern, std::strerror(errno)));
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace galet
