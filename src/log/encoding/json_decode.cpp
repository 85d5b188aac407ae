#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "encoding/json_codec.hpp"
#include "outrider/core/base64.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

bool is_real(FieldKind kind) { return kind == FieldKind::float32 || kind == FieldKind::float64; }

/// Returns true if a key is the name of the field, in ROS 2 or in ROS 1.
bool is_name_of(const MessageField& field, std::string_view key) {
  if (std::ranges::equal(field.name, key, {}, lower_letter, lower_letter)) return true;
  if (field.name == "sec") return key == "secs";
  return field.name == "nanosec" && (key == "nsec" || key == "nsecs");
}

/// Stores a number if the type holds it.
template <class Stored, class Number>
bool store(char* at, Number value) {
  if constexpr (std::is_floating_point_v<Stored>) {
    const auto stored = static_cast<Stored>(value);
    std::memcpy(at, &stored, sizeof stored);
    return true;
  } else if constexpr (std::is_floating_point_v<Number>) {
    constexpr double most = 9007199254740992.0;  // 2^53: whole numbers are exact up to it
    if (!(std::abs(value) <= most) || value != std::floor(value)) return false;
    return store<Stored>(at, static_cast<std::int64_t>(value));
  } else {
    if (!std::in_range<Stored>(value)) return false;
    const auto stored = static_cast<Stored>(value);
    std::memcpy(at, &stored, sizeof stored);
    return true;
  }
}

template <class Number>
bool store(FieldKind kind, char* at, Number value) {
  switch (kind) {
    case FieldKind::int8: return store<std::int8_t>(at, value);
    case FieldKind::uint8: return store<std::uint8_t>(at, value);
    case FieldKind::int16: return store<std::int16_t>(at, value);
    case FieldKind::uint16: return store<std::uint16_t>(at, value);
    case FieldKind::int32: return store<std::int32_t>(at, value);
    case FieldKind::uint32: return store<std::uint32_t>(at, value);
    case FieldKind::int64: return store<std::int64_t>(at, value);
    case FieldKind::uint64: return store<std::uint64_t>(at, value);
    case FieldKind::float32: return store<float>(at, value);
    case FieldKind::float64: return store<double>(at, value);
    default: return false;
  }
}

/// Receives the parts of a JSON text in their order, and stores them in a message. The names of its functions
/// are those that nlohmann::json::sax_parse() calls; false stops the parser.
class JsonDecoder {
 public:
  using json = nlohmann::json;

  JsonDecoder(const MessageType& type, char* at) : type_(type), at_(at) {}

  bool null() { return put_number(std::numeric_limits<double>::quiet_NaN(), "null"); }
  bool boolean(bool value) {
    const Place place = next();
    if (place.field == nullptr) return false;
    if (place.whole || place.field->kind != FieldKind::boolean) return refuse("a truth value");
    *reinterpret_cast<bool*>(place.at) = value;
    return true;
  }
  bool number_integer(json::number_integer_t value) { return put_number(value, "a negative number"); }
  bool number_unsigned(json::number_unsigned_t value) { return put_number(value, "a number"); }
  bool number_float(json::number_float_t value, const std::string& /*text*/) {
    return put_number(value, "a number");
  }
  bool string(std::string& value);
  bool binary(json::binary_t& /*value*/) { return false; }
  bool start_object(std::size_t /*length*/);
  bool key(std::string& name);
  bool end_object();
  bool start_array(std::size_t /*length*/);
  bool end_array();
  bool parse_error(std::size_t position, const std::string& /*token*/, const std::exception& /*exception*/) {
    if (complaint_.empty()) complaint_ = fmt::format("it is not JSON from byte {} on", position);
    return false;
  }

  [[nodiscard]] const std::string& complaint() const { return complaint_; }

 private:
  /// An object that is read, and the field of it that comes next.
  struct Level {
    const MessageType* type = nullptr;
    char* at = nullptr;
    const MessageField* field = nullptr;  ///< null: a header's "seq", which is skipped
    std::uint64_t seen = 0;               ///< a bit for each field
    bool in_array = false;
    std::size_t count = 0;  ///< elements of the array so far
  };
  /// The destination of a value.
  struct Place {
    const MessageField* field = nullptr;  ///< null: nowhere, and there is a complaint
    char* at = nullptr;
    bool whole = false;  ///< the value is the whole of a sequence or array
  };

  bool enter(const MessageType& type, char* at);
  Place next();
  template <class Number>
  bool put_number(Number value, std::string_view what);
  bool put_bytes(const Place& place, const std::string& text);
  bool complain(std::string sentence) {
    complaint_ = std::move(sentence);
    return false;
  }
  bool refuse(std::string_view what) { return complain(fmt::format("its field '{}' is {}", path(), what)); }
  [[nodiscard]] std::string path() const;

  const MessageType& type_;
  char* at_;
  std::vector<Level> levels_;
  bool skipping_ = false;  ///< the next value is a header's "seq"
  std::string complaint_;
};

std::string JsonDecoder::path() const {
  std::string path;
  for (const Level& level : levels_) {
    if (level.field == nullptr) continue;
    path += fmt::format("{}{}", path.empty() ? "" : ".", level.field->name);
    if (level.in_array && level.count > 0) path += fmt::format("[{}]", level.count - 1);
  }
  return path;
}

bool JsonDecoder::enter(const MessageType& type, char* at) {
  if (type.fields.size() > 64) throw std::logic_error("a message with more fields than `seen` has bits");
  levels_.push_back({&type, at});
  return true;
}

JsonDecoder::Place JsonDecoder::next() {
  if (levels_.empty() || skipping_) {
    complain(skipping_ ? "the 'seq' of a header is no number" : "it is no JSON object");
    return {};
  }
  Level& level = levels_.back();
  const MessageField& field = *level.field;
  char* at = level.at + field.offset;
  if (field.shape == FieldShape::single) return {&field, at, false};
  if (!level.in_array) return {&field, at, true};
  const std::size_t index = level.count++;
  if (field.shape == FieldShape::array) {
    if (index >= field.array_length) {
      complain(fmt::format("its field '{}' has more than {} elements", field.name, field.array_length));
      return {};
    }
    return {&field, at + index * field.element_bytes, false};
  }
  char* first = static_cast<char*>(field.resize(at, level.count));
  return {&field, first + index * field.element_bytes, false};
}

template <class Number>
bool JsonDecoder::put_number(Number value, std::string_view what) {
  if (std::exchange(skipping_, false)) return true;
  const Place place = next();
  if (place.field == nullptr) return false;
  if (std::is_floating_point_v<Number> && std::isnan(static_cast<double>(value)) &&
      !is_real(place.field->kind)) {
    return refuse(what);
  }
  if (!place.whole && store(place.field->kind, place.at, value)) return true;
  return refuse(fmt::format("{} that does not fit", what));
}

bool JsonDecoder::put_bytes(const Place& place, const std::string& text) {
  const bool bytes = place.field->shape == FieldShape::sequence && place.field->element_bytes == 1;
  const auto content = bytes ? base64_decoded(text) : std::nullopt;
  if (!content) return refuse(bytes ? "no base64" : "a text");
  void* first = place.field->resize(place.at, content->size());
  if (!content->empty()) std::memcpy(first, content->data(), content->size());
  return true;
}

bool JsonDecoder::string(std::string& value) {
  const Place place = next();
  if (place.field == nullptr) return false;
  if (place.whole) return put_bytes(place, value);
  if (place.field->kind == FieldKind::text) {
    *reinterpret_cast<std::string*>(place.at) = std::move(value);
    return true;
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!is_real(place.field->kind)) return refuse("a text");
  if (value == "NaN" || value == "nan") return store(place.field->kind, place.at, std::nan(""));
  if (value == "Infinity" || value == "inf") return store(place.field->kind, place.at, infinity);
  if (value == "-Infinity" || value == "-inf") return store(place.field->kind, place.at, -infinity);
  return refuse("a text");
}

bool JsonDecoder::start_object(std::size_t /*length*/) {
  if (levels_.empty()) return enter(type_, at_);
  const Place place = next();
  if (place.field == nullptr) return false;
  if (place.whole || place.field->kind != FieldKind::message) return refuse("an object");
  return enter(*place.field->message, place.at);
}

bool JsonDecoder::key(std::string& name) {
  Level& level = levels_.back();
  const auto& fields = level.type->fields;
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const MessageField& field) { return is_name_of(field, name); });
  if (found == fields.end()) {
    skipping_ = name == "seq" && level.type->name == "std_msgs/msg/Header";
    if (skipping_) return true;
    return complain(fmt::format("it has the field '{}', which {} has not", excerpt(name), level.type->name));
  }
  level.field = &*found;
  const auto bit = std::uint64_t{1} << static_cast<unsigned>(found - fields.begin());
  if ((level.seen & bit) != 0) return refuse("there twice");
  level.seen |= bit;
  return true;
}

bool JsonDecoder::end_object() {
  const Level& level = levels_.back();
  const auto missing = static_cast<std::size_t>(std::countr_one(level.seen));
  if (missing < level.type->fields.size()) {
    return complain(
        fmt::format("it has no field '{}' in its {}", level.type->fields[missing].name, level.type->name));
  }
  levels_.pop_back();
  return true;
}

bool JsonDecoder::start_array(std::size_t /*length*/) {
  if (levels_.empty()) return complain("it is no JSON object");
  Level& level = levels_.back();
  if (skipping_ || level.in_array || level.field->shape == FieldShape::single) return refuse("a list");
  level.in_array = true;
  level.count = 0;
  if (level.field->shape == FieldShape::sequence) level.field->resize(level.at + level.field->offset, 0);
  return true;
}

bool JsonDecoder::end_array() {
  Level& level = levels_.back();
  level.in_array = false;
  if (level.field->shape == FieldShape::sequence || level.count == level.field->array_length) return true;
  return refuse(fmt::format("a list of {}, where {} are expected", level.count, level.field->array_length));
}

}  // namespace

Status decode_json(const MessageType& type, std::string_view text, void* message) {
  JsonDecoder decoder(type, static_cast<char*>(message));
  if (nlohmann::json::sax_parse(text.begin(), text.end(), &decoder)) return {};
  return bad_input(fmt::format("a {} in JSON is wrong: {}", type.name, decoder.complaint()));
}

}  // namespace outrider
