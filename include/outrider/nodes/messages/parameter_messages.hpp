// The services by which nodes of ROS 2 show their parameters (rcl_interfaces). Sequences of booleans are
// those of bytes, which are the same on the wire.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"

namespace outrider::rcl_interfaces {

/// Types of a parameter, as ParameterType has them.
inline constexpr std::uint8_t no_parameter = 0, bool_parameter = 1, integer_parameter = 2,
                              double_parameter = 3, string_parameter = 4;

struct ParameterValue {
  std::uint8_t type_id = no_parameter;
  bool bool_value = false;
  std::int64_t integer_value = 0;
  double double_value = 0.0;
  std::string string_value;
  std::vector<std::uint8_t> byte_array_value;
  std::vector<std::uint8_t> bool_array_value;
  std::vector<std::int64_t> integer_array_value;
  std::vector<double> double_array_value;
  std::vector<std::string> string_array_value;

  static constexpr std::string_view type = "rcl_interfaces/msg/ParameterValue";
  template <class List>
  static void describe(List& list) {
    list.field("type", &ParameterValue::type_id);
    list.field("bool_value", &ParameterValue::bool_value);
    list.field("integer_value", &ParameterValue::integer_value);
    list.field("double_value", &ParameterValue::double_value);
    list.field("string_value", &ParameterValue::string_value);
    list.field("byte_array_value", &ParameterValue::byte_array_value);
    list.field("bool_array_value", &ParameterValue::bool_array_value);
    list.field("integer_array_value", &ParameterValue::integer_array_value);
    list.field("double_array_value", &ParameterValue::double_array_value);
    list.field("string_array_value", &ParameterValue::string_array_value);
  }
};

struct Parameter {
  std::string name;
  ParameterValue value;

  OUTRIDER_MESSAGE(Parameter, "rcl_interfaces/msg/Parameter", name, value)
};

struct FloatingPointRange {
  double from_value = 0.0;
  double to_value = 0.0;
  double step = 0.0;

  OUTRIDER_MESSAGE(FloatingPointRange, "rcl_interfaces/msg/FloatingPointRange", from_value, to_value, step)
};

struct IntegerRange {
  std::int64_t from_value = 0;
  std::int64_t to_value = 0;
  std::uint64_t step = 0;

  OUTRIDER_MESSAGE(IntegerRange, "rcl_interfaces/msg/IntegerRange", from_value, to_value, step)
};

struct ParameterDescriptor {
  std::string name;
  std::uint8_t type_id = no_parameter;
  std::string description;
  std::string additional_constraints;
  bool read_only = false;
  bool dynamic_typing = false;
  std::vector<FloatingPointRange> floating_point_range;
  std::vector<IntegerRange> integer_range;

  static constexpr std::string_view type = "rcl_interfaces/msg/ParameterDescriptor";
  template <class List>
  static void describe(List& list) {
    list.field("name", &ParameterDescriptor::name);
    list.field("type", &ParameterDescriptor::type_id);
    list.field("description", &ParameterDescriptor::description);
    list.field("additional_constraints", &ParameterDescriptor::additional_constraints);
    list.field("read_only", &ParameterDescriptor::read_only);
    list.field("dynamic_typing", &ParameterDescriptor::dynamic_typing);
    list.field("floating_point_range", &ParameterDescriptor::floating_point_range);
    list.field("integer_range", &ParameterDescriptor::integer_range);
  }
};

struct ListParametersResult {
  std::vector<std::string> names;
  std::vector<std::string> prefixes;

  OUTRIDER_MESSAGE(ListParametersResult, "rcl_interfaces/msg/ListParametersResult", names, prefixes)
};

struct SetParametersResult {
  bool successful = false;
  std::string reason;

  OUTRIDER_MESSAGE(SetParametersResult, "rcl_interfaces/msg/SetParametersResult", successful, reason)
};

struct ListParametersRequest {
  std::vector<std::string> prefixes;
  std::uint64_t depth = 0;

  OUTRIDER_MESSAGE(ListParametersRequest, "rcl_interfaces/srv/ListParameters_Request", prefixes, depth)
};

struct ListParametersResponse {
  ListParametersResult result;

  OUTRIDER_MESSAGE(ListParametersResponse, "rcl_interfaces/srv/ListParameters_Response", result)
};

struct GetParametersRequest {
  std::vector<std::string> names;

  OUTRIDER_MESSAGE(GetParametersRequest, "rcl_interfaces/srv/GetParameters_Request", names)
};

struct GetParametersResponse {
  std::vector<ParameterValue> values;

  OUTRIDER_MESSAGE(GetParametersResponse, "rcl_interfaces/srv/GetParameters_Response", values)
};

struct GetParameterTypesRequest {
  std::vector<std::string> names;

  OUTRIDER_MESSAGE(GetParameterTypesRequest, "rcl_interfaces/srv/GetParameterTypes_Request", names)
};

struct GetParameterTypesResponse {
  std::vector<std::uint8_t> types;

  OUTRIDER_MESSAGE(GetParameterTypesResponse, "rcl_interfaces/srv/GetParameterTypes_Response", types)
};

struct DescribeParametersRequest {
  std::vector<std::string> names;

  OUTRIDER_MESSAGE(DescribeParametersRequest, "rcl_interfaces/srv/DescribeParameters_Request", names)
};

struct DescribeParametersResponse {
  std::vector<ParameterDescriptor> descriptors;

  OUTRIDER_MESSAGE(DescribeParametersResponse, "rcl_interfaces/srv/DescribeParameters_Response", descriptors)
};

struct SetParametersRequest {
  std::vector<Parameter> parameters;

  OUTRIDER_MESSAGE(SetParametersRequest, "rcl_interfaces/srv/SetParameters_Request", parameters)
};

struct SetParametersResponse {
  std::vector<SetParametersResult> results;

  OUTRIDER_MESSAGE(SetParametersResponse, "rcl_interfaces/srv/SetParameters_Response", results)
};

struct SetParametersAtomicallyRequest {
  std::vector<Parameter> parameters;

  OUTRIDER_MESSAGE(SetParametersAtomicallyRequest, "rcl_interfaces/srv/SetParametersAtomically_Request",
                   parameters)
};

struct SetParametersAtomicallyResponse {
  SetParametersResult result;

  OUTRIDER_MESSAGE(SetParametersAtomicallyResponse, "rcl_interfaces/srv/SetParametersAtomically_Response",
                   result)
};

}  // namespace outrider::rcl_interfaces
