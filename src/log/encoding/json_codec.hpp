// Messages as JSON: an object with the fields under their names.
//
// Fields are those of ROS 2; the names of ROS 1 ("secs", "nsecs", capital letters, "seq" of a header) are
// read, too. NaN and infinities are the texts "NaN", "Infinity" and "-Infinity"; null is read as NaN. A
// sequence of bytes is written as base64, and read as that or as numbers. Every field must be there, once,
// and no other.
//
// The text is decoded while it is parsed: memory grows with the message that comes out of it, not with what
// the text could say. Source: RFC 8259, RFC 4648.
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/message_type.hpp"

namespace outrider {

std::string encode_json(const MessageType& type, const void* message);

/// Fault: bad_input that names the field, without a place. After it the content of the message is
/// unspecified.
Status decode_json(const MessageType& type, std::string_view text, void* message);

}  // namespace outrider
