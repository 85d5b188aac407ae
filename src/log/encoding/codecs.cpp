#include "outrider/log/encoding/codecs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "encoding/json_codec.hpp"

namespace outrider {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

constexpr std::string_view cdr_head{"\0\1\0\0", 4};  // XCDR1, little-endian, no options
constexpr std::string_view header_type = "std_msgs/msg/Header";
constexpr std::size_t largest_padding = 3;  // that may follow a CDR message

/// Returns the least number of bytes that a value takes.
std::size_t least_bytes(const MessageField& field) {
  if (field.kind == FieldKind::text) return sizeof(std::uint32_t);
  if (field.kind != FieldKind::message) return field.element_bytes;
  std::size_t sum = 0;
  for (const MessageField& inner : field.message->fields) {
    if (inner.shape == FieldShape::sequence)
      sum += sizeof(std::uint32_t);
    else
      sum += inner.array_length * least_bytes(inner);
  }
  return sum;
}

std::size_t padding(std::size_t position, std::size_t alignment) {
  return (alignment - position % alignment) % alignment;
}

class Encoder {
 public:
  explicit Encoder(MessageEncoding encoding) : encoding_(encoding) {
    if (encoding == MessageEncoding::cdr) bytes_ = cdr_head;
  }

  void message(const MessageType& type, const char* at) {
    if (encoding_ == MessageEncoding::ros1 && type.name == header_type) number(std::uint32_t{0});  // seq
    for (const MessageField& field : type.fields) this->field(field, at + field.offset);
  }

  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  void field(const MessageField& field, const char* at) {
    if (field.shape != FieldShape::sequence) return elements(field, at, field.array_length);
    const std::size_t length = field.length(at);
    number(static_cast<std::uint32_t>(length));
    if (length > 0) elements(field, static_cast<const char*>(field.elements(at)), length);
  }

  void elements(const MessageField& field, const char* at, std::size_t count) {
    if (field.kind != FieldKind::text && field.kind != FieldKind::message) return numbers(field, at, count);
    for (std::size_t i = 0; i < count; ++i, at += field.element_bytes) {
      if (field.kind == FieldKind::message)
        message(*field.message, at);
      else
        text(*reinterpret_cast<const std::string*>(at));
    }
  }

  void numbers(const MessageField& field, const char* at, std::size_t count) {
    align(field.element_bytes);
    bytes_.append(at, count * field.element_bytes);
  }

  void number(std::uint32_t value) {
    align(sizeof value);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  void text(const std::string& text) {
    const bool terminated = encoding_ == MessageEncoding::cdr;
    number(static_cast<std::uint32_t>(text.size() + (terminated ? 1 : 0)));
    bytes_ += text;
    if (terminated) bytes_ += '\0';
  }

  void align(std::size_t alignment) {
    if (encoding_ == MessageEncoding::cdr)
      bytes_.append(padding(bytes_.size() - cdr_head.size(), alignment), '\0');
  }

  MessageEncoding encoding_;
  std::string bytes_;
};

class Decoder {
 public:
  /// `bytes` without the head of CDR.
  Decoder(MessageEncoding encoding, std::string_view bytes) : encoding_(encoding), bytes_(bytes) {}

  bool message(const MessageType& type, char* at) {
    std::uint32_t seq = 0;
    if (encoding_ == MessageEncoding::ros1 && type.name == header_type && !number(seq)) return false;
    return std::all_of(type.fields.begin(), type.fields.end(),
                       [&](const MessageField& field) { return this->field(field, at + field.offset); });
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size() - position_; }
  [[nodiscard]] std::size_t position() const { return position_; }

 private:
  bool field(const MessageField& field, char* at) {
    if (field.shape != FieldShape::sequence) return elements(field, at, field.array_length);
    std::uint32_t length = 0;
    if (!number(length)) return false;
    if (length > left() / std::max<std::size_t>(1, least_bytes(field))) return false;
    char* first = static_cast<char*>(field.resize(at, length));
    return length == 0 || elements(field, first, length);
  }

  bool elements(const MessageField& field, char* at, std::size_t count) {
    if (field.kind != FieldKind::text && field.kind != FieldKind::message) return numbers(field, at, count);
    for (std::size_t i = 0; i < count; ++i, at += field.element_bytes) {
      if (field.kind == FieldKind::message ? !message(*field.message, at)
                                           : !text(*reinterpret_cast<std::string*>(at))) {
        return false;
      }
    }
    return true;
  }

  bool numbers(const MessageField& field, char* at, std::size_t count) {
    if (!align(field.element_bytes) || left() < count * field.element_bytes) return false;
    if (field.kind == FieldKind::boolean) return booleans(at, count);
    std::memcpy(at, bytes_.data() + position_, count * field.element_bytes);
    position_ += count * field.element_bytes;
    return true;
  }

  /// A bool in memory is 0 or 1, whatever the byte.
  bool booleans(char* at, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      *reinterpret_cast<bool*>(at + i) = bytes_[position_++] != '\0';
    }
    return true;
  }

  bool number(std::uint32_t& value) {
    if (!align(sizeof value) || left() < sizeof value) return false;
    std::memcpy(&value, bytes_.data() + position_, sizeof value);
    position_ += sizeof value;
    return true;
  }

  bool text(std::string& text) {
    std::uint32_t length = 0;
    if (!number(length) || left() < length) return false;
    const bool terminated = encoding_ == MessageEncoding::cdr;
    if (terminated && (length == 0 || bytes_[position_ + length - 1] != '\0')) return false;
    text = bytes_.substr(position_, length - (terminated ? 1 : 0));
    position_ += length;
    return true;
  }

  bool align(std::size_t alignment) {
    const std::size_t skipped = encoding_ == MessageEncoding::cdr ? padding(position_, alignment) : 0;
    if (left() < skipped) return false;
    position_ += skipped;
    return true;
  }

  MessageEncoding encoding_;
  std::string_view bytes_;
  std::size_t position_ = 0;
};

}  // namespace

std::optional<MessageEncoding> encoding_named(std::string_view name) {
  if (name == "cdr") return MessageEncoding::cdr;
  if (name == "ros1") return MessageEncoding::ros1;
  if (name == "json") return MessageEncoding::json;
  return std::nullopt;
}

std::string encode(MessageEncoding encoding, const MessageType& type, const void* message) {
  if (encoding == MessageEncoding::json) return encode_json(type, message);
  Encoder encoder(encoding);
  encoder.message(type, static_cast<const char*>(message));
  return encoder.take();
}

Status decode(MessageEncoding encoding, const MessageType& type, std::string_view bytes, void* message) {
  if (encoding == MessageEncoding::json) return decode_json(type, bytes, message);
  if (encoding == MessageEncoding::cdr) {
    if (!bytes.starts_with(cdr_head.substr(0, 2))) {
      return bad_input(fmt::format("a {} is not encoded as little-endian CDR", type.name));
    }
    if (bytes.size() < cdr_head.size()) return bad_input(fmt::format("a {} ends too early", type.name));
    bytes.remove_prefix(cdr_head.size());
  }
  Decoder decoder(encoding, bytes);
  if (!decoder.message(type, static_cast<char*>(message))) {
    return bad_input(fmt::format("a {} of {} bytes does not hold its fields from byte {} on", type.name,
                                 bytes.size(), decoder.position()));
  }
  if (decoder.left() > (encoding == MessageEncoding::cdr ? largest_padding : 0)) {
    return bad_input(fmt::format("a {} has {} bytes more than its fields", type.name, decoder.left()));
  }
  return {};
}

}  // namespace outrider
