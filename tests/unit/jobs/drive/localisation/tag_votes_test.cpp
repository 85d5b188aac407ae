#include "outrider/jobs/drive/localisation/tag_votes.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

/// A tag that put the robot at (0, y), m, to 1 mm, where dead reckoning had it at (0, `reckoned_y`).
TagVotes::Vote vote(double y, double reckoned_y) {
  TagVotes::Vote vote;
  vote.information = Eigen::Matrix2d::Identity() * 1e6;
  vote.weighted_m = vote.information * Eigen::Vector2d(0.0, y);
  vote.weighted_reckoned_m = vote.information * Eigen::Vector2d(0.0, reckoned_y);
  return vote;
}

TEST(TagVotes, WhatDeadReckoningMovedSinceCountsHalf) {
  TagVotes votes;
  votes.votes[{1}] = vote(0.010, 0.0);
  votes.votes[{2}] = vote(0.010, 0.030);
  const std::set<int> first{1};
  EXPECT_EQ(votes.agreeing({}, 0.024), std::vector{first}) << "the other was seen 30 mm away";
  EXPECT_EQ(votes.agreeing({}, 0.028), (std::vector<std::set<int>>{first, {2}}))
      << "off by 10, and 15 for that";
  votes.corrected_m = {0.0, -0.010};  // the belief stays, so dead reckoning is 10 mm ahead of it
  EXPECT_EQ(votes.agreeing({}, 0.024), (std::vector<std::set<int>>{})) << "both are off by 20 mm";
}

}  // namespace
}  // namespace outrider
