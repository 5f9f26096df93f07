#include "common/io/program.hpp"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/core/error.hpp"

extern char** environ;

namespace galet {

namespace {

std::string read_to_end(int descriptor) {
  std::string text;
  std::array<char, 4096> block;
  while (true) {
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count > 0)
      text.append(block.data(), static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
      return text;
  }
}

/// Starts the program with its standard error in `messages_end`; returns the system's error, or 0.
int start(std::vector<std::string>& arguments, const std::string& folder, int messages_end, pid_t& child) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, messages_end, STDERR_FILENO);
  const int error = ::posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

ProgramEnd run_program(std::vector<std::string> arguments, const std::string& folder) {
  require(!arguments.empty(), "a program needs a name");
  std::array<int, 2> pipe_ends{};
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    throw RunError(fmt::format("can't start {}: {}", arguments[0], std::strerror(errno)));
  pid_t child = 0;
  const int error = start(arguments, folder, pipe_ends[1], child);
  ::close(pipe_ends[1]);
  ProgramEnd end;
  end.found = error == 0;
  if (end.found) end.messages = read_to_end(pipe_ends[0]);
  ::close(pipe_ends[0]);
  if (error == ENOENT) return end;
  if (error != 0) throw RunError(fmt::format("can't start {}: {}", arguments[0], std::strerror(error)));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) end.code = WEXITSTATUS(status);
  return end;
}

}  // namespace galet
