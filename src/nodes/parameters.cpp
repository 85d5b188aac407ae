#include "outrider/nodes/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "outrider/core/text.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/log/encoding/codecs.hpp"

namespace outrider {
namespace {

using rcl_interfaces::bool_parameter;
using rcl_interfaces::DescribeParametersRequest;
using rcl_interfaces::DescribeParametersResponse;
using rcl_interfaces::double_parameter;
using rcl_interfaces::GetParametersRequest;
using rcl_interfaces::GetParametersResponse;
using rcl_interfaces::GetParameterTypesRequest;
using rcl_interfaces::GetParameterTypesResponse;
using rcl_interfaces::integer_parameter;
using rcl_interfaces::ListParametersRequest;
using rcl_interfaces::ListParametersResponse;
using rcl_interfaces::no_parameter;
using rcl_interfaces::Parameter;
using rcl_interfaces::ParameterDescriptor;
using rcl_interfaces::ParameterValue;
using rcl_interfaces::SetParametersAtomicallyRequest;
using rcl_interfaces::SetParametersAtomicallyResponse;
using rcl_interfaces::SetParametersRequest;
using rcl_interfaces::SetParametersResponse;
using rcl_interfaces::SetParametersResult;
using rcl_interfaces::string_parameter;

/// Returns the value in the unit of the option.
ParameterValue value_of(const Option& option) {
  ParameterValue value;
  if (const auto* const* flag = std::get_if<bool*>(&option.value)) {
    value.type_id = bool_parameter;
    value.bool_value = **flag;
  } else if (const auto* const* integer = std::get_if<std::int64_t*>(&option.value)) {
    value.type_id = integer_parameter;
    value.integer_value = **integer;
  } else if (std::holds_alternative<double*>(option.value)) {
    value.type_id = double_parameter;
    value.double_value = number<double>(value_text(option)).value_or(0.0);
  } else {
    value.type_id = string_parameter;
    value.string_value = *std::get<std::string*>(option.value);
  }
  return value;
}

ParameterDescriptor descriptor_of(const std::string& name, const Option& option, std::uint8_t type) {
  ParameterDescriptor descriptor;
  descriptor.name = name;
  descriptor.type_id = type;
  descriptor.description =
      option.unit.empty() ? option.sentence : fmt::format("{}, {}", option.sentence, option.unit);
  if (!option.choices.empty())
    descriptor.additional_constraints = fmt::format("one of: {}", fmt::join(option.choices, ", "));
  descriptor.read_only = true;
  if (type == double_parameter) descriptor.floating_point_range = {{option.low, option.high, 0.0}};
  if (type == integer_parameter) {
    descriptor.integer_range = {
        {static_cast<std::int64_t>(option.low), static_cast<std::int64_t>(option.high), 1}};
  }
  return descriptor;
}

bool same(const ParameterValue& a, const ParameterValue& b) {
  return a.type_id == b.type_id && a.bool_value == b.bool_value && a.integer_value == b.integer_value &&
         a.double_value == b.double_value && a.string_value == b.string_value;
}

/// Returns true if the name is within a prefix and at most so many parts below it; 0: any number.
bool listed(std::string_view name, const std::vector<std::string>& prefixes, std::uint64_t depth) {
  const auto parts = [](std::string_view text) {
    return static_cast<std::uint64_t>(std::ranges::count(text, '.')) + 1;
  };
  if (prefixes.empty()) return depth == 0 || parts(name) <= depth;
  return std::ranges::any_of(prefixes, [&](const std::string& prefix) {
    if (name == prefix) return true;
    if (!name.starts_with(prefix + ".")) return false;
    return depth == 0 || parts(name.substr(prefix.size() + 1)) <= depth;
  });
}

/// Returns how many parameters or prefixes a request names.
template <class Request>
std::size_t count_of(const Request& request) {
  if constexpr (requires { request.names; })
    return request.names.size();
  else if constexpr (requires { request.parameters; })
    return request.parameters.size();
  else
    return request.prefixes.size();
}

/// Makes a service of a function from request to response.
template <class Request, class Response>
NodeService service(std::string name, std::function<Response(const Request&)> answer) {
  return {std::move(name), &message_type<Request>(), &message_type<Response>(),
          [answer = std::move(answer)](std::string_view cdr) -> Outcome<std::string> {
            const auto request = decode<Request>(MessageEncoding::cdr, cdr);
            if (!request) return pass_on(request);
            if (const std::size_t count = count_of(*request); count > most_parameters_asked) {
              return bad_input(fmt::format("the request names {} parameters; ask for at most {} at once",
                                           count, most_parameters_asked));
            }
            return encode(MessageEncoding::cdr, answer(*request));
          }};
}

}  // namespace

NodeParameters::NodeParameters(std::vector<OptionGroup> groups) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string name =
          group.name.empty() ? option.name : fmt::format("{}.{}", group.name, option.name);
      if (find(name) != nullptr) continue;
      const ParameterValue value = value_of(option);
      entries_.push_back({descriptor_of(name, option, value.type_id), value});
    }
  }
}

const NodeParameters::Entry* NodeParameters::find(std::string_view name) const {
  const auto found =
      std::ranges::find_if(entries_, [&](const Entry& entry) { return entry.descriptor.name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

ListParametersResponse NodeParameters::list(const ListParametersRequest& request) const {
  ListParametersResponse response;
  auto& [names, prefixes] = response.result;
  for (const Entry& entry : entries_) {
    const std::string& name = entry.descriptor.name;
    if (!listed(name, request.prefixes, request.depth)) continue;
    names.push_back(name);
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) continue;
    if (const std::string prefix = name.substr(0, dot); std::ranges::find(prefixes, prefix) == prefixes.end())
      prefixes.push_back(prefix);
  }
  return response;
}

GetParametersResponse NodeParameters::get(const GetParametersRequest& request) const {
  GetParametersResponse response;
  for (const std::string& name : request.names) {
    const Entry* entry = find(name);
    response.values.push_back(entry == nullptr ? ParameterValue{} : entry->value);
  }
  return response;
}

GetParameterTypesResponse NodeParameters::types(const GetParameterTypesRequest& request) const {
  GetParameterTypesResponse response;
  for (const std::string& name : request.names) {
    const Entry* entry = find(name);
    response.types.push_back(entry == nullptr ? no_parameter : entry->value.type_id);
  }
  return response;
}

DescribeParametersResponse NodeParameters::describe(const DescribeParametersRequest& request) const {
  DescribeParametersResponse response;
  for (const std::string& name : request.names) {
    const Entry* entry = find(name);
    response.descriptors.push_back(entry == nullptr ? ParameterDescriptor{} : entry->descriptor);
    response.descriptors.back().name = name;
  }
  return response;
}

SetParametersResult NodeParameters::set_one(const Parameter& parameter) const {
  const Entry* entry = find(parameter.name);
  if (entry == nullptr) {
    std::vector<std::string> known;
    for (const Entry& one : entries_) known.push_back(one.descriptor.name);
    const std::string shown = excerpt(parameter.name);
    const std::string nearest = nearest_name(shown, known);
    return {false, nearest.empty()
                       ? fmt::format("there is no parameter '{}'", shown)
                       : fmt::format("there is no parameter '{}'; did you mean '{}'?", shown, nearest)};
  }
  if (same(entry->value, parameter.value)) return {true, {}};
  return {false, fmt::format("'{}' cannot change while the node runs; start it anew with another value",
                             parameter.name)};
}

SetParametersResponse NodeParameters::set(const SetParametersRequest& request) const {
  SetParametersResponse response;
  for (const Parameter& parameter : request.parameters) response.results.push_back(set_one(parameter));
  return response;
}

std::vector<NodeService> NodeParameters::services() const {
  const auto atomically = [self = *this](const SetParametersAtomicallyRequest& request) {
    const auto each = self.set({request.parameters});
    const auto refused = std::ranges::find(each.results, false, &SetParametersResult::successful);
    return SetParametersAtomicallyResponse{refused == each.results.end() ? SetParametersResult{true, {}}
                                                                         : *refused};
  };
  return {service<ListParametersRequest, ListParametersResponse>(
              "list_parameters", [self = *this](const auto& request) { return self.list(request); }),
          service<GetParametersRequest, GetParametersResponse>(
              "get_parameters", [self = *this](const auto& request) { return self.get(request); }),
          service<GetParameterTypesRequest, GetParameterTypesResponse>(
              "get_parameter_types", [self = *this](const auto& request) { return self.types(request); }),
          service<DescribeParametersRequest, DescribeParametersResponse>(
              "describe_parameters", [self = *this](const auto& request) { return self.describe(request); }),
          service<SetParametersRequest, SetParametersResponse>(
              "set_parameters", [self = *this](const auto& request) { return self.set(request); }),
          service<SetParametersAtomicallyRequest, SetParametersAtomicallyResponse>(
              "set_parameters_atomically", atomically)};
}

}  // namespace outrider
