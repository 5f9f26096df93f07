// The program, running beside the test.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace galet::test {

class RunningProgram {
 public:
  /// Starts `galet ARGUMENTS...` with its standard output and error in `log`.
  RunningProgram(const std::vector<std::string>& arguments, const std::string& log);
  /// Kills it if it still runs.
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  /// Waits for its end: the exit code, or minus the signal that ended it.
  int wait();
  /// Has it ended?
  bool ended();

 private:
  pid_t process_ = -1;
  int status_ = 0;
};

/// Runs to the end; returns the exit code, or minus the signal.
int run_galet(const std::vector<std::string>& arguments, const std::string& log);

void sleep_for(double seconds);

/// Waits until the file is there and not empty; false after 20 s.
bool wait_for_file(const std::string& path);

/// The state hash in a run's summary.
std::string hash_in(const std::string& summary);

}  // namespace galet::test
