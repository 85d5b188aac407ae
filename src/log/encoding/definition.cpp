#include "encoding/definition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

/// The names of ROS 1 and of older definitions.
constexpr std::array<std::array<std::string_view, 2>, 5> other_names = {
    {{"time", "builtin_interfaces/Time"},
     {"duration", "builtin_interfaces/Duration"},
     {"Header", "std_msgs/Header"},
     {"char", "uint8"},
     {"byte", "uint8"}}};

bool is_primitive(std::string_view type) {
  constexpr std::array<std::string_view, 13> names = {"bool",    "int8",   "uint8",  "int16",  "uint16",
                                                      "int32",   "uint32", "int64",  "uint64", "float32",
                                                      "float64", "string", "wstring"};
  return std::find(names.begin(), names.end(), type) != names.end();
}

/// The name of a type in a definition of the package.
std::string full_name(std::string_view type, std::string_view package) {
  for (const auto& [other, name] : other_names) {
    if (type == other) return std::string(name);
  }
  if (is_primitive(type)) return std::string(type);
  if (type.find('/') != std::string_view::npos) return short_name(type);
  return fmt::format("{}/{}", package, type);
}

/// Splits "float64[36]" into the type and the shape. Texts and sequences may be bounded: "string<=10[<=3]".
std::optional<DefinedField> parse_type(std::string_view word, std::string_view package) {
  DefinedField field;
  const std::size_t bracket = word.find('[');
  std::string_view type = word.substr(0, bracket);
  type = type.substr(0, type.find("<="));
  if (type.empty()) return std::nullopt;
  field.type = full_name(type, package);
  if (bracket == std::string_view::npos) return field;
  std::string_view count = word.substr(bracket + 1);
  if (!count.ends_with(']')) return std::nullopt;
  count.remove_suffix(1);
  if (count.empty() || count.starts_with("<=")) {
    field.shape = FieldShape::sequence;
    return field;
  }
  field.shape = FieldShape::array;
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), field.length);
  if (error != std::errc() || end != count.data() + count.size()) return std::nullopt;
  return field;
}

struct Line {
  bool wrong = false;
  std::optional<DefinedField> field = {};  ///< nothing: a constant, a comment, or an empty line
};

Line parse_line(std::string_view line, std::string_view package) {
  line = trimmed(line.substr(0, line.find('#')));
  if (line.empty()) return {};
  const std::size_t space = line.find_first_of(" \t");
  if (space == std::string_view::npos) return {.wrong = true};
  auto field = parse_type(line.substr(0, space), package);
  const std::string_view rest = trimmed(line.substr(space));
  const std::size_t end = rest.find_first_of(" \t=");
  const std::string_view after = end == std::string_view::npos ? "" : trimmed(rest.substr(end));
  if (after.starts_with('=')) return {};
  if (!field) return {.wrong = true};
  field->name = rest.substr(0, end);
  return {.field = std::move(field)};
}

/// The package of a type comes before each field of it, so a long name would grow with every line.
bool is_long(std::string_view name) { return name.size() > 255; }

std::string_view package_of(std::string_view name) { return name.substr(0, name.find('/')); }

}  // namespace

std::string short_name(std::string_view name) {
  std::string result(name);
  if (const auto at = result.find("/msg/"); at != std::string::npos) result.erase(at, 4);
  return result;
}

Outcome<Definitions> parse_definitions(std::string_view text, std::string_view type) {
  if (text.size() > largest_schema) {
    return bad_input(
        fmt::format("it has {} bytes, more than the {} that are read", text.size(), largest_schema));
  }
  if (is_long(type)) return bad_input("its type has a name of more than 255 bytes");
  Definitions all;
  std::string name = short_name(type);
  auto* fields = &all[name];
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with("====")) continue;
    if (line.starts_with("MSG:")) {
      name = short_name(trimmed(line.substr(4)));
      if (is_long(name))
        return bad_input(fmt::format("its line {} names a type by more than 255 bytes", number));
      fields = &all[name];
      fields->clear();  // a type that is defined again counts as its last definition
      continue;
    }
    Line parsed = parse_line(line, package_of(name));
    if (parsed.wrong) {
      return bad_input(fmt::format("its line {} is no field: '{}'", number, excerpt(line)));
    }
    if (parsed.field) fields->push_back(std::move(*parsed.field));
  }
  return all;
}

}  // namespace outrider
