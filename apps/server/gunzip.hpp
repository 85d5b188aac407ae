// What gzip compressed, for the rare client that does not take it so.
#pragma once

#include <string>
#include <string_view>

namespace outrider::server {

/// The bytes again. Throws std::runtime_error on bytes that gzip did not make: a bug, since they are our own.
std::string gunzipped(std::string_view bytes);

}  // namespace outrider::server
