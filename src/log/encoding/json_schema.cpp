#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "encoding/definition.hpp"
#include "encoding/schema_check.hpp"
#include "outrider/core/json_excess.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

using json = nlohmann::json;

/// Returns true if a JSON schema may describe an element of the field.
bool may_be(const json& schema, const MessageField& field) {
  const auto type = schema.find("type");
  if (type == schema.end() || !type->is_string()) return true;
  const std::string& name = type->get_ref<const std::string&>();
  switch (field.kind) {
    case FieldKind::boolean: return name == "boolean";
    case FieldKind::text: return name == "string";
    case FieldKind::message: return name == "object";
    default: return name == "number" || name == "integer";
  }
}

std::string compare(const json& schema, const MessageType& type);

std::string compare_field(const json& schema, const MessageField& field) {
  const json* element = &schema;
  if (field.shape != FieldShape::single) {
    const auto items = schema.find("items");
    if (schema.value("type", json("array")) == "string")
      return field.element_bytes == 1 ? "" : "it is a text";
    if (schema.value("type", json("array")) != "array") return "it is no list";
    if (items == schema.end() || !items->is_object()) return {};
    element = &*items;
  }
  if (!may_be(*element, field))
    return fmt::format("it is of the type {}", excerpt(element->value("type", "")));
  return field.message == nullptr ? std::string() : compare(*element, *field.message);
}

/// Returns what is wrong, or an empty text.
std::string compare(const json& schema, const MessageType& type) {
  const auto properties = schema.find("properties");
  if (properties == schema.end() || !properties->is_object()) return {};
  for (const MessageField& field : type.fields) {
    const auto found = properties->find(field.name);
    if (found == properties->end() || !found->is_object()) continue;  // the messages must have it
    const std::string wrong = compare_field(*found, field);
    if (!wrong.empty()) return fmt::format("'{}': {}", field.name, wrong);
  }
  return {};
}

}  // namespace

Status check_json_schema(std::string_view schema, const MessageType& type) {
  const auto refuse = [&](const std::string& what) {
    return bad_input(fmt::format("its schema is not that of {}: {}; record it with the standard message",
                                 type.name, what));
  };
  if (schema.size() > largest_schema) return refuse(fmt::format("it has {} bytes", schema.size()));
  if (const auto why = json_excess(schema); !why.empty()) return refuse(std::string(why));
  const json parsed = json::parse(schema, nullptr, false);
  if (!parsed.is_object()) return refuse("it is no JSON object");
  const std::string wrong = compare(parsed, type);
  return wrong.empty() ? Status{} : refuse(wrong);
}

}  // namespace outrider
