#include "outrider/sweep/distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace outrider {
namespace {

Varied parsed(const std::string& text) {
  auto varied = parse_varied(text);
  EXPECT_TRUE(varied) << text;
  return varied ? *varied : Varied{};
}

TEST(Distribution, GridsAreSplitAtCommasOrSemicolons) {
  EXPECT_EQ(parsed("a.b=1, 2,x").grid, (std::vector<std::string>{"1", "2", "x"}));
  EXPECT_EQ(parsed("from=1,2;3,4").grid, (std::vector<std::string>{"1,2", "3,4"}));
  EXPECT_EQ(parsed("map=a (1).map").grid, (std::vector<std::string>{"a (1).map"}));
  EXPECT_EQ(parsed("a.b=1").key, "a.b");
}

TEST(Distribution, WhatIsNoDistributionIsRefused) {
  for (const char* text : {"",
                           "a",
                           "=1",
                           "a=",
                           "a=1,,2",
                           "a=uniform(1,1)",
                           "a=uniform(2,1)",
                           "a=uniform(1)",
                           "a=uniform(1,2",
                           "a=uniform(nan,1)",
                           "a=uniform(0,1e999)",
                           "a=uniform(-1e308,1e308)",
                           "a=log_uniform(0,1)",
                           "a=integer(1.5,2)",
                           "a=integer(0,1e300)",
                           "a=normal(0,0)",
                           "a=normal(0,-1)",
                           "a=choice(a)",
                           "a=choice(a,)",
                           "a=gauss(0,1)"}) {
    EXPECT_FALSE(parse_varied(text)) << text;
  }
  const auto fault = parse_varied("robot.radius=gauss(0,1)");
  EXPECT_EQ(fault.error().where, "robot.radius");
  EXPECT_NE(fault.error().sentence.find("'gauss'"), std::string::npos);
}

/// Moments and ranges of what is drawn are those of the distributions.
TEST(Distribution, DrawsHaveTheirMoments) {
  struct Case {
    const char* text;
    double mean, deviation, low, high;
  };
  const double ratio = std::log(100.0);
  for (const Case& one : {Case{"k=uniform(2,6)", 4.0, 4.0 / std::sqrt(12.0), 2.0, 6.0},
                          Case{"k=log_uniform(1,100)", 99.0 / ratio,
                               std::sqrt(9999.0 / (2.0 * ratio) - std::pow(99.0 / ratio, 2)), 1.0, 100.0},
                          Case{"k=integer(-1,2)", 0.5, std::sqrt(15.0 / 12.0), -1.0, 2.0},
                          Case{"k=normal(3,2)", 3.0, 2.0, -20.0, 25.0}}) {
    const Varied varied = parsed(one.text);
    EXPECT_TRUE(varied.is_random_number());
    constexpr int draws = 20'000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < draws; ++i) {
      const double value = std::stod(draw(varied, Rng(5).child(static_cast<std::uint64_t>(i))));
      EXPECT_GE(value, one.low);
      EXPECT_LE(value, one.high);
      sum += value;
      squares += value * value;
    }
    const double mean = sum / draws;
    EXPECT_NEAR(mean, one.mean, 5.0 * one.deviation / std::sqrt(draws)) << one.text;
    EXPECT_NEAR(std::sqrt(squares / draws - mean * mean), one.deviation, 0.03 * one.deviation) << one.text;
  }
}

TEST(Distribution, TextHoldsSeveralDraws) {
  const Varied varied = parsed("to=uniform(1,2),integer(7,7),choice(east;west)");
  EXPECT_FALSE(varied.is_random_number());
  std::map<std::string, int> words;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const std::string text = draw(varied, Rng(i));
    EXPECT_EQ(text.substr(0, 2), "1.");
    const std::size_t comma = text.find(',');
    EXPECT_EQ(text.substr(comma, 3), ",7,");
    ++words[text.substr(comma + 3)];
  }
  EXPECT_EQ(words.size(), 2U);
  EXPECT_GT(words["east"], 60);
  EXPECT_GT(words["west"], 60);
  EXPECT_EQ(draw(varied, Rng(9)), draw(varied, Rng(9)));
}

TEST(Distribution, ExtremeValuesAreThoseThatMayBeRefused) {
  EXPECT_EQ(extreme_values(parsed("k=uniform(2,6)")), (std::vector<std::string>{"2", "6"}));
  EXPECT_EQ(extreme_values(parsed("k=normal(2,6)")), (std::vector<std::string>{"2", "2"}));
  EXPECT_EQ(extreme_values(parsed("k=choice(a,b,c)")), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(extreme_values(parsed("k=x,y")), (std::vector<std::string>{"x", "y"}));
}

}  // namespace
}  // namespace outrider
