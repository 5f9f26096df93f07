// Base64 (RFC 4648, with padding): bytes in XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace galet {

std::string base64(std::string_view bytes);

}  // namespace galet
