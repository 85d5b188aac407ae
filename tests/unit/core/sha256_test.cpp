// The hashes are those of FIPS 180-4, its examples, and of Python's hashlib.
#include "outrider/core/sha256.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(Sha256, KnownHashes) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/// hashlib.sha256("".join(hashlib.sha256(b"x" * n).hexdigest() for n in range(200)).encode()).hexdigest()
TEST(Sha256, EveryLengthAboutABlock) {
  std::string all;
  for (std::size_t n = 0; n < 200; ++n) all += sha256(std::string(n, 'x'));
  EXPECT_EQ(sha256(all), "f61ffcc417e1f0e59eba2da7fa32fbe05b64e478b68c6bacf990455f00248b98");
}

TEST(Sha256, PiecesAreTheWhole) {
  const std::string text(777, 'q');
  for (std::size_t piece : {1U, 7U, 63U, 64U, 65U, 500U}) {
    Sha256 hash;
    for (std::size_t i = 0; i < text.size(); i += piece) {
      hash.add(std::string_view(text).substr(i, piece));
      if (i % 3 == 0) (void)hash.hex();  // asking does not end it
    }
    EXPECT_EQ(hash.hex(), sha256(text)) << piece;
  }
}

}  // namespace
}  // namespace outrider
