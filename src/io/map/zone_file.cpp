#include "outrider/io/map/zone_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "map/area_formats.hpp"
#include "map/cell_outlines.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {
namespace {

constexpr double least_mps = 0.01, largest_mps = 100.0;
constexpr std::size_t most_zones = 1000;
constexpr const char* area_form =
    "keep_out and its corners x,y in m, or slow, a speed in m/s and the corners, such as \"keep_out 1,1 2,1 "
    "2,2; "
    "slow 0.3 4,0 6,0 6,2\"";

Status check_zone(const Zone& zone) {
  if (zone.kind == Zone::Kind::slow && !(zone.speed_mps >= least_mps && zone.speed_mps <= largest_mps))
    return bad_input(
        fmt::format("a slow zone has the largest speed {:g} m/s; give one from {} to {}, or make it "
                    "a keep_out zone",
                    zone.speed_mps, least_mps, largest_mps),
        zone.where);
  for (const std::vector<Vec2>& ring : zone.rings) {
    if (auto good = check_polygon(ring, "the zone"); !good)
      return bad_input(good.error().sentence, zone.where);
  }
  return {};
}

Outcome<Zone> zone_of(std::string_view text, const std::string& where) {
  const auto parts = words(text);
  Zone zone{.where = where};
  std::size_t at = 1;
  const bool slow = parts.front() == "slow";
  if (slow) {
    zone.kind = Zone::Kind::slow;
    const auto speed = parts.size() > 1 ? number<double>(parts[1]) : std::nullopt;
    if (!speed) return bad_input(fmt::format("'{}' has no speed; write {}", excerpt(text), area_form), where);
    zone.speed_mps = *speed;
    at = 2;
  } else if (parts.front() != "keep_out") {
    return bad_input(fmt::format("'{}' is no zone; write {}", excerpt(text), area_form), where);
  }
  std::vector<Vec2>& ring = zone.rings.emplace_back();
  for (; at < parts.size(); ++at) {
    auto corner = parse_place(std::string(parts[at]), where);
    if (!corner) return pass_on(corner);
    ring.push_back(*corner);
  }
  if (auto good = check_zone(zone); !good) return pass_on(good);
  return zone;
}

/// Reads the kind of a polygon from the properties of its feature.
Status take_properties(const std::string& text, Zone& zone) {
  const auto properties = nlohmann::json::parse(text, nullptr, false);
  const auto kind = properties.is_object() ? properties.find("kind") : properties.end();
  const std::string name = kind != properties.end() && kind->is_string() ? kind->get<std::string>() : "";
  if (name == "keep_out") return {};
  if (name != "slow")
    return bad_input(
        fmt::format("{} is no kind of a zone; give its feature the property \"kind\": \"keep_out\", or "
                    "\"slow\" and \"speed\"",
                    name.empty() ? "nothing" : fmt::format("'{}'", excerpt(name))),
        zone.where);
  zone.kind = Zone::Kind::slow;
  const auto speed = properties.find("speed");
  zone.speed_mps = speed != properties.end() && speed->is_number() ? speed->get<double>() : 0.0;
  return {};
}

/// Returns the outlines of cells that are not 0, in the world.
std::vector<std::vector<Vec2>> outlines_in_world(const Grid<std::uint8_t>& cells, double yaw_rad) {
  auto rings = cell_outlines(cells);
  const Vec2 origin = cells.frame.origin;
  for (auto& ring : rings) {
    for (Vec2& corner : ring) corner = origin + rotated(yaw_rad, corner - origin);
  }
  return rings;
}

Zone zone_of_cells(const MapServerValues& mask, const std::function<bool(std::int8_t)>& belongs,
                   const std::string& where) {
  Grid<std::uint8_t> cells(mask.percent.frame);
  for (std::size_t i = 0; i < cells.cells.size(); ++i)
    cells.cells[i] = belongs(mask.percent.cells[i]) ? 1 : 0;
  return {.rings = outlines_in_world(cells, mask.yaw_rad), .where = where};
}

/// Loads a mask that lies on the ground at least in part.
Outcome<MapServerValues> load_mask(const std::string& path, const Box2& ground) {
  auto mask = load_map_server_values(path);
  if (!mask) return pass_on(mask);
  const GridFrame& frame = mask->percent.frame;
  Box2 box;
  for (const Cell corner : {Cell{0, 0}, {frame.width, 0}, {frame.width, frame.height}, {0, frame.height}})
    box.include(frame.origin + rotated(mask->yaw_rad, frame.corner(corner) - frame.origin));
  if (!ground.empty() && !box.overlaps(ground))
    return bad_input(
        fmt::format("the mask lies from ({:g}, {:g}) to ({:g}, {:g}) and the ground from ({:g}, {:g}) to "
                    "({:g}, {:g}); correct its origin and resolution",
                    box.low.x, box.low.y, box.high.x, box.high.y, ground.low.x, ground.low.y, ground.high.x,
                    ground.high.y),
        path);
  return mask;
}

Status add_keep_out_mask(const std::string& path, const Box2& ground, LoadedZones& loaded) {
  auto mask = load_mask(path, ground);
  if (!mask) return pass_on(mask);
  Zone zone = zone_of_cells(*mask, [](std::int8_t value) { return value == 100; }, path);
  const auto weighted = std::ranges::count_if(mask->percent.cells, [](int v) { return v > 0 && v < 100; });
  if (weighted > 0)
    loaded.warnings.push_back(fmt::format(
        "{}: {} cells have values from 1 to 99; they are taken for free, since only 100 is kept out of", path,
        weighted));
  if (!zone.rings.empty()) loaded.zones.push_back(std::move(zone));
  return {};
}

Status add_speed_mask(const ZoneSources& sources, double most_mps, const Box2& ground, LoadedZones& loaded) {
  const std::string& path = sources.speed_mask;
  auto mask = load_mask(path, ground);
  if (!mask) return pass_on(mask);
  std::map<std::int8_t, bool> values;
  for (const std::int8_t value : mask->percent.cells) values[value] = value > 0;
  for (const auto& [value, limits] : values) {
    const double limit = sources.speed_base + sources.speed_multiplier * value;
    if (!limits || limit == 0.0) continue;
    if (limit < 0.0 || (sources.speed_percent && limit > 100.0))
      return bad_input(fmt::format("its value {} means a limit of {:g}{}; correct zones.speed_base, "
                                   "zones.speed_multiplier or zones.speed_percent",
                                   value, limit, sources.speed_percent ? " %, and not 0 to 100" : " m/s"),
                       path);
    Zone zone = zone_of_cells(*mask, [&](std::int8_t one) { return one == value; }, path);
    zone.kind = Zone::Kind::slow;
    zone.speed_mps = std::max(least_mps, sources.speed_percent ? limit / 100.0 * most_mps : limit);
    loaded.zones.push_back(std::move(zone));
  }
  return {};
}

}  // namespace

std::vector<Option> describe(ZoneSources& sources) {
  return {
      {"areas", "", 0, 0,
       "kind, of slow ones the largest speed in m/s, and corners x,y in m of each; several with ; between",
       &sources.areas},
      file_option("file", "GeoJSON of polygons in m with the properties kind and speed; empty: none",
                  &sources.file),
      file_option("keep_out_mask", "YAML file of a keep-out filter mask of Nav2; empty: none",
                  &sources.keep_out_mask),
      file_option("speed_mask", "YAML file of a speed filter mask of Nav2; empty: none", &sources.speed_mask),
      {"speed_base", "", -1e6, 1e6, "base of the speed mask", &sources.speed_base},
      {"speed_multiplier", "", -1e6, 1e6, "multiplier of the values of the speed mask",
       &sources.speed_multiplier},
      {"speed_percent", "", 0, 0, "limits of the speed mask are in percent of follow.speed, else in m/s",
       &sources.speed_percent},
  };
}

Outcome<std::vector<Zone>> zones_from_text(const std::string& text, const std::string& where) {
  std::vector<Zone> zones;
  const auto parts = filled_parts_between(text, ';');
  for (const std::string_view part : parts) {
    auto zone = zone_of(part, where);
    if (!zone) return pass_on(zone);
    zones.push_back(std::move(*zone));
  }
  return zones;
}

Outcome<std::vector<Zone>> zones_from_geojson(std::string_view text, const std::string& name) {
  auto file = area_from_geojson(text, name);
  if (!file) return pass_on(file);
  if (file->units == Units::degrees)
    return bad_input(
        fmt::format("its crs '{}' says degrees; give metres in the frame of the map, without a crs",
                    excerpt(file->crs_name)),
        name);
  std::vector<Zone> zones;
  for (std::size_t i = 0; i < file->polygons.size(); ++i) {
    AreaRings& rings = file->polygons[i];
    Zone zone{.where = rings.front().where};
    if (auto good = take_properties(file->properties[i], zone); !good) return pass_on(good);
    for (AreaRing& ring : rings) zone.rings.push_back(std::move(ring.corners));
    if (auto good = check_zone(zone); !good) return pass_on(good);
    zones.push_back(std::move(zone));
  }
  return zones;
}

Outcome<LoadedZones> load_zones(const ZoneSources& sources, double most_mps, const Box2& ground) {
  LoadedZones loaded;
  auto areas = zones_from_text(sources.areas, "zones.areas");
  if (!areas) return pass_on(areas);
  loaded.zones = std::move(*areas);
  if (!sources.file.empty()) {
    const auto text = read_file(sources.file);
    if (!text) return pass_on(text);
    auto zones = zones_from_geojson(*text, sources.file);
    if (!zones) return pass_on(zones);
    std::ranges::move(*zones, std::back_inserter(loaded.zones));
  }
  if (!sources.keep_out_mask.empty()) {
    if (auto good = add_keep_out_mask(sources.keep_out_mask, ground, loaded); !good) return pass_on(good);
  }
  if (!sources.speed_mask.empty()) {
    if (auto good = add_speed_mask(sources, most_mps, ground, loaded); !good) return pass_on(good);
  }
  if (loaded.zones.size() > most_zones)
    return bad_input(fmt::format("there are {} zones; at most {} are taken", loaded.zones.size(), most_zones),
                     "zones");
  return loaded;
}

}  // namespace outrider
