#include "outrider/slam/landmark/joint_compatibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "dense.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// Joint distance of the chosen pairs through a dense inverse.
double joint_distance(const std::vector<PossiblePair>& pairs, const Eigen::MatrixXd& covariance,
                      const std::vector<std::size_t>& chosen) {
  if (chosen.empty()) return 0.0;
  const std::size_t n = 2 * chosen.size();
  testing::Dense s = testing::zeros(n, n);
  std::vector<double> v(n);
  for (std::size_t r = 0; r < n; ++r) {
    const std::size_t row = 2 * chosen[r / 2] + r % 2;
    v[r] = r % 2 == 0 ? pairs[chosen[r / 2]].innovation.x : pairs[chosen[r / 2]].innovation.y;
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t column = 2 * chosen[c / 2] + c % 2;
      s[r][c] = covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    }
  }
  const testing::Dense inverse = testing::inverse(s);
  double sum = 0.0;
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < n; ++c) sum += v[r] * inverse[r][c] * v[c];
  }
  return sum;
}

/// Returns the best of all subsets that pair each sighting and landmark at most once and whose beginnings are
/// compatible.
std::vector<std::size_t> by_brute_force(const std::vector<PossiblePair>& pairs,
                                        const Eigen::MatrixXd& covariance, double gate) {
  std::vector<std::size_t> best;
  double best_distance = 0.0;
  for (std::size_t mask = 0; mask < (std::size_t{1} << pairs.size()); ++mask) {
    std::vector<std::size_t> chosen;
    std::set<std::size_t> sightings, landmarks;
    bool valid = true;
    for (std::size_t i = 0; valid && i < pairs.size(); ++i) {
      if ((mask >> i & 1) == 0) continue;
      chosen.push_back(i);
      valid = sightings.insert(pairs[i].sighting).second && landmarks.insert(pairs[i].landmark).second &&
              joint_distance(pairs, covariance, chosen) <= squared_gate(gate, 2 * chosen.size());
    }
    if (!valid || chosen.size() < best.size()) continue;
    const double distance = joint_distance(pairs, covariance, chosen);
    if (chosen.size() == best.size() && distance >= best_distance) continue;
    best = chosen;
    best_distance = distance;
  }
  return best;
}

TEST(JointCompatibility, FindsWhatBruteForceFinds) {
  Rng rng(1);
  std::set<std::size_t> sizes;
  for (int round = 0; round < testing::cases(100); ++round) {
    std::vector<PossiblePair> pairs;
    for (std::size_t sighting = 0; sighting < 4; ++sighting) {
      for (std::size_t landmark = 0; landmark < 4; ++landmark) {
        if (pairs.size() < 9 && rng.below(2) == 0) {
          pairs.push_back({sighting, landmark, testing::random_point(rng, 4.0)});
        }
      }
    }
    const std::size_t n = 2 * pairs.size();
    testing::Dense root = testing::zeros(n, n + 1);
    for (auto& row : root) {
      for (double& value : row) value = 0.5 * rng.normal();
    }
    Eigen::MatrixXd covariance(n, n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        double sum = i == j ? 0.1 : 0.0;
        for (std::size_t k = 0; k <= n; ++k) sum += root[i][k] * root[j][k];
        covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = sum;
      }
    }
    const auto found = joint_compatibility(pairs, covariance, 0.95);
    EXPECT_EQ(found, by_brute_force(pairs, covariance, 0.95));
    sizes.insert(found.size());
  }
  EXPECT_GE(sizes.size(), 3U) << "the cases are all alike";
}

TEST(JointCompatibility, ManyAlikeSightingsEndWithTheBestSoFar) {
  // 30 sightings of which each fits 30 landmarks: 30! pairings are complete.
  std::vector<PossiblePair> pairs;
  for (std::size_t sighting = 0; sighting < 30; ++sighting) {
    for (std::size_t landmark = 0; landmark < 30; ++landmark)
      pairs.push_back({sighting, landmark, {0.01 * static_cast<double>(sighting), 0.0}});
  }
  const auto n = static_cast<Eigen::Index>(2 * pairs.size());
  const auto found = joint_compatibility(pairs, Eigen::MatrixXd::Identity(n, n), 0.95);
  std::set<std::size_t> sightings, landmarks;
  for (const std::size_t pair : found) {
    EXPECT_TRUE(sightings.insert(pairs[pair].sighting).second);
    EXPECT_TRUE(landmarks.insert(pairs[pair].landmark).second);
  }
  EXPECT_EQ(found.size(), 30U);
}

TEST(JointCompatibility, TheGateIsTheQuantileOfTheTables) {
  EXPECT_NEAR(squared_gate(0.95, 2), 5.991, 1e-3);
  EXPECT_NEAR(squared_gate(0.99, 4), 13.277, 1e-3);
  EXPECT_NEAR(squared_gate(0.975, 60), 83.298, 1e-3);
  EXPECT_NEAR(squared_gate(0.025, 60), 40.482, 1e-3);
  EXPECT_EQ(squared_gate(0.5, 0), 0.0);
  EXPECT_EQ(squared_gate(1.0, 2), HUGE_VAL);
}

}  // namespace
}  // namespace outrider
