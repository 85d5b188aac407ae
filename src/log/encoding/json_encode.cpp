#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>

#include "encoding/json_codec.hpp"
#include "outrider/core/base64.hpp"

namespace outrider {
namespace {

template <class Number>
Number number_at(const char* at) {
  Number value{};
  std::memcpy(&value, at, sizeof value);
  return value;
}

class JsonEncoder {
 public:
  void message(const MessageType& type, const char* at) {
    char before = '{';
    for (const MessageField& field : type.fields) {
      fmt::format_to(std::back_inserter(text_), "{}\"{}\":", before, field.name);
      this->field(field, at + field.offset);
      before = ',';
    }
    text_ += type.fields.empty() ? "{}" : "}";
  }

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void field(const MessageField& field, const char* at) {
    if (field.shape == FieldShape::single) return element(field, at);
    const bool sequence = field.shape == FieldShape::sequence;
    const std::size_t length = sequence ? field.length(at) : field.array_length;
    const char* first = sequence ? static_cast<const char*>(field.elements(at)) : at;
    if (sequence && field.kind == FieldKind::uint8) {
      text_ += '"' + base64_encoded({first, length}) + '"';
      return;
    }
    text_ += '[';
    for (std::size_t i = 0; i < length; ++i) {
      if (i > 0) text_ += ',';
      element(field, first + i * field.element_bytes);
    }
    text_ += ']';
  }

  void element(const MessageField& field, const char* at) {
    switch (field.kind) {
      case FieldKind::boolean: text_ += *at != 0 ? "true" : "false"; return;
      case FieldKind::int8: return number(int{number_at<std::int8_t>(at)});
      case FieldKind::uint8: return number(int{number_at<std::uint8_t>(at)});
      case FieldKind::int16: return number(number_at<std::int16_t>(at));
      case FieldKind::uint16: return number(number_at<std::uint16_t>(at));
      case FieldKind::int32: return number(number_at<std::int32_t>(at));
      case FieldKind::uint32: return number(number_at<std::uint32_t>(at));
      case FieldKind::int64: return number(number_at<std::int64_t>(at));
      case FieldKind::uint64: return number(number_at<std::uint64_t>(at));
      case FieldKind::float32: return real(number_at<float>(at));
      case FieldKind::float64: return real(number_at<double>(at));
      case FieldKind::text: return text(*reinterpret_cast<const std::string*>(at));
      case FieldKind::message: return message(*field.message, at);
    }
  }

  template <class Number>
  void number(Number value) {
    fmt::format_to(std::back_inserter(text_), "{}", value);
  }

  template <class Real>
  void real(Real value) {
    if (value == 0 && std::signbit(value)) {
      text_ += "-0.0";  // "-0" would be read as the integer 0
      return;
    }
    if (std::isfinite(value)) return number(value);
    text_ += std::isnan(value) ? "\"NaN\"" : value > 0 ? "\"Infinity\"" : "\"-Infinity\"";
  }

  void text(const std::string& value) {
    text_ += nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }

  std::string text_;
};

}  // namespace

std::string encode_json(const MessageType& type, const void* message) {
  JsonEncoder encoder;
  encoder.message(type, static_cast<const char*>(message));
  return encoder.take();
}

}  // namespace outrider
