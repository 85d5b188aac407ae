// PieceDriver: drives a robot along one piece of a path by twists, as FollowPiece says: turn in place, wait,
// drive the piece from rest to rest.
//
// The speed is such that the robot can stop where the piece ends. Its heading follows the piece by feedback:
// along the way, the distance e from the piece and the angle a between the two are to satisfy
// e'' = -k^2 e - 2 k e', the critically damped equation, so the curvature driven is that of the piece less
// k^2 e + 2 k a. Source: Siciliano et al., Robotics, section 11.6 (path following).
#pragma once

#include <optional>

#include "outrider/motion/pace.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/robot/command.hpp"

namespace outrider {

class PieceDriver {
 public:
  /// `turns`: the robot turns in place.
  PieceDriver(const Pace& pace, bool turns) : pace_(pace), turns_(turns) {}

  void begin(const FollowPiece& command, double time_s);
  /// Returns the command for a robot that is at that pose; nothing once the piece is driven, or before the
  /// first.
  std::optional<Twist2> twist(double time_s, const Pose2& pose);
  /// Returns the distance of a point from the piece, m.
  [[nodiscard]] double distance_from(Vec2 point) const;
  /// Returns true if it drives along the piece, and does not turn or wait.
  [[nodiscard]] bool drives() const { return stage_ == Stage::drive; }
  /// Lets it begin from rest, after a stop.
  void stopped() { speed_ = turn_rate_ = 0.0; }

 private:
  enum class Stage { turn, wait, drive, done };

  /// The place of a point relative to the piece.
  struct Place {
    double along_m = 0.0;
    double left_m = 0.0;       ///< beside the piece, seen along the way
    double heading_rad = 0.0;  ///< of the way there
  };
  [[nodiscard]] Place place_of(Vec2 point) const;
  Twist2 turn(double step_s, double error_rad);
  Twist2 drive(double step_s, const Pose2& pose);

  Pace pace_;
  bool turns_;
  FollowPiece command_;
  Stage stage_ = Stage::done;
  double until_s_ = 0.0;
  double time_s_ = 0.0;  ///< of the newest command
  double speed_ = 0.0;
  double turn_rate_ = 0.0;
};

}  // namespace outrider
