// Definitions of messages in the language of ROS ("ros1msg", "ros2msg"): the text of a schema, parsed.
//
// A text is the fields of a type, and for each type that it uses a line of '=' signs, "MSG: package/Name",
// and the fields of that. Sources: the ROS 2 interface definition documentation (docs.ros.org, "Interfaces"),
// and wiki.ros.org/msg for ROS 1.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/message_type.hpp"

namespace outrider {

inline constexpr std::size_t largest_schema = std::size_t{1} << 20U;  ///< bytes of a text that is parsed

/// A line "float64[36] covariance", with the type in its ROS 2 form.
struct DefinedField {
  std::string type;  ///< "float64", "string" or "geometry_msgs/Pose"; times are "builtin_interfaces/Time"
  std::string name;
  FieldShape shape = FieldShape::single;
  std::size_t length = 1;  ///< of an array
};

/// The fields of each type of a text, by its short name "geometry_msgs/Pose".
using Definitions = std::map<std::string, std::vector<DefinedField>, std::less<>>;

/// "geometry_msgs/msg/Point" is "geometry_msgs/Point" inside a definition.
std::string short_name(std::string_view name);

/// Parses a text whose first part defines `type`. Fault: bad_input with the line, without a place.
Outcome<Definitions> parse_definitions(std::string_view text, std::string_view type);

}  // namespace outrider
