#include "strokes/bar_strokes.hpp"

#include <algorithm>
#include <cmath>

#include "ground/bar_sweep.hpp"
#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

constexpr double bar_slack_part = 2e-4;  // of the width of the bar, and
constexpr double least_slack_m = 2e-5;   // more than rounding: between bar and edges
constexpr double gap_part = 2e-3;      // of the width: the most that a turn away from a wall leaves beside it
constexpr double station_part = 0.25;  // of the width, between places that are tried
constexpr double least_move = 1e-3;    // of the width: less is not driven
constexpr int halvings = 24;
constexpr int seeds = 8;

/// A place of the stroke from which the robot comes or goes, and the place where it can turn.
struct Station {
  double at_m;
  std::optional<Vec2> aside;
};

/// The robot on a line, seen from its bar: the bar is ahead. One whose bar is behind looks the other way.
class OnLine {
 public:
  OnLine(const BarLine& line, const BarRoom& room)
      : line_(line),
        room_(room),
        heading_rad_(heading_of(line.to - line.from)),
        along_(direction(heading_rad_)) {}

  [[nodiscard]] Vec2 place(double at_m) const { return line_.from + at_m * along_; }
  [[nodiscard]] bool free(double a_m, double b_m) const { return room_.free(pose(a_m), pose(b_m)); }
  /// Returns how far it may go from a free place towards another.
  [[nodiscard]] double farthest(double from_m, double to_m) const {
    if (free(from_m, to_m)) return to_m;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (free(from_m, from_m + middle * (to_m - from_m)) ? low : high) = middle;
    }
    return from_m + low * (to_m - from_m);
  }
  [[nodiscard]] std::optional<Station> station(double at_m) const {
    if (room_.turns(place(at_m))) return Station{at_m, {}};
    if (line_.away_rad == 0.0) return std::nullopt;
    const Pose2 beside = pose(at_m), turned{beside.position, beside.heading_rad + line_.away_rad};
    const Vec2 aside = place(at_m) + line_.away_m * direction(heading_rad_ + line_.away_rad);
    if (!room_.turns(aside) || !room_.free(beside, turned) ||
        !room_.free(turned, {aside, turned.heading_rad}))
      return std::nullopt;
    return Station{at_m, aside};
  }
  /// Returns the station nearest to a place, between two others.
  [[nodiscard]] std::optional<Station> nearest_station(double to_m, double low_m, double high_m) const {
    const double step_m = station_part * room_.bar().width_m;
    const double most_m = std::max(to_m - low_m, high_m - to_m);
    for (double off_m = 0.0; off_m <= most_m; off_m += step_m) {
      for (const double at_m : {to_m - off_m, to_m + off_m}) {
        if (at_m < low_m || at_m > high_m) continue;
        if (auto found = station(at_m)) return found;
      }
    }
    return std::nullopt;
  }
  /// Returns the piece between two places; the bar is ahead on the way from `a` to `b` if `ahead` says so.
  [[nodiscard]] PathPiece piece(Vec2 a, Vec2 b, bool ahead) const {
    return {a, b, {}, 0.0, ahead == behind()};
  }

 private:
  [[nodiscard]] bool behind() const { return room_.bar().forward_m < 0.0; }
  [[nodiscard]] Pose2 pose(double at_m) const { return {place(at_m), heading_rad_ + (behind() ? pi : 0.0)}; }

  const BarLine& line_;
  const BarRoom& room_;
  double heading_rad_;
  Vec2 along_;
};

/// The way from the entry to the begin of the stroke, the stroke, and the way to the exit.
Traversal driven(const OnLine& on, const Station& entry, double begin_m, double end_m, const Station& exit,
                 PieceRole role) {
  Traversal traversal;
  const auto add = [&](Vec2 a, Vec2 b, bool ahead, PieceRole as) {
    traversal.pieces.push_back(on.piece(a, b, ahead));
    traversal.roles.push_back(as);
  };
  const PieceRole aside = role == PieceRole::lap ? PieceRole::lap : PieceRole::move;
  if (entry.aside) add(*entry.aside, on.place(entry.at_m), false, aside);
  if (entry.at_m != begin_m) add(on.place(entry.at_m), on.place(begin_m), entry.at_m < begin_m, aside);
  add(on.place(begin_m), on.place(end_m), true, role);
  if (exit.at_m != end_m) add(on.place(end_m), on.place(exit.at_m), exit.at_m > end_m, aside);
  if (exit.aside) add(on.place(exit.at_m), *exit.aside, true, aside);
  return traversal;
}

}  // namespace

BarRoom::BarRoom(const CoverField& field, const Bar& bar, double slack_m, PolygonGround body)
    : field_(&field),
      bar_(bar),
      slack_m_(slack_m),
      body_(std::make_shared<const PolygonGround>(std::move(body))),
      room_(std::make_shared<const FreeRoom>(*body_)) {}

Outcome<BarRoom> BarRoom::of(const CoverProblem& problem, const CoverField& field) {
  auto body = PolygonGround::of(field.ground->boundary, field.ground->obstacles, problem.body_radius_m());
  if (!body) return pass_on(body);
  const Bar bar = problem.bar().value();
  return BarRoom(field, bar, bar_slack_part * bar.width_m + least_slack_m, std::move(*body));
}

bool BarRoom::free(const Pose2& from, const Pose2& to) const {
  if (!body_->point_free(from.position)) return false;
  if (!(from.position == to.position) && !room_->free(PathPiece{from.position, to.position, {}, 0.0}))
    return false;
  const Bar wider{bar_.width_m + slack_m_, bar_.length_m + slack_m_, bar_.forward_m};
  const std::vector<Pose2> poses = with_small_turns({from, to});
  std::vector<Region> swept;
  for (std::size_t i = 1; i < poses.size(); ++i)
    swept.push_back(bar_sweep(poses[i - 1], poses[i], wider, Approximation::around));
  return without(united(swept), field_->area).empty();
}

bool BarRoom::turns(Vec2 p) const {
  if (!field_->ground->point_free(p)) return false;
  const double near_m = slack_m_;  // of the chords of the standing room
  return std::any_of(field_->standing.begin(), field_->standing.end(), [&](const RingedPolygon& part) {
    return contains(part, p) || distance_to_border(part, p) <= near_m;
  });
}

WallTurn wall_turn(const Bar& bar) {
  const double rear = std::abs(bar.forward_m) - 0.5 * bar.length_m, half = 0.5 * bar.width_m;
  if (rear >= 0.0) return {0.5 * pi, 0.0};
  const double angle = std::asin(std::min(1.0, gap_part * bar.width_m / -rear));
  const double worst = std::min(angle, std::atan2(-rear, half));  // the corner swings out until then
  return {angle, half * (std::cos(worst) - 1.0) - rear * std::sin(worst)};
}

std::optional<Traversal> bar_stroke(const BarLine& line, const BarRoom& room, PieceRole role) {
  const OnLine on(line, room);
  const Bar& bar = room.bar();
  const double rear_m = std::abs(bar.forward_m) - 0.5 * bar.length_m, front_m = rear_m + bar.length_m;
  const double length_m = distance(line.from, line.to), least_m = least_move * bar.width_m;
  const double low_m = -line.overrun_m - rear_m;
  const double high_m = std::max(length_m + line.overrun_m - front_m, low_m + 0.25 * bar.width_m);
  std::optional<double> seed;
  for (int i = 0; i <= seeds && !seed; ++i) {
    for (const double part : {0.5 - 0.5 * i / seeds, 0.5 + 0.5 * i / seeds}) {
      const double at_m = low_m + part * (high_m - low_m);
      if (!seed && on.free(at_m, at_m)) seed = at_m;
    }
  }
  if (!seed) return std::nullopt;
  double begin_m = on.farthest(*seed, low_m), end_m = on.farthest(*seed, high_m);
  const double more_m = room.bar().reach_m() + bar.width_m;
  const double first_m = begin_m > low_m ? begin_m : on.farthest(begin_m, begin_m - more_m);
  const double last_m = end_m < high_m ? end_m : on.farthest(end_m, end_m + more_m);
  const auto entry = on.nearest_station(begin_m, first_m, last_m);
  const auto exit = on.nearest_station(end_m, first_m, last_m);
  if (!entry || !exit || end_m - begin_m < least_m) return std::nullopt;
  if (std::abs(entry->at_m - begin_m) < least_m) begin_m = entry->at_m;
  if (std::abs(exit->at_m - end_m) < least_m) end_m = exit->at_m;
  if (end_m - begin_m < least_m) return std::nullopt;
  return driven(on, *entry, begin_m, end_m, *exit, role);
}

}  // namespace outrider::cover
