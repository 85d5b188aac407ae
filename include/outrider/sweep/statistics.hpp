// Statistics of samples: rates, quantiles and means with their intervals, and tests of paired differences.
//
// All intervals have a confidence of 95 %. Intervals of quantiles hold for every distribution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outrider/core/rng.hpp"

namespace outrider {

struct ConfidenceInterval {
  double low = 0.0;
  double high = 0.0;
};

/// Returns the interval of a rate of which `hits` of `count` were seen; count > 0. Source: Wilson, Probable
/// inference, the law of succession, and statistical inference, 1927.
ConfidenceInterval wilson_interval(std::uint64_t hits, std::uint64_t count);

/// Returns P(X <= hits) for X binomial, by the regularised incomplete beta function. O(sqrt(count)).
double binomial_cdf(std::uint64_t hits, std::uint64_t count, double rate);

/// Returns the quantile of sorted values, linear between them (type 7 of Hyndman and Fan, 1996).
double quantile(std::span<const double> sorted, double share);

/// Returns two of the sorted values between which the quantile of the distribution lies, with a confidence of
/// at least 95 % whatever the distribution; infinite where there are too few values. O(sqrt(n) log n).
ConfidenceInterval quantile_interval(std::span<const double> sorted, double share);

/// Returns the mean of one value or more, which is exact where all are the same.
double mean_of(std::span<const double> values);

/// Returns the interval of the mean by the normal distribution of means; infinite for one value.
ConfidenceInterval normal_mean_interval(std::span<const double> values);

/// Returns the interval of the mean by the bootstrap: percentiles of 1,000 resamples (Efron, 1979). Of more
/// than 5,000 values it is that of normal_mean_interval(), from which the bootstrap hardly differs there.
ConfidenceInterval mean_interval(std::span<const double> values, Rng rng);

/// Returns the interval of the median by the bootstrap: percentiles of 1,000 resamples. Of more than 5,000
/// values it is that of quantile_interval().
ConfidenceInterval median_interval(std::span<const double> sorted, Rng rng);

/// Returns the two-sided p-value of Wilcoxon's signed rank test that the differences are symmetric about 0.
/// Differences of 0 are left out. It is exact for up to 50 differences without ties and zeros, else by the
/// normal distribution with correction for ties. 1 if all are 0. Source: Wilcoxon, 1945. O(n log n).
double wilcoxon_p(std::vector<double> differences);

/// Returns the two-sided exact p-value that of `first + second` discordant pairs each kind is as likely.
/// Source: McNemar, 1947.
double mcnemar_p(std::uint64_t first, std::uint64_t second);

}  // namespace outrider
