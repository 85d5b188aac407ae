// ByteCursor: reads little-endian numbers and texts from bytes, never beyond their end.
//
// A read beyond the end gives zeros and makes ok() false for good: so read all, then ask once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace outrider {

class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }
  [[nodiscard]] std::size_t position() const { return at_; }

  std::string_view text(std::size_t length) {
    if (length > bytes_.size() - at_) {
      ok_ = false;
      at_ = bytes_.size();
      return {};
    }
    at_ += length;
    return bytes_.substr(at_ - length, length);
  }
  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }

 private:
  std::uint64_t number(std::size_t length) {
    std::uint64_t value = 0;
    const std::string_view digits = text(length);
    for (std::size_t i = digits.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(digits[i]);
    return value;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace outrider
