#include "outrider/world/changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "outrider/core/options.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_near_names = 3;

bool stands_for(std::string_view name, std::string_view solid) {
  return solid.starts_with(name) && (solid.size() == name.size() || solid[name.size()] == '/');
}

std::vector<std::size_t> solids_of(const World& world, std::string_view name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < world.solids.size(); ++i) {
    if (stands_for(name, world.solids[i].name)) found.push_back(i);
  }
  return found;
}

bool is_ground(const Solid& solid) {
  return std::holds_alternative<HalfSpaceShape>(solid.shape) ||
         std::holds_alternative<HeightFieldShape>(solid.shape);
}

std::string_view first_part(std::string_view name) { return name.substr(0, name.find('/')); }

Vec2 middle_of(const World& world, const std::vector<std::size_t>& solids) {
  Box2 around;
  for (const std::size_t i : solids) {
    const Box2 box = bounds(world.solids[i]).ground();
    around.include(box.low);
    around.include(box.high);
  }
  return 0.5 * (around.low + around.high);
}

/// Makes the fault for an unknown name.
tl::unexpected<Fault> unknown(std::string_view name, const World& world, const char* key) {
  std::vector<std::string> known, near;
  for (const MovableThing& thing : movable_things(world)) known.push_back(thing.name);
  const std::vector<std::string> all = known;
  for (const Solid& solid : world.solids) known.push_back(solid.name);
  while (near.size() < most_near_names) {
    const std::string nearest = nearest_name(name.substr(0, 64), known);
    if (nearest.empty()) break;
    near.push_back(fmt::format("'{}'", nearest));
    std::erase(known, nearest);
  }
  const std::size_t shown = std::min<std::size_t>(all.size(), 20);
  const std::string remedy =
      !near.empty() ? fmt::format("near to it are {}", fmt::join(near, ", "))
      : all.empty()
          ? "nothing in it can be moved"
          : fmt::format("take one of {}",
                        fmt::join(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return bad_input(fmt::format("nothing in the world is named '{}'; {}", excerpt(name), remedy), key);
}

/// Returns the solids of a name and marks them as taken. Faults: ground, and solids that are already taken.
Outcome<std::vector<std::size_t>> claimed(const World& world, std::string_view name, const char* key,
                                          std::vector<bool>& taken) {
  std::vector<std::size_t> solids = solids_of(world, name);
  if (solids.empty()) return unknown(name, world, key);
  for (const std::size_t i : solids) {
    if (is_ground(world.solids[i])) {
      return bad_input(fmt::format("'{}' is the ground, which stays; name what stands on it", excerpt(name)),
                       key);
    }
    if (taken[i]) {
      return bad_input(fmt::format("'{}' is named twice, in moved or removed; leave one out",
                                   excerpt(world.solids[i].name)),
                       key);
    }
    taken[i] = true;
  }
  return solids;
}

}  // namespace

Outcome<World> changed(const World& world, const WorldChanges& changes) {
  std::vector<bool> taken(world.solids.size(), false), gone(world.solids.size(), false);
  World next = world;
  for (const auto& [name, place] : changes.moved) {
    auto solids = claimed(world, name, "moved", taken);
    if (!solids) return pass_on(solids);
    const Vec2 from = middle_of(world, *solids), to = place.position;
    const double rise = world.ground_z_m(to) - world.ground_z_m(from);
    const Pose3 there{{to.x, to.y, rise}, Rotation::from_rpy(0.0, 0.0, place.heading_rad)};
    for (const std::size_t i : *solids) {
      Pose3& pose = next.solids[i].world_T_solid;
      pose.position = pose.position - Vec3{from.x, from.y, 0.0};
      pose = there * pose;
    }
  }
  for (const std::string& name : changes.removed) {
    auto solids = claimed(world, name, "removed", taken);
    if (!solids) return pass_on(solids);
    for (const std::size_t i : *solids) gone[i] = true;
  }
  std::size_t at = 0;
  std::erase_if(next.solids, [&](const Solid&) { return gone[at++]; });
  return next;
}

std::vector<MovableThing> movable_things(const World& world) {
  std::vector<MovableThing> things;
  std::map<std::string_view, std::size_t> index;
  std::vector<bool> stays;
  for (std::size_t i = 0; i < world.solids.size(); ++i) {
    const std::string_view name = first_part(world.solids[i].name);
    const auto [known, is_new] = index.try_emplace(name, things.size());
    if (is_new) {
      things.push_back({std::string(name), {}, {}});
      stays.push_back(name.empty() || trimmed(name) != name || name.find(';') != std::string_view::npos);
    }
    things[known->second].solids.push_back(i);
    if (is_ground(world.solids[i])) stays[known->second] = true;
  }
  std::size_t at = 0;
  std::erase_if(things, [&](const MovableThing&) { return stays[at++]; });
  for (MovableThing& thing : things) thing.middle = middle_of(world, thing.solids);
  return things;
}

}  // namespace outrider
