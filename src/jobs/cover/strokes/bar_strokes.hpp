// Strokes of a bar: straight motions whose sweep stays within the area, with the ways to and from them.
//
// A stroke ends where the bar is as near to what stands ahead as it may be; there it cannot turn. So the
// robot enters a stroke from a place where it can, a station, backs to where the stroke begins, drives it,
// backs to the next station, and leaves. A station is a point of the stroke where the disk of the robot with
// its bar has room; or, beside a wall, one that is reached sideways: with a bar ahead the robot backs in on a
// line that leads away from the wall, and turns towards the stroke. With a bar behind it all is driven the
// other way round.
#pragma once

#include <optional>

#include "ground/coverage_units.hpp"
#include "ground/free_room.hpp"
#include "outrider/jobs/cover/ground/problem.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"

namespace outrider::cover {

/// The room in which a robot with a bar may move.
class BarRoom {
 public:
  /// Faults: those of PolygonGround::of(). The field must outlive this object.
  static Outcome<BarRoom> of(const CoverProblem& problem, const CoverField& field);

  /// Returns true if the robot and its bar stay within the area between two poses, straight or in place.
  [[nodiscard]] bool free(const Pose2& from, const Pose2& to) const;
  /// Returns true if it can turn there, whichever way.
  [[nodiscard]] bool turns(Vec2 p) const;

  [[nodiscard]] const Bar& bar() const { return bar_; }
  /// Distance of the bar from edges that strokes keep.
  [[nodiscard]] double slack_m() const { return slack_m_; }

 private:
  BarRoom(const CoverField& field, const Bar& bar, double slack_m, PolygonGround body);

  const CoverField* field_;
  Bar bar_;
  double slack_m_;
  std::shared_ptr<const PolygonGround> body_;
  std::shared_ptr<const FreeRoom> room_;
};

/// A line for the bar: it is to pass from `from` to `to`, and `overrun_m` farther at both ends.
struct BarLine {
  Vec2 from;
  Vec2 to;
  double overrun_m = 0.0;
  double away_rad =
      0.0;              ///< how a robot turns away from a wall beside the line, for a bar ahead; 0: it cannot
  double away_m = 0.0;  ///< how far it drives then until it can turn
};

/// A turn of the robot away from a wall: its angle, and the distance that the bar then has to keep in
/// addition to half its width.
struct WallTurn {
  double angle_rad;
  double gap_m;
};
WallTurn wall_turn(const Bar& bar);

/// Returns the stroke along the line as far as it is free about its middle; nothing without stations.
std::optional<Traversal> bar_stroke(const BarLine& line, const BarRoom& room, PieceRole role);

}  // namespace outrider::cover
