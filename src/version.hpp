// Which program this is.
#pragma once

#include <string>

namespace galet {

std::string program_version();

/// Compiler and build type, as results must not depend on them, and a report says which they were all the same.
std::string program_build();

}  // namespace galet
