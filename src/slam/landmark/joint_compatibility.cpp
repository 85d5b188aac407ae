#include "outrider/slam/landmark/joint_compatibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace outrider {
namespace {

/// The Cholesky factor of the covariance of the chosen pairs, extended and shortened with the choice, and the
/// innovations divided by it: their squared norm is the joint distance.
class Joint {
 public:
  Joint(const std::vector<PossiblePair>& pairs, const Eigen::MatrixXd& covariance)
      : pairs_(pairs), covariance_(covariance) {}

  /// Adds a pair. Returns false, and adds nothing, if the covariance is not positive definite.
  bool push(std::size_t pair) {
    const std::size_t before = rows_.size();
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t index = 2 * pair + k;
      std::vector<double> row;
      double pivot = at(index, index);
      double value = k == 0 ? pairs_[pair].innovation.x : pairs_[pair].innovation.y;
      for (std::size_t r = 0; r < rows_.size(); ++r) {
        double sum = at(index, indices_[r]);
        for (std::size_t c = 0; c < r; ++c) sum -= row[c] * rows_[r][c];
        row.push_back(sum / rows_[r][r]);
        pivot -= row[r] * row[r];
        value -= row[r] * values_[r];
      }
      if (!(pivot > 0.0)) {
        shrink(before);
        return false;
      }
      row.push_back(std::sqrt(pivot));
      values_.push_back(value / row.back());
      rows_.push_back(std::move(row));
      indices_.push_back(index);
    }
    return true;
  }
  void pop() { shrink(rows_.size() - 2); }
  [[nodiscard]] double distance() const {
    double sum = 0.0;
    for (const double value : values_) sum += value * value;
    return sum;
  }

 private:
  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return covariance_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
  }
  void shrink(std::size_t size) {
    rows_.resize(size);
    values_.resize(size);
    indices_.resize(size);
  }

  const std::vector<PossiblePair>& pairs_;
  const Eigen::MatrixXd& covariance_;
  std::vector<std::vector<double>> rows_;
  std::vector<double> values_;
  std::vector<std::size_t> indices_;
};

struct JointSearch {
  const std::vector<PossiblePair>& pairs;
  std::vector<std::vector<std::size_t>> by_sighting;
  double gate;
  Joint joint;
  std::vector<std::size_t> chosen;
  std::set<std::size_t> taken;  ///< landmarks
  std::vector<std::size_t> best;
  double best_distance = 0.0;
  std::int64_t work_left = 20'000'000;  ///< there may be exponentially many; then the best so far is kept

  void run(std::size_t sighting) {
    if (chosen.size() + by_sighting.size() - sighting < best.size()) return;
    if (sighting == by_sighting.size()) {
      const double distance = joint.distance();
      if (chosen.size() == best.size() && distance >= best_distance) return;
      best = chosen;
      best_distance = distance;
      return;
    }
    for (const std::size_t pair : by_sighting[sighting]) {
      if (work_left < 0) return;
      work_left -= static_cast<std::int64_t>((chosen.size() + 1) * (chosen.size() + 1));  // numbers of a row
      if (taken.contains(pairs[pair].landmark) || !joint.push(pair)) continue;
      if (joint.distance() <= squared_gate(gate, 2 * (chosen.size() + 1))) {
        taken.insert(pairs[pair].landmark);
        chosen.push_back(pair);
        run(sighting + 1);
        chosen.pop_back();
        taken.erase(pairs[pair].landmark);
      }
      joint.pop();
    }
    run(sighting + 1);
  }
};

}  // namespace

std::vector<std::size_t> joint_compatibility(const std::vector<PossiblePair>& pairs,
                                             const Eigen::MatrixXd& covariance, double gate) {
  std::vector<std::vector<std::size_t>> by_sighting;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i == 0 || pairs[i].sighting != pairs[i - 1].sighting) by_sighting.emplace_back();
    by_sighting.back().push_back(i);
  }
  JointSearch search{pairs, std::move(by_sighting), gate, Joint(pairs, covariance), {}, {}, {}, 0.0};
  search.run(0);
  return search.best;
}

/// For 2k dimensions the probability beyond x is e^(-x/2) times the sum of (x/2)^i / i! for i < k.
double squared_gate(double share, std::size_t numbers) {
  if (numbers == 0) return 0.0;
  if (share >= 1.0) return std::numeric_limits<double>::infinity();
  const auto beyond = [&](double x) {
    double term = std::exp(-0.5 * x), sum = term;
    for (std::size_t i = 1; 2 * i < numbers; ++i) sum += term *= 0.5 * x / static_cast<double>(i);
    return sum;
  };
  double low = 0.0, high = 2.0 * static_cast<double>(numbers);
  while (beyond(high) > 1.0 - share && high < 1e3) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (beyond(middle) > 1.0 - share ? low : high) = middle;
  }
  return high;
}

}  // namespace outrider
