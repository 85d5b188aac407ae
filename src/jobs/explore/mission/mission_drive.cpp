#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "outrider/jobs/explore/mission/mission.hpp"

namespace outrider {
namespace {

constexpr double instant_s = 1e-9;  // by which times are rounded

}  // namespace

/// Returns true if it is time for a new decision.
bool ExploreMission::time_to_decide() const {
  if (!where_->has_news()) return false;
  if (!path_ || sees_nothing_new()) return true;
  if (where_->time_s() - decided_s_ >= task_.rules.think_again_s - instant_s) return true;
  if (stage_ == ExploreStage::seek && !frontiers_.frontiers().contains(decision_.choice.frontier))
    return true;
  return remaining_m(*path_) < arrived_m();
}

/// Returns true if the robot has been at one place for too long. The navigator does not know, since orders
/// change with the map.
bool ExploreMission::stands_still() {
  constexpr double moved_m = 0.04;
  const Pose2& here = where_->pose();
  if (!path_ || distance(here.position, stood_.position) > moved_m) {
    stood_ = here;
    moved_on_s_ = where_->time_s();
  }
  return where_->time_s() - moved_on_s_ > task_.rules.patience_s + instant_s;
}

/// Leaves the goal out for a while, since the robot got stuck on the way or touched something, which blocks
/// the ground: there may be another way.
void ExploreMission::give_up_goal(const std::string& why) {
  constexpr double elsewhere_m = 20.0;  // between two times stuck that have nothing in common
  if (where_->driven_m() - stuck_m_ > elsewhere_m) stuck_here_ = 0;
  stuck_m_ = where_->driven_m();
  ++stuck_;
  const bool touched_new = touching_ && touches_.take_new();
  if (!touched_new) ++stuck_here_;
  const Vec2 here = where_->pose().position;
  add_event(touching_ ? "touch" : "stuck", fmt::format("at ({:.2f}, {:.2f}): {}", here.x, here.y, why));
  if (stuck_here_ > task_.rules.most_stuck) {
    end("stuck", fmt::format("it got stuck {} times in a row", stuck_here_));
    return;
  }
  if (!touching_) {
    if (gaps_.in_narrow() && gaps_.note_stuck(*where_, frontiers_.ground()))
      too_narrow();
    else if (stage_ == ExploreStage::seek && path_)
      blacklist_.add(decision_.choice.place, where_->time_s());
  }
  path_.reset();
  order_.reset();
  moved_on_s_ = where_->time_s();
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
    home_.nearer_s = where_->time_s();
  } else if (where_->time_s() - home_.nearer_s > home_patience_s) {
    const double cell_m = task_.slam.map.resolution_m;
    end("stuck", fmt::format("it gets no nearer to home since {:.0f} s: {}", home_.nearer_s,
                             cell_m > task_.robot.radius_m
                                 ? fmt::format("are the cells of its map, {} m, too wide for it?", cell_m)
                                 : "is the way closed?"));
  }
}

/// Looks at narrow places ahead from near, and goes elsewhere where they are too narrow.
void ExploreMission::look_close() {
  if (gaps_.look(task_, *where_, frontiers_.ground(), touches_.points(), path_ ? &*path_ : nullptr,
                 stage_ == ExploreStage::seek ? Driving::to_goal : Driving::home))
    return;
  add_event("narrow", gaps_.sentence());
  too_narrow();
}

/// The gap ahead is too narrow: the way through it is closed again.
void ExploreMission::too_narrow() {
  touches_.redraw();
  gaps_.shut_gaps(frontiers_.ground());
  path_.reset();
}

/// Returns the order to go on along the path: to its end, or to a place on it a little ahead. The order
/// before stands as long as that is so of it.
GoTo ExploreMission::next_order(const PathProgress& path) const {
  constexpr double ahead_m = 2.0, again_m = 0.8, within_m = 0.3, same_m = 0.07;
  const std::vector<Vec2> ahead = points_ahead(path, ahead_m);
  const Vec2 end = path.points.back();
  const auto is_same = [&](Vec2 place) {
    return order_ && distance(place, order_->place) < same_m &&
           distance(place, where_->pose().position) > again_m;
  };
  if (std::ranges::any_of(ahead, is_same)) return *order_;
  if (remaining_m(path) > ahead_m) return {ahead.back(), within_m};
  const bool goes_there = order_ && distance(end, order_->place) < arrived_m() && order_->within_m < within_m;
  return goes_there ? *order_ : GoTo{end, arrived_m()};
}

Order ExploreMission::drive() {
  if (path_) advance_along(*path_, where_->pose().position);
  end_if_no_nearer_to_home();
  if (stage_ == ExploreStage::over) return Hold{};
  look_close();
  const bool blocked = order_ && now_.progress.state == Progress::State::blocked;
  if (blocked || stands_still()) {
    give_up_goal(blocked ? now_.progress.why : "it does not move on");
    return Hold{};
  }
  if (stage_ == ExploreStage::over || where_->settles_soon()) return Hold{};
  if (time_to_decide()) {
    decide_anew();
    look_close();
  }
  if (where_->has_news()) navigator_.look_close(gaps_.surfaces(), CloseRange::reach_m - 0.1);
  if (!path_ || !gaps_.may_pass()) return Hold{};
  if (gaps_.in_narrow() && remaining_m(*path_) > arrived_m()) {
    if (!through_ || where_->has_news()) through_ = gaps_.order(*path_, task_.robot);
    order_.reset();
    return *through_;
  }
  through_.reset();
  order_ = next_order(*path_);
  return *order_;
}

}  // namespace outrider
