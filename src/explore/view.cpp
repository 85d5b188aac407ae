#include "outrider/explore/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "flood.hpp"
#include "outrider/core/units.hpp"
#include "reach.hpp"
#include "sight.hpp"

namespace outrider {
namespace {

constexpr int gain_rays = 180;
constexpr double heading_m = 0.5;  // the way begins in the direction of the place so far along it

struct ViewMemory {
  SightMemory sight;
  RayFan fan;
};

/// Of a seat by the flood from the robot, and whether it may be chosen.
struct Finder {
  const ExploreState& state;
  const ExploreOptions& options;
  const Flood& flood;
  ViewMemory& memory;
  const KnownGround& ground = state.map.ground();
  double per_cost_s = ground.blocks().frame.resolution_m / Flood::per_block / state.robot.speed_mps;

  [[nodiscard]] RefusedFrontier refusal(const Frontier& frontier, std::string reason) const {
    return {frontier.id, frontier.centroid, frontier.cells.size(), std::move(reason)};
  }

  /// The seat that is reached first; null when none is, with the ban that keeps the robot off.
  [[nodiscard]] std::pair<const Seat*, const Ban*> first(const FrontierSight& sight) const {
    const Seat* best = nullptr;
    const Ban* banned = nullptr;
    for (const Seat& seat : sight.seats) {
      if (flood.cost(seat.block) == Flood::far) continue;
      if (best != nullptr && flood.cost(seat.block) >= flood.cost(best->block)) continue;
      const Ban* ban = state.blacklist.find(centre(seat.cell), state.time_s);
      if (ban == nullptr)
        best = &seat;
      else
        banned = ban;
    }
    return {best, banned};
  }

  [[nodiscard]] Vec2 centre(std::uint32_t cell) const {
    return ground.frame().centre(ground.frame().cell(cell));
  }

  [[nodiscard]] View view(const Frontier& frontier, const FrontierSight& sight, const Seat& seat) const {
    View made;
    made.frontier = frontier.id;
    made.block = seat.block;
    Vec2 mean;
    for (const std::uint32_t cell : sight.sample) mean = mean + centre(cell);
    const Vec2 at = centre(seat.cell);
    made.pose = {at, heading_of(1.0 / static_cast<double>(sight.sample.size()) * mean - at)};
    for (const Seat& other : sight.seats) made.seats.push_back(other.block);
    made.reach_s = per_cost_s * flood.cost(seat.block);
    const GridFrame& blocks = ground.blocks().frame;
    const auto ahead = static_cast<std::uint32_t>(heading_m / blocks.resolution_m * Flood::per_block);
    const Vec2 begin = blocks.centre(blocks.cell(flood.towards(ground.blocks(), seat.block, ahead)));
    if (flood.cost(seat.block) > 0) {
      const double turn = wrap_angle(heading_of(begin - state.pose.position) - state.pose.heading_rad);
      made.turn_s = std::abs(turn) / state.robot.turn_rate_radps;
    }
    made.gain_m2 = gain_at(ground.frame().cell(seat.cell), ground.known(), memory.fan);
    return made;
  }

  void look_at(const Frontier& frontier, Views& found) const {
    if (std::ranges::all_of(frontier.cells, [&](std::uint32_t cell) { return ground.blocked(cell); })) {
      found.refused.push_back(refusal(frontier, "a crack between walls: the robot fits nowhere into it"));
      return;
    }
    const FrontierSight sight = sight_of(frontier, state.map, options.view_m, memory.sight);
    if (sight.sample.empty()) {
      found.refused.push_back(
          refusal(frontier, fmt::format("given up after {} tries to see more", options.frontier.patience)));
      return;
    }
    if (sight.seats.empty()) {
      found.refused.push_back(refusal(
          frontier, fmt::format("the robot fits nowhere within {:g} m in sight of it", options.view_m)));
      return;
    }
    const auto [seat, ban] = first(sight);
    if (seat == nullptr) {
      found.refused.push_back(refusal(
          frontier, ban == nullptr ? std::string("no known way leads to where it would be seen")
                                   : fmt::format("going there failed {} times; left alone until {:.0f} s",
                                                 ban->failures, ban->until_s)));
      return;
    }
    const double behind =
        gain_behind(ground.frame().cell(seat->cell), ground.known(), sight.sample, state.range_m);
    if (behind < options.least_gain_m2) {
      found.refused.push_back(refusal(
          frontier,
          fmt::format("a crack: {:.4f} m2 behind it are less than {:g} m2", behind, options.least_gain_m2)));
      return;
    }
    found.views.push_back(view(frontier, sight, *seat));
  }
};

/// From a point to a box.
double distance_to(const Box2& box, Vec2 p) {
  return norm(Vec2{std::max({0.0, box.low.x - p.x, p.x - box.high.x}),
                   std::max({0.0, box.low.y - p.y, p.y - box.high.y})});
}

}  // namespace

Views find_views(const ExploreState& state, const ExploreOptions& options, Workspace& workspace) {
  Views found;
  const KnownGround& ground = state.map.ground();
  auto& memory = workspace.get<ViewMemory>();
  const int range = static_cast<int>(state.range_m / ground.frame().resolution_m);
  if (memory.fan.cells != range) memory.fan = RayFan::of(range, gain_rays);
  Flood& flood = workspace.get<RobotFlood>().flood;
  const Flood::Walls walls =
      options.strategy == "nearest" ? Flood::Walls::are_shunned : Flood::Walls::do_not_matter;
  if (const auto start = free_block_near(ground, state.pose.position))
    flood.run(ground.blocks(), *start, walls);
  else
    flood.clear(ground.blocks());

  std::vector<std::pair<double, const Frontier*>> nearest;
  for (const auto& [id, frontier] : state.map.frontiers()) {
    // The choice before is weighed wherever the robot is by now, or it would swing between two far ones.
    const bool before = id == state.before.frontier;
    nearest.emplace_back(before ? 0.0 : distance_to(frontier.bounds, state.pose.position), &frontier);
  }
  std::sort(nearest.begin(), nearest.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second->id) < std::pair(b.first, b.second->id);
  });
  const Finder finder{state, options, flood, memory};
  const auto by_reach = [&](const View& a, const View& b) {
    const auto key = [&](const View& v) {
      return std::tuple(v.frontier != state.before.frontier, v.reach_s, v.frontier);
    };
    return key(a) < key(b);
  };
  const auto most = static_cast<std::size_t>(options.most_views);
  for (const auto& [away, frontier] : nearest) {
    if (found.views.size() >= most) {
      // No place in sight of it is nearer than this.
      const double least_s = (away - options.view_m) / state.robot.speed_mps;
      std::nth_element(found.views.begin(), found.views.begin() + static_cast<std::ptrdiff_t>(most) - 1,
                       found.views.end(), by_reach);
      found.all = found.views[most - 1].reach_s > least_s;
      if (!found.all) break;
    }
    finder.look_at(*frontier, found);
  }
  std::sort(found.views.begin(), found.views.end(), by_reach);
  if (found.views.size() > most) {
    found.views.resize(most);
    found.all = false;
  }
  std::sort(found.refused.begin(), found.refused.end(),
            [](const RefusedFrontier& a, const RefusedFrontier& b) { return a.frontier < b.frontier; });
  return found;
}

}  // namespace outrider
