#include "outrider/io/cover_area.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "area_formats.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/polygons.hpp"
#include "outrider/io/text.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {
namespace {

constexpr double widest_deg = 0.2;

bool ends_with_any(std::string_view name, std::initializer_list<std::string_view> ends) {
  if (name.ends_with(".gz")) name.remove_suffix(3);
  return std::any_of(ends.begin(), ends.end(), [&](std::string_view end) { return name.ends_with(end); });
}

/// Returns the lines that are not empty, each as its number (from 1) and its first word.
std::vector<std::pair<std::size_t, std::string_view>> filled_lines(std::string_view text) {
  std::vector<std::pair<std::size_t, std::string_view>> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    line = line.substr(0, line.find('#'));
    if (const std::string_view word = take_word(line); !word.empty()) lines.emplace_back(number, word);
  }
  return lines;
}

Outcome<AreaRings> rings_from_polygon_text(std::string_view text, const std::string& name) {
  auto map = polygon_map_from_text(text, name);
  if (!map) return pass_on(map);
  const auto lines = filled_lines(text);
  auto line = lines.begin();  // the boundary ends at ---; then each obstacle has one line
  AreaRings rings{{std::move(map->boundary), fmt::format("{}:{}", name, line->first)}};
  while (line->second != "---") ++line;
  for (auto& obstacle : map->obstacles) {
    rings.push_back({std::move(obstacle), fmt::format("{}:{}", name, (++line)->first)});
  }
  return rings;
}

/// Converts degrees to metres east and north of the low corner of the box.
/// Source: radii of curvature of WGS 84, NIMA TR8350.2 (2000).
void project(AreaRings& rings, const Box2& box) {
  constexpr double equator_m = 6378137.0, eccentricity2 = 6.69437999014e-3;
  const double sine = std::sin(radians(0.5 * (box.low.y + box.high.y)));
  const double w2 = 1.0 - eccentricity2 * sine * sine;
  const double east_m = equator_m / std::sqrt(w2) * std::sqrt(1.0 - sine * sine);  // per radian
  const double north_m = equator_m * (1.0 - eccentricity2) / (w2 * std::sqrt(w2));
  for (AreaRing& ring : rings) {
    for (Vec2& p : ring.corners) {
      p = {east_m * radians(p.x - box.low.x), north_m * radians(p.y - box.low.y)};
    }
  }
}

bool could_be_degrees(const Box2& box) {
  return box.size().x <= widest_deg && box.size().y <= widest_deg && std::abs(box.low.y) <= 90.0 &&
         std::abs(box.high.y) <= 90.0 && std::abs(box.low.x) <= 180.0 && std::abs(box.high.x) <= 180.0;
}

Status check_sizes(const AreaRings& rings) {
  std::size_t corners = 0;
  for (const AreaRing& ring : rings) {
    corners += ring.corners.size();
    if (ring.corners.size() < 3) {
      return bad_input(fmt::format("a ring of {} corners has no area; give at least 3", ring.corners.size()),
                       ring.where);
    }
    for (const Vec2 p : ring.corners) {
      if (std::abs(p.x) <= farthest_corner_m && std::abs(p.y) <= farthest_corner_m) continue;
      return bad_input(
          fmt::format("the corner ({:g}, {:g}) is farther than {:g} m from the origin; move it near", p.x,
                      p.y, farthest_corner_m),
          ring.where);
    }
  }
  if (corners <= most_polygon_corners) return {};
  return bad_input(
      fmt::format("{} corners are more than {}; simplify the area", corners, most_polygon_corners),
      rings.front().where);
}

}  // namespace

Outcome<CoverArea> cover_area_from_text(std::string_view text, const std::string& name, Units units) {
  const bool json = ends_with_any(name, {".json", ".geojson"}), xml = ends_with_any(name, {".xml", ".gml"});
  auto rings = json                                     ? rings_from_geojson(text, name)
               : xml                                    ? rings_from_gml(text, name)
               : ends_with_any(name, {".yaml", ".yml"}) ? rings_from_yaml(text, name)
                                                        : rings_from_polygon_text(text, name);
  if (!rings) return pass_on(rings);
  Box2 box;
  for (AreaRing& ring : *rings) {
    if (ring.corners.size() > 1 && ring.corners.front() == ring.corners.back()) ring.corners.pop_back();
    for (const Vec2 p : ring.corners) box.include(p);
  }
  CoverArea area;
  const bool geographic = json || xml;
  if (units == Units::degrees && !could_be_degrees(box)) {
    return bad_input(
        fmt::format("({:g}, {:g}) to ({:g}, {:g}) are no degrees of an area up to {:g} across; say "
                    "units: metres",
                    box.low.x, box.low.y, box.high.x, box.high.y, widest_deg),
        name);
  }
  const bool degrees =
      units == Units::degrees || (units == Units::told_by_size && geographic && could_be_degrees(box));
  if (degrees) project(*rings, box);
  if (geographic && units == Units::told_by_size && !degrees) {
    area.note = fmt::format("{}: as degrees it would span {:g} by {:g}; taken for metres", name, box.size().x,
                            box.size().y);
  }
  if (auto good = check_sizes(*rings); !good) return pass_on(good);
  area.boundary = std::move(rings->front());
  area.holes.assign(std::make_move_iterator(rings->begin() + 1), std::make_move_iterator(rings->end()));
  return area;
}

Outcome<CoverArea> load_cover_area(const std::string& path, Units units) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return cover_area_from_text(*text, path, units);
}

}  // namespace outrider
