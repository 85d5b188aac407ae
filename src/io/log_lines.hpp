// Shared by the readers of logs and graphs: lines of words and numbers, and motions with their noise.
#pragma once

#include <functional>
#include <span>

#include "outrider/io/landmark_logs.hpp"
#include "outrider/io/text.hpp"

namespace outrider {

/// Calls `read` with the words of each line that is not empty; '#' starts a comment. Adds file and line to
/// its faults.
Status for_each_line(const NamedText& text,
                     const std::function<Status(std::span<const std::string_view>)>& read);

/// Returns the words as numbers. Fault: bad_input, with the form `takes`, unless there are `count` words and
/// all are finite numbers.
Outcome<std::vector<double>> line_numbers(std::span<const std::string_view> words, std::size_t count,
                                          std::string_view takes);

/// A motion with its covariance, composed of short motions.
struct Motion {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Adds a turn, a straight drive and a second turn.
  void add(double turn_rad, double distance_m, double then_turn_rad, const LogNoise& noise);
};

}  // namespace outrider
