#include "outrider/core/rng.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace outrider {
namespace {

std::vector<std::uint64_t> draw(Rng rng, int count) {
  std::vector<std::uint64_t> drawn;
  for (int i = 0; i < count; ++i) drawn.push_back(rng.bits());
  return drawn;
}

TEST(Rng, TheEngineIsTheOneOfTheStandard) {
  std::mt19937_64 engine;
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042ULL);  // [rand.predef]
}

TEST(Rng, GoldenValues) {
  // The first output of SplitMix64 from state 0 is 0xe220a8397b1dcdaf: it seeds the engine of Rng(0).
  std::mt19937_64 engine(0xe220a8397b1dcdafULL);
  const std::vector<std::uint64_t> expected = {engine(), engine(), engine()};
  EXPECT_EQ(draw(Rng(0), 3), expected);
}

TEST(Rng, SameSeedSameDraws) {
  EXPECT_EQ(draw(Rng(7), 100), draw(Rng(7), 100));
  EXPECT_NE(draw(Rng(7), 100), draw(Rng(8), 100));
}

TEST(Rng, AChildDependsOnSeedAndNameOnly) {
  Rng used(7);
  const auto fresh = draw(used.child("laser"), 20);
  for (int i = 0; i < 1000; ++i) used.bits();
  EXPECT_EQ(draw(used.child("laser"), 20), fresh);
  EXPECT_EQ(draw(Rng(7).child("laser"), 20), fresh);
}

TEST(Rng, StreamsDiffer) {
  std::set<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Rng rng(seed);
    firsts.insert(draw(rng, 1)[0]);
    for (const char* name : {"", "a", "b", "ab", "ba", "laser", "odometry"}) {
      firsts.insert(draw(rng.child(name), 1)[0]);
      firsts.insert(draw(rng.child(name).child(name), 1)[0]);
    }
    for (std::uint64_t index = 0; index < 20; ++index) firsts.insert(draw(rng.child(index), 1)[0]);
  }
  EXPECT_EQ(firsts.size(), 20U * (1 + 2 * 7 + 20));
}

TEST(Rng, UniformStaysInItsIntervalAndFillsIt) {
  Rng rng(1);
  constexpr int count = 100000;
  std::array<int, 10> bins{};
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double u = rng.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(u * 10.0)];
    sum += u;
  }
  EXPECT_NEAR(sum / count, 0.5, 5.0 / std::sqrt(12.0 * count));
  double chi2 = 0.0;
  for (const int n : bins) chi2 += std::pow(n - count / 10.0, 2) / (count / 10.0);
  EXPECT_LT(chi2, 27.9);  // 99.9 % of chi-squared with 9 degrees of freedom
  const double v = rng.uniform(-3.0, -2.0);
  EXPECT_GE(v, -3.0);
  EXPECT_LT(v, -2.0);
}

TEST(Rng, BelowIsUnbiased) {
  Rng rng(2);
  constexpr std::uint64_t sides = 6;
  constexpr int count = 60000;
  std::array<int, sides> seen{};
  for (int i = 0; i < count; ++i) ++seen.at(rng.below(sides));
  double chi2 = 0.0;
  for (const int n : seen) chi2 += std::pow(n - count / 6.0, 2) / (count / 6.0);
  EXPECT_LT(chi2, 20.5);  // 99.9 %, 5 degrees of freedom
  EXPECT_EQ(rng.below(1), 0U);

  // 2^64 mod (3 * 2^62) = 2^62: a plain remainder would draw the lowest third half of the time.
  constexpr std::uint64_t third = 1ULL << 62U;
  int lowest = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::uint64_t draw = rng.below(3 * third);
    ASSERT_LT(draw, 3 * third);
    lowest += draw < third ? 1 : 0;
  }
  EXPECT_NEAR(lowest, 1000, 5 * std::sqrt(3000 * 2.0 / 9.0));
}

TEST(Rng, NormalHasTheRightMoments) {
  Rng rng(3);
  constexpr int count = 200000;
  std::array<double, 5> moments{};
  for (int i = 0; i < count; ++i) {
    const double x = rng.normal();
    ASSERT_TRUE(std::isfinite(x));
    for (std::size_t k = 1; k <= 4; ++k) moments[k] += std::pow(x, static_cast<double>(k)) / count;
  }
  const double sigma = 1.0 / std::sqrt(count);
  EXPECT_NEAR(moments[1], 0.0, 5 * sigma);
  EXPECT_NEAR(moments[2], 1.0, 5 * std::sqrt(2.0) * sigma);
  EXPECT_NEAR(moments[3], 0.0, 5 * std::sqrt(15.0) * sigma);
  EXPECT_NEAR(moments[4], 3.0, 5 * std::sqrt(96.0) * sigma);
}

}  // namespace
}  // namespace outrider
