#include "text.hpp"

#include <algorithm>
#include <string>

namespace outrider {

std::string excerpt(std::string_view text, std::size_t most) {
  std::string result(text.substr(0, most));
  std::ranges::replace_if(result, [](char c) { return c < ' ' || c > '~'; }, '?');
  if (text.size() > most) result += "...";
  return result;
}

bool is_printable(std::string_view text) {
  constexpr unsigned least_by_length[] = {0x20, 0x80, 0x800, 0x10000};  // shorter forms are forgeries
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) {
      return static_cast<unsigned char>(at < text.size() ? text[at] : 0);
    };
    const unsigned lead = byte(i);
    const std::size_t tail = lead < 0x80       ? 0
                             : lead >> 5 == 6  ? 1
                             : lead >> 4 == 14 ? 2
                             : lead >> 3 == 30 ? 3
                                               : 4;
    if (tail > 3) return false;
    unsigned code = tail == 0 ? lead : lead & (0x3FU >> tail);
    for (std::size_t k = 1; k <= tail; ++k) {
      if (byte(i + k) >> 6 != 2) return false;
      code = code << 6 | (byte(i + k) & 0x3FU);
    }
    if (code < least_by_length[tail] || code == 0x7F || code > 0x10FFFF || (code >> 11) == 0x1B) return false;
    i += tail + 1;
  }
  return true;
}

}  // namespace outrider
