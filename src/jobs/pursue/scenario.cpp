#include "outrider/jobs/pursue/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/io/files/text.hpp"
#include "outrider/io/map/pursuit_map.hpp"
#include "outrider/pursuit/catalog.hpp"

namespace outrider {
namespace {

Status check_names(const PursuitScenario& scenario) {
  if (scenario.map.empty()) return bad_input("missing; give the file of the map and the target", "map");
  if (scenario.clock != "virtual" && scenario.clock != "wall") {
    return bad_input(fmt::format("'{}' is no clock; expected virtual or wall", excerpt(scenario.clock)),
                     "clock");
  }
  if (scenario.faults.of_sightings() && scenario.known < 0) {
    return bad_input(
        "the whole future is known, so no sighting can be missing, late or wrong; give known: 0, or leave "
        "these faults out",
        "faults");
  }
  return {};
}

/// Refuses what does not go together with the robot that is simulated.
Status check_sim(const PursuitScenario& scenario) {
  const NavigationOptions& navigation = scenario.pursuer.navigation;
  if (scenario.sim != "navigator") {
    const char* asked = navigation.faults.any() ? "robot_faults" : nullptr;
    if (!scenario.pursuer.things.empty()) asked = "things";
    if (asked == nullptr) return {};
    return bad_input("robots that step from cell to cell meet nothing; give sim: navigator, or leave it out",
                     asked);
  }
  if (scenario.pursuers > 1)
    return bad_input("one robot is driven by a navigator; give one pursuer, or sim: ideal", "pursuers");
  if (scenario.faults.any())
    return bad_input("these are faults of steps from cell to cell; give those of robot_faults, or sim: ideal",
                     "faults");
  return check(navigation.laser);
}

/// The cells of the robots after the first.
Outcome<std::vector<Cell>> other_starts(const PursuitScenario& scenario, const PursuitProblem& problem) {
  const GridFrame& frame = problem.costs->frame;
  std::vector<Cell> cells;
  for (const std::string_view word : words(scenario.starts)) {
    const std::size_t comma = word.find(',');
    const auto x = number<int>(word.substr(0, comma));
    const auto y = comma == word.npos ? std::nullopt : number<int>(word.substr(comma + 1));
    if (!x || !y || !frame.contains({*x - 1, *y - 1})) {
      return bad_input(fmt::format("'{}' is no cell of the map; expected x,y from 1,1 to {},{}, with blanks "
                                   "between robots",
                                   excerpt(word), frame.width, frame.height),
                       "starts");
    }
    cells.push_back({*x - 1, *y - 1});
  }
  if (cells.size() + 1 == static_cast<std::size_t>(scenario.pursuers)) return cells;
  return bad_input(fmt::format("{} cells for {} pursuers; the first starts where the map says, so give {}",
                               cells.size(), scenario.pursuers, scenario.pursuers - 1),
                   "starts");
}

Outcome<std::vector<Cell>> robots_of(const PursuitScenario& scenario, const PursuitProblem& problem) {
  if (scenario.starts.empty()) return place_team(problem, static_cast<std::size_t>(scenario.pursuers));
  auto others = other_starts(scenario, problem);
  if (!others) return others;
  others->insert(others->begin(), problem.start);
  return others;
}

/// Nothing for the planners that the anytime search stands for.
PursuitAsk asked_by(const PursuitScenario& scenario) {
  if (scenario.planner == "optimal" || scenario.planner == "anytime") return {};
  std::size_t row = 0;
  while (pursuit_planners()[row].name != scenario.planner) ++row;
  return [configured = scenario.planners[row]](const PursuitProblem& problem, const Budget& budget) {
    Workspace workspace;
    return configured.plan(problem, budget, workspace);
  };
}

}  // namespace

std::vector<ConfiguredPursuitPlanner> PursuitScenario::configured_planners() {
  std::vector<ConfiguredPursuitPlanner> configured;
  for (const PursuitPlanner& planner : pursuit_planners()) configured.push_back(planner.configure());
  return configured;
}

std::vector<OptionGroup> describe(PursuitScenario& scenario) {
  std::vector<OptionGroup> groups = {
      {"",
       "the pursuit",
       {file_option("map", "file of the costs, the robot and the target", &scenario.map),
        choice_option("clock", "virtual (planning is free) or wall (it costs the seconds it takes)",
                      &scenario.clock, {"virtual", "wall"}),
        choice_option("planner", "a pursuit planner of 'outrider list'", &scenario.planner,
                      names_of(pursuit_planners())),
        {"known", "s", -1, 1e7, "seconds of the target's future that are known; -1: all", &scenario.known},
        {"forecast", "", 0, 0, "of the rest: last_velocity, visit_map, evade or stay", &scenario.forecast},
        {"pursuers", "", 1, 100, "robots that pursue the target", &scenario.pursuers},
        {"starts", "", 0, 0, "x,y of each robot but the first, with blanks between; empty: spread out",
         &scenario.starts},
        {"call", "s", 0.01, 1.9, "of a planning call on the wall clock", &scenario.call_s},
        {"seed", "", 0, 1e15, "seed of what faults and sensors draw; nothing else is random", &scenario.seed},
        choice_option("sim",
                      "ideal: steps from cell to cell; navigator: a robot on wheels drives there, around "
                      "what is in its way",
                      &scenario.sim, {"ideal", "navigator"}),
        {"cell", "m", 0.05, 1000, "side of a cell, for sim: navigator", &scenario.pursuer.cell_m},
        {"things", "", 0, 0,
         "on no map: boxes x,y,length,width and posts x,y,radius in m, with blanks between; for sim: "
         "navigator",
         &scenario.pursuer.things}}}};
  for (std::size_t i = 0; i < scenario.planners.size(); ++i) {
    const std::string name(pursuit_planners()[i].name);
    if (!scenario.planners[i].options.empty()) {
      groups.push_back({name, "planner " + name, scenario.planners[i].options});
    }
  }
  groups.push_back({"faults", "what goes wrong without the robots being told", describe(scenario.faults)});
  groups.push_back({"robot", "the robot on wheels", describe(scenario.pursuer.robot)});
  std::vector<Option> of_robot = describe(scenario.pursuer.navigation.faults);
  std::erase_if(of_robot, [](const Option& option) { return option.name.starts_with("clock"); });
  groups.push_back({"robot_faults", "what goes wrong with it without its being told", std::move(of_robot)});
  for (OptionGroup& group : describe(scenario.pursuer.navigation)) groups.push_back(std::move(group));
  return groups;
}

Outcome<PursuitRules> rules_of(const PursuitScenario& scenario) {
  if (auto known = find_pursuit_planner(scenario.planner); !known) return pass_on(known);
  auto forecast = find_target_forecast(scenario.forecast);
  if (!forecast) return pass_on(forecast);
  PursuitRules rules;
  if (scenario.clock == "wall") rules.clock = PursuitClock::wall;
  if (scenario.known >= 0) rules.known_s = static_cast<int>(scenario.known);
  rules.forecast = std::move(*forecast);
  rules.ask = asked_by(scenario);
  rules.call_s = scenario.call_s;
  return rules;
}

Outcome<PursuitTask> load_task(const PursuitScenario& scenario) {
  if (auto ok = check_names(scenario); !ok) return pass_on(ok);
  if (auto ok = check_sim(scenario); !ok) return pass_on(ok);
  auto rules = rules_of(scenario);
  if (!rules) return pass_on(rules);
  auto problem = load_pursuit_map(scenario.map);
  if (!problem) return pass_on(problem);
  auto robots = robots_of(scenario, *problem);
  if (!robots) return pass_on(robots);
  if (scenario.sim == "navigator") {
    CostGrid in_metres = *problem->costs;
    in_metres.frame.resolution_m = scenario.pursuer.cell_m;
    problem->costs = std::make_shared<const CostGrid>(std::move(in_metres));
  }
  return PursuitTask{std::move(*problem), std::move(*robots), std::move(*rules)};
}

}  // namespace outrider
