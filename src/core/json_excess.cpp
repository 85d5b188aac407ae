#include "outrider/core/json_excess.hpp"

#include <cstddef>

namespace outrider {

std::string_view json_excess(std::string_view text) {
  constexpr std::size_t deepest = 100, most_values = 4'000'000;
  std::size_t depth = 0, values = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') quoted = !quoted;
    if (quoted) {
      if (c == '\\') ++i;
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (c == ',' || c == ':' || c == '[' || c == '{') ++values;
    if (depth > deepest) return "its JSON nests more than 100 deep";
    if (values > most_values) return "its JSON has more than 4,000,000 values";
  }
  return {};
}

}  // namespace outrider
