#include "line_outliers.hpp"

#include <algorithm>
#include <cmath>

#include "student.hpp"

namespace outrider {
namespace {

constexpr std::size_t least_points = 8;
constexpr double one_in_a_million = 4.891638475699;  ///< normal quantile, both tails

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The residuals of the line of Theil and Sen.
std::vector<double> robust_residuals(const std::vector<Vec2>& points) {
  std::vector<double> slopes, residuals;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (points[i].x != points[k].x)
        slopes.push_back((points[i].y - points[k].y) / (points[i].x - points[k].x));
    }
  }
  const double slope = slopes.empty() ? 0.0 : median(std::move(slopes));
  for (const Vec2 p : points) residuals.push_back(p.y - slope * p.x);
  const double offset = median(residuals);
  for (double& residual : residuals) residual -= offset;
  return residuals;
}

/// Compares a point with the line of the other points that fit.
LineFit compare(const std::vector<Vec2>& points, const std::vector<LineFit>& fits, std::size_t one,
                double exact) {
  double n = 0.0, square = 0.0, product = 0.0, residual_square = 0.0;
  Vec2 mean;
  const auto others = [&](const auto& visit) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i != one && fits[i].fits) visit(points[i]);
    }
  };
  others([&](Vec2 p) { mean = mean + p, n += 1.0; });
  if (n < 3.0) return {};
  mean = (1.0 / n) * mean;
  others([&](Vec2 p) {
    square += (p.x - mean.x) * (p.x - mean.x);
    product += (p.x - mean.x) * (p.y - mean.y);
  });
  if (!(square > 0.0)) return {};
  const double slope = product / square;
  const auto off_line = [&](Vec2 p) { return p.y - mean.y - slope * (p.x - mean.x); };
  others([&](Vec2 p) { residual_square += off_line(p) * off_line(p); });
  const double ahead = points[one].x - mean.x;
  const double sigma = std::sqrt(residual_square / (n - 2.0) * (1.0 + 1.0 / n + ahead * ahead / square));
  const double off = off_line(points[one]);
  const double most = student_value(one_in_a_million, static_cast<std::size_t>(n) - 2) * sigma;
  return {std::abs(off) <= std::max(exact, most), off};
}

}  // namespace

std::vector<LineFit> fit_to_line(const std::vector<Vec2>& points, double exact) {
  std::vector<LineFit> fits(points.size());
  if (points.size() < least_points) return fits;
  const std::vector<double> residuals = robust_residuals(points);
  std::vector<double> sizes;
  for (const double residual : residuals) sizes.push_back(std::abs(residual));
  const double sigma = 1.4826 * median(sizes);  // of a normal distribution, from the median of the sizes
  for (std::size_t i = 0; i < points.size(); ++i) fits[i].fits = sizes[i] <= std::max(exact, 5.0 * sigma);
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    std::vector<LineFit> next;
    for (std::size_t i = 0; i < points.size(); ++i) next.push_back(compare(points, fits, i, exact));
    const bool same = std::ranges::equal(fits, next, {}, &LineFit::fits, &LineFit::fits);
    fits = std::move(next);
    if (same) break;
  }
  return fits;
}

}  // namespace outrider
