#include "outrider/navigate/goal_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "navigate_grid.hpp"
#include "passage_sides.hpp"

namespace outrider {
namespace {

constexpr double slowest_part = 0.25;  // of the speed, where the robot just has room
constexpr double settled_s = 2.5;      // cells so much further away than the robot are not asked for
constexpr double fast_units = 16.0;    // to cross a cell at full speed
constexpr double slowest_units = 255;  // the same where it goes slowest
constexpr std::size_t ring = 1024;     // more than a diagonal step takes
constexpr double most_units = 1e9;
constexpr std::uint8_t out_of_room = 70;  // to cross a cell beside the robot that has no room
constexpr double beside_m = 0.15;

}  // namespace

void GoalField::compute(const GoalGround& ground, const Footprint& footprint, const RobotModel& robot,
                        const GoalQuery& query, std::optional<Vec2> place) {
  frame_ = ground.frame;
  unit_s_ = frame_.resolution_m / robot.speed_mps / fast_units;
  find_room(ground, footprint, query);
  if (ground.zones != nullptr) slow_down(*ground.zones, robot);
  if (place) let_out(*place, ground.zones);
  wrong_.clear();
  if (query.side != 0) find_wrong_sides(frame_, ground.obstacles, query.passage_m, query.side, wrong_);
  time_.assign(frame_.size(), unknown);
  buckets_.resize(ring);
  for (auto& bucket : buckets_) bucket.clear();
  waiting_ = 0;
  edge_.clear();
  seed(query);
  spread(place);
}

/// Finds how fast the robot goes in each cell.
void GoalField::find_room(const GoalGround& ground, const Footprint& footprint, const GoalQuery& query) {
  const double least = footprint.inner_m() + query.margin_m, aligned = footprint.outer_m() + query.margin_m;
  spread_distances(frame_, ground.obstacles, aligned + query.wide_m, distance_m_);
  pace_.resize(frame_.size());
  for (std::size_t i = 0; i < frame_.size(); ++i) {
    const bool has_zones = ground.zones != nullptr && !ground.zones->room_m.empty();
    if (has_zones) distance_m_[i] = std::min(distance_m_[i], ground.zones->room_m[i]);
    const auto room_m = static_cast<double>(distance_m_[i]);
    const double part =
        slowest_part + (1.0 - slowest_part) * std::clamp((room_m - aligned) / query.wide_m, 0.0, 1.0);
    const bool closed = ground.closed != nullptr && (*ground.closed)[i] != 0;
    pace_[i] = closed || room_m < least ? 0 : static_cast<std::uint8_t>(std::lround(fast_units / part));
  }
  for (int x = 0; x < frame_.width; ++x)
    pace_[frame_.index({x, 0})] = pace_[frame_.index({x, frame_.height - 1})] = 0;
  for (int y = 0; y < frame_.height; ++y)
    pace_[frame_.index({0, y})] = pace_[frame_.index({frame_.width - 1, y})] = 0;
}

/// Lets the robot be no faster in a zone than its speed there.
void GoalField::slow_down(const ZoneCells& zones, const RobotModel& robot) {
  for (std::size_t i = 0; i < zones.speed_mps.size(); ++i) {
    const double units = fast_units * robot.speed_mps / static_cast<double>(zones.speed_mps[i]);
    if (pace_[i] == 0 || units <= pace_[i]) continue;
    pace_[i] = static_cast<std::uint8_t>(std::lround(std::min(units, slowest_units)));
  }
}

/// A robot that stands too near to something can leave, but not into a zone.
void GoalField::let_out(Vec2 place, const ZoneCells* zones) {
  const Cell low = frame_.cell_at(place - Vec2{beside_m, beside_m}),
             high = frame_.cell_at(place + Vec2{beside_m, beside_m});
  for (int y = std::max(low.y, 1); y <= std::min(high.y, frame_.height - 2); ++y) {
    for (int x = std::max(low.x, 1); x <= std::min(high.x, frame_.width - 2); ++x) {
      const std::size_t cell = frame_.index({x, y});
      if (zones != nullptr && !zones->room_m.empty() && zones->room_m[cell] < 0.0F) continue;
      if (pace_[cell] == 0) pace_[cell] = out_of_room;
    }
  }
}

void GoalField::reach(std::size_t cell, Units time) {
  if (pace_[cell] == 0 || time >= time_[cell]) return;
  time_[cell] = time;
  buckets_[time % ring].push_back(static_cast<std::uint32_t>(cell));
  ++waiting_;
}

/// Reaches the cells around the goal, and those at the edge of the grid from which a way outside is known, or
/// must be, since the goal is there.
void GoalField::seed(const GoalQuery& query) {
  const Cell goal = frame_.cell_at(query.goal);
  if (frame_.contains(goal)) {
    const int most = std::max(frame_.width, frame_.height);
    const int near = static_cast<int>(std::min(query.within_m / frame_.resolution_m, 1.0 * most));
    for (int y = -near; y <= near; ++y) {
      for (int x = -near; x <= near; ++x) {
        const Cell cell{goal.x + x, goal.y + y};
        if (!frame_.contains(cell) ||
            (cell != goal && distance(frame_.centre(cell), query.goal) > query.within_m))
          continue;
        reach(frame_.index(cell), 0);
      }
    }
  }
  if (query.beyond || !frame_.contains(goal)) seed_edge(query);
}

/// The times of these cells differ by what is left from there.
void GoalField::seed_edge(const GoalQuery& query) {
  for (int y = 1; y + 1 < frame_.height; ++y) {
    const bool whole_row = y == 1 || y + 2 == frame_.height;
    for (int x = 1; x + 1 < frame_.width; x += whole_row ? 1 : std::max(1, frame_.width - 3)) {
      const Vec2 place = frame_.centre({x, y});
      double units = distance(place, query.goal) / frame_.resolution_m * fast_units;
      if (query.beyond) {
        const auto left_s = query.beyond(place);
        if (!left_s) continue;
        units = *left_s / unit_s_;
      }
      edge_.emplace_back(static_cast<Units>(std::min(units, most_units)),
                         static_cast<std::uint32_t>(frame_.index({x, y})));
    }
  }
  std::ranges::sort(edge_, std::greater{});
}

void GoalField::spread(std::optional<Vec2> place) {
  const bool inside = place && frame_.contains(frame_.cell_at(*place));
  const std::size_t robot = inside ? frame_.index(frame_.cell_at(*place)) : frame_.size();
  // Nothing leads over the edge of the window, so every cell that is reached has eight neighbours.
  std::array<std::size_t, 8> to{};
  for (std::size_t n = 0; n < to.size(); ++n) {
    const auto width = static_cast<std::ptrdiff_t>(frame_.width);
    to[n] = static_cast<std::size_t>(neighbours[n].y * width + neighbours[n].x);  // wraps: added modulo 2^64
  }
  Units last = unknown;
  const Units first = waiting_ > 0 || edge_.empty() ? 0 : edge_.back().first;
  for (Units now = first; (waiting_ > 0 || !edge_.empty()) && now <= last; ++now) {
    for (; !edge_.empty() && edge_.back().first < now + ring / 2; edge_.pop_back())
      reach(edge_.back().second, edge_.back().first);
    auto& bucket = buckets_[now % ring];
    for (const std::size_t at : bucket) {
      if (time_[at] != now) continue;
      if (at == robot) last = now + static_cast<Units>(settled_s / unit_s_);
      for (std::size_t n = 0; n < to.size(); ++n) {
        const std::size_t next = at + to[n];
        Units step = (Units{pace_[at]} + pace_[next]) / 2;
        if (!wrong_.empty() && ((wrong_[next] >> n) & 1U) != 0) step += step / 2;
        reach(next, now + (n < 4 ? step : (step * 181) / 128));  // 181 / 128: the square root of 2
      }
    }
    waiting_ -= bucket.size();
    bucket.clear();
  }
}

std::optional<double> GoalField::time_s(Vec2 place) const {
  const double x = (place.x - frame_.origin.x) / frame_.resolution_m - 0.5;
  const double y = (place.y - frame_.origin.y) / frame_.resolution_m - 0.5;
  const double u = x - std::floor(x), v = y - std::floor(y);
  const Cell low{static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))};
  double sum = 0.0, weights = 0.0;
  for (const int up : {0, 1}) {
    for (const int right : {0, 1}) {
      const Units units = units_at({low.x + right, low.y + up});
      const double weight = (up != 0 ? v : 1.0 - v) * (right != 0 ? u : 1.0 - u);
      if (units == unknown) continue;
      sum += weight * static_cast<double>(units);
      weights += weight;
    }
  }
  if (weights < 1e-3) return std::nullopt;
  return sum / weights * unit_s_;
}

std::optional<Vec2> GoalField::downhill(Vec2 place) const {
  const double step_m = 2.0 * frame_.resolution_m;
  const auto here = time_s(place);
  if (!here) return std::nullopt;
  const auto slope = [&](Vec2 along) {
    return time_s(place - along).value_or(*here) - time_s(place + along).value_or(*here);
  };
  const Vec2 fall{slope({step_m, 0.0}), slope({0.0, step_m})};
  if (squared_norm(fall) == 0.0) return std::nullopt;
  return (1.0 / norm(fall)) * fall;
}

std::vector<Vec2> GoalField::way(Vec2 place, double most_m) const {
  std::vector<Vec2> points = {place};
  Cell at = frame_.cell_at(place);
  for (double gone_m = 0.0; gone_m < most_m;) {
    Cell best = at;
    Units least = units_at(at);
    for (const Cell& step : neighbours) {
      const Cell next{at.x + step.x, at.y + step.y};
      if (units_at(next) < least) best = next, least = units_at(next);
    }
    if (best == at) break;
    at = best;
    gone_m += distance(points.back(), frame_.centre(at));
    points.push_back(frame_.centre(at));
  }
  return points;
}

}  // namespace outrider
