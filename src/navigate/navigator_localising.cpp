// The parts of the navigator that find where the robot is.
#include "outrider/navigate/navigator.hpp"

namespace outrider {

/// Takes a scan. If it corrects earlier poses too, what is marked moves along, since it was seen from about
/// here.
void Navigator::take(const LaserScan& scan) {
  const Pose2 then = odometry_at(scan.time_s);
  const Pose2 before = localiser_->world_T_odometry();
  const bool was_located = localiser_->is_located();
  const Pose2 about = compose(compose(before, then), setup_.robot_T_laser);
  followed_.note(scan, about);
  const bool corrected = localiser_->take(followed_.without(scan, about), then);
  note_localised(before, was_located, corrected);
  const Pose2 world_T_laser = compose(compose(localiser_->world_T_odometry(), then), setup_.robot_T_laser);
  map_.note(scan, world_T_laser);
  scan_s_ = scan.time_s;
  if (!localiser_->is_located()) search_.look(scan, world_T_laser);
}

/// Takes the tags of an image, once.
void Navigator::see(const TagImage& image) {
  if (image.taken_s <= image_s_) return;
  image_s_ = image.taken_s;
  const Pose2 before = localiser_->world_T_odometry();
  const bool was_located = localiser_->is_located();
  note_localised(before, was_located, localiser_->see(image, odometry_at(image.taken_s)));
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

}  // namespace outrider
