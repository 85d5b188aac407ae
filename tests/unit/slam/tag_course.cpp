#include "tag_course.hpp"

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double half_room_m = 0.9;
constexpr double square_side_m = 0.8;
constexpr double octagon_side_m = 0.3313;
constexpr double place_error = 0.2;  // m in the root of a metre
const double heading_error_rad = radians(5.0);
const double half_view_rad = radians(45.0);
constexpr double reach_m = 2.5;
constexpr double tag_error_m = 0.01;

std::map<std::int64_t, Vec2> tags() {
  std::map<std::int64_t, Vec2> result;
  for (int i = 0; i < 4; ++i) {
    result[2 * i] = rotated(0.5 * pi * i, {half_room_m, 0.0});
    result[2 * i + 1] = rotated(0.5 * pi * i, {half_room_m, half_room_m});
  }
  return result;
}

Vec2 noisy(Vec2 v, double sd, Rng& rng) {
  const double x = rng.normal(), y = rng.normal();
  return v + sd * Vec2{x, y};
}

void look(const Pose2& robot, LogStep& step, const std::map<std::int64_t, Vec2>& places, Rng& rng) {
  for (const auto& [id, place] : places) {
    const Vec2 seen = robot.to_local(place);
    const double off_axis = std::abs(heading_of(seen)) / half_view_rad;
    if (off_axis > 1.0 || norm(seen) > reach_m) continue;
    const double sd = tag_error_m * (1.0 + off_axis * off_axis);
    step.sightings.push_back({id, noisy(seen, sd, rng), sd * sd * Eigen::Matrix2d::Identity()});
  }
}

/// A true motion, and what odometry and camera make of it.
void move(TagRun& run, const Pose2& motion, Rng& rng) {
  const Pose2& before = run.poses.empty() ? run.log.start : run.poses.back();
  run.poses.push_back(wrap_heading(compose(before, motion)));
  const double driven_m = norm(motion.position);
  const double quarters = std::abs(motion.heading_rad) / (0.5 * pi);
  constexpr double least = 1e-4;
  const double place_sd = place_error * std::sqrt(driven_m) + least;
  const double heading_sd = heading_error_rad * std::sqrt(driven_m + quarters) + least;
  LogStep step;
  step.time_s = static_cast<double>(run.poses.size());
  step.odometry.position = noisy(motion.position, place_sd, rng);
  step.odometry.heading_rad = motion.heading_rad + heading_sd * rng.normal();
  step.covariance =
      Eigen::Vector3d(place_sd * place_sd, place_sd * place_sd, heading_sd * heading_sd).asDiagonal();
  look(run.poses.back(), step, run.log.true_landmarks, rng);
  run.log.steps.push_back(std::move(step));
}

}  // namespace

TagRun drive_tag_course(const TagCourse& course, Rng& rng) {
  constexpr double longest_m = 0.025;
  const double widest_rad = radians(7.5);
  const double side_m = course.sides == 8 ? octagon_side_m : square_side_m;
  const double turn_rad = 2.0 * pi / course.sides;
  const int drives = static_cast<int>(std::ceil(side_m / longest_m));
  const int turns = static_cast<int>(std::ceil(turn_rad / widest_rad - 1e-9));
  TagRun run;
  run.log.true_landmarks = tags();
  run.log.start = {{-0.5 * side_m, -0.5 * square_side_m}, 0.0};
  for (int i = 0; i < 2; ++i) move(run, {}, rng);
  for (int side = 0; side < course.sides * course.laps; ++side) {
    for (int i = 0; i < drives; ++i) move(run, {{side_m / drives, 0.0}, 0.0}, rng);
    for (int i = 0; i < turns; ++i) move(run, {{}, turn_rad / turns}, rng);
  }
  return run;
}

}  // namespace outrider
