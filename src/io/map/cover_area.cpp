#include "outrider/io/map/cover_area.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/area_formats.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/map/polygons.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {
namespace {

constexpr double widest_deg = 0.2;          // of what is taken for degrees
constexpr double widest_said_deg = 1.0;     // of what is said to be degrees
constexpr double farthest_of_file_m = 3e7;  // more than any projected coordinate

bool ends_with_any(std::string_view name, std::initializer_list<std::string_view> ends) {
  return std::ranges::any_of(ends, [&](std::string_view end) { return without_gz(name).ends_with(end); });
}

Outcome<AreaRings> rings_from_polygon_text(std::string_view text, const std::string& name) {
  auto map = polygon_map_from_text(text, name);
  if (!map) return pass_on(map);
  TextLines lines{text, name};
  lines.next_filled();
  AreaRings rings{{std::move(map->boundary), lines.where()}};
  while (trimmed(lines.line) != "---") lines.next_filled();
  for (auto& obstacle : map->obstacles) {  // each has one line
    lines.next_filled();
    rings.push_back({std::move(obstacle), lines.where()});
  }
  return rings;
}

bool could_be_degrees(const Box2& box, double widest) {
  const Box2 earth{{-180.0, -90.0}, {180.0, 90.0}};
  return box.size().x <= widest && box.size().y <= widest && earth.contains(box.low) &&
         earth.contains(box.high);
}

template <class Check>
Status each_ring(const std::vector<AreaRings>& polygons, Check check) {
  for (const AreaRings& rings : polygons) {
    for (const AreaRing& ring : rings) {
      if (Status good = check(ring); !good) return good;
    }
  }
  return {};
}

/// Checks what was read.
Status check_rings(const std::vector<AreaRings>& polygons) {
  std::size_t corners = 0;
  auto good = each_ring(polygons, [&](const AreaRing& ring) -> Status {
    corners += ring.corners.size();
    if (ring.corners.size() < 3) {
      return bad_input(fmt::format("a ring of {} corners has no area; give at least 3", ring.corners.size()),
                       ring.where);
    }
    for (const Vec2 p : ring.corners) {
      if (std::abs(p.x) <= farthest_of_file_m && std::abs(p.y) <= farthest_of_file_m) continue;
      return bad_input(fmt::format("the corner ({:g}, {:g}) is farther than {:g} m from the origin; no "
                                   "coordinates on the earth are",
                                   p.x, p.y, farthest_of_file_m),
                       ring.where);
    }
    return {};
  });
  if (!good || corners <= most_polygon_corners) return good;
  return bad_input(
      fmt::format("{} corners are more than {}; simplify the area", corners, most_polygon_corners),
      polygons.front().front().where);
}

/// Returns true if two rings have the same corners in the same or the opposite order, whichever is the first.
bool same_ring(const AreaRing& a, const AreaRing& b) {
  const std::size_t n = a.corners.size();
  const auto first = std::ranges::find(b.corners, a.corners.front());
  if (b.corners.size() != n || first == b.corners.end()) return false;
  const auto agrees = [&](std::size_t step) {
    auto at = static_cast<std::size_t>(first - b.corners.begin());
    return std::ranges::all_of(a.corners,
                               [&](Vec2 p) { return p == b.corners[std::exchange(at, (at + step) % n)]; });
  };
  return agrees(1) || agrees(n - 1);
}

/// Leaves out holes that are given again: laps around two of them would be the same.
void leave_out_repeated_holes(AreaRings& rings) {
  for (std::size_t i = rings.size(); i-- > 2;) {
    const auto hole = rings.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::any_of(rings.begin() + 1, hole, [&](const AreaRing& other) { return same_ring(other, *hole); }))
      rings.erase(hole);
  }
}

/// Checks the local coordinates.
Status check_span(const std::vector<AreaRings>& polygons) {
  return each_ring(polygons, [](const AreaRing& ring) -> Status {
    for (const Vec2 p : ring.corners) {
      if (std::abs(p.x) <= farthest_corner_m && std::abs(p.y) <= farthest_corner_m) continue;
      return bad_input(fmt::format("a corner lies ({:g}, {:g}) m from the south-west corner, farther than "
                                   "{:g} m; cut the area into parts",
                                   p.x, p.y, farthest_corner_m),
                       ring.where);
    }
    return {};
  });
}

Outcome<AreaFile> read_area(std::string_view text, const std::string& name, bool json, bool xml) {
  if (json) return area_from_geojson(text, name);
  auto rings = xml                                      ? rings_from_gml(text, name)
               : ends_with_any(name, {".yaml", ".yml"}) ? rings_from_yaml(text, name)
                                                        : rings_from_polygon_text(text, name);
  if (!rings) return pass_on(rings);
  AreaFile file;
  file.polygons.push_back(std::move(*rings));
  return file;
}

/// Says how numbers were told by their size, and what says it for sure.
std::string sentence_of_guess(const Box2& box, const std::string& name, const AreaFile& file, bool degrees) {
  const std::string crs = file.crs_name.empty()
                              ? "no 'crs' says otherwise"
                              : fmt::format("the crs '{}' is not known", excerpt(file.crs_name));
  return fmt::format(
      "{}: its numbers span {:g} by {:g} and are taken for {} by their size, as {}; say units: degrees or "
      "units: metres",
      name, box.size().x, box.size().y, degrees ? "degrees" : "metres", crs);
}

/// Chooses the frame for coordinates in that box, and says in `note` if it had to guess. RFC 7946 says
/// degrees; numbers that cannot be degrees of an area are metres.
Outcome<AreaFrame> frame_of(const Box2& box, const std::string& name, Units units, const AreaFile& file,
                            bool geographic, std::string& note) {
  if (units == Units::degrees && !could_be_degrees(box, widest_said_deg)) {
    return bad_input(
        fmt::format("({:g}, {:g}) to ({:g}, {:g}) are no degrees of an area up to {:g} across; say "
                    "units: metres",
                    box.low.x, box.low.y, box.high.x, box.high.y, widest_said_deg),
        name);
  }
  const bool guess = units == Units::told_by_size && geographic;
  const bool degrees = units == Units::degrees || (guess && could_be_degrees(box, widest_deg));
  if (guess && !(degrees && file.crs_name.empty())) note = sentence_of_guess(box, name, file, degrees);
  return degrees ? AreaFrame::of_degrees(box) : AreaFrame::of_metres(box, farthest_corner_m);
}

}  // namespace

Outcome<CoverArea> cover_area_from_text(std::string_view text, const std::string& name, Units units) {
  const bool json = ends_with_any(name, {".json", ".geojson"}), xml = ends_with_any(name, {".xml", ".gml"});
  auto file = read_area(text, name, json, xml);
  if (!file) return pass_on(file);
  Box2 box;
  for (AreaRings& rings : file->polygons) {
    for (AreaRing& ring : rings) {
      if (ring.corners.size() > 1 && ring.corners.front() == ring.corners.back()) ring.corners.pop_back();
      for (const Vec2 p : ring.corners) box.include(p);
    }
  }
  if (auto good = check_rings(file->polygons); !good) return pass_on(good);
  std::ranges::for_each(file->polygons, leave_out_repeated_holes);
  CoverArea area;
  auto frame =
      frame_of(box, name, units == Units::told_by_size ? file->units : units, *file, json || xml, area.note);
  if (!frame) return pass_on(frame);
  area.frame = std::move(*frame);
  area.frame.crs = std::move(file->crs);
  for (AreaRings& rings : file->polygons) {
    for (AreaRing& ring : rings) {
      for (Vec2& p : ring.corners) p = area.frame.to_local(p);
    }
  }
  if (auto good = check_span(file->polygons); !good) return pass_on(good);
  for (AreaRings& rings : file->polygons) {
    area.polygons.push_back(
        {std::move(rings.front()),
         {std::make_move_iterator(rings.begin() + 1), std::make_move_iterator(rings.end())}});
  }
  return area;
}

Outcome<CoverArea> load_cover_area(const std::string& path, Units units) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return cover_area_from_text(*text, path, units);
}

}  // namespace outrider
