// Decompression: exactly the stated size, or a sentence.
#include "bytes/compression.hpp"

#include <bzlib.h>
#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

std::string compressed(Codec codec, const std::string& content) {
  if (codec != Codec::bz2) return compress(codec, content);
  std::string out(content.size() + content.size() / 100 + 600, '\0');
  auto size = static_cast<unsigned>(out.size());
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(content.data()),
                                     static_cast<unsigned>(content.size()), 9, 0, 0),
            BZ_OK);
  out.resize(size);
  return out;
}

std::string content_of_size(std::size_t size) {
  Rng rng(size);
  std::string content(size, '\0');
  for (char& c : content) c = static_cast<char>(rng.below(8));
  return content;
}

constexpr Codec codecs[] = {Codec::none, Codec::lz4, Codec::zstd, Codec::bz2};

TEST(Compression, ContentComesBack) {
  for (const Codec codec : codecs) {
    for (const std::size_t size : {0U, 1U, 1000U, 65536U, 3000000U}) {
      const std::string content = content_of_size(size);
      const auto back = decompress(codec, compressed(codec, content), size);
      ASSERT_TRUE(back) << back.error().sentence;
      EXPECT_TRUE(*back == content) << size;
    }
    const std::string zeros(10000000, '\0');
    EXPECT_TRUE(decompress(codec, compressed(codec, zeros), zeros.size()) == zeros);
  }
}

TEST(Compression, AnotherSizeIsRefused) {
  for (const Codec codec : codecs) {
    for (const std::size_t size : {1U, 100U, 100000U}) {
      const std::string bytes = compressed(codec, content_of_size(size));
      EXPECT_FALSE(decompress(codec, bytes, size + 1));
      EXPECT_FALSE(decompress(codec, bytes, size - 1));
      EXPECT_FALSE(decompress(codec, bytes, std::uint64_t{1} << 50U));
    }
  }
}

TEST(Compression, CutOrTrailingBytesAreRefused) {
  const std::string content = content_of_size(2000);
  for (const Codec codec : codecs) {
    const std::string bytes = compressed(codec, content);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const auto cut = decompress(codec, std::string_view(bytes).substr(0, length), content.size());
      ASSERT_FALSE(cut) << length;
      EXPECT_FALSE(cut.error().sentence.empty());
    }
    EXPECT_FALSE(decompress(codec, bytes + "tail", content.size()));
  }
}

}  // namespace
}  // namespace outrider
