#include "outrider/jobs/drive/localisation/tag_votes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double to_spare = 2.0;    ///< standard deviations
constexpr double may_be_off = 0.5;  ///< part of what dead reckoning says that the robot moved

}  // namespace

void TagVotes::note_correction(const PoseBelief& before, const PoseBelief& after) {
  const Vec2 by = after.world_T_robot.position - before.world_T_robot.position;
  corrected_m += Eigen::Vector2d(by.x, by.y);
}

void TagVotes::add(std::span<const TagSighting> sightings, std::span<const TagVerdict> verdicts,
                   const PoseBelief& belief, const TagMap& map, const RobotCamera& camera,
                   const LocaliseOptions& options) {
  std::vector<TagSighting> used;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (verdicts[i] == TagVerdict::used) used.push_back(sightings[i]);
  }
  const auto add_vote = [&](std::span<const TagSighting> tags) {
    const TagFix fix = localise(tags, map, camera, belief, options);
    if (!fix.belief || std::ranges::count(fix.verdicts, TagVerdict::used) != std::ssize(tags)) return;
    std::set<int> ids;
    for (const TagSighting& tag : tags) ids.insert(tag.id);
    const Vec2 off = fix.belief->world_T_robot.position - belief.world_T_robot.position;
    const Eigen::Matrix2d covariance = fix.belief->covariance.topLeftCorner<2, 2>();
    const Eigen::Matrix2d information = covariance.inverse();
    Vote& vote = votes[ids];
    vote.information += information;
    vote.weighted_m += information * (Eigen::Vector2d(off.x, off.y) + corrected_m);
    vote.weighted_reckoned_m += information * reckoned_m(belief.world_T_robot.position);
  };
  for (std::size_t i = 0; i < used.size(); ++i) {
    add_vote({&used[i], 1});
    std::vector<TagSighting> others = used;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (others.size() > 1) add_vote(others);
  }
}

std::vector<std::set<int>> TagVotes::agreeing(Vec2 believed, double most_m) const {
  std::vector<std::set<int>> sets;
  for (const auto& [ids, vote] : votes) {
    const Eigen::Matrix2d covariance = vote.information.inverse();
    const double variance =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).eigenvalues().maxCoeff();
    const double off_m = (covariance * vote.weighted_m - corrected_m).norm();
    const double moved_m = (covariance * vote.weighted_reckoned_m - reckoned_m(believed)).norm();
    if (off_m + may_be_off * moved_m + to_spare * std::sqrt(variance) <= most_m) sets.push_back(ids);
  }
  return sets;
}

}  // namespace outrider
