#include "outrider/io/text.hpp"

#include <algorithm>
#include <string>

namespace outrider {

std::string excerpt(std::string_view text, std::size_t most) {
  std::string result(text.substr(0, most));
  std::ranges::replace_if(result, [](char c) { return c < ' ' || c > '~'; }, '?');
  if (text.size() > most) result += "...";
  return result;
}

}  // namespace outrider
