// RangeResiduals: do measured ranges differ from the map on average in one direction?
//
// The errors of single ranges average out over many sightings of landmarks from many sides. A range finder
// that measures too long or too short leaves a mean that they do not explain, although each single residual
// is as small as its noise.
#pragma once

#include <cmath>
#include <cstddef>

namespace outrider {

class RangeResiduals {
 public:
  /// Adds a residual, the measured range minus that by the map, with its standard deviation.
  void add(double residual_m, double sd_m) {
    ++count_;
    sum_m_ += residual_m;
    sum_sds_ += residual_m / sd_m;
  }

  [[nodiscard]] double mean_m() const { return count_ == 0 ? 0.0 : sum_m_ / static_cast<double>(count_); }
  /// Returns true if the mean is more than five of its standard deviations and more than a quarter of one of
  /// a single range. `chi2_per_dof` is by how much errors exceed their covariances; below 1 it counts as 1.
  [[nodiscard]] bool is_biased(double chi2_per_dof) const {
    constexpr double most_of_mean = 5.0, most_of_one = 0.25;
    const double scale = chi2_per_dof > 1.0 ? std::sqrt(chi2_per_dof) : 1.0;
    const double root = std::sqrt(static_cast<double>(count_));
    return std::abs(sum_sds_) > most_of_mean * root * scale &&
           std::abs(sum_sds_) > most_of_one * static_cast<double>(count_) * scale;
  }

 private:
  std::size_t count_ = 0;
  double sum_m_ = 0.0;
  double sum_sds_ = 0.0;
};

}  // namespace outrider
