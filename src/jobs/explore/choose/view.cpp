#include "outrider/jobs/explore/choose/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "map/flood.hpp"
#include "map/reach.hpp"
#include "map/sight.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double heading_m = 0.5;  // the way begins in the direction of the place so far along it

struct GainMemory {
  RayFan fan;
};

/// A frontier to which the flood from the robot has not come yet.
struct Ahead {
  const Frontier* frontier = nullptr;
  const FrontierSight* sight = nullptr;
};

struct Finder {
  const ExploreState& state;
  const ExploreOptions& options;
  const Flood& flood;
  const RayFan& fan;
  SightMemory& sights;
  const TraversabilityGrid& ground = state.map.ground();
  double per_cost_s = ground.blocks().frame.resolution_m / Flood::per_block / state.robot.speed_mps;

  [[nodiscard]] RefusedFrontier refusal(const Frontier& frontier, Refusal kind, std::string reason) const {
    return {frontier.id, frontier.centroid, frontier.cells.size(), kind, std::move(reason)};
  }

  /// The seat that is reached first; null when none is so far, with the ban that keeps the robot off.
  [[nodiscard]] std::pair<const Seat*, const Ban*> first(const FrontierSight& sight) const {
    const Seat* best = nullptr;
    const Ban* banned = nullptr;
    for (const Seat& seat : sight.seats) {
      if (!flood.settled(seat.block)) continue;
      if (best != nullptr && flood.cost(seat.block) >= flood.cost(best->block)) continue;
      const Ban* ban = state.blacklist.find(centre(seat.cell), state.time_s);
      if (ban == nullptr)
        best = &seat;
      else
        banned = ban;
    }
    return {best, banned};
  }

  /// The seat that sees the most of a frontier of which no good seat can be reached, as through a gap that is
  /// too narrow; null if none is worth the way.
  [[nodiscard]] const Seat* best_of_poorer(const FrontierSight& sight) const {
    const Seat* best = nullptr;
    for (const Seat& seat : sight.poorer) {
      if (!flood.settled(seat.block) || (best != nullptr && seat.seen <= best->seen)) continue;
      if (state.blacklist.find(centre(seat.cell), state.time_s) == nullptr) best = &seat;
    }
    if (best == nullptr) return nullptr;
    const double gain_m2 = gain_at(ground.frame().cell(best->cell), ground.known(), fan);
    return gain_m2 >= options.least_left_m2 ? best : nullptr;
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
    made.gain_m2 = gain_at(ground.frame().cell(seat.cell), ground.known(), fan);
    return made;
  }

  /// Refuses a frontier that cannot be seen from anywhere, or keeps it for when the flood comes there.
  void look_at(const Frontier& frontier, std::vector<Ahead>& ahead, Views& found) const {
    const double wide_m = static_cast<double>(frontier.cells.size()) * ground.frame().resolution_m;
    if (wide_m < options.least_opening_m - 1e-9 &&
        std::ranges::all_of(frontier.cells, [&](std::uint32_t cell) { return ground.blocked(cell); })) {
      found.refused.push_back(
          refusal(frontier, Refusal::closed, "a crack between walls: the robot fits nowhere into it"));
      return;
    }
    const FrontierSight& sight = sight_of(frontier, state.map, options.view_m, sights);
    if (sight.sample.empty()) {
      found.refused.push_back(
          refusal(frontier, Refusal::given_up,
                  fmt::format("given up after {} tries to see more", options.frontier.patience)));
    } else if (sight.seats.empty()) {
      found.refused.push_back(
          refusal(frontier, Refusal::closed,
                  fmt::format("the robot fits nowhere within {:g} m in sight of it", options.view_m)));
    } else {
      ahead.push_back({&frontier, &sight});
    }
  }

  /// Finds the view of a frontier, or refuses it; false when the flood, which has `more` to reach, has to go
  /// on.
  bool settle(const Ahead& ahead, bool more, Views& found) const {
    const Frontier& frontier = *ahead.frontier;
    auto [seat, ban] = first(*ahead.sight);
    if (seat == nullptr && more) return false;
    if (seat == nullptr && ban == nullptr) seat = best_of_poorer(*ahead.sight);
    if (seat == nullptr) {
      found.refused.push_back(
          refusal(frontier, ban == nullptr ? Refusal::no_way : Refusal::banned,
                  ban == nullptr ? std::string("no known way leads to where it would be seen")
                                 : fmt::format("going there failed {} times; left alone until {:.0f} s",
                                               ban->failures, ban->until_s)));
      return true;
    }
    const double behind =
        gain_behind(ground.frame().cell(seat->cell), ground.known(), ahead.sight->sample, state.range_m);
    if (behind < options.least_gain_m2) {
      found.refused.push_back(refusal(
          frontier, Refusal::small,
          fmt::format("a crack: {:.4f} m2 behind it are less than {:g} m2", behind, options.least_gain_m2)));
    } else {
      found.views.push_back(view(frontier, *ahead.sight, *seat));
    }
    return true;
  }
};

using Distant = std::pair<double, const Frontier*>;

/// The frontiers by a way that no way to a view of them is shorter than, in m.
std::vector<Distant> by_distance(const ExploreState& state, const ExploreOptions& options) {
  constexpr double least_ratio = 0.98;  // of the length of a flood's way and the straight one
  const double slack_m = options.view_m + snap_m + 4.0 * state.map.frame().resolution_m;
  std::vector<Distant> all;
  for (const auto& [id, frontier] : state.map.frontiers()) {
    // The previous choice is always compared, or the robot would oscillate between two distant frontiers.
    const double away_m =
        id == state.before.frontier ? 0.0 : frontier.bounds.distance_to(state.pose.position) - slack_m;
    all.emplace_back(least_ratio * std::max(0.0, away_m), &frontier);
  }
  std::sort(all.begin(), all.end(), [](const Distant& a, const Distant& b) {
    return std::pair(a.first, a.second->id) < std::pair(b.first, b.second->id);
  });
  return all;
}

/// Lets the flood from the robot go on until enough views are found, or it has reached all.
void search(const Finder& finder, Flood& flood, bool more, Views& found) {
  constexpr double stride_m = 2.0;
  const Grid<std::uint8_t>& blocks = finder.ground.blocks();
  const double cost_per_m = Flood::per_block / blocks.frame.resolution_m;
  const std::vector<Distant> frontiers = by_distance(finder.state, finder.options);
  const auto most = static_cast<std::size_t>(finder.options.most_views);
  auto next = frontiers.begin();
  std::vector<Ahead> ahead;
  bool enough = false;
  for (double way_m = stride_m; !enough; way_m += stride_m) {
    more = more && flood.advance(blocks, static_cast<std::uint32_t>(cost_per_m * way_m));
    for (; next != frontiers.end() && (!more || next->first <= way_m); ++next)
      finder.look_at(*next->second, ahead, found);
    std::erase_if(ahead, [&](const Ahead& each) { return finder.settle(each, more, found); });
    const bool waits = std::ranges::any_of(
        ahead, [&](const Ahead& each) { return each.frontier->id == finder.state.before.frontier; });
    enough = !more || (found.views.size() >= most && !waits);
  }
  found.all = !more && found.views.size() <= most;
}

}  // namespace

void prepare(FrontierMap& map, const ExploreOptions& options) {
  map.ground().grid();
  auto& sights = map.memory().get<SightMemory>();
  forget_gone(sights, map);
  for (const auto& [id, frontier] : map.frontiers()) sight_of(frontier, map, options.view_m, sights);
}

Views find_views(const ExploreState& state, const ExploreOptions& options, Workspace& workspace) {
  Views found;
  const TraversabilityGrid& ground = state.map.ground();
  RayFan& fan = workspace.get<GainMemory>().fan;
  const int range = static_cast<int>(state.range_m / ground.frame().resolution_m);
  if (fan.cells != range) fan = RayFan::of(range, gain_rays);
  auto& sights = state.map.memory().get<SightMemory>();
  forget_gone(sights, state.map);
  Flood& flood = workspace.get<RobotFlood>().flood;
  const auto start = free_block_near(ground, state.pose.position);
  if (start)
    flood.begin(ground.blocks(), *start,
                options.strategy == "nearest" ? Flood::Walls::are_shunned : Flood::Walls::do_not_matter);
  else
    flood.clear(ground.blocks());
  search({state, options, flood, fan, sights}, flood, start.has_value(), found);

  std::sort(found.views.begin(), found.views.end(), [&](const View& a, const View& b) {
    const auto key = [&](const View& v) {
      return std::tuple(v.frontier != state.before.frontier, v.reach_s, v.frontier);
    };
    return key(a) < key(b);
  });
  const auto most = static_cast<std::size_t>(options.most_views);
  if (found.views.size() > most) found.views.resize(most);
  std::ranges::sort(found.refused, {}, &RefusedFrontier::frontier);
  return found;
}

}  // namespace outrider
