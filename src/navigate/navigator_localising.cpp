// The parts of the navigator that find where the robot is.
#include <fmt/format.h>

#include <algorithm>

#include "beams.hpp"
#include "outrider/core/units.hpp"
#include "outrider/navigate/navigator.hpp"

namespace outrider {
namespace {

constexpr double lost_after = 120.0;   // times that without a scan after which the robot stands
constexpr double look_within_m = 0.3;  // of a place to look from
constexpr double look_turn_rad = 2.0;  // where there is none

}  // namespace

/// Takes a scan. If it corrects earlier poses too, what is marked moves along, since it was seen from about
/// here.
void Navigator::take(const LaserScan& scan) {
  const Pose2 then = odometry_.at(scan.time_s);
  const Pose2 before = localiser_->world_T_odometry();
  const bool was_located = localiser_->is_located();
  const Pose2 about = compose(compose(before, then), setup_.robot_T_laser);
  followed_.note(scan, about);
  const bool corrected = localiser_->take(followed_.without(scan, about), then);
  note_localised(before, was_located, corrected);
  const Pose2 world_T_laser = compose(compose(localiser_->world_T_odometry(), then), setup_.robot_T_laser);
  map_.note(scan, world_T_laser);
  scan_s_ = scan.time_s;
  looks_back_ = looks_at(scan, pi - setup_.robot_T_laser.heading_rad);
  if (!localiser_->is_located()) search_.look(scan, world_T_laser);
}

/// Takes the tags of an image, once.
void Navigator::see(const TagImage& image) {
  if (image.taken_s <= image_s_) return;
  image_s_ = image.taken_s;
  const Pose2 before = localiser_->world_T_odometry();
  const bool was_located = localiser_->is_located();
  note_localised(before, was_located, localiser_->see(image, odometry_.at(image.taken_s)));
}

/// Moves what was seen before along with a correction of earlier poses.
void Navigator::note_localised(const Pose2& before, bool was_located, bool corrected) {
  if (corrected) map_.correct(compose(localiser_->world_T_odometry(), inverse(before)));
  if (corrected) followed_.clear();
  if (localiser_->is_located() != was_located) {
    order_.reset();
    progress_ = {};
    search_.begin();
    map_.follow(pose().position);
    map_.know(was_located || !far_ ? nullptr : far_->walls());
  }
}

/// Goes from place to place until the robot recognises where it is, or gives up.
Twist2 Navigator::look_for_itself() {
  search_.advance(odometry_.twist().ahead_mps, setup_.options.period_s);
  if (search_.length_m() > setup_.options.most_search_m) {
    progress_ = {Progress::State::lost,
                 {},
                 fmt::format("it has not recognised where it is on its map, on a way of {:.0f} m",
                             search_.length_m())};
  }
  if (progress_.state == Progress::State::lost || is_blind() || !search_.looks()) return {};
  if (!order_ || progress_.state != Progress::State::underway) {
    const Pose2 here = pose();
    const auto place = search_.next(here.position, setup_.footprint.outer_m() + setup_.motion.wide_m);
    begin(place ? GoTo{*place, look_within_m}
                : GoTo{here.position, look_within_m, here.heading_rad + look_turn_rad, 0.5 * look_turn_rad});
  }
  return go(GoTo{*order_});
}

/// Returns true if no scan has come for too long; after a while the robot is lost.
bool Navigator::is_blind() {
  const double blind_s = now_s() - scan_s_.value_or(left_.nearer_s);
  if (scan_s_ && blind_s <= setup_.options.blind_s) return false;
  if (scan_s_) left_.nearer_s = now_s();
  if (blind_s > lost_after * setup_.options.blind_s)
    progress_ = {Progress::State::lost, {}, fmt::format("no scan has come for {:.1f} s", blind_s)};
  return true;
}

}  // namespace outrider
