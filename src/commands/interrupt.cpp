#include "src/commands/interrupt.hpp"

#include <atomic>

#include <signal.h>

namespace galet::cli {

namespace {
// The one global of the program: a signal handler can reach nothing else.
std::atomic<bool> arrived = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
void note_arrival(int) { arrived = true; }
}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = note_arrival;
  action.sa_flags = SA_RESETHAND | SA_RESTART;  // the second signal has its usual effect
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return arrived; }

}  // namespace galet::cli
