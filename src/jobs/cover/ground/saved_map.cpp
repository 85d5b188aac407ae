#include "outrider/jobs/cover/ground/saved_map.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"
#include "outrider/world/free_parts.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_cells = 25'000'000;
constexpr int most_side = 32766;
constexpr double cells_of_tolerance = 2.0;

bool is_yaml(std::string_view path) {
  if (path.ends_with(".gz")) path.remove_suffix(3);
  return path.ends_with(".yaml") || path.ends_with(".yml");
}

bool names_image(std::string_view text) {
  while (!text.empty()) {
    if (take_line(text).starts_with("image:")) return true;
  }
  return false;
}

Vec2 to_world(const MapServerMap& map, Vec2 p) {
  const Vec2 from_origin = p - map.occupancy.frame.origin, along = direction(map.yaw_rad);
  return map.occupancy.frame.origin + from_origin.x * along + from_origin.y * perpendicular(along);
}

Vec2 to_map(const MapServerMap& map, Vec2 p) {
  const Vec2 from_origin = p - map.occupancy.frame.origin, along = direction(map.yaw_rad);
  return map.occupancy.frame.origin + Vec2{dot(from_origin, along), dot(from_origin, perpendicular(along))};
}

/// Returns the part in which the start lies, or the largest.
std::size_t chosen_part(const FreeParts& parts, const MapServerMap& map, const std::optional<Vec2>& start) {
  if (!start) return 0;
  const GridFrame& frame = map.occupancy.frame;
  const Vec2 at = to_map(map, *start);
  if (!frame.bounds().contains(at)) return 0;
  const Cell cell = frame.cell_at(at);
  return frame.contains(cell) && parts.part[cell] >= 0 ? static_cast<std::size_t>(parts.part[cell]) : 0;
}

/// Says how much of the other parts is left out, where a disk of that area would fit.
std::string left_out(const FreeParts& parts, std::size_t part, double cell_m2, double disk_m2,
                     const std::string& name) {
  std::size_t others = 0;
  double left_m2 = 0.0;
  for (std::size_t i = 0; i < parts.cells.size(); ++i) {
    const double part_m2 = cell_m2 * static_cast<double>(parts.cells[i]);
    if (i == part || part_m2 < disk_m2) continue;
    ++others;
    left_m2 += part_m2;
  }
  if (others == 0) return {};
  return fmt::format(
      "{}: {:.3g} m2 of its free space are left out, in {} part{} to which no way leads; a start chooses the "
      "part",
      name, left_m2, others, others == 1 ? "" : "s");
}

Status check_size(const GridFrame& frame, const std::string& name) {
  if (frame.size() <= most_cells && frame.width <= most_side && frame.height <= most_side) return {};
  return bad_input(fmt::format("the map has {} x {} cells; up to {} and {} on a side are taken", frame.width,
                               frame.height, most_cells, most_side),
                   name);
}

AreaRing ring_of(const MapServerMap& map, const AreaFrame& frame, const std::vector<Vec2>& corners,
                 const std::string& name) {
  AreaRing ring{{}, name};
  for (const Vec2 corner : corners) ring.corners.push_back(frame.to_local(to_world(map, corner)));
  return ring;
}

}  // namespace

Outcome<std::optional<MapServerMap>> saved_map(const std::string& path) {
  if (!is_yaml(path)) return std::nullopt;
  auto text = read_file(path);
  if (!text) return pass_on(text);
  if (!names_image(*text)) return std::nullopt;
  auto map = map_server_from_text(*text, path);
  if (!map) return pass_on(map);
  return std::optional(std::move(*map));
}

Outcome<CoverArea> area_of_map(const MapServerMap& map, const std::string& name,
                               const SavedMapOptions& options) {
  const GridFrame& grid = map.occupancy.frame;
  if (auto ok = check_size(grid, name); !ok) return pass_on(ok);
  const FreeParts parts = free_parts(reach_of_disk(map.occupancy, options.radius_m));
  if (parts.cells.empty()) {
    return bad_input(fmt::format("nowhere on the map is free space {:g} m wide; give a robot that fits",
                                 2.0 * options.radius_m),
                     name);
  }
  const double tolerance_m =
      options.tolerance_m > 0.0 ? options.tolerance_m : cells_of_tolerance * grid.resolution_m;
  const std::size_t part = chosen_part(parts, map, options.start);
  const FreeOutline outline = outline_of(parts, part, tolerance_m);
  std::size_t corners = outline.boundary.size();
  for (const auto& hole : outline.holes) corners += hole.size();
  if (corners > most_polygon_corners) {
    return bad_input(fmt::format("its free space has {} corners, more than {}; give a map_tolerance larger "
                                 "than {:g} m, or clean the map",
                                 corners, most_polygon_corners, tolerance_m),
                     name);
  }
  Box2 box;
  for (const Vec2 corner : outline.boundary) box.include(to_world(map, corner));
  CoverArea area;
  area.frame = AreaFrame::of_metres(box, farthest_corner_m);
  area.note = left_out(parts, part, grid.resolution_m * grid.resolution_m,
                       std::numbers::pi * options.radius_m * options.radius_m, name);
  AreaPolygon polygon{ring_of(map, area.frame, outline.boundary, name), {}};
  for (const auto& hole : outline.holes) polygon.holes.push_back(ring_of(map, area.frame, hole, name));
  area.polygons.push_back(std::move(polygon));
  return area;
}

}  // namespace outrider
