#include "files/zip.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(Zip, AnEmptyFileIsTheEndOfTheDirectory) {
  EXPECT_EQ(ZipFile().finish(), "PK\5\6" + std::string(18, '\0'));
}

TEST(Zip, TheFileIsStoredAndListed) {
  ZipFile zip;
  ASSERT_TRUE(zip.add("a", "hello"));
  // Version 2.0, UTF-8 name, stored, 1980-01-01 0:00, CRC-32 of "hello", its size twice, length of the name.
  const std::string fields("\x14\0\0\x08\0\0\0\0\x21\0\x86\xA6\x10\x36\5\0\0\0\5\0\0\0\1\0\0\0", 26);
  const std::string head = "PK\3\4" + fields + "a";
  const std::string entry = "PK\1\2" + std::string("\x14\0", 2) + fields + std::string(14, '\0') + "a";
  const std::string end = "PK\5\6" + std::string("\0\0\0\0\1\0\1\0\x2F\0\0\0\x24\0\0\0\0\0", 18);
  EXPECT_EQ(std::move(zip).finish(), head + "hello" + entry + end);
}

}  // namespace
}  // namespace outrider
