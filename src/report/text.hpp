// Text that stands safely inside markup.
#pragma once

#include <string>
#include <string_view>

namespace outrider {

/// Valid UTF-8: each byte that is none becomes U+FFFD.
std::string valid_utf8(std::string_view text);

/// Character data and attribute values of HTML and XML: the five special characters become entities,
/// control characters (which XML forbids) spaces, and bytes that are no UTF-8 become U+FFFD.
std::string markup_text(std::string_view text);

}  // namespace outrider
