// PieceBody: an ideal differential robot that drives piece by piece, at its own pace and a little beside it.
//
// The robot aims at points beside the ends of the pieces, each drawn from a disk of the tracking error, and
// is on every piece beside it by the offsets of its ends, blended. Where that would touch an edge the offset
// is halved until it does not: walls stop the robot. Each turn and each piece has the trapezoidal profile of
// a speed drawn between the slowest and the full. So a drive keeps all that is asked of a robot by bounds on
// its time and by proofs of what it covers, and nothing more.
//
// A piece is driven as a whole: between its ends the body is nowhere, so no device looks from there.
// Same stream of random numbers and commands, same drive. O(edges near the piece) a piece.
#pragma once

#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/motion/pace.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"
#include "outrider/report/report.hpp"
#include "outrider/robot/command.hpp"

namespace outrider {

struct PieceDrive {
  std::vector<Vec2> way;        ///< driven, with points on arcs every 2 degrees
  std::vector<double> times_s;  ///< at which each of these points is reached
  std::vector<double> ends_s;   ///< of the pieces; its turn and its pause belong to a piece

  /// The poses, without a gun: exact at the points of the way and wherever the acceleration changes. Linear
  /// interpolation is exact at steady speed, and off by at most 3 mm and 4 mrad while it changes.
  std::vector<TrackSample> track;

  double time_s = 0.0;
  double length_m = 0.0;
  double turned_rad = 0.0;        ///< in place and along arcs
  double tracking_error_m = 0.0;  ///< largest offset
};

class PieceBody {
 public:
  /// The ground must outlive the body. Draws from the children `pace` and `stray` of the stream.
  PieceBody(const Pose2& start, const Pace& pace, double tracking_error_m, const PolygonGround& ground,
            const Rng& rng);

  /// Carries out a FollowPiece, and returns when it is done; other commands are done at once.
  double begin(const Command& command);
  void run_until(double time_s) { time_s_ = time_s; }

  [[nodiscard]] double time_s() const { return time_s_; }
  /// Where the last piece ends; the heading is not wrapped.
  [[nodiscard]] const Pose2& pose() const { return drive_.track.back().pose; }
  [[nodiscard]] Twist2 twist() const { return {}; }  ///< at rest between two pieces
  [[nodiscard]] const PieceDrive& drive() const { return drive_; }

 private:
  Vec2 next_offset(const FollowPiece& command);
  void follow(const FollowPiece& command);

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
