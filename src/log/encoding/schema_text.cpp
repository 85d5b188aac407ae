// The text of a schema, as rosbag2 and MCAP store it: the fields of the type, then a section for each type
// used.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "encoding/definition.hpp"
#include "encoding/field_words.hpp"
#include "outrider/log/encoding/codecs.hpp"

namespace outrider {
namespace {

constexpr std::array<std::string_view, 13> kind_names = {"bool",    "int8",   "uint8", "int16",  "uint16",
                                                         "int32",   "uint32", "int64", "uint64", "float32",
                                                         "float64", "string", ""};

std::string field_line(const MessageField& field) {
  std::string line = field_words(field);
  if (!field.default_text.empty()) line += fmt::format(" {}", field.default_text);
  if (!field.unit.empty()) line += fmt::format("  # {}", field.unit);
  return line + "\n";
}

void collect(const MessageType& type, std::vector<const MessageType*>& used) {
  for (const MessageField& field : type.fields) {
    if (field.message == nullptr || std::find(used.begin(), used.end(), field.message) != used.end())
      continue;
    used.push_back(field.message);
    collect(*field.message, used);
  }
}

std::string definition(const MessageType& type) {
  std::string text;
  for (const MessageConstant& constant : type.constants) {
    text += fmt::format("{} {}={}\n", constant.type, constant.name, constant.value);
  }
  for (const MessageField& field : type.fields) text += field_line(field);
  return text;
}

}  // namespace

std::string type_word(const MessageField& field) {
  if (field.kind == FieldKind::message) return short_name(field.message->name);
  return std::string(kind_names[static_cast<std::size_t>(field.kind)]);
}

std::string field_words(const MessageField& field) {
  std::string type = type_word(field);
  if (field.shape == FieldShape::array) type += fmt::format("[{}]", field.array_length);
  if (field.shape == FieldShape::sequence) type += "[]";
  return fmt::format("{} {}", type, field.name);
}

std::string schema_text(const MessageType& type) {
  std::vector<const MessageType*> used;
  collect(type, used);
  std::string text = definition(type);
  for (const MessageType* inner : used) {
    text += fmt::format("{}\nMSG: {}\n{}", std::string(80, '='), short_name(inner->name), definition(*inner));
  }
  return text;
}

}  // namespace outrider
