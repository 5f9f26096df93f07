#include "common/io/base64.hpp"

#include <algorithm>
#include <cstdint>

namespace galet {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    for (std::size_t b = 0; b < 3; ++b)
      three = three << 8 | (b < count ? static_cast<unsigned char>(bytes[k + b]) : 0u);
    for (std::size_t digit = 0; digit < 4; ++digit)
      text += digit <= count ? digits[three >> (18 - 6 * digit) & 63] : '=';
  }
  return text;
}

}  // namespace galet
