// The message for a name that no field or table has.
#pragma once

#include <string>
#include <vector>

namespace galet {

struct UnknownName {
  std::string message;
  std::vector<std::string> meant;  ///< paths of the fields or tables that it may stand for
};

/// An unknown key of the table `section`: its near match, the table it belongs to, or what is possible there.
UnknownName explain_unknown_key(const std::string& key, const std::string& section);

/// An unknown [name] or, for lists, [[name]].
UnknownName explain_unknown_table(const std::string& name, bool list);

}  // namespace galet
