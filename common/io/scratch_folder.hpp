// A folder for files that nobody keeps.
#pragma once

#include <filesystem>
#include <string>

namespace galet {

/// Made below the system's temporary folder; removed with everything in it at the end of the scope.
class ScratchFolder {
 public:
  /// Throws RunError with the system's reason when it can't be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace galet
