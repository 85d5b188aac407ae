#include "outrider/core/text.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(Text, PrintableTextStaysAsItIs) {
  for (const std::string text : {"", "crate 7",
                                 "k\xC3\xBC"
                                 "che",
                                 "\xE2\x82\xAC 5", "\xF0\x9F\x90\x88", "\xC2\xA0"}) {
    EXPECT_TRUE(is_printable(text)) << text;
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Text, WhatATerminalActsOnBecomesAQuestionMark) {
  const std::pair<std::string, std::string> cases[] = {{"\x1B[31mred", "?[31mred"},
                                                       {"one\ntwo\r\t", "one?two??"},
                                                       {std::string("nul\0", 4), "nul?"},
                                                       {"del\x7F", "del?"},
                                                       {"\xC2\x9B"
                                                        "31m",
                                                        "??31m"},           // U+009B begins a command too
                                                       {"\xFF\xFE", "??"},  // no UTF-8
                                                       {"\xC0\xAF", "??"},  // a slash in too many bytes
                                                       {"\xED\xA0\x80", "???"},       // half a surrogate pair
                                                       {"\xF4\x90\x80\x80", "????"},  // beyond U+10FFFF
                                                       {"cut \xE2\x82", "cut ??"},
                                                       {"\xE2\x82"
                                                        "A",
                                                        "??A"}};
  for (const auto& [text, shown] : cases) {
    EXPECT_FALSE(is_printable(text)) << shown;
    EXPECT_EQ(printable(text), shown);
    EXPECT_TRUE(is_printable(printable(text)));
  }
}

TEST(Text, KeepsWhatItIsTold) { EXPECT_EQ(printable("a\n\tb\x1B", "\n\t"), "a\n\tb?"); }

TEST(Text, IsTrimmedAtBothEndsOnly) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \t\r\n\f\v"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Text, LowerCaseIsOfAsciiLettersOnly) {
  EXPECT_EQ(lower("AZ az 09 [@"), "az az 09 [@");
  EXPECT_EQ(lower("\u00c4"), "\u00c4");
}

TEST(Text, MarkupCannotBreakOut) {
  EXPECT_EQ(markup_text("<b>&amp;\x1B"), "&lt;b&gt;&amp;amp;?");
  EXPECT_EQ(markup_text("a \u03c3"), "a \u03c3");
}

TEST(Text, EveryPairOfBytesEndsPrintable) {
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) {
      const std::string text{static_cast<char>(a), static_cast<char>(b)};
      ASSERT_TRUE(is_printable(printable(text))) << a << ' ' << b;
      ASSERT_EQ(is_printable(text), printable(text) == text) << a << ' ' << b;
    }
  }
}

TEST(Text, DurationsInUnitsThatSuitThem) {
  const std::pair<double, std::string> cases[] = {
      {0.31, "0.31 s"},          {42.0, "42.0 s"},       {81.2, "1 min 21 s"},
      {3599.4, "59 min 59 s"},   {3599.6, "1 h 0 min"},  {38580.0, "10 h 43 min"},
      {360000.0, "100 h 0 min"}, {7169.0, "1 h 59 min"}, {7170.0, "2 h 0 min"}};
  for (const auto& [seconds, text] : cases) EXPECT_EQ(duration_text(seconds), text);
}

}  // namespace
}  // namespace outrider
