// Compression of answers with gzip, for clients that accept it.
#pragma once

#include <string>
#include <string_view>

#include "byte_budget.hpp"
#include "http/message.hpp"

namespace outrider::server {

inline constexpr std::size_t least_compressed_bytes = 1000;  ///< shorter answers stay as they are

/// Returns true if a header Accept-Encoding allows gzip. Source: RFC 9110, section 12.5.3.
bool accepts_gzip(std::string_view accept_encoding);

/// Compresses bytes to the gzip format.
std::string gzipped(std::string_view bytes);

/// Compresses the body of an answer, or its file, if the client accepts gzip, the answer is long enough, and
/// its type is not compressed already. Bytes of a part of a file are those of the file, so a request for one
/// is answered without compression, and a compressed answer offers no parts. Such an answer, compressed or
/// not, has the header Vary. Memory is taken from `memory` meanwhile; if too little is left, the answer stays
/// as it is.
void compress(const Request& request, Response& response, ByteBudget& memory);

}  // namespace outrider::server
