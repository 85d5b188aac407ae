// PieceBody: a differential-drive robot that follows a path piece by piece, with a bounded tracking error and
// a random speed.
//
// At the end of each piece the robot has an offset from the path, drawn from a disk with the radius of the
// tracking error. Along a piece the offset is blended between its two ends. If the robot would touch an edge,
// the offset is halved until it does not: walls stop the robot. Each turn and each piece follows a
// trapezoidal speed profile with a maximum speed drawn between the slowest and the full speed. A drive thus
// meets exactly the assumptions behind the bounds on its time and the proofs of its coverage, and no more.
//
// A piece is driven as a whole: the body has no pose between the ends of a piece, so devices cannot measure
// there. The same random stream and commands give the same drive. O(edges near the piece) per piece.
#pragma once

#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/motion/pace.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"
#include "outrider/robot/command.hpp"

namespace outrider {

struct TimedPose {
  double time_s = 0.0;
  Pose2 pose;
};

/// A time span in which the robot was carried: it did not drive from the pose before to the one after.
struct Carried {
  double from_s = 0.0;
  double until_s = 0.0;
};

/// A record of the driven path.
struct PieceDrive {
  std::vector<Vec2> way;        ///< points of the driven path; on arcs one every 2 degrees
  std::vector<double> times_s;  ///< time at which each point of `way` is reached
  std::vector<double> ends_s;   ///< end time of each piece, including its turn and pause

  /// Poses over time. They are exact at the points of `way` and where the acceleration
  /// changes. Linear interpolation is exact at constant speed; otherwise its error is at most 3 mm and 4
  /// mrad.
  std::vector<TimedPose> track;
  std::vector<Carried> carried;  ///< in the order of time; `way` and `track` have no points within

  double time_s = 0.0;            ///< end of the drive
  double length_m = 0.0;          ///< length of `way`
  double turned_rad = 0.0;        ///< sum of turns in place and along arcs
  double tracking_error_m = 0.0;  ///< largest offset so far
};

class PieceBody {
 public:
  /// The ground must outlive the body. Draws from the child streams `pace` and `stray` of `rng`.
  PieceBody(const Pose2& start, const Pace& pace, double tracking_error_m, const PolygonGround& ground,
            const Rng& rng);

  /// Carries out a FollowPiece or a Wait and returns its end time; other commands end at once.
  double begin(const Command& command);
  void run_until(double time_s) { time_s_ = time_s; }

  [[nodiscard]] double time_s() const { return time_s_; }
  /// Returns the pose at the end of the last piece; the heading is not wrapped.
  [[nodiscard]] const Pose2& pose() const { return drive_.track.back().pose; }
  [[nodiscard]] Twist2 twist() const { return {}; }  ///< at rest between two pieces
  [[nodiscard]] const PieceDrive& drive() const { return drive_; }

 private:
  Vec2 next_offset(const FollowPiece& command);
  void follow(const FollowPiece& command);
  double turn(double angle_rad, const Limits& limits, double pause_s);
  void drive_along(const std::vector<Vec2>& points, const std::vector<double>& headings,
                   const Limits& limits);

  Pace pace_;
  double tracking_error_m_;
  const PolygonGround* ground_;
  Rng speed_rng_;
  Rng offset_rng_;
  double time_s_ = 0.0;
  double heading_rad_;  ///< now
  Vec2 offset_;         ///< of the end of the last piece
  PieceDrive drive_;
};

}  // namespace outrider
