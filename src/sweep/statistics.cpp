#include "outrider/sweep/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace outrider {
namespace {

constexpr double z95 = 1.959963984540054;  // of the normal distribution, two-sided
constexpr double one_tail = 0.025;
constexpr std::size_t resamples = 1000;
constexpr std::size_t most_resampled = 5000;
constexpr std::size_t most_exact = 50;  // differences of an exact signed rank test
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns lgamma(x) without the global sign, which threads would share.
double log_gamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

/// Evaluates the continued fraction of the incomplete beta function by Lentz's method. Source: Press et al.,
/// Numerical Recipes, 6.4.
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300, enough = 1e-15;
  constexpr int most = 1'000'000;
  const auto safe = [](double value) { return std::abs(value) < tiny ? tiny : value; };
  double c = 1.0;
  double d = 1.0 / safe(1.0 - (a + b) * x / (a + 1.0));
  double h = d;
  for (int m = 1; m < most; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1.0 / safe(1.0 + even * d);
    c = safe(1.0 + even / c);
    h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1.0 / safe(1.0 + odd * d);
    c = safe(1.0 + odd / c);
    h *= d * c;
    if (std::abs(d * c - 1.0) < enough) break;
  }
  return h;
}

double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0 || x >= 1.0) return x <= 0.0 ? 0.0 : 1.0;
  const double front =
      std::exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

/// Returns the percentiles of a statistic over resamples with replacement.
template <class Statistic>
ConfidenceInterval resampled_interval(std::span<const double> values, Rng rng, const Statistic& statistic) {
  std::vector<double> found(resamples), sample(values.size());
  for (double& one : found) {
    for (double& value : sample) value = values[rng.below(values.size())];
    one = statistic(sample);
  }
  std::ranges::sort(found);
  return {quantile(found, one_tail), quantile(found, 1.0 - one_tail)};
}

double normal_two_sided(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// Returns the exact p-value of a sum of ranks of positive differences, by counting the sets of ranks.
double exact_signed_rank_p(std::size_t n, double rank_sum) {
  const std::size_t all = n * (n + 1) / 2;
  std::vector<double> share(all + 1, 0.0);  // of the 2^n sets, by their sums
  share[0] = 1.0;
  for (std::size_t rank = 1; rank <= n; ++rank) {
    for (std::size_t sum = all; sum + 1 > 0; --sum) {
      share[sum] = 0.5 * (share[sum] + (sum >= rank ? share[sum - rank] : 0.0));
      if (sum == 0) break;
    }
  }
  const double smaller = std::min(rank_sum, static_cast<double>(all) - rank_sum);
  double p = 0.0;
  for (std::size_t sum = 0; static_cast<double>(sum) <= smaller; ++sum) p += share[sum];
  return std::min(1.0, 2.0 * p);
}

}  // namespace

ConfidenceInterval wilson_interval(std::uint64_t hits, std::uint64_t count) {
  const auto n = static_cast<double>(count);
  const double p = static_cast<double>(hits) / n;
  const double z2 = z95 * z95;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = z95 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return {hits == 0 ? 0.0 : std::max(0.0, middle - half), hits == count ? 1.0 : std::min(1.0, middle + half)};
}

double binomial_cdf(std::uint64_t hits, std::uint64_t count, double rate) {
  if (hits >= count) return 1.0;
  return incomplete_beta(static_cast<double>(count - hits), static_cast<double>(hits) + 1.0, 1.0 - rate);
}

double quantile(std::span<const double> sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  const double part = place - static_cast<double>(below);
  return part == 0.0 ? sorted[below] : sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

ConfidenceInterval quantile_interval(std::span<const double> sorted, double share) {
  const std::uint64_t n = sorted.size();
  // Let X of the n values lie below the quantile; X is binomial. Value k (from 1) lies above it if X < k.
  const auto first_above = [&](double probability) {  // the first x with P(X <= x) > probability
    std::uint64_t low = 0, high = n;
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      if (binomial_cdf(middle, n, share) > probability) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return low;
  };
  // Value l (from 1) is above the quantile with P(X <= l - 1) <= one_tail: l is the largest such number.
  const std::uint64_t l = first_above(one_tail);
  // Value u is below the quantile with P(X >= u) <= one_tail: u is the smallest number with P(X <= u - 1) >=
  // 1 - one_tail.
  const std::uint64_t u = first_above(std::nextafter(1.0 - one_tail, 0.0)) + 1;
  return {l == 0 ? -infinity : sorted[l - 1], u > n ? infinity : sorted[u - 1]};
}

double mean_of(std::span<const double> values) {
  const double first = values.front();
  double beyond = 0.0;
  for (const double value : values) beyond += value - first;
  return first + beyond / static_cast<double>(values.size());
}

ConfidenceInterval normal_mean_interval(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  if (values.size() < 2) return {-infinity, infinity};
  const double middle = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  const double half = z95 * std::sqrt(squares / (n - 1.0) / n);
  return {middle - half, middle + half};
}

ConfidenceInterval mean_interval(std::span<const double> values, Rng rng) {
  if (values.size() > most_resampled || values.size() < 2) return normal_mean_interval(values);
  return resampled_interval(values, rng, mean_of);
}

ConfidenceInterval median_interval(std::span<const double> sorted, Rng rng) {
  if (sorted.size() > most_resampled || sorted.size() < 2) return quantile_interval(sorted, 0.5);
  return resampled_interval(sorted, rng, [](std::vector<double>& sample) {
    const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
    std::nth_element(sample.begin(), middle, sample.end());
    if (sample.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(sample.begin(), middle));
  });
}

double wilcoxon_p(std::vector<double> differences) {
  const std::size_t given = differences.size();
  std::erase(differences, 0.0);
  std::ranges::sort(differences, {}, [](double d) { return std::abs(d); });
  const std::size_t n = differences.size();
  if (n == 0) return 1.0;
  double positive = 0.0, ties = 0.0;
  for (std::size_t begin = 0; begin < n;) {  // equal differences share the mean of their ranks
    std::size_t end = begin;
    while (end < n && std::abs(differences[end]) == std::abs(differences[begin])) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    const auto size = static_cast<double>(end - begin);
    ties += size * size * size - size;
    for (; begin < end; ++begin) positive += differences[begin] > 0.0 ? rank : 0.0;
  }
  if (n <= most_exact && ties == 0.0 && n == given) return exact_signed_rank_p(n, positive);
  const auto count = static_cast<double>(n);
  const double mean = count * (count + 1.0) / 4.0;
  const double variance = count * (count + 1.0) * (2.0 * count + 1.0) / 24.0 - ties / 48.0;
  return normal_two_sided((positive - mean) / std::sqrt(variance));
}

double mcnemar_p(std::uint64_t first, std::uint64_t second) {
  if (first == second) return 1.0;
  return std::min(1.0, 2.0 * binomial_cdf(std::min(first, second), first + second, 0.5));
}

}  // namespace outrider
