// The first leg of the fastest round through the nearest views and home. The way home counts from the
// beginning: what lies on it is left for later, and what does not is finished before the robot goes on.
#include <algorithm>
#include <limits>
#include <map>

#include "choose/round_trip.hpp"
#include "choose/strategies.hpp"
#include "map/reach.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_stops = 12;
constexpr double unreached_s = 1e6;
/// The first leg is driven as planned; the rest changes with what is seen on it, so it weighs less.
constexpr double first_leg_weight = 1.5;

/// The travel times from one stop to the others, s, by their frontiers.
struct TravelTimes {
  std::uint64_t made = 0;  ///< value of TourMemory::made when these were computed; 0: never
  std::map<std::uint32_t, double> seconds;
};

/// Travel times that are kept between calls, for one map. The key is the frontier of the stop; home has the
/// key 0.
struct TourMemory {
  std::uint64_t made = 0;  ///< how many entries were computed so far
  std::map<std::uint32_t, TravelTimes> from;
};

struct Stop {
  std::uint32_t frontier = 0;
  std::uint32_t block = 0;
};

TravelTimes travel_times_from(std::uint32_t block, const Views& views, std::size_t count,
                              const ExploreState& state, Flood& flood) {
  const Grid<std::uint8_t>& blocks = state.map.ground().blocks();
  const double per_cost_s = blocks.frame.resolution_m / Flood::per_block / state.robot.speed_mps;
  std::vector<std::uint32_t> goals;
  for (std::size_t i = 0; i < count; ++i) goals.push_back(views.views[i].block);
  flood.run(blocks, block, Flood::Walls::do_not_matter, goals);
  TravelTimes times;
  for (std::size_t i = 0; i < count; ++i) {
    double& least = times.seconds[views.views[i].frontier] = unreached_s;
    for (const std::uint32_t seat : views.views[i].seats) {
      if (flood.cost(seat) != Flood::far) least = std::min(least, per_cost_s * flood.cost(seat));
    }
  }
  return times;
}

/// Computes entries again, those that are missing first and then the oldest, until a bounded effort is spent.
void renew(std::vector<Stop> stops, const Views& views, std::size_t count, const ExploreState& state,
           TourMemory& memory, Flood& flood) {
  constexpr std::size_t most_blocks = 100'000;
  std::erase_if(memory.from, [&](const auto& row) {
    return row.first != 0 && !state.map.frontiers().contains(row.first);
  });
  std::stable_sort(stops.begin(), stops.end(), [&](const Stop& a, const Stop& b) {
    return memory.from[a.frontier].made < memory.from[b.frontier].made;
  });
  std::size_t reached = 0;
  for (const Stop& stop : stops) {
    TravelTimes& times = memory.from[stop.frontier] =
        travel_times_from(stop.block, views, count, state, flood);
    times.made = ++memory.made;
    reached += flood.reached();
    if (reached > most_blocks) return;
  }
}

/// The views that make the round, by their indices: a view from which another frontier is seen as well as
/// from its own one counts for both.
std::vector<std::size_t> stops_of(const Views& views) {
  std::vector<std::size_t> stops;
  for (std::size_t i = 0; i < views.views.size() && stops.size() < most_stops; ++i) {
    const std::vector<std::uint32_t>& seats = views.views[i].seats;
    const bool seen = std::ranges::any_of(
        stops, [&](std::size_t stop) { return std::ranges::binary_search(seats, views.views[stop].block); });
    if (!seen) stops.push_back(i);
  }
  return stops;
}

/// Seconds, the first leg weighted and with its turn. A way that is not known yet is that past the robot.
RoundTrip round_through(const Views& views, const ExploreState& state, Workspace& workspace) {
  RoundTrip round;
  round.count = views.views.size();
  std::vector<Stop> stops;
  for (const View& view : views.views) {
    stops.push_back({view.frontier, view.block});
    round.out.push_back(first_leg_weight * (view.turn_s + view.reach_s));
  }
  const auto home = free_block_near(state.map.ground(), state.home.position);
  if (home) stops.push_back({0, *home});
  auto& memory = state.map.memory().get<TourMemory>();
  renew(stops, views, round.count, state, memory, workspace.get<OtherFlood>().flood);

  const auto way = [&](std::uint32_t from, const View& to, double else_s) {
    const std::map<std::uint32_t, double>& seconds = memory.from[from].seconds;
    const auto known = seconds.find(to.frontier);
    return known == seconds.end() ? else_s : known->second;
  };
  for (const View& from : views.views) {
    for (const View& to : views.views)
      round.between.push_back(way(from.frontier, to, from.reach_s + to.reach_s));
    round.home.push_back(home ? way(0, from, from.reach_s) : 0.0);
  }
  return round;
}

}  // namespace

std::vector<double> round_values(const Views& views, const ExploreState& state, const ExploreOptions& options,
                                 Workspace& workspace) {
  const std::vector<std::size_t> chosen = stops_of(views);
  Views stops;
  for (const std::size_t i : chosen) stops.views.push_back(views.views[i]);
  std::vector<double> whole_s = wholes(round_through(stops, state, workspace));
  if (const auto before = chosen_before(stops, state.before))
    whole_s[*before] -= bonus_of_before(state, options);
  std::vector<double> values(views.views.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < chosen.size(); ++i) values[chosen[i]] = whole_s[i];
  return values;
}

}  // namespace outrider
