// The message for a name that no field or table has.
#pragma once

#include <string>
#include <vector>

namespace galet {

struct UnknownName {
  std::string message;
  std::vector<std::string> meant;  ///< paths of the fields or tables that it may stand for
};

/// The message for an unknown key of a table: the near match, the table it belongs to, or what is possible.
UnknownName explain_unknown(const std::string& key, const std::string& section);

}  // namespace galet
