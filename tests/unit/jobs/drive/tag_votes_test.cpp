#include "outrider/jobs/drive/tag_votes.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace outrider {
namespace {

/// Says that tags put the robot there, m, with that standard deviation.
TagVotes::Vote vote(double x, double y, double sd_m) {
  TagVotes::Vote vote;
  vote.information = Eigen::Matrix2d::Identity() / (sd_m * sd_m);
  vote.weighted_m = vote.information * Eigen::Vector2d(x, y);
  return vote;
}

/// Many images of one tag tell its place well, but not better than its place is known.
TEST(TagVotes, WhereATagHangsIsNotAveraged) {
  TagVotes votes;
  votes.votes[{3}] = vote(0.0, 0.019, 0.0005);
  EXPECT_EQ(votes.agreeing(0.024, 0.0).size(), 1U);
  EXPECT_TRUE(votes.agreeing(0.024, 0.005).empty()) << "19 mm off, known to 5 mm";
  votes.votes[{3}] = vote(0.0, 0.011, 0.0005);
  EXPECT_EQ(votes.agreeing(0.024, 0.005).size(), 1U);
}

/// Tag 1 was moved by 4 cm and is consistent with itself. The robot looked at it, turned to tag 3 and back,
/// and drifted by 14 mm on the way, which only tag 1 tells.
TEST(TagVotes, DriftWhileItTurnsCounts) {
  TagVotes votes;
  votes.votes[{3}] = vote(0.0, 0.010, 0.002);
  votes.votes[{1}] = vote(0.0, -0.002, 0.001);
  votes.since_turn[{1}] = vote(0.0, -0.002, 0.001);
  EXPECT_EQ(votes.drift_m(), 0.0) << "it has not turned";
  EXPECT_EQ(votes.agreeing(0.024, 0.005).size(), 2U);
  votes.before_turn[{1}] = vote(0.0, -0.016, 0.001);
  EXPECT_NEAR(votes.drift_m(), 0.014 - 0.002, 1e-9);
  EXPECT_EQ(votes.agreeing(0.024, 0.005).size(), 0U);
}

}  // namespace
}  // namespace outrider
