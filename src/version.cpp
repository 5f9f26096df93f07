#include "src/version.hpp"

namespace galet {

std::string program_version() { return GALET_VERSION; }

std::string program_build() { return GALET_BUILD; }

}  // namespace galet
