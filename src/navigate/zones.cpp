#include "outrider/navigate/zones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "navigate_grid.hpp"

namespace outrider {
namespace {

constexpr double braking_part = 0.8;  // of the deceleration of the robot, with which it slows down in time

/// Calls `visit` with the index of each cell whose middle lies in a zone.
template <class Visit>
void each_cell_in(const Zone& zone, const Box2& bounds, const GridFrame& frame, Visit visit) {
  const int first = std::max(frame.cell_at(bounds.low).y, 0);
  const int last = std::min(frame.cell_at(bounds.high).y, frame.height - 1);
  if (last < first) return;
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(last - first + 1));  // of each row
  each_edge(zone, [&](Segment edge) {
    if (edge.a.y > edge.b.y) std::swap(edge.a, edge.b);
    const int low = std::max(frame.cell_at(edge.a).y, first), high = std::min(frame.cell_at(edge.b).y, last);
    for (int y = low; y <= high; ++y) {
      const double at_y = frame.centre({0, y}).y;
      if ((edge.a.y > at_y) == (edge.b.y > at_y)) continue;
      const double part = (at_y - edge.a.y) / (edge.b.y - edge.a.y);
      crossings[static_cast<std::size_t>(y - first)].push_back(edge.a.x + part * (edge.b.x - edge.a.x));
    }
  });
  for (int y = first; y <= last; ++y) {
    std::vector<double>& row = crossings[static_cast<std::size_t>(y - first)];
    std::ranges::sort(row);
    for (std::size_t i = 0; i + 1 < row.size(); i += 2) {
      const auto column = [&](double x) { return (x - frame.origin.x) / frame.resolution_m - 0.5; };
      const int left = static_cast<int>(std::ceil(std::max(column(row[i]), 0.0)));
      const int right = static_cast<int>(std::floor(std::min(column(row[i + 1]), frame.width - 1.0)));
      for (int x = left; x <= right; ++x) visit(frame.index({x, y}));
    }
  }
}

}  // namespace

std::vector<Option> describe(ZoneOptions& options) {
  return {
      {"margin", "m", 0.0, 2.0, "room that the footprint keeps from keep-out zones, for errors of the pose",
       &options.margin_m},
      choice_option("side", "side of passages that is preferred", &options.side, {"none", "right", "left"}),
      {"passage", "m", 0.1, 20.0, "width of the widest passage that has sides", &options.passage_m},
  };
}

Zones::Zones(std::vector<Zone> zones, double margin_m) : zones_(std::move(zones)), margin_m_(margin_m) {
  for (const Zone& zone : zones_) {
    Box2& box = bounds_.emplace_back();
    each_edge(zone, [&](Segment edge) { box.include(edge.a); });
  }
}

ZoneCells Zones::cells(const GridFrame& frame, double most_m) const {
  ZoneCells cells;
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    const Zone& zone = zones_[i];
    const bool slow = zone.kind == Zone::Kind::slow;
    if (!bounds_[i].overlaps(frame.bounds().grown(most_m + margin_m_))) continue;
    if (slow && cells.speed_mps.empty())
      cells.speed_mps.assign(frame.size(), std::numeric_limits<float>::infinity());
    if (!slow && cells.room_m.empty()) cells.room_m.assign(frame.size(), 0.0F);
    each_cell_in(zone, bounds_[i], frame, [&](std::size_t cell) {
      if (slow) {
        cells.speed_mps[cell] = std::min(cells.speed_mps[cell], static_cast<float>(zone.speed_mps));
      } else {
        cells.room_m[cell] = ZoneCells::in_zone;
      }
    });
    if (!slow) each_edge(zone, [&](Segment edge) { add_points(edge, 0.5 * frame.resolution_m, places); });
  }
  if (cells.room_m.empty()) return cells;
  std::vector<float> distance_m;
  spread_distances(frame, places, most_m + margin_m_, distance_m);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (cells.room_m[i] >= 0.0F) cells.room_m[i] = distance_m[i] - static_cast<float>(margin_m_);
  }
  return cells;
}

std::vector<Segment> Zones::edges_near(Vec2 middle, double reach_m) const {
  std::vector<Segment> edges;
  const Box2 box = Box2{middle, middle}.grown(reach_m);
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    if (zones_[i].kind != Zone::Kind::keep_out || !bounds_[i].overlaps(box)) continue;
    each_edge(zones_[i], [&](Segment edge) {
      Box2 around;
      around.include(edge.a);
      around.include(edge.b);
      if (around.overlaps(box)) edges.push_back(edge);
    });
  }
  return edges;
}

bool Zones::overlap(const Footprint& footprint, const Pose2& pose) const {
  for (const Zone& zone : zones_) {
    if (zone.kind == Zone::Kind::keep_out && zone.contains(pose.position)) return true;
  }
  return std::ranges::any_of(edges_near(pose.position, footprint.outer_m()), [&](const Segment& edge) {
    return footprint.gap_m(pose, {{edge.a, edge.b}, 0.0}) <= 0.0;
  });
}

double Zones::most_mps(Vec2 place, double radius_m, const RobotModel& robot, double period_s) const {
  double most_mps = robot.speed_mps;
  const double braking_mps2 = braking_part * robot.acceleration_mps2;
  const double near_m = radius_m + margin_m_ + robot.speed_mps * period_s;  // of the middle, after a period
  const double far_m = near_m + robot.speed_mps * robot.speed_mps / (2.0 * braking_mps2);
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    const Zone& zone = zones_[i];
    if (zone.kind != Zone::Kind::slow || bounds_[i].distance_to(place) > far_m) continue;
    const double left_m = std::max(0.0, zone.distance_to(place) - near_m);
    most_mps = std::min(most_mps, std::sqrt(zone.speed_mps * zone.speed_mps + 2.0 * braking_mps2 * left_m));
  }
  return most_mps;
}

}  // namespace outrider
