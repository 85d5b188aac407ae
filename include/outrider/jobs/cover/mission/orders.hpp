// CoverOrders: what a robot that covers an area tells its navigator.
//
// First it follows the track of the plan, which the navigator leaves around what stands on it. Then it looks
// at what is not covered, by where it believes that it was: it plans anew on the area without what it has
// seen there, drives those sections of that track that cover something more, and looks again, until nothing
// is left that it can reach, or no more comes of it.
//
// What it has seen counts with a rim, and with the gaps into which the robot does not fit. The same
// situations give the same orders. Thread rule: one at a time.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/sim/bodies/piece_body.hpp"

namespace outrider {

/// Returns true if a robot with that pace was carried, since it does not drive so far within that time.
bool is_leap(Vec2 from, Vec2 to, double within_s, const Pace& pace);

/// Returns what is left without what is narrower than 3 cm, such as the rim of what a robot drove around.
Region without_specks(const Region& left);

class CoverOrders {
 public:
  /// A robot that covers with its disk, turns in place and covers one area. All but `budget` must outlive
  /// this object. It keeps `rim_m` away from what it sees.
  CoverOrders(const CoverProblem& problem, const CoverMethod& method, const CoverOptions& options,
              const CoverPlan& plan, double rim_m, Budget budget);

  /// Takes where the robot is, and returns the next order; nothing at the end.
  std::optional<Order> next(const Situation& now, const Navigator& navigator);

  /// Returns true if all that the robot can reach is covered, as far as it knows.
  [[nodiscard]] bool believes_complete() const { return complete_; }
  /// Returns why it ended before that; empty if it did not.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// Returns what it has not covered and could reach, as far as it knows.
  [[nodiscard]] const Region& left() const { return left_; }
  /// Returns how often it has planned what was left.
  [[nodiscard]] int rounds() const { return rounds_; }
  /// Returns the part of the present tracks that is behind it, from 0 to 1.
  [[nodiscard]] double driven_part(const Navigator& navigator) const;

 private:
  void note(double time_s, const Pose2& pose);
  void note_circling(double time_s, const Pose2& pose);
  [[nodiscard]] Region things(const Navigator& navigator) const;
  [[nodiscard]] Outcome<CoverPlan> plan_here(const Region& things) const;
  bool plan_rest(const Navigator& navigator);
  void take_needed(const CoverPlan& plan);

  const CoverProblem& problem_;
  const CoverMethod& method_;
  CoverOptions options_;
  const CoverPlan& plan_;
  double rim_m_;
  Budget budget_;
  PieceDrive believed_;       // where it was when
  double heading_rad_ = 0.0;  // at the last place of that
  Pose2 here_;
  double time_s_ = 0.0;
  Vec2 spot_;                // from which it has not gone far
  double turned_rad_ = 0.0;  // there, since it stood last
  double stands_until_s_ = 0.0;
  int stands_ = 0;  // in a row
  std::deque<std::shared_ptr<const TrackPieces>> tracks_;
  std::size_t all_tracks_ = 1;  // of this round
  Region left_;
  int rounds_ = 0;
  bool complete_ = false;
  std::string reason_;
};

}  // namespace outrider
