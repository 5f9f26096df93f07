#include "src/png.hpp"

#include <array>
#include <filesystem>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

extern char** environ;

namespace galet {

namespace {

/// Runs a program without a shell, silently; true when it could be started and ended well.
template <std::size_t N>
bool run_program(std::array<const char*, N> arguments) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, arguments[0], &actions, nullptr, const_cast<char* const*>(arguments.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return error == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::string convert_to_png(const std::string& svg_path) {
  const std::string png = std::filesystem::path(svg_path).replace_extension(".png").string();
  // "--": a path that begins with a dash is no option.
  const std::array<const char*, 6> arguments = {"rsvg-convert", "--output",       png.c_str(),
                                                "--",           svg_path.c_str(), nullptr};
  return run_program(arguments) ? png : std::string();
}

}  // namespace galet
