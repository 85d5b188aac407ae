// The first leg of the fastest round through the nearest views.
#include <algorithm>

#include "reach.hpp"
#include "round_trip.hpp"
#include "strategies.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_stops = 12;
constexpr double unreached_s = 1e6;

/// Seconds; the first leg with its turn. The round ends at home if that is all there is left to see, or
/// anywhere.
RoundTrip round_through(const Views& views, const ExploreState& state, Workspace& workspace) {
  const Grid<std::uint8_t>& blocks = state.map.ground().blocks();
  const double per_cost_s = blocks.frame.resolution_m / Flood::per_block / state.robot.speed_mps;
  RoundTrip round;
  round.count = std::min(views.views.size(), most_stops);
  Flood& flood = workspace.get<OtherFlood>().flood;
  std::vector<std::uint32_t> goals;
  for (std::size_t i = 0; i < round.count; ++i) {
    goals.push_back(views.views[i].block);
    round.out.push_back(views.views[i].turn_s + views.views[i].reach_s);
  }
  const auto seconds = [&](std::uint32_t block) {
    return flood.cost(block) == Flood::far ? unreached_s : per_cost_s * flood.cost(block);
  };
  for (std::size_t i = 0; i < round.count; ++i) {
    flood.run(blocks, views.views[i].block, Flood::Walls::do_not_matter, goals);
    for (std::size_t j = 0; j < round.count; ++j) {
      double least = unreached_s;
      for (const std::uint32_t seat : views.views[j].seats) least = std::min(least, seconds(seat));
      round.between.push_back(least);
    }
  }
  round.home.assign(round.count, 0.0);
  const auto home = free_block_near(state.map.ground(), state.home.position);
  if (!home || !views.all || round.count < views.views.size()) return round;  // the round ends elsewhere
  flood.run(blocks, *home, Flood::Walls::do_not_matter, goals);
  for (std::size_t i = 0; i < round.count; ++i) round.home[i] = seconds(views.views[i].block);
  return round;
}

}  // namespace

std::size_t choose_by_tour(const Views& views, const ExploreState& state, const ExploreOptions& options,
                           Workspace& workspace) {
  std::vector<double> whole_s = wholes(round_through(views, state, workspace));
  const auto before = chosen_before(views, state.before);
  if (before && *before < whole_s.size()) whole_s[*before] -= bonus_of_before(state, options);
  return static_cast<std::size_t>(std::min_element(whole_s.begin(), whole_s.end()) - whole_s.begin());
}

}  // namespace outrider
