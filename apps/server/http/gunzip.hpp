// Decompression of gzip data, for the rare client that does not accept gzip.
#pragma once

#include <string>
#include <string_view>

namespace outrider::server {

/// Decompresses gzip data. Throws std::runtime_error on any other bytes: a bug, since the data is our own.
std::string gunzipped(std::string_view bytes);

}  // namespace outrider::server
