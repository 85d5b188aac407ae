#include "outrider/job/scene_markers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/messages/ros_marker_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

using visualization_msgs::Marker;
using Colour = std_msgs::ColorRGBA;

constexpr double round_step_rad = radians(20.0);
constexpr double endless_m = 1.0;  ///< height of a solid without end
constexpr double line_m = 0.03;
constexpr std::uint32_t most_terrain_columns = 60;  ///< and rows

Marker marker_of(std::string name, std::int32_t shape, const Colour& colour) {
  Marker marker;
  marker.header = header_of(0.0, "map");
  marker.ns = std::move(name);
  marker.shape = shape;
  marker.color = colour;
  marker.scale = {1.0, 1.0, 1.0};
  return marker;
}

/// Collects the markers of a scene.
class Scene {
 public:
  /// Adds a marker; those of one name are numbered. A list without points is left out.
  void add(Marker marker) {
    const bool list = marker.shape == Marker::line_list || marker.shape == Marker::triangle_list;
    if (list && marker.points.empty()) return;
    marker.id = static_cast<std::int32_t>(std::ranges::count(message.markers, marker.ns, &Marker::ns));
    message.markers.push_back(std::move(marker));
  }

  void add_box(const std::string& kind, const MarkerBox& box, const Colour& colour) {
    Marker cube = marker_of(kind, Marker::cube, colour);
    cube.pose = {point_of(box.centre), quaternion_of(box.yaw_rad)};
    cube.scale = vector_of(box.size);
    add(std::move(cube));
    if (!box.name.empty()) add_text(box.name, box.centre + Vec3{0.0, 0.0, 0.5 * box.size.z + 0.2});
  }

  void add_text(const std::string& text, const Vec3& at) {
    Marker label = marker_of("names", Marker::text_view_facing, {0.1F, 0.1F, 0.1F, 1.0F});
    label.pose.position = point_of(at);
    label.scale.z = 0.2;
    label.text = text;
    add(std::move(label));
  }

  visualization_msgs::MarkerArray message;
};

void add_triangle(Marker& marker, const Vec3& a, const Vec3& b, const Vec3& c) {
  for (const Vec3& corner : {a, b, c}) marker.points.push_back(point_of(corner));
}

/// Adds the sides and the top of a prism over a convex polygon, counter-clockwise; over a segment, both faces
/// of a thin wall.
void add_prism(Marker& marker, const std::vector<Vec2>& base, double low_z, double high_z) {
  const auto at = [](Vec2 p, double z) { return Vec3{p.x, p.y, z}; };
  for (std::size_t i = 0; i < base.size(); ++i) {
    const Vec2 a = base[i], b = base[(i + 1) % base.size()];
    add_triangle(marker, at(a, low_z), at(b, low_z), at(b, high_z));
    add_triangle(marker, at(a, low_z), at(b, high_z), at(a, high_z));
    if (i > 0 && i + 1 < base.size()) add_triangle(marker, at(base[0], high_z), at(a, high_z), at(b, high_z));
  }
}

void add_solids(Scene& scene, const outrider_msgs::Solids& solids) {
  Marker blocks = marker_of("solids", Marker::triangle_list, {0.55F, 0.6F, 0.65F, 1.0F});
  Marker overhead = marker_of("overhead", Marker::triangle_list, {0.55F, 0.6F, 0.65F, 0.4F});
  for (const outrider_msgs::Solid& solid : solids.solids) {
    const double low_z = std::isfinite(solid.low_z) ? solid.low_z : 0.0;
    const double high_z = std::isfinite(solid.high_z) ? solid.high_z : low_z + endless_m;
    for (const outrider_msgs::RoundedPolygon& piece : solid.footprint) {
      RoundedPolygon shape{{}, piece.radius};
      for (const auto& point : piece.points) shape.core.push_back(vec2_of(point));
      const auto base = shape.radius_m > 0.0 ? inscribed(shape, round_step_rad) : shape.core;
      if (base.size() > 1) add_prism(solid.blocks_driving ? blocks : overhead, base, low_z, high_z);
    }
  }
  scene.add(std::move(blocks));
  scene.add(std::move(overhead));
}

void add_terrain(Scene& scene, const outrider_msgs::Terrain& terrain) {
  Marker ground = marker_of("terrain", Marker::triangle_list, {0.55F, 0.65F, 0.45F, 1.0F});
  const std::uint32_t step = 1 + (std::max(terrain.columns, terrain.rows) - 1) / most_terrain_columns;
  const auto post = [&](std::uint32_t column, std::uint32_t row) {
    column = std::min(column, terrain.columns - 1);
    row = std::min(row, terrain.rows - 1);
    return Vec3{terrain.origin.x + column * terrain.spacing.x, terrain.origin.y + row * terrain.spacing.y,
                terrain.heights[row * terrain.columns + column]};
  };
  for (std::uint32_t y = 0; y + 1 < terrain.rows; y += step) {
    for (std::uint32_t x = 0; x + 1 < terrain.columns; x += step) {
      add_triangle(ground, post(x, y), post(x + step, y), post(x + step, y + step));
      add_triangle(ground, post(x, y), post(x + step, y + step), post(x, y + step));
    }
  }
  scene.add(std::move(ground));
}

void add_outlines(Scene& scene, const std::string& name, const std::vector<outrider_msgs::Outline>& outlines,
                  const Colour& colour) {
  Marker lines = marker_of(name, Marker::line_list, colour);
  lines.scale.x = line_m;
  for (const auto& [points] : outlines) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& a = points[i];
      const auto& b = points[(i + 1) % points.size()];
      lines.points.push_back({a.x, a.y, 0.0});
      lines.points.push_back({b.x, b.y, 0.0});
    }
  }
  scene.add(std::move(lines));
}

void add_tags(Scene& scene, const outrider_msgs::Tags& tags) {
  constexpr double thick_m = 0.01, unknown_height_m = 0.5;
  for (const outrider_msgs::Tag& tag : tags.tags) {
    const double z = std::isfinite(tag.position.z) ? tag.position.z : unknown_height_m;
    scene.add_box("tags",
                  {"", {tag.position.x, tag.position.y, z}, tag.facing, {thick_m, tag.size, tag.size}},
                  {0.1F, 0.1F, 0.1F, 1.0F});
  }
}

void add_stations(Scene& scene, const outrider_msgs::Supplies& supplies) {
  constexpr double wide_m = 0.4, high_m = 0.05;
  for (const outrider_msgs::Station& station : supplies.stations) {
    Marker disk = marker_of("stations", Marker::cylinder, {0.05F, 0.4F, 0.75F, 1.0F});
    disk.pose.position = {station.position.x, station.position.y, 0.5 * high_m};
    disk.scale = {wide_m, wide_m, high_m};
    scene.add(std::move(disk));
    scene.add_text(station.name, {station.position.x, station.position.y, 0.3});
  }
}

}  // namespace

void log_markers(Log& log, const std::vector<MarkerBox>& targets) {
  Scene scene;
  if (const auto* solids = log.latest<outrider_msgs::Solids>(topic::solids)) add_solids(scene, *solids);
  if (const auto* terrain = log.latest<outrider_msgs::Terrain>(topic::terrain)) add_terrain(scene, *terrain);
  if (const auto* walls = log.latest<outrider_msgs::Outlines>(topic::walls))
    add_outlines(scene, "walls", walls->outlines, {0.3F, 0.36F, 0.4F, 1.0F});
  if (const auto* zones = log.latest<outrider_msgs::Outlines>(topic::keep_out))
    add_outlines(scene, "keep_out", zones->outlines, {0.77F, 0.1F, 0.1F, 1.0F});
  if (const auto* zones = log.latest<outrider_msgs::Outlines>(topic::slow_zones))
    add_outlines(scene, "slow", zones->outlines, {0.9F, 0.62F, 0.0F, 1.0F});
  if (const auto* area = log.latest<outrider_msgs::CoverageArea>(topic::coverage_area))
    add_outlines(scene, "area", area->area, {0.1F, 0.1F, 0.1F, 1.0F});
  if (const auto* tags = log.latest<outrider_msgs::Tags>(topic::tags)) add_tags(scene, *tags);
  if (const auto* supplies = log.latest<outrider_msgs::Supplies>(topic::supplies))
    add_stations(scene, *supplies);
  for (const MarkerBox& target : targets) scene.add_box("targets", target, {0.77F, 0.3F, 0.02F, 1.0F});
  if (!scene.message.markers.empty()) log.append(topic::scene, 0.0, std::move(scene.message));
}

}  // namespace outrider
