#include "outrider/jobs/drive/task.hpp"

namespace outrider {

std::vector<Option> describe(TagEye& eye) {
  return {
      {"fx", "px", 1.0, 1e6, "focal length across the image", &eye.camera.fx},
      {"fy", "px", 1.0, 1e6, "focal length down the image", &eye.camera.fy},
      {"cx", "px", 0.0, 1e5, "where the axis meets the image, from its left", &eye.camera.cx},
      {"cy", "px", 0.0, 1e5, "where the axis meets the image, from its top", &eye.camera.cy},
      {"ahead", "m", -10.0, 10.0, "of the camera, ahead of the robot's middle", &eye.ahead_m},
      {"height", "m", 0.0, 10.0, "of the camera above the floor", &eye.height_m},
      {"rate", "1/s", 0.1, 60.0, "images a second", &eye.rate_hz},
      {"exposure", "s", 0.0, 0.1, "for which the shutter is open", &eye.exposure_s},
      {"latency", "s", 0.0, 2.0, "until the tags of an image are known; they correct the belief of its time",
       &eye.latency_s},
  };
}

RobotCamera robot_camera(const TagEye& eye) {
  return {eye.camera, looking_ahead({eye.ahead_m, 0.0, eye.height_m})};
}

std::vector<Option> describe(DriveRules& rules) {
  return {
      {"period", "s", 0.005, 1.0, "of control; an image older than its latency and half of it is not used",
       &rules.period_s},
      {"settle", "s", 0.0, 60.0, "of standing at a stop before it counts as reached", &rules.settle_s},
      {"most_settle", "s", 0.0, 600.0, "after which a stop is unconfirmed, and the robot goes on",
       &rules.most_settle_s},
      {"settle_sightings", "", 1, 1000,
       "images at a stop whose tags are accepted before it counts as reached", &rules.settle_sightings},
      {"settle_sigma", "m", 1e-4, 10.0, "standard deviation of a position that is not wide",
       &rules.settle_sigma_m},
      {"settle_sigma_angle", "deg", 0.01, 90.0, "standard deviation of a heading that is not wide",
       &rules.settle_sigma_rad},
      {"tags_move", "", 0, 0,
       "tags may be moved during the drive: where one alone tells a stop, the robot looks round for another",
       &rules.tags_move},
      {"patience", "s", 1.0, 1e5, "for one waypoint", &rules.patience_s},
      {"hold_refused", "", 1, 10000,
       "images in a row whose tags are where they cannot be; then the robot stands still",
       &rules.hold_refused},
      {"relocalise", "", 1, 10000, "images that have to agree on where it is then", &rules.relocalise},
      {"most_refused", "", 1, 10000, "images in a row whose tags are where they cannot be; then it is lost",
       &rules.most_refused},
      {"rest", "s", 0.0, 60.0, "between two motions of the open loop", &rules.rest_s},
  };
}

}  // namespace outrider
