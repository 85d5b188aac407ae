#include "outrider/jobs/guard/capabilities.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/scenario.hpp"

namespace outrider {
namespace {

constexpr std::string_view still_bodies =
    "the physics engine holds targets that stand still and leave when hit";
constexpr std::string_view who_is_inside = "what stands in the way would change with who is inside";
constexpr std::string_view shared_once = "the targets are shared out once, before anybody drives";
constexpr std::string_view untold = "no topic tells where intruders are";
constexpr std::string_view of_one_robot = "it is made for one robot";
constexpr std::string_view unseen = "while the yard is explored nobody may come, move or be missed";

bool has_other_faults(const GuardScenario& scenario) {
  GuardSimParams faults = scenario.faults;
  faults.way = {};
  faults.planner = {};
  return faults.any();
}

}  // namespace

const std::vector<CapabilityRow>& capabilities() {
  using enum Capability;
  using Scenario = const GuardScenario&;
  static const std::vector<CapabilityRow> rows = {
      {own_robot, "a robot that is not simulated", ""},
      {topics, "a robot behind topics", ""},
      {arrivals, "intruders that keep coming", "arrivals", [](Scenario s) { return s.arrivals.any(); }},
      {survivors, "intruders that may survive a hit", "arrivals.leave",
       [](Scenario s) { return s.arrivals.may_survive(); }},
      {walkers, "intruders that walk about", "wander.speed", [](Scenario s) { return s.wander.any(); }},
      {supplies, "limited supplies", "supplies", [](Scenario s) { return s.problem.supplies.any(); }},
      {terrain, "terrain", "terrain", [](Scenario s) { return s.problem.world.terrain != nullptr; }},
      {air, "air", "air.drag", [](Scenario s) { return !s.problem.air.none(); }},
      {unknown, "an unknown yard", "scout.unknown", [](Scenario s) { return s.scout.unknown; }},
      {rigid, "rigid bodies", "sim", [](Scenario s) { return s.sim == "physics"; }},
      {navigated, "a robot that its navigator drives", "sim",
       [](Scenario s) { return s.sim == "navigator"; }},
      {blocking, "targets that block", "targets_block", [](Scenario s) { return s.problem.targets_block; }},
      {faults, "faults of the robot", "faults", has_other_faults},
      {held_up, "a robot that is held up (kidnapped_at, stuck_from, blocked_at, planner_fails_from)",
       "faults.kidnapped_at", [](Scenario s) { return s.faults.way.any() || s.faults.planner.any(); }},
      {team, "several robots", "robots", [](Scenario s) { return s.robots > 1; }},
      {planner, "a planner other than best_tour", "plan.planner",
       [](Scenario s) { return s.options.planner != guard_planners().front().name; }},
      {proof, "a proof that the tour is the best", "plan.prove", [](Scenario s) { return s.options.prove; }},
  };
  return rows;
}

const std::vector<Clash>& clashes() {
  using enum Capability;
  static const std::vector<Clash> table = {
      {own_robot, unknown, "the yard has to be explored first"},
      {own_robot, team, "a mission is that of one robot"},
      {topics, arrivals, untold},
      {topics, survivors, untold},
      {topics, walkers, untold},
      {topics, supplies, "no topic tells how full tank and battery are"},
      {topics, terrain, "it drives on flat ground"},
      {arrivals, walkers, "who enters goes to one place and stays there"},
      {arrivals, unknown, unseen},
      {arrivals, rigid, still_bodies},
      {arrivals, blocking, who_is_inside},
      {arrivals, team, shared_once},
      {survivors, walkers, "who walks about leaves when hit"},
      {survivors, unknown, unseen},
      {survivors, rigid, still_bodies},
      {survivors, blocking, who_is_inside},
      {survivors, team, shared_once},
      {walkers, supplies, "the stops against walkers are chosen without stations"},
      {walkers, terrain, "walks and the shots that lead them are for level ground"},
      {walkers, unknown, unseen},
      {walkers, rigid, still_bodies},
      {walkers, blocking, who_is_inside},
      {walkers, team, shared_once},
      {supplies, rigid, "the rigid robot has no tank and no battery"},
      {supplies, team, "nobody keeps the robots apart at the stations"},
      {terrain, air, "drag is modelled on level ground only"},
      {terrain, unknown, "the map of a range finder is level"},
      {terrain, rigid, "the rigid robot rolls on a level floor"},
      {terrain, team, "the times at which robots keep apart are for level ground"},
      {air, rigid, "the physics engine knows no drag"},
      {rigid, faults, "faults are simulated in the kinematic robot only"},
      {terrain, held_up, "the places where it is held up are for level ground"},
      {rigid, held_up, "faults are simulated in the kinematic robot only"},
      {held_up, team, "nobody tells the others who is held up"},
      {rigid, team, "the physics engine holds one robot"},
      {rigid, navigated, "a robot is driven in one way"},
      {terrain, navigated, "its range finder and its wheels are for a level floor"},
      {navigated, team, "the times at which robots keep apart are those of planned drives"},
      {unknown, rigid, "the rigid robot has no range finder"},
      {unknown, blocking, "targets that block would be walls on the map"},
      {unknown, team, "one robot explores the yard"},
      {team, planner, of_one_robot},
      {team, proof, of_one_robot},
  };
  return table;
}

std::vector<Capability> requested_capabilities(const GuardScenario& scenario) {
  std::vector<Capability> requested;
  for (const CapabilityRow& row : capabilities()) {
    if (row.asked != nullptr && row.asked(scenario)) requested.push_back(row.capability);
  }
  return requested;
}

Status check_capabilities(const std::vector<Capability>& asked) {
  for (const Clash& clash : clashes()) {
    if (std::ranges::count(asked, clash.one) == 0 || std::ranges::count(asked, clash.other) == 0) continue;
    const CapabilityRow& one = capabilities()[static_cast<std::size_t>(clash.one)];
    const CapabilityRow& other = capabilities()[static_cast<std::size_t>(clash.other)];
    const std::string left_out = one.key.empty() ? "" : fmt::format("{} or ", one.key);
    return bad_input(fmt::format("{} and {} do not go together, because {}; leave out {}{}", one.noun,
                                 other.noun, clash.why, left_out, other.key),
                     std::string(other.key));
  }
  return {};
}

}  // namespace outrider
