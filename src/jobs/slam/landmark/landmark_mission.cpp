#include "outrider/jobs/slam/landmark/landmark_mission.hpp"

#include <algorithm>

#include "outrider/job/clock.hpp"

namespace outrider {

std::optional<Command> LandmarkMission::step(const Observation& seen) {
  newest.reset();
  if (!seen.landmarks) return std::nullopt;
  odometry.push_back(compose(odometry.back(), seen.landmarks->odometry));
  const double since_s = wall_s();
  auto outcome = slam.advance(*seen.landmarks);
  times_s.push_back(wall_s() - since_s);
  if (!outcome) {
    fault = std::move(outcome.error());
    return std::nullopt;
  }
  if (checks_landmarks && outcome->used > 0) check.note(times_s.size() - 1, slam.landmarks());
  used += outcome->used;
  refused += outcome->refused;
  removed += static_cast<int>(outcome->removed.size());
  contradicted += outcome->contradicted;
  if (outcome->used > 0) misfits_now_ = 0;
  if (outcome->used == 0 && outcome->refused > 0) misfits = std::max(misfits, ++misfits_now_);
  lost += outcome->lost ? 1 : 0;
  newest = std::move(*outcome);
  return Wait{};
}

}  // namespace outrider
