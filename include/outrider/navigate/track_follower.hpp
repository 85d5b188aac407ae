// TrackFollower: keeps a robot on a track of legs and arcs, and knows which part of it is behind the robot.
//
// Along a piece the robot is steered back to it as the critically damped response over a length l,
//     turn rate = speed (curvature - off / l^2 - 2 sin(angle) / l),
// off: the distance to the left of the track, angle: that from its direction (Kanayama et al., A stable
// tracking control method for an autonomous mobile robot, ICRA 1990, along the way in place of time). It
// turns in place where the track has a corner, and goes backwards on pieces that say so. The speed is what
// lets it stop at the next corner, or where the track is not free. A part that is left out is noted.
//
// Deterministic. Thread rule: one at a time. O(1) a period, but for the search of free places.
#pragma once

#include <compare>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/motion/robot_model.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {

using TrackPieces = std::vector<PathPiece>;

/// A place on a track: so far along one of its pieces.
struct TrackPlace {
  std::size_t piece = 0;
  double part = 0.0;  ///< 0: its beginning, 1: its end
  friend auto operator<=>(const TrackPlace&, const TrackPlace&) = default;
};

struct TrackSection {
  TrackPlace from;
  TrackPlace to;
};

/// Returns the pieces of a track between two places.
std::vector<PathPiece> pieces_of(const TrackPieces& track, const TrackSection& section);

class TrackFollower {
 public:
  using IsFree = std::function<bool(const Pose2&)>;

  explicit TrackFollower(std::shared_ptr<const TrackPieces> track) : track_(std::move(track)) {}

  [[nodiscard]] const std::shared_ptr<const TrackPieces>& track() const { return track_; }
  [[nodiscard]] bool is_done() const { return at_.piece >= track_->size(); }
  [[nodiscard]] TrackPlace at() const { return at_; }
  [[nodiscard]] Pose2 pose_at(const TrackPlace& place) const;
  /// Returns the distance of a robot from where it should be, m.
  [[nodiscard]] double beside_m(Vec2 robot) const;
  /// Returns what was left out so far.
  [[nodiscard]] const std::vector<TrackSection>& left_out() const { return left_out_; }

  /// A robot that drives already does not stop to turn to a track that leads about where it looks.
  void go_on(const Pose2& robot);
  /// Goes on along the track as far as the robot has come.
  void note(const Pose2& robot);
  /// Returns the heading to turn to before the present piece; nothing if the robot looks along it.
  [[nodiscard]] std::optional<double> heading_to_turn_to(const Pose2& robot);
  /// Returns the twist along the track that can stop within `room_m`.
  [[nodiscard]] Twist2 twist(const Pose2& robot, const RobotModel& model, double period_s,
                             double room_m) const;

  /// Returns how far the track ahead is free, m, at most `most_m`.
  [[nodiscard]] double free_m(const IsFree& is_free, double most_m) const;
  /// Returns the first place after `from` from which the track is free for `free_m`; nothing if there is
  /// none.
  [[nodiscard]] std::optional<TrackPlace> next_free(TrackPlace from, const IsFree& is_free,
                                                    double free_m) const;
  /// Returns the place so far ahead of another; nothing beyond the end.
  [[nodiscard]] std::optional<TrackPlace> ahead_of(TrackPlace from, double way_m) const;
  /// Leaves out what lies before a place; with nothing, all the rest.
  void skip_to(const std::optional<TrackPlace>& place);

 private:
  [[nodiscard]] const PathPiece& piece() const { return (*track_)[at_.piece]; }
  [[nodiscard]] bool joins_smoothly(std::size_t piece) const;
  [[nodiscard]] double curvature_soon(double speed_mps, const RobotModel& model, double period_s) const;

  std::shared_ptr<const TrackPieces> track_;
  TrackPlace at_;
  bool looks_along_ = false;  // the robot has turned to the present piece
  std::vector<TrackSection> left_out_;
};

}  // namespace outrider
