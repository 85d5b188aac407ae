#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mission/near_robot.hpp"
#include "outrider/jobs/explore/mission/mission.hpp"

namespace outrider {

/// Returns true if the next part of the path is blocked.
bool ExploreMission::blocked(const Nearby& nearby) const {
  const double gap_m = gaps_.in_narrow() ? 0.0 : task_.steer.least_gap_m;
  const double wanted =
      std::min(task_.robot.radius_m + gap_m, nearby.clearance(where_.pose().position) - 1e-3);
  double before = 0.0;
  const PathProgress& path = *path_;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Segment leg{path.points[i - 1], path.points[i]};
    const double length = distance(leg.a, leg.b);
    before += length;
    if (before <= path.along_m || length == 0.0) continue;
    const double from = std::max(0.0, path.along_m - (before - length));
    const Segment ahead{leg.a + (from / length) * (leg.b - leg.a), leg.b};
    if (distance(ahead.a, where_.pose().position) > nearby_m) return false;
    if (nearby.clearance(ahead) < wanted) return true;
  }
  return false;
}

/// Returns true if it is time for a new decision.
bool ExploreMission::time_to_decide(const Nearby& nearby) const {
  if (!where_.has_news()) return false;
  if (!path_ || sees_nothing_new()) return true;
  if (where_.time_s() - decided_s_ >= task_.rules.think_again_s) return true;
  if (stage_ == ExploreStage::seek && !frontiers_.frontiers().contains(decision_.choice.frontier))
    return true;
  return remaining_m(*path_) < arrived_m || blocked(nearby);
}

/// Goes back along the way it came, and leaves the goal out for a while. If it has just tried that here, goes
/// to where there is most room.
void ExploreMission::back_off(const Nearby& nearby) {
  const Vec2 here = where_.pose().position;
  const std::int64_t stuck = retreat_.count(where_.driven_m(), touching_ && touches_.take_new());
  add_event(touching_ ? "touch" : "stuck",
            fmt::format("at ({:.2f}, {:.2f}): {}; it goes back a little", here.x, here.y,
                        touching_ ? "something was touched" : "it does not move on"));
  if (stuck > task_.rules.most_stuck)
    return end("stuck", fmt::format("it got stuck {} times in a row", stuck));
  // A touch has blocked the ground; there may be another way.
  if (gaps_.in_narrow()) {
    if (gaps_.note_stuck(where_, frontiers_.ground())) too_narrow();
  } else if (stage_ == ExploreStage::seek && path_ && !touching_) {
    blacklist_.add(decision_.choice.place, where_.time_s());
  }
  stage_ = ExploreStage::back_off;
  follow(retreat_.way(where_, nearby, task_.rules.back_off_m));
  moved_on();
}

/// Returns the twist at half the speed.
Twist2 ExploreMission::steer_slowly(const Pose2& pose, const Twist2& now, const Nearby& nearby) const {
  RobotModel slow = task_.robot;
  slow.speed_mps *= 0.5;
  return steer(*path_, pose, now, nearby, slow, task_.steer);
}

/// Returns the twist for a robot that drives backwards.
Twist2 ExploreMission::steer_back(const Nearby& nearby) const {
  const Pose2 turned{where_.pose().position, where_.pose().heading_rad + pi};
  const Twist2 now{-where_.twist().ahead_mps, 0.0, where_.twist().turn_radps};
  const Twist2 back = steer_slowly(turned, now, nearby);
  return {-back.ahead_mps, 0.0, back.turn_radps};
}

/// Ends the mission if the robot has got no nearer to home for long, as behind a door that was closed. It may
/// move all that time, to and fro.
void ExploreMission::end_if_no_nearer_to_home() {
  constexpr double nearer_m = 0.1, home_patience_s = 120.0;
  if (stage_ != ExploreStage::go_home || !path_) return;
  const double left_m = remaining_m(*path_);
  double& least_m = home_.left_m[home_.on_trail ? 1 : 0];
  if (left_m < least_m - nearer_m) {
    least_m = left_m;
    home_.nearer_s = where_.time_s();
  } else if (where_.time_s() - home_.nearer_s > home_patience_s) {
    const double cell_m = task_.slam.map.resolution_m;
    end("stuck", fmt::format("it gets no nearer to home since {:.0f} s: {}", home_.nearer_s,
                             cell_m > task_.robot.radius_m
                                 ? fmt::format("are the cells of its map, {} m, too wide for it?", cell_m)
                                 : "is the way closed?"));
  }
}

/// Returns the obstacles around the robot: by the map; by the last scans in a narrow place; by the newest
/// scan if the map encloses the robot. Touched obstacles are added too, except beside the trail that leads
/// home.
Nearby ExploreMission::surroundings() const {
  constexpr double beam_m = 0.01;
  Nearby nearby;
  if (gaps_.in_narrow())
    nearby = gaps_.surfaces();
  else if (retreat_.often_here(where_.driven_m()))
    nearby = {where_.beam_ends(), beam_m};
  else
    nearby = {where_.slam().map().occupancy(), where_.pose().position, nearby_m};
  if (!home_.on_trail) nearby.add(touches_.points());
  return nearby;
}

/// Looks at narrow places ahead from near, and goes elsewhere where they are too narrow.
void ExploreMission::look_close() {
  const Driving driving = stage_ == ExploreStage::back_off ? Driving::back
                          : stage_ == ExploreStage::seek   ? Driving::to_goal
                                                           : Driving::home;
  if (gaps_.look(task_, where_, frontiers_.ground(), path_ ? &*path_ : nullptr, driving)) return;
  add_event("narrow", gaps_.sentence());
  too_narrow();
}

/// The gap ahead is too narrow: the way through it is closed again.
void ExploreMission::too_narrow() {
  touches_.redraw();
  path_.reset();
}

bool ExploreMission::stands_still() {
  return path_ && retreat_.stands_still(where_.pose(), where_.time_s(), task_.rules.patience_s);
}

Twist2 ExploreMission::drive() {
  if (path_) advance_along(*path_, where_.pose().position);
  end_if_no_nearer_to_home();
  if (stage_ == ExploreStage::over) return {};
  look_close();
  Nearby nearby = surroundings();
  if (stage_ == ExploreStage::back_off) {
    if (path_ && remaining_m(*path_) >= arrived_m && !stands_still())
      return retreat_.backwards() ? steer_back(nearby) : steer_slowly(where_.pose(), where_.twist(), nearby);
    stage_ = ExploreStage::seek;
    path_.reset();
  } else if (touching_ || stands_still()) {
    back_off(nearby);
    return {};
  }
  if (where_.settles_soon()) return {};
  if (time_to_decide(nearby)) {
    decide_anew();
    look_close();
    nearby = surroundings();
  }
  if (!path_ || !gaps_.may_pass()) return {};
  const auto [robot, steering] = gaps_.way_of_driving(task_);
  return steer(*path_, where_.pose(), where_.twist(), nearby, robot, steering);
}

}  // namespace outrider
