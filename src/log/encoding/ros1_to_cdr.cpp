#include "encoding/ros1_to_cdr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ranges>
#include <set>
#include <span>

#include "outrider/core/text.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"

namespace outrider {
namespace {

constexpr std::string_view ros1_header = "std_msgs/Header";
constexpr int most_levels = 32;

constexpr std::array<std::pair<std::string_view, std::size_t>, 11> sizes = {{{"bool", 1},
                                                                             {"int8", 1},
                                                                             {"uint8", 1},
                                                                             {"int16", 2},
                                                                             {"uint16", 2},
                                                                             {"int32", 4},
                                                                             {"uint32", 4},
                                                                             {"int64", 8},
                                                                             {"uint64", 8},
                                                                             {"float32", 4},
                                                                             {"float64", 8}}};

/// Returns the size of a number; 0 for other types.
std::size_t size_of(std::string_view type) {
  const auto found = std::ranges::find(sizes, type, &std::pair<std::string_view, std::size_t>::first);
  return found == sizes.end() ? 0 : found->second;
}

/// Times are two numbers of four bytes.
bool is_time(std::string_view type) {
  return type == "builtin_interfaces/Time" || type == "builtin_interfaces/Duration";
}

bool is_message(std::string_view type) { return size_of(type) == 0 && type != "string" && !is_time(type); }

std::span<const DefinedField> ros2_fields(std::string_view name, const std::vector<DefinedField>& fields) {
  return std::span(fields).subspan(name == ros1_header ? 1 : 0);  // without "seq"
}

class Conversion {
 public:
  Conversion(const Definitions& definitions, std::string_view bytes)
      : definitions_(definitions), bytes_(bytes), steps_left_(10 * bytes.size() + 10000) {}

  bool message(std::string_view name, int level = 0) {
    const auto& fields = definitions_.find(name)->second;
    if (level > most_levels) return false;
    if (name == ros1_header) take(4);
    const auto kept = ros2_fields(name, fields);
    if (kept.empty()) out_ += '\0';
    return ok_ && std::ranges::all_of(kept, [&](const DefinedField& each) { return field(each, level); });
  }

  [[nodiscard]] bool at_end() const { return position_ == bytes_.size(); }
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::string take_out() { return std::string{"\0\1\0\0", 4} + out_; }

 private:
  bool field(const DefinedField& field, int level) {
    std::size_t count = field.length;
    if (field.shape == FieldShape::sequence) count = length();
    if (const std::size_t size = size_of(field.type); size > 0) return copy(size, count);
    if (is_time(field.type)) return copy(4, 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      if (steps_left_-- == 0) return false;  // elements without bytes may be very many
      if (field.type == "string" ? !text() : !message(field.type, level + 1)) return false;
    }
    return ok_;
  }

  bool copy(std::size_t size, std::size_t count) {
    if (steps_left_-- == 0 || count > (bytes_.size() - position_) / size) return ok_ = false;
    if (count > 0) align(size);
    out_ += take(size * count);
    return ok_;
  }

  bool text() {
    const std::size_t size = read_length();
    append_length(size + 1);
    out_ += take(size);
    out_ += '\0';
    return ok_;
  }

  std::size_t length() {
    const std::size_t value = read_length();
    append_length(value);
    return ok_ ? value : 0;
  }

  std::size_t read_length() {
    std::uint32_t value = 0;
    if (const std::string_view four = take(4); four.size() == 4) std::memcpy(&value, four.data(), 4);
    return value;
  }

  void append_length(std::size_t value) {
    align(4);
    const auto four = static_cast<std::uint32_t>(value);
    out_.append(reinterpret_cast<const char*>(&four), 4);
  }

  void align(std::size_t size) { out_.append((size - out_.size() % size) % size, '\0'); }

  std::string_view take(std::size_t count) {
    if (!ok_ || count > bytes_.size() - position_) {
      ok_ = false;
      return {};
    }
    position_ += count;
    return bytes_.substr(position_ - count, count);
  }

  const Definitions& definitions_;
  std::string_view bytes_;
  std::size_t position_ = 0;
  std::size_t steps_left_;
  std::string out_;
  bool ok_ = true;
};

/// Lists the types that a type uses, itself first, each before those of its fields. Returns a name that is
/// not defined, or an empty text.
std::string collect(const Definitions& definitions, const std::string& name, std::vector<std::string>& used) {
  std::set<std::string_view> seen;
  std::vector<std::string_view> open = {name};
  while (!open.empty()) {
    const std::string_view next = open.back();
    open.pop_back();
    if (!seen.insert(next).second) continue;
    const auto found = definitions.find(next);
    if (found == definitions.end()) return std::string(next);
    used.emplace_back(next);
    for (const DefinedField& field : found->second | std::views::reverse) {
      if (is_message(field.type)) open.push_back(field.type);
    }
  }
  return {};
}

std::string field_line(const DefinedField& field) {
  std::string name = field.name;
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  std::string shape;
  if (field.shape == FieldShape::array) shape = fmt::format("[{}]", field.length);
  if (field.shape == FieldShape::sequence) shape = "[]";
  return fmt::format("{}{} {}\n", field.type, shape, name);
}

std::string ros2_text(const Definitions& definitions, const std::vector<std::string>& used) {
  std::string text;
  bool has_time = false, has_duration = false;
  for (const std::string& name : used) {
    if (!text.empty()) text += fmt::format("{}\nMSG: {}\n", std::string(80, '='), name);
    for (const DefinedField& field : ros2_fields(name, definitions.find(name)->second)) {
      text += field_line(field);
      has_time = has_time || field.type == "builtin_interfaces/Time";
      has_duration = has_duration || field.type == "builtin_interfaces/Duration";
    }
    if (text.empty()) text += '\n';  // a type without fields
  }
  for (const auto& [has, name] : {std::pair(has_time, "Time"), std::pair(has_duration, "Duration")}) {
    if (!has) continue;
    text += fmt::format("{}\nMSG: builtin_interfaces/{}\nint32 sec\nuint32 nanosec\n", std::string(80, '='),
                        name);
  }
  return text;
}

}  // namespace

Outcome<Ros1ToCdr> Ros1ToCdr::of(const Channel& channel) {
  const std::string topic = printable(channel.topic);
  if (channel.schema.empty()) return bad_input("it has no schema", topic);
  auto definitions = parse_definitions(channel.schema, ros2_type_name(channel.type));
  if (!definitions) return bad_input("its schema is wrong: " + definitions.error().sentence, topic);
  Ros1ToCdr made;
  made.channel_ = {channel.topic, ros2_type_name(channel.type), "cdr", "ros2msg", {}};
  made.type_ = short_name(made.channel_.type);
  std::vector<std::string> used;
  if (const auto missing = collect(*definitions, made.type_, used); !missing.empty()) {
    return bad_input(fmt::format("its schema does not define {}", excerpt(missing)), topic);
  }
  const auto header = definitions->find(ros1_header);
  if (header != definitions->end() && (header->second.empty() || header->second[0].name != "seq")) {
    return bad_input("its schema has a Header without 'seq'", topic);
  }
  made.channel_.schema = ros2_text(*definitions, used);
  made.definitions_ = std::move(*definitions);
  return made;
}

Outcome<std::string> Ros1ToCdr::convert(std::string_view ros1) const {
  Conversion conversion(definitions_, ros1);
  if (conversion.message(type_) && conversion.at_end()) return conversion.take_out();
  return bad_input(
      fmt::format("a {} of {} bytes does not hold its fields from byte {} on, or they nest more than {} deep",
                  channel_.type, ros1.size(), conversion.position(), most_levels),
      printable(channel_.topic));
}

}  // namespace outrider
