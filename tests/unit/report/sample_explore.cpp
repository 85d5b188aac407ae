#include "sample_explore.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/report/discovery.hpp"

namespace outrider::test {
namespace {

const std::vector<Box2> walls = {{{0, 0}, {6, 0.1}},    {{0, 3.9}, {6, 4}},   {{0, 0}, {0.1, 4}},
                                 {{5.9, 0}, {6, 4}},    {{2, 0}, {2.1, 2.8}}, {{4, 1.2}, {4.1, 4}},
                                 {{2.8, 1}, {3.2, 1.4}}};
const std::vector<Vec2> way = {{1, 1}, {1.2, 3.2}, {3, 3}, {3.4, 0.7}, {5, 0.8},
                               {5, 3}, {3.4, 0.7}, {3, 3}, {1, 1}};

bool within(const Box2& box, Vec2 p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
}

bool in_wall(Vec2 p) {
  return std::ranges::any_of(walls, [&](const Box2& wall) { return within(wall, p); });
}

bool seen(Vec2 from, Vec2 to) {
  const double away = distance(from, to);
  if (away > 1.8) return false;
  for (double along = 0.05; along < away - 0.06; along += 0.02) {
    if (in_wall(from + (along / away) * (to - from))) return false;
  }
  return true;
}

void drive(PageReport& report) {
  double time_s = 0.0;
  for (std::size_t leg = 0; leg + 1 < way.size(); ++leg) {
    const Vec2 along = way[leg + 1] - way[leg];
    const double steps = std::ceil(norm(along) / 0.1);
    for (double step = 0.0; step < steps; ++step, time_s += 0.5) {
      const Pose2 pose{way[leg] + (step / steps) * along, std::atan2(along.y, along.x)};
      report.track.push_back({time_s, pose});
      const Vec2 drift{0.002 * std::sin(0.3 * time_s), 0.0004 * time_s};
      report.explore->beliefs.push_back(
          {time_s, {pose.position + drift, pose.heading_rad}, 0.01, 0.006, 0.3, 0.01});
    }
    report.explore->decisions.push_back(
        {report.track.back().time_s, "go", {way[leg + 1], 0.0}, {way[leg], way[leg + 1]}, 3});
  }
}

}  // namespace

PageReport sample_explore() {
  PageReport report;
  report.job = "explore";
  report.status = "done";
  report.reason = "complete";
  report.world_name = "three <rooms>";
  report.bounds = {{0, 0}, {6, 4}};
  report.robot_radius_m = 0.105;
  report.start = {way.front(), 0.0};
  report.explore.emplace();
  drive(report);
  Grid<std::uint8_t> map({{-0.2, -0.2}, 0.05, 128, 88}, unknown_cell);
  Discovery discovery;
  for (const TrackSample& sample : report.track) {
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const Vec2 p = map.frame.centre(map.frame.cell(i));
      if (map.cells[i] != unknown_cell || !seen(sample.pose.position, p)) continue;
      map.cells[i] = in_wall(p) ? occupied_cell : free_cell;
      changed.push_back(i);
    }
    discovery.note(map, false, changed, sample.time_s);
  }
  report.explore->map = discovery.map(map);
  for (const Box2& wall : walls) {
    report.explore->walls.push_back(
        {wall.low, {wall.high.x, wall.low.y}, wall.high, {wall.low.x, wall.high.y}});
  }
  report.explore->refused = {{{5.5, 3.5}, "no place <near> it can be reached"}};
  report.metrics = {{"explored_fraction", 0.993}, {"time_s", report.track.back().time_s}};
  return report;
}

}  // namespace outrider::test
