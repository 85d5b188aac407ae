#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "area_formats.hpp"
#include "outrider/io/text.hpp"

namespace outrider {
namespace {

using GeoJson = nlohmann::json;

constexpr int deepest = 64;

/// Collects the polygons of a GeoJSON object, each with its position in the document.
Status find_polygons(const GeoJson& object, const std::string& where, int depth,
                     std::vector<std::pair<const GeoJson*, std::string>>& found) {
  if (depth > deepest) return bad_input("it nests too deep; give one polygon", where);
  const auto type = object.is_object() ? object.find("type") : object.end();
  if (!object.is_object() || type == object.end() || !type->is_string()) {
    return bad_input("it is no GeoJSON object with a type", where);
  }
  const auto into = [&](const char* key) -> Status {
    const auto inner = object.find(key);
    if (inner == object.end() || inner->is_null()) return {};
    if (!inner->is_array()) return find_polygons(*inner, fmt::format("{}.{}", where, key), depth + 1, found);
    for (std::size_t i = 0; i < inner->size(); ++i) {
      auto good = find_polygons((*inner)[i], fmt::format("{}.{}[{}]", where, key, i), depth + 1, found);
      if (!good) return good;
    }
    return {};
  };
  if (*type == "FeatureCollection") return into("features");
  if (*type == "Feature") return into("geometry");
  if (*type == "GeometryCollection") return into("geometries");
  if (*type == "Polygon") found.emplace_back(&object, where + ".coordinates");
  return {};
}

Outcome<AreaRing> ring_of(const GeoJson& points, const std::string& where) {
  if (!points.is_array()) return bad_input("a ring is a list of [x, y]", where);
  AreaRing ring{{}, where};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const GeoJson& point = points[i];
    if (!point.is_array() || point.size() < 2 || !point[0].is_number() || !point[1].is_number()) {
      return bad_input("a corner is [longitude, latitude] or [x, y]", fmt::format("{}[{}]", where, i));
    }
    ring.corners.push_back({point[0].get<double>(), point[1].get<double>()});
  }
  return ring;
}

}  // namespace

Outcome<AreaRings> rings_from_geojson(std::string_view text, const std::string& name) {
  const GeoJson object = GeoJson::parse(text, nullptr, false);
  if (object.is_discarded()) return bad_input("it is no JSON; write a GeoJSON polygon", name);
  std::vector<std::pair<const GeoJson*, std::string>> polygons;
  if (auto good = find_polygons(object, name + ": $", 0, polygons); !good) return pass_on(good);
  if (polygons.size() != 1) {
    return bad_input(
        fmt::format("it holds {} polygons; give one, with its holes as further rings", polygons.size()),
        name);
  }
  const auto& [polygon, where] = polygons.front();
  const auto coordinates = polygon->find("coordinates");
  if (coordinates == polygon->end() || !coordinates->is_array() || coordinates->empty()) {
    return bad_input("a polygon has a list of rings here", where);
  }
  AreaRings rings;
  for (std::size_t i = 0; i < coordinates->size(); ++i) {
    auto ring = ring_of((*coordinates)[i], fmt::format("{}[{}]", where, i));
    if (!ring) return pass_on(ring);
    rings.push_back(std::move(*ring));
  }
  return rings;
}

}  // namespace outrider
