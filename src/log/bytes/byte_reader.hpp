// Reads little-endian numbers and texts from bytes, and never past their end.
//
// After a read past the end ok() is false, at_end() is true, every number is 0 and every text is empty: a
// decoder reads all of its fields and asks once.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace outrider {

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <std::unsigned_integral T>
  T number() {
    const std::string_view read = take(sizeof(T));
    T value = 0;
    for (std::size_t i = read.size(); i-- > 0;) {
      value = static_cast<T>((std::uint64_t{value} << 8U) | static_cast<unsigned char>(read[i]));
    }
    return value;
  }

  std::string_view take(std::uint64_t count) {
    if (!ok_ || count > bytes_.size() - position_) {
      ok_ = false;
      position_ = bytes_.size();
      return {};
    }
    const std::string_view read = bytes_.substr(position_, static_cast<std::size_t>(count));
    position_ += read.size();
    return read;
  }

  /// Reads a text after its length of 4 bytes.
  std::string_view text() { return take(number<std::uint32_t>()); }

  /// Reads what is left.
  std::string_view rest() { return take(bytes_.size() - position_); }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return position_ == bytes_.size(); }
  [[nodiscard]] std::size_t position() const { return position_; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace outrider
