#include "log_lines.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {

std::vector<Option> describe(LogNoise& noise) {
  return {{"distance", "", 1e-6, 100, "m of error in the root of a metre driven, along and across",
           &noise.distance},
          {"turn_per_distance", "deg", 0, 360, "error of heading in the root of a metre driven",
           &noise.turn_per_distance_rad},
          {"turn", "", 0, 100, "rad of error in the root of a radian turned", &noise.turn},
          {"range", "m", 1e-6, 1000, "error of a range", &noise.range_m},
          {"bearing", "deg", 1e-6, 180, "error of a bearing", &noise.bearing_rad}};
}

Status for_each_line(const NamedText& text,
                     const std::function<Status(std::span<const std::string_view>)>& read) {
  constexpr std::size_t most_lines = 2'000'000;
  TextLines lines{text.text, text.name};
  while (lines.next_filled()) {
    if (lines.number > most_lines) {
      return bad_input(fmt::format("more than {} lines; shorten the file", most_lines), lines.where());
    }
    if (auto ok = read(words(lines.line)); !ok) return bad_input(ok.error().sentence, lines.where());
  }
  return {};
}

Outcome<std::vector<double>> line_numbers(std::span<const std::string_view> words, std::size_t count,
                                          std::string_view takes) {
  std::vector<double> result;
  for (const std::string_view word : words) {
    const auto value = number<double>(word);
    if (!value || std::abs(*value) > 1e12) {
      return bad_input(fmt::format("'{}' is no number of use; a line is {}", excerpt(word), takes));
    }
    result.push_back(*value);
  }
  if (result.size() == count) return result;
  return bad_input(fmt::format("{} numbers where a line is {}", result.size(), takes));
}

/// Adds independent errors for each part, so that the variances grow with the distance and the angle (Thrun,
/// Burgard and Fox, Probabilistic Robotics, section 5.4, with standard deviations that grow with the square
/// root).
void Motion::add(double turn_rad, double distance_m, double then_turn_rad, const LogNoise& noise) {
  const double heading_rad = pose.heading_rad + turn_rad;
  const Vec2 arm = distance_m * direction(heading_rad);
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose(0, 2) = -arm.y;
  by_pose(1, 2) = arm.x;
  const double driven_m = std::abs(distance_m);
  const double turned_rad = std::abs(turn_rad) + std::abs(then_turn_rad);
  constexpr double least = 1e-8;  // a robot at rest may still have been pushed
  const double place = noise.distance * noise.distance * driven_m + least;
  const double heading = noise.turn_per_distance_rad * noise.turn_per_distance_rad * driven_m +
                         noise.turn * noise.turn * turned_rad + least;
  covariance = by_pose * covariance * by_pose.transpose();
  covariance.diagonal() += Eigen::Vector3d(place, place, heading);
  pose = {pose.position + arm, wrap_angle(heading_rad + then_turn_rad)};
}

}  // namespace outrider
