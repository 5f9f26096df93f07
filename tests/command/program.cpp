#include "tests/command/program.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/io/files.hpp"

extern char** environ;

namespace galet::test {

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const std::string& log) {
  std::vector<std::string> words = {GALET_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  const int error = ::posix_spawn(&process_, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("can't start " + words[0]);
}

RunningProgram::~RunningProgram() {
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  wait();
}

void RunningProgram::send(int signal) const {
  if (process_ > 0) ::kill(process_, signal);
}

int RunningProgram::wait() {
  if (process_ > 0) {
    while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
  }
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
}

bool RunningProgram::ended() {
  if (process_ > 0 && ::waitpid(process_, &status_, WNOHANG) == process_) process_ = -1;
  return process_ < 0;
}

int run_galet(const std::vector<std::string>& arguments, const std::string& log) {
  return RunningProgram(arguments, log).wait();
}

void sleep_for(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

bool wait_for_file(const std::string& path) {
  for (int k = 0; k < 4000; ++k) {
    std::error_code ignored;
    if (std::filesystem::file_size(path, ignored) > 0 && !ignored) return true;
    sleep_for(0.005);
  }
  return false;
}

std::string hash_in(const std::string& summary) {
  return nlohmann::json::parse(read_file(summary)).at("state_hash").get<std::string>();
}

}  // namespace galet::test
