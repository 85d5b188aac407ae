#include "outrider/core/text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/core/rng.hpp"

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
                                                        "?31m"},             // U+009B begins a command too
                                                       {"a\u202Eb", "a?b"},  // turns the text after it
                                                       {"\u061C\u200E\u200F", "???"},
                                                       {"\u202A\u202B\u202C\u202D", "????"},
                                                       {"\u2066\u2067\u2068\u2069", "????"},
                                                       {"\u2028\u2029", "??"},   // ends of lines
                                                       {"\xFF\xFE", "??"},       // no UTF-8
                                                       {"\xC0\xAF", "??"},       // a slash in too many bytes
                                                       {"\xED\xA0\x80", "???"},  // half a surrogate pair
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

TEST(Text, NeighboursOfWhatTurnsTextStay) {
  for (const std::string text :
       {"\u061B", "\u061D", "\u200D", "\u2010", "\u2027", "\u202F", "\u2065", "\u206A"})
    EXPECT_EQ(printable(text), text);
}

TEST(Text, ExcerptsAreShortAndWholeCharacters) {
  EXPECT_EQ(excerpt(""), "");
  EXPECT_EQ(excerpt(std::string(80, 'a')), std::string(80, 'a'));
  const auto cut = [](char c) { return std::string(80, c).append("..."); };
  EXPECT_EQ(excerpt(std::string(81, 'a')), cut('a'));
  EXPECT_EQ(excerpt("\u00fc\u00fc\u00fc", 5), "\u00fc\u00fc...");
  EXPECT_EQ(excerpt("a\u202Eb\x1B\xFF", 6), "a?b?...");
  EXPECT_EQ(excerpt(std::string(1'000'000, '\xFF')), cut('?'));
  EXPECT_EQ(excerpt("abc", 0), "...");
}

TEST(Text, NumbersOfSentencesAreShort) {
  const std::pair<double, std::string> cases[] = {{-8.881784197001252e-16, "0"},
                                                  {-0.0, "0"},
                                                  {1.0 / 3.0, "0.333333333"},
                                                  {0.1 + 0.2, "0.3"},
                                                  {-7.000000000001, "-7"},
                                                  {45.00000000000001, "45"},
                                                  {12.0, "12"},
                                                  {1e-5, "1e-05"},
                                                  {1.23456789e-8, "1.2346e-08"},
                                                  {5428123.75049, "5428123.75"},
                                                  {123456.7894, "123456.789"},
                                                  {1e15, "1e+15"},
                                                  {1e300, "1e+300"},
                                                  {std::numeric_limits<double>::max(), "1.79769e+308"},
                                                  {HUGE_VAL, "inf"},
                                                  {-HUGE_VAL, "-inf"},
                                                  {std::nan(""), "nan"},
                                                  {std::numeric_limits<double>::denorm_min(), "0"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(short_number(value), text);
}

/// The text stands for the number to nine digits, or to a thousandth, and has at most sixteen characters.
TEST(Text, NumbersOfSentencesAreRight) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const double value = rng.uniform(-1.0, 1.0) * std::pow(10.0, rng.uniform(-10.0, 9.0));
    const std::string text = short_number(value);
    const double allowed = std::max(5.001e-13, std::min(5.001e-4, 5.001e-9 * std::abs(value)));
    EXPECT_NEAR(std::stod(text), value, allowed) << text;
    EXPECT_LE(text.size(), 16U) << text;
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
