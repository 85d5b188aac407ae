#include "encoding/schema_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "encoding/definition.hpp"
#include "encoding/field_words.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr std::string_view time_type = "builtin_interfaces/Time";
constexpr std::string_view plain_header = "std_msgs/Header";

std::string words_of(const DefinedField& field) {
  std::string type = field.type;
  if (field.shape == FieldShape::array) type += fmt::format("[{}]", field.length);
  if (field.shape == FieldShape::sequence) type += "[]";
  return excerpt(type + " " + field.name);
}

class Comparison {
 public:
  Comparison(const Definitions& definitions, bool ros1) : definitions_(definitions), ros1_(ros1) {}

  /// Returns what is wrong, or an empty text.
  std::string compare(const MessageType& type) {
    const std::string name = short_name(type.name);
    if (!compared_.insert(name).second) return {};
    const auto found = definitions_.find(name);
    if (found == definitions_.end()) {
      if (name == time_type) return {};  // a primitive type in ROS 1
      return fmt::format("it does not define {}", name);
    }
    std::span<const DefinedField> fields = found->second;
    if (ros1_ && name == plain_header) {
      if (fields.empty() || fields[0].name != "seq" || fields[0].type != "uint32")
        return "its Header has no 'seq'";
      fields = fields.subspan(1);
    }
    return compare(type, fields);
  }

 private:
  std::string compare(const MessageType& type, std::span<const DefinedField> fields) {
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      const MessageField& expected = type.fields[i];
      const std::string words = field_words(expected);
      if (i >= fields.size()) return fmt::format("its {} has no field '{}'", short_name(type.name), words);
      if (!agrees(fields[i], expected)) {
        return fmt::format("field {} of its {} is '{}', and not '{}'", i + 1, short_name(type.name),
                           words_of(fields[i]), words);
      }
      if (expected.message == nullptr) continue;
      if (auto wrong = compare(*expected.message); !wrong.empty()) return wrong;
    }
    if (fields.size() == type.fields.size()) return {};
    return fmt::format("its {} has one more field, '{}'", short_name(type.name),
                       words_of(fields[type.fields.size()]));
  }

  [[nodiscard]] bool agrees(const DefinedField& field, const MessageField& expected) const {
    const bool same_name = ros1_
                               ? std::ranges::equal(field.name, expected.name, {}, lower_letter, lower_letter)
                               : field.name == expected.name;
    return same_name && field.type == type_word(expected) && field.shape == expected.shape &&
           (field.shape != FieldShape::array || field.length == expected.array_length);
  }

  const Definitions& definitions_;
  bool ros1_;
  std::set<std::string> compared_ = {};
};

std::string find_difference(const Channel& channel, const MessageType& type) {
  auto definitions = parse_definitions(channel.schema, type.name);
  if (!definitions) return definitions.error().sentence;
  return Comparison(*definitions, channel.schema_encoding == "ros1msg").compare(type);
}

}  // namespace

Status check_schema(const Channel& channel, const MessageType& type) {
  if (channel.schema.empty()) return {};
  if (channel.schema_encoding == "jsonschema") return check_json_schema(channel.schema, type);
  if (channel.schema_encoding != "ros1msg" && channel.schema_encoding != "ros2msg") return {};
  const std::string difference = find_difference(channel, type);
  if (difference.empty()) return {};
  return bad_input(fmt::format("its schema is not that of {}: {}; record it with the standard message",
                               type.name, difference));
}

}  // namespace outrider
