// What the readers of landmark logs share: lines of words and numbers, and motions with their noise.
#pragma once

#include <functional>
#include <span>

#include "outrider/io/landmark_logs.hpp"
#include "outrider/io/text.hpp"

namespace outrider {

/// Calls `read` with the words of each line that has some, without what follows '#', and puts the place
/// before what it refuses.
Status for_each_line(const NamedText& text,
                     const std::function<Status(std::span<const std::string_view>)>& read);

/// The words as numbers; refused, with what a line takes, unless there are as many and all are finite.
Outcome<std::vector<double>> line_numbers(std::span<const std::string_view> words, std::size_t count,
                                          std::string_view takes);

/// A motion with its covariance, made of short ones one after the other.
struct Motion {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Turns, drives, turns.
  void add(double turn_rad, double distance_m, double then_turn_rad, const LogNoise& noise);
};

}  // namespace outrider
