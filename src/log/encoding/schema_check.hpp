// Compares the schema of a channel with a type of ours.
#pragma once

#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/message_type.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

/// Returns a fault if the schema of the channel does not have exactly the fields of the type, in their order.
/// Names are compared without case in ROS 1, whose messages have some in capital letters. A channel without a
/// schema, or with one in another language than ros1msg, ros2msg and jsonschema, is believed. Fault:
/// bad_input that names the field, without a place.
Status check_schema(const Channel& channel, const MessageType& type);

/// The same for the text of a JSON schema: the properties of each object are the fields, and their types fit.
/// Parts that a schema leaves open, for instance by "$ref", are accepted.
Status check_json_schema(std::string_view schema, const MessageType& type);

}  // namespace outrider
