#include "outrider/sim/bodies/navigated_body.hpp"

#include <algorithm>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "times.hpp"

namespace outrider {

NavigatedBody::NavigatedBody(std::unique_ptr<const World> world, const Pose2& start, const RobotModel& robot,
                             const ExplorerSimParams& params, std::uint64_t seed, Navigator navigator,
                             double within_m)
    : world_(std::move(world)),
      body_(*world_, start, robot, params.wheels, Rng(seed).child("wheels"), params.faults,
            Rng(seed).child("walk-ins"), params.footprint),
      laser_(*world_, params.laser, Rng(seed).child("laser"), params.faults),
      navigator_(std::move(navigator)),
      within_m_(within_m),
      kidnapping_(params.faults.kidnapping) {
  perceive();
}

void NavigatedBody::watch(Look look, std::stop_token stop) {
  look_ = std::move(look);
  stop_ = std::move(stop);
}

void NavigatedBody::perceive() {
  Observation seen;
  seen.time_s = time_s();
  seen.odometry = logged_pose(body_.odometry());
  seen.touching = body_.take_touch();
  if (seen.touching) seen.touch_rad = body_.touch_rad();
  seen.scan = laser_.look(pose(), seen.time_s, &body_.walk_ins());
  now_ = navigator_.perceive(seen);
  belief_error_m_ = std::max(belief_error_m_, distance(now_.pose.position, pose().position));
  if (look_) look_(seen, now_, navigator_);
}

void NavigatedBody::carry_out(const Order& order, double until_s) {
  const double end_s = std::min(until_s, body_.begin(navigator_.act(order)));
  body_.run_until(end_s);
  if (!kidnapped_ && time_s() >= kidnapping_.at_s) {
    kidnapped_ = was_put_ = true;
    body_.put(compose(pose(), {{0.0, kidnapping_.by_m}, kidnapping_.by_rad}));
  }
  recoveries_ = std::max(recoveries_, navigator_.recoveries());
  perceive();
}

void NavigatedBody::drive_to(Vec2 place, const std::function<bool()>& goes_on) {
  constexpr double forever_s = 1e9;
  const GoTo there{place, within_m_, now_.pose.heading_rad, pi};
  do {
    carry_out(there, forever_s);
    if (now_.progress.state == Progress::State::arrived) return;
    if (now_.progress.state != Progress::State::underway) {
      why_stopped_ = now_.progress.why;
      return;
    }
  } while (goes_on() && !stop_.stop_requested());
}

void NavigatedBody::go(const Order& order, double until_s) {
  while (time_s() < until_s - instant_s && !stop_.stop_requested()) carry_out(order, until_s);
}

}  // namespace outrider
