// SHA-256: the hash by which files are recognised. Source: FIPS 180-4.
//
//   Sha256 hash;
//   hash.add(bytes);
//   hash.hex()  // 64 digits
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace outrider {

/// Hashes bytes as they come, in constant memory. Thread rule: one thread at a time.
class Sha256 {
 public:
  /// Appends bytes. O(bytes).
  void add(std::string_view bytes);
  /// Returns the hash of all bytes so far in hexadecimal. More bytes may follow.
  [[nodiscard]] std::string hex() const;

 private:
  void block(const unsigned char* bytes);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> rest_{};  ///< bytes of the block that is not complete
  std::uint64_t bytes_ = 0;
};

/// Returns the hash of the bytes in hexadecimal.
std::string sha256(std::string_view bytes);

}  // namespace outrider
