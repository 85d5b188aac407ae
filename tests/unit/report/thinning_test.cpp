#include "outrider/report/thinning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

struct Recording {
  std::vector<double> time;
  std::vector<std::vector<double>> columns;
};

/// Walks with jumps, at times that now and then stand still.
Recording walk(Rng& rng, std::size_t rows) {
  Recording made{{}, {{}, {}}};
  double time_s = 0.0, x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    if (rng.uniform() > 0.05) time_s += rng.uniform();
    x += rng.uniform() - 0.5 + (rng.uniform() > 0.98 ? 5.0 : 0.0);
    y += 0.1;
    made.time.push_back(time_s);
    made.columns[0].push_back(x);
    made.columns[1].push_back(y);
  }
  return made;
}

/// How far a row that is left out is from the line between those around it: looked at one by one.
double farthest_off(const Recording& made, const std::vector<std::size_t>& rows) {
  double most = 0.0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const std::size_t a = rows[k - 1], b = rows[k];
    for (std::size_t i = a + 1; i < b; ++i) {
      const double span = made.time[b] - made.time[a];
      const double share = span > 0.0 ? (made.time[i] - made.time[a]) / span : 0.0;
      for (const auto& column : made.columns)
        most = std::max(most, std::abs(column[a] + share * (column[b] - column[a]) - column[i]));
    }
  }
  return most;
}

TEST(Thinning, FewRowsAllStay) {
  const Thinning kept = thinned({0.0, 1.0, 2.0}, {{0.0, 9.0, 0.0}}, 3, 0.01);
  EXPECT_EQ(kept.rows, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(kept.within, 0.0);
  EXPECT_TRUE(thinned({}, {{}}, 3, 0.01).rows.empty());
}

TEST(Thinning, LinesBetweenTheRowsKeptAreWithinWhatItSays) {
  Rng rng(3);
  for (int i = 0; i < testing::cases(30); ++i) {
    const Recording made = walk(rng, 40 + static_cast<std::size_t>(i) * 10);
    const std::size_t most = 5 + static_cast<std::size_t>(i);
    const Thinning kept = thinned(made.time, made.columns, most, 0.01);
    EXPECT_LE(kept.rows.size(), most);
    EXPECT_TRUE(std::ranges::is_sorted(kept.rows));
    EXPECT_EQ(kept.rows.front(), 0U);
    EXPECT_EQ(kept.rows.back(), made.time.size() - 1);
    EXPECT_NEAR(farthest_off(made, kept.rows), kept.within, 1e-12);
  }
}

TEST(Thinning, WhatIsLinearGoesFirst) {
  Recording made;
  made.columns.resize(1);
  for (int i = 0; i <= 100; ++i) {
    made.time.push_back(i);
    made.columns[0].push_back(i < 50 ? 0.0 : 3.0);
  }
  const Thinning kept = thinned(made.time, made.columns, 10, 0.01);
  EXPECT_EQ(kept.rows, (std::vector<std::size_t>{0, 49, 50, 100}));
  EXPECT_EQ(kept.within, 0.0);
}

}  // namespace
}  // namespace outrider
