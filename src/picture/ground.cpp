#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "draw.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider::picture {
namespace {

std::vector<Vec2> vec2s(const std::vector<outrider_msgs::Point2>& points) {
  std::vector<Vec2> result;
  for (const auto& point : points) result.push_back(vec2_of(point));
  return result;
}

std::string areas(Sheet& sheet, const std::vector<outrider_msgs::Outline>& outlines) {
  std::string path;
  for (const auto& outline : outlines) path += sheet.area(vec2s(outline.points));
  return path;
}

std::string areas(Sheet& sheet, const std::vector<outrider_msgs::RoundedPolygon>& shapes) {
  std::string path;
  for (const auto& shape : shapes) path += sheet.area(RoundedPolygon{vec2s(shape.points), shape.radius});
  return path;
}

std::string wide(const Sheet& sheet, double width_m) {
  return fmt::format("stroke-width:{:.1f}px", sheet.px_per_m * width_m);
}

/// Draws where the centre of the robot cannot be: areas grown by its radius.
void draw_rim(Sheet& sheet, const std::string& areas, double radius_m) {
  if (areas.empty() || !(radius_m > 0.0)) return;
  sheet.put("rim", areas, "", "", wide(sheet, 2.0 * radius_m));
  sheet.put("close", "M0 0", area_sample, "no room for the robot's centre");
}

void draw_coverage(Sheet& sheet, const Log& log, double width_m) {
  const auto* area = log.latest<outrider_msgs::CoverageArea>(topic::coverage_area);
  if (area == nullptr) return;
  sheet.put("beyond", areas(sheet, area->area), area_sample, "out of reach");
  sheet.put("reach", areas(sheet, area->reach), area_sample, "not covered");
  std::vector<Vec2> way;
  for (const Pose2& pose : poses_of(log)) way.push_back(pose.position);
  if (width_m > 0.0) sheet.put("strip", sheet.line(way), "", "", wide(sheet, width_m));
  sheet.put("covered", "M0 0", area_sample, "covered");
  sheet.put("overlap", areas(sheet, area->overlap), area_sample, "covered more than once");
  sheet.put("missed", areas(sheet, area->missed), area_sample, "missed");
  sheet.put("border", areas(sheet, area->area), area_sample, "area to cover");
  sheet.put("planned", sheet.line(vec2s(area->planned)), line_sample, "planned track");
}

void draw_terrain(Sheet& sheet, const outrider_msgs::Terrain& terrain) {
  sheet.put("steep", areas(sheet, terrain.steep), area_sample, "too steep to drive on");
  std::map<double, std::string> lines;
  for (const auto& contour : terrain.contours) {
    if (std::isfinite(contour.height)) lines[contour.height] += sheet.line(vec2s(contour.points));
  }
  for (const auto& [height, path] : lines) {
    const double low = lines.begin()->first, high = lines.rbegin()->first,
                 share = (height - low) / std::max(high - low, 1e-9);
    sheet.put("contour", path, line_sample, fmt::format("contours from {:g} to {:g} m", low, high),
              fmt::format("stroke-opacity:{:.2f}", 0.4 + 0.6 * share));
  }
}

/// Draws the solids, low ones first, with a rim where the centre of the robot cannot be. Solids beside a map
/// that was made of them are outlines.
void draw_solids(Sheet& sheet, const std::vector<outrider_msgs::Solid>& solids, double radius_m,
                 bool mapped) {
  constexpr double tones = 7.0;
  double highest_m = 1e-3;
  for (const auto& solid : solids) {
    if (solid.blocks_driving && std::isfinite(solid.high_z)) highest_m = std::max(highest_m, solid.high_z);
  }
  std::map<double, std::string> levels;
  std::string overhead, all;
  for (const auto& solid : solids) {
    const double share = std::clamp(std::isfinite(solid.high_z) ? solid.high_z / highest_m : 1.0, 0.0, 1.0);
    const std::string path = areas(sheet, solid.footprint);
    (solid.blocks_driving ? levels[std::floor(std::sqrt(share) * tones) / tones] : overhead) += path;
    if (solid.blocks_driving) all += path;
  }
  if (mapped) return sheet.put("truth", all, area_sample, "true solid");
  draw_rim(sheet, all, radius_m);
  for (const auto& [share, path] : levels) {
    const std::string tone = mixed(0xcfd7dd, 0x5d6d7a, share);
    sheet.put("solid", path, area_sample, share == 1.0 ? "solid; the taller, the darker" : "",
              fmt::format("fill:{0};stroke:{0}", tone));
  }
  sheet.put("overhead", overhead, area_sample, "overhead, not in the way");
}

}  // namespace

void draw_ground(Sheet& sheet, const Log& log) {
  const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run);
  const double radius_m = info == nullptr ? 0.0 : info->robot_radius;
  const bool mapped = log.latest<nav_msgs::OccupancyGrid>(topic::map) != nullptr;
  draw_coverage(sheet, log, info == nullptr ? 0.0 : info->coverage_width);
  if (const auto* terrain = log.latest<outrider_msgs::Terrain>(topic::terrain)) draw_terrain(sheet, *terrain);
  const auto* solids = log.latest<outrider_msgs::Solids>(topic::solids);
  if (solids != nullptr && !solids->solids.empty()) {
    return draw_solids(sheet, solids->solids, radius_m, mapped);
  }
  const auto* walls = log.latest<outrider_msgs::Outlines>(topic::walls);
  if (walls == nullptr) return;
  const std::string path = areas(sheet, walls->outlines);
  if (!mapped) draw_rim(sheet, path, radius_m);
  sheet.put(mapped ? "truth" : "full", path, area_sample, "wall");
}

}  // namespace outrider::picture
