// Oracles: the definitions by brute force, and values of SciPy 1.10 where a test says so.
#include "outrider/sweep/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// P(X <= hits), term by term.
double summed_binomial(std::uint64_t hits, std::uint64_t count, double rate) {
  double sum = 0.0;
  for (std::uint64_t k = 0; k <= hits; ++k) {
    double term = 1.0;
    for (std::uint64_t i = 0; i < k; ++i) term *= static_cast<double>(count - i) / static_cast<double>(k - i);
    sum +=
        term * std::pow(rate, static_cast<double>(k)) * std::pow(1.0 - rate, static_cast<double>(count - k));
  }
  return sum;
}

TEST(Statistics, TheBinomialDistributionIsTheSumOfItsTerms) {
  for (std::uint64_t count : {1U, 2U, 7U, 30U}) {
    for (std::uint64_t hits = 0; hits < count; ++hits) {
      for (double rate : {0.01, 0.3, 0.5, 0.95}) {
        EXPECT_NEAR(binomial_cdf(hits, count, rate), summed_binomial(hits, count, rate), 1e-12);
      }
    }
  }
  EXPECT_EQ(binomial_cdf(5, 5, 0.3), 1.0);
  EXPECT_NEAR(binomial_cdf(500'000, 1'000'000, 0.5), 0.5003989421806669, 1e-9);   // SciPy
  EXPECT_NEAR(binomial_cdf(498'800, 1'000'000, 0.5), 0.00821993600571375, 1e-9);  // SciPy
}

/// The ends of Wilson's interval are the rates of which the rate seen is 1.96 standard errors away.
TEST(Statistics, WilsonsIntervalEndsWhereTheScoreTestDoes) {
  for (std::uint64_t count : {1U, 9U, 200U, 1'000'000U}) {
    for (std::uint64_t hits : {std::uint64_t{0}, count / 3, count / 2, count}) {
      const auto n = static_cast<double>(count);
      const double seen = static_cast<double>(hits) / n;
      const auto [low, high] = wilson_interval(hits, count);
      for (const double p : {low, high}) {
        if (p == 0.0 || p == 1.0) continue;
        EXPECT_NEAR(std::abs(seen - p), 1.959963984540054 * std::sqrt(p * (1.0 - p) / n), 1e-12);
      }
      EXPECT_LE(low, seen);
      EXPECT_GE(high, seen);
    }
  }
  EXPECT_EQ(wilson_interval(0, 200).low, 0.0);
  EXPECT_NEAR(wilson_interval(0, 200).high, 0.018846, 1e-6);
}

TEST(Statistics, QuantilesAreLinearBetweenValues) {
  const std::vector<double> values = {1.0, 2.0, 4.0, 8.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_EQ(quantile(values, 1.0), 8.0);
  EXPECT_NEAR(quantile(values, 0.05), 1.15, 1e-12);  // numpy.quantile
}

/// The interval is the innermost that covers enough, of all pairs of values that are symmetric in the two
/// tails.
TEST(Statistics, QuantileIntervalsCover95PercentOfSamples) {
  for (std::size_t n : {1U, 5U, 6U, 20U, 59U, 200U}) {
    std::vector<double> ranks(n);
    for (std::size_t i = 0; i < n; ++i) ranks[i] = static_cast<double>(i + 1);
    for (double share : {0.05, 0.5, 0.95}) {
      const auto [low, high] = quantile_interval(ranks, share);
      // X values lie below the quantile: the value of rank l does so if X >= l.
      const auto at_most = [&](double x) {
        return x < 0.0 ? 0.0 : summed_binomial(static_cast<std::uint64_t>(x), n, share);
      };
      if (std::isfinite(low)) {
        EXPECT_LE(at_most(low - 1.0), 0.025) << n;
        EXPECT_GT(at_most(low), 0.025) << n;
      } else {
        EXPECT_GT(at_most(0.0), 0.025) << n;
      }
      if (std::isfinite(high)) {
        EXPECT_GE(at_most(high - 1.0), 0.975 - 1e-12) << n;
        EXPECT_LT(at_most(high - 2.0), 0.975) << n;
      } else {
        EXPECT_LT(at_most(static_cast<double>(n) - 1.0), 0.975) << n;
      }
    }
  }
}

/// The p-value over all signs of the differences.
double enumerated_wilcoxon(const std::vector<double>& differences) {
  const std::size_t n = differences.size();
  std::vector<double> sizes;
  for (double d : differences) sizes.push_back(std::abs(d));
  const auto rank = [&](std::size_t i) {
    return 1.0 + static_cast<double>(std::ranges::count_if(sizes, [&](double s) { return s < sizes[i]; }));
  };
  const auto all = static_cast<double>(n * (n + 1) / 2);
  double seen = 0.0;
  for (std::size_t i = 0; i < n; ++i) seen += differences[i] > 0 ? rank(i) : 0.0;
  std::size_t as_extreme = 0;
  for (std::size_t signs = 0; signs < std::size_t{1} << n; ++signs) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += (signs >> i & 1U) != 0 ? rank(i) : 0.0;
    if (std::min(sum, all - sum) <= std::min(seen, all - seen)) ++as_extreme;
  }
  return std::min(1.0, static_cast<double>(as_extreme) / static_cast<double>(std::size_t{1} << n));
}

TEST(Statistics, WilcoxonIsExactForFewDifferences) {
  Rng rng(4);
  for (int i = 0; i < testing::cases(60); ++i) {
    std::vector<double> differences(1 + rng.below(11));
    for (double& d : differences) d = rng.normal() + 0.4;
    EXPECT_NEAR(wilcoxon_p(differences), enumerated_wilcoxon(differences), 1e-12);
  }
  EXPECT_EQ(wilcoxon_p({}), 1.0);
  EXPECT_EQ(wilcoxon_p({0.0, 0.0}), 1.0);
}

TEST(Statistics, WilcoxonWithTiesIsThatOfSciPy) {
  std::vector<double> differences;  // scipy.stats.wilcoxon([((i * 7) % 23) - 9 for i in range(60)])
  for (int i = 0; i < 60; ++i) differences.push_back((i * 7) % 23 - 9);
  EXPECT_NEAR(wilcoxon_p(differences), 0.033735606717976555, 1e-12);
  differences.clear();  // scipy.stats.wilcoxon([((i * 37) % 101) - 40.5 for i in range(101)])
  for (int i = 0; i < 101; ++i) differences.push_back((i * 37) % 101 - 40.5);
  EXPECT_NEAR(wilcoxon_p(differences), 0.003067598930140447, 1e-12);
}

TEST(Statistics, McNemarIsTheExactBinomialTest) {
  for (std::uint64_t a = 0; a < 12; ++a) {
    for (std::uint64_t b = 0; b < 12; ++b) {
      const double p = a == b ? 1.0 : std::min(1.0, 2.0 * summed_binomial(std::min(a, b), a + b, 0.5));
      EXPECT_NEAR(mcnemar_p(a, b), p, 1e-12) << a << " " << b;
    }
  }
}

/// The share of 300 samples of 40 whose interval holds the mean of the distribution. The bootstrap of skewed
/// values is known to cover less than it should.
TEST(Statistics, BootstrapIntervalsHoldMeanAndMedian) {
  Rng rng(11);
  int means = 0, medians = 0;
  const int samples = testing::cases(300);
  for (int i = 0; i < samples; ++i) {
    std::vector<double> values(40);
    for (double& value : values) value = -std::log(1.0 - rng.uniform());  // mean 1, median log 2
    std::ranges::sort(values);
    const auto mean = mean_interval(values, rng.child("mean"));
    const auto median = median_interval(values, rng.child("median"));
    means += mean.low <= 1.0 && 1.0 <= mean.high ? 1 : 0;
    medians += median.low <= std::log(2.0) && std::log(2.0) <= median.high ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(means) / samples, 0.93, 0.035);
  EXPECT_NEAR(static_cast<double>(medians) / samples, 0.95, 0.035);
}

TEST(Statistics, ValuesThatAreAllTheSameHaveThemselvesAsMean) {
  for (const std::size_t count : {3U, 1000U, 6000U}) {
    const std::vector<double> values(count, 29.016100416950906);
    EXPECT_EQ(mean_of(values), values.front());
    const auto mean = mean_interval(values, Rng(1));
    EXPECT_EQ(mean.low, values.front());
    EXPECT_EQ(mean.high, values.front());
  }
}

TEST(Statistics, ManyValuesAreNotResampled) {
  std::vector<double> values(6000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  const double deviation = std::sqrt(6000.0 * 6001.0 / 12.0);
  const auto mean = mean_interval(values, Rng(1));
  EXPECT_NEAR(mean.high - mean.low, 2.0 * 1.959964 * deviation / std::sqrt(6000.0), 1e-3);
  const auto median = median_interval(values, Rng(1)), exact = quantile_interval(values, 0.5);
  EXPECT_EQ(median.low, exact.low);
  EXPECT_EQ(median.high, exact.high);
}

}  // namespace
}  // namespace outrider
