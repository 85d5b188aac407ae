// Fields of messages in the words of a ROS definition.
#pragma once

#include <string>

#include "outrider/log/encoding/message_type.hpp"

namespace outrider {

/// Returns the type of an element: "float64" or "geometry_msgs/Pose".
std::string type_word(const MessageField& field);
/// Returns the type with its shape and the name: "float64[36] covariance".
std::string field_words(const MessageField& field);

}  // namespace outrider
