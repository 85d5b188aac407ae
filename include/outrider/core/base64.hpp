// Base64 (RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace outrider {

/// Decodes the text. Returns nothing if it is not base64: other characters, or a length that is not a
/// multiple of four.
std::optional<std::string> base64_decoded(std::string_view text);

std::string base64_encoded(std::string_view bytes);

}  // namespace outrider
