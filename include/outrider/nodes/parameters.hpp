// NodeParameters: the options of a node as parameters of ROS 2, answered as its services do.
//
// An option "radius" of the section "robot" is the parameter "robot.radius", in the unit of its description.
// Parameters cannot change while a node runs: to set one to another value is refused with a sentence.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/message_type.hpp"
#include "outrider/nodes/messages/parameter_messages.hpp"

namespace outrider {

/// Most names in a request, so that an answer does not keep a node from acting.
inline constexpr std::size_t most_parameters_asked = 1000;

/// A service: its name beneath the node, its types, and its answer to an encoded request.
struct NodeService {
  std::string name;  ///< such as "list_parameters"
  const MessageType* request = nullptr;
  const MessageType* response = nullptr;
  /// Returns the encoded response. Fault: bad_input for bytes that are no request, or that name more than
  /// most_parameters_asked.
  std::function<Outcome<std::string>(std::string_view cdr)> answer;
};

class NodeParameters {
 public:
  /// The values of the options are those at this time.
  explicit NodeParameters(std::vector<OptionGroup> groups);

  [[nodiscard]] rcl_interfaces::ListParametersResponse list(
      const rcl_interfaces::ListParametersRequest&) const;
  /// Values, types and descriptors are those of no parameter for names that are none.
  [[nodiscard]] rcl_interfaces::GetParametersResponse get(const rcl_interfaces::GetParametersRequest&) const;
  [[nodiscard]] rcl_interfaces::GetParameterTypesResponse types(
      const rcl_interfaces::GetParameterTypesRequest&) const;
  [[nodiscard]] rcl_interfaces::DescribeParametersResponse describe(
      const rcl_interfaces::DescribeParametersRequest&) const;
  /// Successful only for the value that a parameter has.
  [[nodiscard]] rcl_interfaces::SetParametersResponse set(const rcl_interfaces::SetParametersRequest&) const;

  /// Returns the six services of a node of ROS 2. They hold a copy of the parameters.
  [[nodiscard]] std::vector<NodeService> services() const;

 private:
  struct Entry {
    rcl_interfaces::ParameterDescriptor descriptor;
    rcl_interfaces::ParameterValue value;
  };
  [[nodiscard]] const Entry* find(std::string_view name) const;
  [[nodiscard]] rcl_interfaces::SetParametersResult set_one(const rcl_interfaces::Parameter& parameter) const;

  std::vector<Entry> entries_;
};

}  // namespace outrider
