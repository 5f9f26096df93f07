// SIGINT and SIGTERM: the first one asks the run to stop after its present steps, the second one ends the program.
#pragma once

namespace galet::cli {

/// From now on the two signals are caught.
void catch_interrupts();

/// Has one arrived?
bool interrupted();

}  // namespace galet::cli
