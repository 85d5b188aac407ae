#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "map/area_formats.hpp"
#include "outrider/core/json_excess.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

using GeoJson = nlohmann::json;

constexpr int deepest = 64;

/// A list of rings, its position in the document, and the feature that it belongs to, if there is one.
struct FoundPolygon {
  const GeoJson* coordinates;
  std::string where;
  const GeoJson* feature;
};

/// Collects the polygons of a GeoJSON object.
Status find_polygons(const GeoJson& object, const std::string& where, int depth, const GeoJson* feature,
                     std::vector<FoundPolygon>& found) {
  if (depth > deepest) return bad_input("it nests too deep; give polygons in features", where);
  const auto type = object.is_object() ? object.find("type") : object.end();
  if (!object.is_object() || type == object.end() || !type->is_string()) {
    return bad_input("it is no GeoJSON object with a type", where);
  }
  if (*type == "Feature") feature = &object;
  const auto into = [&](const char* key) -> Status {
    const auto inner = object.find(key);
    if (inner == object.end() || inner->is_null()) return {};
    if (!inner->is_array())
      return find_polygons(*inner, fmt::format("{}.{}", where, key), depth + 1, feature, found);
    for (std::size_t i = 0; i < inner->size(); ++i) {
      auto good =
          find_polygons((*inner)[i], fmt::format("{}.{}[{}]", where, key, i), depth + 1, feature, found);
      if (!good) return good;
    }
    return {};
  };
  if (*type == "FeatureCollection") return into("features");
  if (*type == "Feature") return into("geometry");
  if (*type == "GeometryCollection") return into("geometries");
  const bool many = *type == "MultiPolygon";
  if (!many && *type != "Polygon") return {};
  const auto coordinates = object.find("coordinates");
  if (coordinates == object.end() || !coordinates->is_array()) {
    return bad_input("it has no coordinates", where);
  }
  if (!many) found.push_back({&*coordinates, where + ".coordinates", feature});
  for (std::size_t i = 0; many && i < coordinates->size(); ++i) {
    found.push_back({&(*coordinates)[i], fmt::format("{}.coordinates[{}]", where, i), feature});
  }
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

Outcome<AreaRings> polygon_of(const FoundPolygon& found) {
  const auto& [coordinates, where, feature] = found;
  if (!coordinates->is_array() || coordinates->empty()) {
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

/// Returns the code at the end of a name such as "EPSG:25832" or "urn:ogc:def:crs:EPSG::25832"; 0: none.
int epsg_code(std::string_view name) {
  if (name.find("EPSG") == std::string_view::npos) return 0;
  const auto digits = name.substr(name.find_last_of(":/#") + 1);
  return number<int>(digits).value_or(0);
}

/// Returns the units of a named reference system. In the EPSG registry the codes from 4000 to 4999 stand for
/// geographic, geocentric and projected systems, others with few exceptions for projected ones: of those
/// only the common geographic ones are told by the name.
Units units_of_crs(std::string_view name) {
  constexpr std::array geographic{4258, 4267, 4269, 4283, 4326, 4490, 4612, 4674, 4979, 6318, 6668, 7844};
  if (name.ends_with("CRS84") || name.ends_with("CRS83") || name.ends_with("CRS27")) return Units::degrees;
  const int code = epsg_code(name);
  if (std::ranges::count(geographic, code) > 0) return Units::degrees;
  return code == 0 || (code >= 4000 && code < 5000) ? Units::told_by_size : Units::metres;
}

/// Reads the member "crs" of the GeoJSON before RFC 7946.
void note_crs(const GeoJson& object, AreaFile& file) {
  const GeoJson::json_pointer name("/crs/properties/name");
  if (!object.contains(name) || !object.at(name).is_string()) return;
  file.crs_name = object.at(name).get<std::string>();
  file.crs = object.at("crs").dump(-1, ' ', false, GeoJson::error_handler_t::replace);
  file.units = units_of_crs(file.crs_name);
}

}  // namespace

Outcome<AreaFile> area_from_geojson(std::string_view text, const std::string& name) {
  if (const auto why = json_excess(text); !why.empty())
    return bad_input(fmt::format("{}; leave out all but the polygons", why), name);
  const GeoJson object = GeoJson::parse(text, nullptr, false);
  if (object.is_discarded()) return bad_input("it is no JSON; write a GeoJSON polygon", name);
  std::vector<FoundPolygon> found;
  if (auto good = find_polygons(object, name + ": $", 0, nullptr, found); !good) return pass_on(good);
  if (found.empty()) {
    return bad_input("it holds no polygon; give one or more, with their holes as further rings", name);
  }
  AreaFile file;
  note_crs(object, file);
  for (const FoundPolygon& one : found) {
    auto rings = polygon_of(one);
    if (!rings) return pass_on(rings);
    file.polygons.push_back(std::move(*rings));
    const auto* const feature = one.feature;
    const bool has = feature != nullptr && feature->contains("properties");
    file.properties.push_back(
        has ? feature->at("properties").dump(-1, ' ', false, GeoJson::error_handler_t::replace) : "");
  }
  return file;
}

}  // namespace outrider
