#include "outrider/jobs/drive/tag_votes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double to_spare = 2.5;    ///< standard deviations
constexpr double turned_rad = 0.1;  ///< farther is a turn

}  // namespace

void TagVotes::note_correction(const PoseBelief& before, const PoseBelief& after) {
  const Vec2 by = after.world_T_robot.position - before.world_T_robot.position;
  corrected_m += Eigen::Vector2d(by.x, by.y);
}

void TagVotes::add(std::span<const TagSighting> sightings, std::span<const TagVerdict> verdicts,
                   const PoseBelief& belief, const TagMap& map, const RobotCamera& camera,
                   const LocaliseOptions& options) {
  const double heading_now_rad = belief.world_T_robot.heading_rad;
  if (std::abs(wrap_angle(heading_now_rad - heading_rad)) > turned_rad) {
    for (auto& [ids, vote] : since_turn) before_turn[ids] = vote;
    since_turn.clear();
  }
  heading_rad = heading_now_rad;
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
    for (Vote* const vote : {&votes[ids], &since_turn[ids]}) {
      vote->information += information;
      vote->weighted_m += information * (Eigen::Vector2d(off.x, off.y) + corrected_m);
    }
  };
  for (std::size_t i = 0; i < used.size(); ++i) {
    add_vote({&used[i], 1});
    std::vector<TagSighting> others = used;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (others.size() > 1) add_vote(others);
  }
}

std::vector<std::set<int>> TagVotes::agreeing(double most_m, double tag_sigma_m) const {
  std::vector<std::set<int>> sets;
  const double drifted_m = drift_m();
  for (const auto& [ids, vote] : votes) {
    const Eigen::Matrix2d covariance = vote.information.inverse();
    const double variance =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).eigenvalues().maxCoeff() +
        tag_sigma_m * tag_sigma_m;
    const double off_m = (covariance * vote.weighted_m - corrected_m).norm();
    if (off_m + drifted_m + to_spare * std::sqrt(variance) <= most_m) sets.push_back(ids);
  }
  return sets;
}

double TagVotes::drift_m() const {
  double most_m = 0.0;
  for (const auto& [ids, now] : since_turn) {
    const auto found = before_turn.find(ids);
    if (found == before_turn.end()) continue;
    const Vote& before = found->second;
    const Eigen::Matrix2d of_now = now.information.inverse(), of_before = before.information.inverse();
    const double drift_m = (of_now * now.weighted_m - of_before * before.weighted_m).norm();
    most_m = std::max(most_m, drift_m - std::sqrt((of_now + of_before).trace()));
  }
  return most_m;
}

}  // namespace outrider
