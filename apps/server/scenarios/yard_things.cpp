#include "scenarios/yard_things.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "outrider/core/units.hpp"
#include "outrider/path/visibility/polygons_from_world.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_changes = 10'000;

/// Returns the polygons of these solids alone that block the robot.
Json polygons_json(const GuardProblem& yard, std::vector<Solid> solids) {
  World part = yard.world;
  part.solids = std::move(solids);
  Json polygons = Json::array();
  const CollisionMap ground = CollisionMap::of(part, yard.robot.height_m);
  for (const RoundedPolygon& obstacle : ground.obstacles()) {
    Json corners = Json::array();
    for (const Vec2 p : outline(obstacle)) corners.push_back({p.x, p.y});
    polygons.push_back(std::move(corners));
  }
  return polygons;
}

bool is_movable(const YardThings& things, const std::string& name) {
  return std::ranges::find(things.movable, name, &MovableThing::name) != things.movable.end();
}

}  // namespace

Outcome<YardThings> yard_things(const GuardProblem& yard, WorldChanges changes) {
  if (auto ok = changed(yard.world, changes); !ok) return pass_on(ok);
  YardThings things{std::move(changes), movable_things(yard.world)};
  const auto names_a_part = [&](const MovableThing& thing) {
    const auto is_part = [&](const std::string& name) { return name.starts_with(thing.name + '/'); };
    return std::ranges::any_of(things.changes.moved, is_part, &MovedThing::name) ||
           std::ranges::any_of(things.changes.removed, is_part);
  };
  std::erase_if(things.movable, names_a_part);
  return things;
}

Json things_json(const GuardProblem& yard, const YardThings& things) {
  Json list = Json::array();
  for (const auto& [name, middle, solids] : things.movable) {
    std::vector<Solid> parts;
    for (const std::size_t i : solids) parts.push_back(yard.world.solids[i]);
    Json polygons = polygons_json(yard, std::move(parts));
    if (polygons.empty()) continue;
    const auto moved = std::ranges::find(things.changes.moved, name, &MovedThing::name);
    const Pose2 place = moved == things.changes.moved.end() ? Pose2{middle, 0.0} : moved->place;
    list.push_back({{"name", name},
                    {"middle", {middle.x, middle.y}},
                    {"polygons", std::move(polygons)},
                    {"place", {place.position.x, place.position.y}},
                    {"turn_rad", place.heading_rad},
                    {"removed", std::ranges::count(things.changes.removed, name) > 0}});
  }
  return list;
}

Json fixed_json(const GuardProblem& yard, const YardThings& things) {
  WorldChanges of_parts = things.changes, taken_away;
  std::erase_if(of_parts.moved, [&](const MovedThing& one) { return is_movable(things, one.name); });
  std::erase_if(of_parts.removed, [&](const std::string& name) { return is_movable(things, name); });
  for (const MovableThing& thing : things.movable) of_parts.removed.push_back(thing.name);
  auto rest = changed(yard.world, of_parts);
  return rest ? polygons_json(yard, std::move(rest->solids)) : Json::array();
}

Outcome<WorldChanges> changes_of(const Json& moved, const Json& removed, const GuardProblem& yard,
                                 const YardThings& things) {
  if (moved.size() + removed.size() > most_changes)
    return bad_input(fmt::format("more than {} things are changed", most_changes), "moved");
  WorldChanges changes = things.changes;
  std::erase_if(changes.moved, [&](const MovedThing& one) { return is_movable(things, one.name); });
  std::erase_if(changes.removed, [&](const std::string& name) { return is_movable(things, name); });
  for (std::size_t i = 0; i < moved.size(); ++i) {
    Fields fields(moved[i], fmt::format("moved[{}]", i));
    MovedThing thing{fields.text("name"), {fields.point("place"), 0.0}};
    thing.place.heading_rad = wrap_angle(fields.number("turn_rad", -most_turn_rad, most_turn_rad, 0.0));
    if (auto ok = fields.end(); !ok) return pass_on(ok);
    changes.moved.push_back(std::move(thing));
  }
  for (const Json& name : removed) {
    if (!name.is_string()) return bad_input("expected the names of things", "removed");
    changes.removed.push_back(name.get<std::string>());
  }
  // Checks the changes as written to text, since that is what will be run.
  auto written = changes_from_text(moved_text(changes.moved), removed_text(changes.removed));
  if (!written) return pass_on(written);
  if (auto ok = changed(yard.world, *written); !ok) return pass_on(ok);
  return changes;
}

}  // namespace outrider::server
