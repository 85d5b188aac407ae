#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "sheet.hpp"

namespace outrider::picture {
namespace {

using namespace outrider_msgs;

std::vector<Vec2> vec2s(const std::vector<Point2>& points) {
  std::vector<Vec2> result;
  for (const Point2& point : points) result.push_back(vec2_of(point));
  return result;
}

std::vector<Vec2> corners_of(const Outline& outline) { return vec2s(outline.points); }
std::vector<Vec2> corners_of(const outrider_msgs::RoundedPolygon& shape) {
  if (shape.points.empty() || !std::isfinite(shape.radius)) return {};
  return circumscribed({vec2s(shape.points), shape.radius}, radians(15.0));
}
template <class Areas>
std::vector<std::vector<Vec2>> outlines_of(const Areas& areas) {
  std::vector<std::vector<Vec2>> outlines;
  for (const auto& area : areas) outlines.push_back(corners_of(area));
  return outlines;
}

Cells cells_of(const nav_msgs::OccupancyGrid& grid) {
  const auto& info = grid.info;
  return {
      pose_of(info.origin), info.resolution, info.width, info.height, {grid.data.begin(), grid.data.end()}};
}

/// Draws the map at the end of the log.
void draw_map(Sheet& sheet, const Log& log) {
  const auto& maps = log.messages<nav_msgs::OccupancyGrid>(topic::map);
  if (maps.empty()) return;
  Cells map = cells_of(maps.back().message);
  for (const auto& [time_ns, update] : log.messages<map_msgs::OccupancyGridUpdate>(topic::map_updates)) {
    if (time_ns <= maps.back().time_ns || update.width == 0) continue;
    for (std::size_t i = 0; i < update.data.size(); ++i) {
      const std::size_t x = static_cast<std::size_t>(update.x) + i % update.width;
      const std::size_t y = static_cast<std::size_t>(update.y) + i / update.width;
      if (x < map.columns && y * map.columns + x < map.values.size())
        map.values[y * map.columns + x] = update.data[i];
    }
  }
  sheet.cells("unknown", map, -1.0, -1.0);
  sheet.cells("free", map, 0.0, 49.0);
  sheet.cells("mapped", map, 50.0, 100.0);
}

/// Draws costs on a logarithmic scale.
void draw_costs(Sheet& sheet, const CostGrid& grid, const PaidCost* paid) {
  Cells cells{{vec2_of(grid.origin), 0.0}, grid.resolution, grid.width, grid.height};
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const double cost : grid.costs) {
    cells.values.push_back(cost < 0.0 ? -1.0 : std::log1p(cost));
    if (cost >= 0.0 && std::isfinite(cost)) low = std::min(low, cost), high = std::max(high, cost);
  }
  const std::string sum = paid == nullptr ? "" : fmt::format("; {:g} paid in all", paid->paid);
  sheet.cells("cost", cells, std::log1p(low), std::log1p(high),
              fmt::format("cost {:g} to {:g}{}", low, high, sum));
  sheet.cells("occupied", cells, -1.0, -1.0, "wall");
}

/// Draws how many targets can be hit from each cell.
void draw_firing_regions(Sheet& sheet, const std::vector<Stamped<FiringRegion>>& regions) {
  if (regions.empty()) return;
  Cells count = cells_of(regions.front().message.grid);
  for (double& value : count.values) value = std::min(value, 0.0);
  for (const auto& [time_ns, region] : regions) {
    for (std::size_t i = 0; i < std::min(region.grid.data.size(), count.values.size()); ++i)
      count.values[i] += region.grid.data[i] > 0 ? 1.0 : 0.0;
  }
  const double most = count.values.empty() ? 0.0 : std::ranges::max(count.values);
  sheet.cells("in_range", count, 0.0, most,
              fmt::format("0 to {:g} of {} targets in range", most, regions.size()));
}

/// Draws what a bar has covered in the end, and where it is then.
void draw_swath(Sheet& sheet, const CoverageArea& area, const Pose2& last, const RunInfo& info) {
  std::vector<std::vector<Vec2>> covered = outlines_of(area.reach);
  for (std::vector<Vec2> ring : outlines_of(area.missed)) {
    std::ranges::reverse(ring);
    covered.push_back(std::move(ring));
  }
  sheet.area("swath", covered);
  const double front = info.coverage_forward + 0.5 * info.coverage_length,
               rear = front - info.coverage_length;
  const double half = 0.5 * info.coverage_width;
  sheet.area("bar", {{last * Vec2{rear, -half}, last * Vec2{front, -half}, last * Vec2{front, half},
                      last * Vec2{rear, half}}});
}

void draw_coverage(Sheet& sheet, const CoverageArea& area, const std::vector<Pose2>& track,
                   const RunInfo& info) {
  std::vector<Vec2> strip;
  for (const Pose2& pose : track) strip.push_back(pose.position);
  sheet.area("beyond", outlines_of(area.area));
  sheet.area("reach", outlines_of(area.reach));
  const bool bar = info.coverage_length > 0.0;
  if (info.coverage_width > 0.0 && !bar) sheet.line("covered", strip, {.width_m = info.coverage_width});
  if (bar && !track.empty()) draw_swath(sheet, area, track.back(), info);
  sheet.area("overlap", outlines_of(area.overlap));
  sheet.area("missed", outlines_of(area.missed));
  sheet.area("border", outlines_of(area.area));
  sheet.line("plan", vec2s(area.planned), {"planned track"});
}

void show(Sheet& sheet, const Terrain& terrain) {
  sheet.area("steep", outlines_of(terrain.steep));
  if (terrain.contours.empty()) return;
  const auto [low, high] = std::ranges::minmax(terrain.contours, {}, &Contour::height);
  const std::string words = fmt::format("contours from {:g} to {:g} m", low.height, high.height);
  for (const Contour& contour : terrain.contours) {
    const double share = (contour.height - low.height) / std::max(high.height - low.height, 1e-9);
    sheet.line("contour", vec2s(contour.points), {words, share});
  }
}

/// Draws what the robot cannot drive over, and where its centre cannot be; only a hint beside a map that it
/// made.
void draw_obstacle(Sheet& sheet, Kind kind, const std::vector<std::vector<Vec2>>& outlines, double share,
                   double radius_m, bool mapped) {
  if (mapped) return sheet.area("truth", outlines);
  if (radius_m > 0.0) sheet.area("close", outlines, {.width_m = 2.0 * radius_m});
  sheet.area(kind, outlines, {.share = share});
}

void draw_solids(Sheet& sheet, const std::vector<Solid>& solids, double radius_m, bool mapped) {
  double highest_m = 1e-3;
  for (const Solid& solid : solids)
    if (solid.blocks_driving && std::isfinite(solid.high_z)) highest_m = std::max(highest_m, solid.high_z);
  for (const Solid& solid : solids) {
    const auto outlines = outlines_of(solid.footprint);
    const double share = std::sqrt(std::max(0.0, solid.high_z / highest_m));
    if (solid.blocks_driving) draw_obstacle(sheet, "solid", outlines, share, radius_m, mapped);
    if (!solid.blocks_driving && !mapped) sheet.area("overhead", outlines);
  }
}

}  // namespace

void draw_ground(Sheet& sheet, const Log& log) {
  const auto* told = log.latest<RunInfo>(topic::run);
  const RunInfo info = told == nullptr ? RunInfo{} : *told;
  const double radius_m = info.robot_radius;
  const bool mapped = log.latest<nav_msgs::OccupancyGrid>(topic::map) != nullptr;

  draw_map(sheet, log);
  draw_firing_regions(sheet, log.messages<FiringRegion>(topic::firing_regions));
  if (const auto* costs = log.latest<CostGrid>(topic::cost_grid))
    draw_costs(sheet, *costs, log.latest<PaidCost>(topic::paid));
  if (const auto* room = log.latest<nav_msgs::OccupancyGrid>(topic::costmap)) {
    sheet.cells("close", cells_of(*room), 99.0, 99.0);
    sheet.cells("occupied", cells_of(*room), 100.0, 100.0);
  }
  if (const auto* turns = log.latest<nav_msgs::OccupancyGrid>(topic::expanded))
    sheet.cells("expanded", cells_of(*turns), 0.0, 100.0);

  if (const auto* area = log.latest<CoverageArea>(topic::coverage_area))
    draw_coverage(sheet, *area, poses_of(log), info);
  if (const auto* terrain = log.latest<Terrain>(topic::terrain)) show(sheet, *terrain);
  const auto* solids = log.latest<Solids>(topic::solids);
  const auto* walls = log.latest<Outlines>(topic::walls);
  if (solids != nullptr && !solids->solids.empty()) {
    draw_solids(sheet, solids->solids, radius_m, mapped);
  } else if (walls != nullptr) {
    draw_obstacle(sheet, "wall", outlines_of(walls->outlines), 1.0, radius_m, mapped);
  }
  if (const auto* zones = log.latest<Outlines>(topic::keep_out))
    sheet.area("keep_out", outlines_of(zones->outlines));
  if (const auto* zones = log.latest<Outlines>(topic::slow_zones))
    sheet.area("slow", outlines_of(zones->outlines));
  if (const auto* axis = log.latest<Outlines>(topic::medial_axis)) {
    for (const std::vector<Vec2>& line : outlines_of(axis->outlines)) sheet.line("axis", line);
  }
}

}  // namespace outrider::picture
