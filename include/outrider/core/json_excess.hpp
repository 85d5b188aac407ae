// Bounds what a parsed JSON text takes, before it is parsed. Parsers keep a value in some 64 bytes, whatever
// its text takes, and copying or printing a value of theirs recurses as deep as it nests.
#pragma once

#include <string_view>

namespace outrider {

/// Returns why a JSON text is not to be parsed: it nests more than 100 deep, or has more than 4 million
/// values. Empty if it may be parsed. O(text).
std::string_view json_excess(std::string_view text);

}  // namespace outrider
