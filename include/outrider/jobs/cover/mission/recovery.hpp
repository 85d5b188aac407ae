// CoverRecovery: the mission of a robot that measures where it is while it drives a track, and goes on when
// it is held up.
//
// After each piece it compares where it is with where the piece ends.
//   Fell short   It drives the rest of the piece. Where it does not move at all it waits for 10 s and tries
//                again; after six waits in a row it gives up.
//   Carried off  It drives back to where it was, and on from there.
//   Touched      What its bumper feels is not on the map. It waits for 10 s and tries again. If that is still
//                there, it takes it for round (felt_posts.hpp), leaves out the part of the track that is too
//                near to it, drives a lap around it, and on.
//   No way       What no way leads to is left out. At the end it tries once more what it left out, as if
//                nothing stood there.
// A robot that ends a piece beside it, by less than its radius, goes on: what it covers is then not proven.
//
// A robot that is not held up drives the track as CoverMission does. Thread rule: no shared state. The same
// observations give the same commands.
#pragma once

#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/cover/ground/problem.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider {

/// Once that a robot was held up.
struct HoldUp {
  double time_s = 0.0;
  std::string sentence;  ///< without a subject: "touched ..."
};

/// The index of a piece that is not of the track.
inline constexpr std::size_t off_track = std::numeric_limits<std::size_t>::max();

class CoverRecovery {
 public:
  /// The problem must outlive the mission. The track stays on the ground.
  CoverRecovery(const CoverTrack& track, const CoverProblem& problem,
                const std::shared_ptr<const PolygonGround>& ground, const Budget& budget = {});
  CoverRecovery(CoverRecovery&&) noexcept;
  ~CoverRecovery();

  /// Returns the next FollowPiece or Wait, or nothing when nothing is left to drive.
  std::optional<Command> step(const Observation& seen);

  /// Returns true if all of the track was driven, as far as the robot knows, nowhere farther beside it than
  /// its tracking error allows.
  [[nodiscard]] bool believes_complete() const;
  /// Returns the part of the pieces of the track that is behind it, from 0 to 1.
  [[nodiscard]] double driven_part() const;
  /// Returns the length of the track that was not driven, m.
  [[nodiscard]] double left_out_m() const;

  std::vector<std::size_t> pieces;  ///< of each FollowPiece so far: its index in the track, or off_track
  std::vector<HoldUp> hold_ups;
  double strayed_m = 0.0;  ///< largest measured distance from the track
  bool gave_up = false;    ///< it ended although something was left that it could have tried

 private:
  /// A piece to drive.
  struct Task {
    PathPiece piece;
    std::size_t index = off_track;  ///< in the track
    bool way = false;               ///< leads to the task after it
    bool clipped = false;           ///< keeps away from everything that was felt
    bool leaves = false;            ///< drives off what it touches
  };
  struct Parts;

  void judge(const Task& task, const Observation& seen);
  void fell_short(const Task& task, double part, bool stands, const Observation& seen);
  void was_carried(const Task& task, Vec2 from, const Observation& seen);
  void touched(const Task& task, double touch_rad, const Observation& seen);
  void drive_around(const Pose2& pose);
  void keep_rest(const Task& task, double from_part);
  void drop_way();
  void hold_up(const Observation& seen, std::string sentence);
  bool leave(const Pose2& pose);
  [[nodiscard]] std::vector<PathPiece> ways_off(const Pose2& pose, Vec2 from) const;
  [[nodiscard]] bool is_hidden(Vec2 at) const;
  void clip_front();
  [[nodiscard]] bool is_at(const Pose2& pose, const PathPiece& piece) const;
  bool find_way(const Pose2& pose);
  bool look_again();
  std::optional<Command> next(const Pose2& pose);
  [[nodiscard]] Command command_of(const Task& task);

  const CoverProblem& problem_;
  double tolerance_m_;  ///< so near to a point of the track the robot is there
  std::unique_ptr<Parts> parts_;
  std::deque<Task> tasks_;
  std::optional<Task> current_;
  std::optional<double> wait_until_s_;
  std::vector<Task> left_out_;
  double heading_rad_;  ///< at the start of the next piece
  int stalls_ = 0;      ///< pieces in a row on which it did not get on
  std::size_t touches_ = 0;
  std::size_t track_pieces_;
  Vec2 began_;               ///< where the robot was when it began the present piece
  std::optional<Vec2> end_;  ///< of the last piece, if it was driven to there
  bool looked_again_ = false;
};

}  // namespace outrider
