#include "geojson.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

using Json = nlohmann::ordered_json;

constexpr double arc_step_rad = radians(4.0);
constexpr double per_degree = 1e9;  // a tenth of a millimetre

Json point_json(Vec2 p, const AreaFrame& frame) {
  const Vec2 at = frame.to_file(p);
  if (!frame.degrees) return {at.x, at.y};
  return {std::round(at.x * per_degree) / per_degree, std::round(at.y * per_degree) / per_degree};
}

Json ring_json(const std::vector<Vec2>& ring, const AreaFrame& frame) {
  auto points = Json::array();
  for (const Vec2 p : ring) points.push_back(point_json(p, frame));
  if (!ring.empty()) points.push_back(point_json(ring.front(), frame));
  return points;
}

Json feature(Json properties, const char* type, Json coordinates) {
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}}};
}

Json region_feature(const char* name, const Region& region, const AreaFrame& frame) {
  auto polygons = Json::array();
  for (const RingedPolygon& polygon : region) {
    auto rings = Json::array({ring_json(polygon.outer, frame)});
    for (const auto& hole : polygon.holes) rings.push_back(ring_json(hole, frame));
    polygons.push_back(std::move(rings));
  }
  return feature({{"name", name}, {"area_m2", area_of(region)}}, "MultiPolygon", std::move(polygons));
}

std::string collection(Json features, const AreaFrame& frame) {
  Json object = {{"type", "FeatureCollection"}};
  if (!frame.crs.empty()) object["crs"] = Json::parse(frame.crs);
  object["features"] = std::move(features);
  return object.dump() + "\n";
}

const char* name_of(PieceRole role) {
  return role == PieceRole::lap        ? "lap"
         : role == PieceRole::lane     ? "lane"
         : role == PieceRole::transfer ? "transfer"
                                       : "move";
}

}  // namespace

std::string areas_geojson(const CoverRun& run, const AreaFrame& frame) {
  const Coverage &planned = run.proof.planned, &driven = run.driven;
  auto features = Json::array();
  const auto add = [&](const char* name, const Region& region) {
    features.push_back(region_feature(name, region, frame));
  };
  add("area", run.plan.ground.area);
  add("reachable", run.plan.ground.reach);
  add("covered", planned.covered);
  add("missed", planned.missed);
  add("overlap", planned.overlap);
  add("covered by the drive", driven.covered);
  add("missed by the drive", driven.missed);
  add("overlap of the drive", driven.overlap);
  return collection(std::move(features), frame);
}

std::string track_geojson(const CoverRun& run, const AreaFrame& frame) {
  const CoverPlan& plan = run.plan;
  auto features = Json::array();
  for (std::size_t i = 0; i < plan.track.pieces.size();) {
    const PieceRole role = plan.roles[i];
    std::vector<PathPiece> pieces;
    const auto goes_on = [&](std::size_t k) {
      if (k >= plan.track.pieces.size() || plan.roles[k] != role || role == PieceRole::lane) return false;
      return !std::binary_search(plan.begins.begin(), plan.begins.end(), k);
    };
    do pieces.push_back(plan.track.pieces[i++]);
    while (goes_on(i));
    auto line = Json::array();
    for (const Vec2 p : points_along(pieces.front().from, pieces, arc_step_rad))
      line.push_back(point_json(p, frame));
    features.push_back(feature({{"role", name_of(role)}}, "LineString", std::move(line)));
  }
  return collection(std::move(features), frame);
}

std::string track_json(const CoverRun& run, const AreaFrame& frame) {
  const CoverPlan& plan = run.plan;
  const Pose2& start = plan.track.start;
  auto pieces = Json::array();
  for (std::size_t i = 0; i < plan.track.pieces.size(); ++i) {
    const PathPiece& piece = plan.track.pieces[i];
    Json one = {{"role", name_of(plan.roles[i])},
                {"from", {piece.from.x, piece.from.y}},
                {"to", {piece.to.x, piece.to.y}}};
    if (piece.turn_rad != 0.0) one["centre"] = {piece.centre.x, piece.centre.y};
    if (piece.turn_rad != 0.0) one["turn_rad"] = piece.turn_rad;
    if (piece.backward) one["backward"] = true;
    pieces.push_back(std::move(one));
  }
  auto driven = Json::array();
  for (const Vec2 p : run.drive.way) driven.push_back({p.x, p.y});
  Json object = {{"start", {start.position.x, start.position.y, start.heading_rad}},
                 {"pieces", std::move(pieces)},
                 {"driven", std::move(driven)}};
  if (frame.moved()) object["origin"] = {frame.origin.x, frame.origin.y};
  return object.dump() + "\n";
}

}  // namespace outrider::cover
