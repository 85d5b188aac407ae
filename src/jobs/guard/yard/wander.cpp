#include "outrider/jobs/guard/yard/wander.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/sim/walks.hpp"

namespace outrider {
namespace {

constexpr double on_floor_m = 0.01;
constexpr double most_room_m = 0.1;  // half the width that an intruder needs to pass, at most
constexpr double least_room_m = 0.01;

/// Half the width of the way that all can walk, from the rooms around the places.
Outcome<double> room(const GuardProblem& problem, const FiringMap& firing_map) {
  double room_m = most_room_m;
  for (const Target& target : problem.targets) {
    if (std::abs(target.base.z - firing_map.rules.floor_z_m) > on_floor_m) {
      return bad_input(fmt::format("{} does not stand on the floor, so it cannot walk; leave it out or give "
                                   "z={:g}",
                                   target.name, firing_map.rules.floor_z_m),
                       "wander.speed");
    }
    const double clear_m = firing_map.ground.clearance(xy(target.base), most_room_m) - 1e-6;
    if (clear_m < least_room_m) {
      return bad_input(
          fmt::format("{} has no room to walk: an obstacle is {:.3f} m away, and 0.01 m are needed; "
                      "move it",
                      target.name, std::max(0.0, clear_m)),
          "wander.speed");
    }
    room_m = std::min(room_m, clear_m);
  }
  return room_m;
}

}  // namespace

std::vector<Option> describe(WanderOptions& options) {
  return {
      {"speed", "m/s", 0.0, 10.0, "of intruders that walk from place to place; 0: they sit still",
       &options.speed_mps},
      {"rest", "s", 0.1, 1e5, "time they stay at a place, on average", &options.rest_s},
      {"prefers", "", 0, 0, "place=weight with blanks between: how often they go there; the others: 1",
       &options.prefers},
      file_option("history", "file of earlier positions to learn from: lines t,id,x,y in s and m",
                  &options.history),
      {"learn", "", 0, 0, "learn where they like to be, from the history and from what is seen",
       &options.learn},
      {"chance", "", 0.0, 1.0, "least probability of a hit with which a shot is taken", &options.chance},
      {"look", "s", 0.05, 10.0, "time between two looks at where they are", &options.look_s},
      {"sight", "m", 0.0, 1.0, "largest error of a position seen", &options.sight_m},
      {"patience", "s", 1.0, 1e4, "without a hit, before the mission is given up", &options.patience_s},
  };
}

Outcome<std::vector<Walk>> draw_walks(const GuardProblem& problem, const FiringMap& firing_map,
                                      const std::vector<double>& weights, const WanderOptions& options,
                                      std::uint64_t seed, double until_s, const Budget& budget) {
  auto room_m = room(problem, firing_map);
  if (!room_m) return pass_on(room_m);
  std::vector<Vec2> places;
  for (const Target& target : problem.targets) places.push_back(xy(target.base));
  RobotModel walker = problem.robot;
  walker.radius_m = *room_m;
  auto routes = routes_between(firing_map.ground, walker, places, {}, {}, budget);
  if (!routes) return pass_on(routes);
  return draw_walks({std::move(places), weights, options.speed_mps, options.rest_s}, *routes, seed, until_s,
                    budget.stop);
}

}  // namespace outrider
