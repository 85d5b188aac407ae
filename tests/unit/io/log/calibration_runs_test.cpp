#include "outrider/io/log/calibration_runs.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

const std::string runs_head = "ahead_mps,left_mps,turn_dps,time_s,x_m,y_m,heading_deg\n";

TEST(CalibrationRuns, ReadsColumnsInAnyOrder) {
  const auto runs = calibration_runs_from_text(
      "# recorded on the yard\nheading_deg, "
      "time_s,x_m,y_m,ahead_mps,left_mps,turn_dps\n\n-3,2.5,0.5,0.1,0.2,0,0 # ok\n",
      "runs.csv");
  ASSERT_TRUE(runs);
  ASSERT_EQ(runs->size(), 1U);
  EXPECT_EQ(runs->front().command, (Twist2{0.2, 0.0, 0.0}));
  EXPECT_EQ(runs->front().time_s, 2.5);
  EXPECT_EQ(runs->front().start_T_end.position, (Vec2{0.5, 0.1}));
  EXPECT_NEAR(runs->front().start_T_end.heading_rad, radians(-3.0), 1e-15);
  EXPECT_EQ(runs->front().where, "runs.csv:4");
}

TEST(CalibrationRuns, WhatIsWrittenReadsBack) {
  Rng rng(1);
  std::vector<CalibrationRun> runs;
  for (int i = 0; i < 20; ++i) {
    runs.push_back({{0.25, 0.0, 0.0}, 1.5, {testing::random_point(rng, 3.0), rng.uniform(-9.0, 9.0)}, {}});
  }
  const auto read = calibration_runs_from_text(calibration_runs_text(runs), "");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_NEAR(distance((*read)[i].start_T_end.position, runs[i].start_T_end.position), 0.0, 1e-6);
    EXPECT_NEAR((*read)[i].start_T_end.heading_rad, runs[i].start_T_end.heading_rad, 1e-6);
  }
}

TEST(CalibrationRuns, RefusesWithTheLine) {
  const auto refused = [](const std::string& text, const std::string& says) {
    const auto runs = calibration_runs_from_text(text, "runs.csv");
    ASSERT_FALSE(runs) << text;
    EXPECT_NE(to_string(runs.error()).find(says), std::string::npos) << to_string(runs.error());
  };
  refused("", "runs.csv: there are no runs");
  refused(runs_head, "there are no runs");
  refused("time_s\n", "runs.csv:1: the column 'ahead_mps' is missing");
  refused("speed," + runs_head, "'speed' is no column");
  refused("time_s," + runs_head, "is given twice");
  refused(runs_head + "1,2\n", "runs.csv:2: 2 values for 7 columns");
  refused(runs_head + "1,0,0,fast,0,0,0\n", "runs.csv:2: 'fast' is not valid for time_s");
  refused(runs_head + "1,0,0,nan,0,0,0\n", "not valid for time_s");
  refused(runs_head + "1e9,0,0,1,0,0,0\n", "not valid for ahead_mps");
}

}  // namespace
}  // namespace outrider
