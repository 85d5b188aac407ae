#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "commands.hpp"
#include "flags.hpp"
#include "map_file.hpp"
#include "output.hpp"
#include "outrider/core/units.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/guard_scenario.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "path_picture.hpp"
#include "polygon_plan.hpp"
#include "progress.hpp"

namespace outrider::cli {
namespace {

/// A row of the catalogue, with the options that the flags set.
struct Candidate {
  PathPlanner planner;
  ConfiguredPlanner configured;
};

struct PlanCommand {
  std::string map;
  std::string from;
  std::string to;
  std::string query;
  std::string planner = "theta_star";
  bool compare = false;
  std::string model = "cells";
  RobotModel robot;
  GridOptions grid;
  bool json = false;
  std::string svg;
  std::string out;
  std::vector<Candidate> catalogue;
};

struct Row {
  PathPlanner planner;
  Outcome<Plan> plan;
  double time_s = 0.0;
};

std::vector<OptionGroup> describe(PlanCommand& command) {
  OptionGroup question{
      "",
      "what is asked",
      {{"from", "", 0, 0, "x,y of the start, m (MovingAI: cells, y from the bottom)", &command.from},
       {"to", "", 0, 0, "x,y of the goal, m", &command.to},
       {"query", "", 0, 0, "instead, a query of a polygon environment: all, or a number from 1",
        &command.query},
       {"radius", "m", 0, 100, "radius of the robot; MovingAI 0 and polygons 0.18 unless given",
        &command.robot.radius_m},
       {"height", "m", 0, 100, "height of the robot, for SDF worlds", &command.robot.height_m}}};
  OptionGroup answer{
      "",
      "how it is answered",
      {{"planner", "", 0, 0, "name from 'outrider list'", &command.planner},
       {"compare", "", 0, 0, "ask every planner that takes the model", &command.compare},
       {"model", "", 0, 0, "vertices of the paths: cells (their centres) or corners", &command.model}}};
  for (Option& option : describe(command.grid)) answer.options.push_back(std::move(option));
  std::vector<OptionGroup> groups{
      {"",
       "output",
       {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
        {"svg", "", 0, 0, "file to write, a picture of the map and the paths", &command.svg},
        {"out", "", 0, 0, "folder for plan.json and pictures, for polygon environments", &command.out}}},
      std::move(question),
      std::move(answer)};
  for (const Candidate& candidate : command.catalogue) {
    if (candidate.configured.options.empty()) continue;
    const std::string name(candidate.planner.name);
    groups.push_back({name, "planner " + name, candidate.configured.options});
  }
  return groups;
}

Outcome<GridModel> model_of(const PlanCommand& command) {
  for (const GridModel model : {GridModel::cells, GridModel::corners}) {
    if (to_string(model) == command.model) return model;
  }
  return bad_input(fmt::format("'{}' is no good; it takes cells or corners", command.model), "--model");
}

/// The planner that is named, or all that take such a grid.
Outcome<std::vector<Candidate>> chosen(const PlanCommand& command, GridModel model) {
  std::vector<Candidate> candidates = command.catalogue;
  if (command.compare) {
    std::erase_if(candidates, [&](const Candidate& candidate) { return !candidate.planner.takes(model); });
    return candidates;
  }
  auto named = find_path_planner(command.planner);
  if (!named) {
    named.error().where = "--planner";
    return pass_on(named);
  }
  if (!named->takes(model)) {
    return bad_input(fmt::format("{} takes no grid of {}; 'outrider list' says what each planner takes",
                                 named->name, to_string(model)),
                     "--planner");
  }
  std::erase_if(candidates,
                [&](const Candidate& candidate) { return candidate.planner.name != named->name; });
  return candidates;
}

Outcome<Vec2> point(const std::string& text, const std::string& flag) {
  auto numbers = parse_numbers(text, 2, flag, "x,y in m, such as 1.5,-2");
  if (!numbers) return pass_on(numbers);
  return Vec2{(*numbers)[0], (*numbers)[1]};
}

/// Refuses a start and a goal where no path can begin or end, under the name of the flag.
Outcome<Problem> problem_on(const PlanCommand& command, const MapFile& map, GridModel model) {
  auto from = point(command.from, "--from");
  if (!from) return pass_on(from);
  auto to = point(command.to, "--to");
  if (!to) return pass_on(to);
  auto ground = GridGround::of(map.blocked, model);
  if (!ground) return pass_on(ground);
  Problem problem{std::make_shared<const GridGround>(std::move(*ground)), map.to_grid(*from),
                  map.to_grid(*to)};
  if (auto query = grid_query(problem); !query) {
    const std::optional<Cell> start = problem.grid->vertex_at(problem.start);
    const bool bad_start = !start || !problem.grid->place(*start);
    Fault fault = query.error();
    fault.where = bad_start ? "--from " + command.from : "--to " + command.to;
    if (map.yaw_rad != 0.0)
      fault.where += fmt::format(" in the map turned by {:.4g} degrees", degrees(map.yaw_rad));
    return tl::unexpected(std::move(fault));
  }
  return problem;
}

/// Plans, and has every plan judged by the grid's own rules and by the exact shapes where there are any.
Row solve(const Candidate& candidate, const Problem& problem, const MapFile& map) {
  Workspace workspace;
  const auto begin = std::chrono::steady_clock::now();
  auto plan = candidate.configured.plan(problem, {}, workspace);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  if (plan) {
    auto verdict = check(*plan, problem);
    if (verdict && map.ground) verdict = check(*plan, *map.ground, map.radius_m);
    if (!verdict)
      throw std::logic_error(fmt::format("{}: {}", candidate.planner.name, to_string(verdict.error())));
  }
  return {candidate.planner, std::move(plan), time.count()};
}

nlohmann::ordered_json row_json(const Row& row, const MapFile& map) {
  nlohmann::ordered_json object;
  if (!row.plan) {
    object = fault_json(row.plan.error());
    object["planner"] = row.planner.name;
    return object;
  }
  auto waypoints = nlohmann::ordered_json::array();
  for (const Vec2 p : row.plan->waypoints) {
    const Vec2 world = map.to_world(p);
    waypoints.push_back({world.x, world.y});
  }
  return {{"status", "done"},
          {"planner", row.planner.name},
          {"metrics",
           {{"cost_m", row.plan->cost},
            {"lower_bound_m", row.plan->lower_bound},
            {"reached_within_m", row.plan->reached_within},
            {"planning_s", row.time_s},
            {"expansions", row.plan->counters.expansions},
            {"line_of_sight_checks", row.plan->counters.line_of_sight_checks}}},
          {"waypoints", std::move(waypoints)}};
}

void print_json(const PlanCommand& command, const MapFile& map, const std::vector<Row>& rows, bool all) {
  nlohmann::ordered_json object = {
      {"status", all ? "done" : "not_done"}, {"job", "plan"}, {"radius_m", map.radius_m}};
  if (command.compare) {
    object["plans"] = nlohmann::ordered_json::array();
    for (const Row& row : rows) object["plans"].push_back(row_json(row, map));
  } else {
    object.update(row_json(rows.front(), map));
  }
  object["warnings"] = map.warnings;
  print(object);
}

void print_table(const std::vector<Row>& rows) {
  fmt::print("  {:<18} {:>11} {:>11} {:>5} {:>11} {:>10}\n", "planner", "length m", "bound m", "legs",
             "expansions", "ms");
  for (const Row& row : rows) {
    if (!row.plan) {
      fmt::print("  {:<18} {}\n", row.planner.name, row.plan.error().sentence);
      continue;
    }
    fmt::print("  {:<18} {:>11.3f} {:>11.3f} {:>5} {:>11} {:>10.2f}\n", row.planner.name, row.plan->cost,
               row.plan->lower_bound, row.plan->waypoints.empty() ? 0 : row.plan->waypoints.size() - 1,
               row.plan->counters.expansions, 1e3 * row.time_s);
  }
}

Status draw(const PlanCommand& command, const MapFile& map, const Problem& problem,
            const std::vector<Row>& rows) {
  PathPicture picture{map.occupied, map.blocked, {}, problem.start, problem.goal, {}};
  if (map.ground) picture.obstacles = map.ground->obstacles();
  for (const Row& row : rows) {
    if (row.plan) picture.paths.push_back({std::string(row.planner.name), *row.plan});
  }
  return write_file(command.svg, to_svg(picture));
}

struct Answer {
  MapFile map;
  Problem problem;
  std::vector<Row> rows;
};

Outcome<Answer> answer(PlanCommand& command, const CLI::App& flags) {
  auto model = model_of(command);
  if (!model) return pass_on(model);
  auto candidates = chosen(command, *model);
  if (!candidates) return pass_on(candidates);
  Progress progress(1 + static_cast<int>(candidates->size()));
  progress.next("reading the map");
  const bool radius_given = flags.get_option("--radius")->count() > 0;
  auto map = load_map(command.map, radius_given ? std::optional(command.robot.radius_m) : std::nullopt,
                      command.robot, command.grid);
  if (!map) return pass_on(map);
  auto problem = problem_on(command, *map, *model);
  if (!problem) return pass_on(problem);
  std::vector<Row> rows;
  for (const Candidate& candidate : *candidates) {
    progress.next(std::string(candidate.planner.name));
    rows.push_back(solve(candidate, *problem, *map));
  }
  return Answer{std::move(*map), std::move(*problem), std::move(rows)};
}

int execute_on_polygons(const PlanCommand& command, const CLI::App& flags, GridModel model) {
  const auto given = [&](const char* flag) { return flags.get_option(flag)->count() > 0; };
  PolygonPlan request;
  request.map = command.map;
  request.from = command.from;
  request.to = command.to;
  request.query = command.query;
  request.out = command.out;
  request.svg = command.svg;
  if (given("--planner")) request.planner = command.planner;
  if (given("--model")) request.model = model;
  if (given("--radius")) request.radius_m = command.robot.radius_m;
  if (given("--resolution")) request.resolution_m = command.grid.resolution_m;
  request.compare = command.compare;
  request.json = command.json;
  for (const Candidate& candidate : command.catalogue) {
    request.planners.emplace_back(candidate.planner, candidate.configured);
  }
  return plan_on_polygons(request);
}

/// What only a polygon environment takes, and what only it may leave out.
Status check_grid_flags(const CLI::App& flags) {
  for (const char* flag : {"--query", "--out"}) {
    if (flags.get_option(flag)->count() > 0)
      return bad_input("it works with a polygon environment (.txt) only; leave it out", flag);
  }
  for (const char* flag : {"--from", "--to"}) {
    if (flags.get_option(flag)->count() == 0)
      return bad_input("it is missing; give x,y in m, such as 1.5,-2", flag);
  }
  return {};
}

int execute(PlanCommand& command, const CLI::App& flags) {
  const bool json = flags.get_option("--json")->count() > 0;
  if (auto ok = apply_flags(flags, describe(command)); !ok) return say(ok.error(), json);
  if (is_polygon_map(command.map)) {
    const auto model = model_of(command);
    return model ? execute_on_polygons(command, flags, *model) : say(model.error(), json);
  }
  if (auto ok = check_grid_flags(flags); !ok) return say(ok.error(), json);
  const auto found = answer(command, flags);
  if (!found) return say(found.error(), command.json);
  const auto& [map, problem, rows] = *found;
  for (const std::string& warning : map.warnings) fmt::print(stderr, "outrider: warning: {}\n", warning);

  const bool draws = flags.get_option("--svg")->count() > 0;
  if (draws) {
    if (auto ok = draw(command, map, problem, rows); !ok) return say(ok.error(), command.json);
  }
  const bool all = std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.plan.has_value(); });
  if (command.json) {
    print_json(command, map, rows, all);
  } else if (all || command.compare) {
    print_table(rows);
    if (draws) fmt::print("\n  picture  {}\n", command.svg);
  }
  const auto failed = std::find_if(rows.begin(), rows.end(), [](const Row& row) { return !row.plan; });
  return failed == rows.end() ? job_done : say(failed->plan.error(), false);
}

}  // namespace

void add_plan(CLI::App& app, int& status) {
  CLI::App* plan = app.add_subcommand("plan", "find a collision-free path for a disk robot");
  auto command = std::make_shared<PlanCommand>();
  for (const PathPlanner& planner : path_planners())
    command->catalogue.push_back({planner, planner.configure()});
  plan->add_option("map", command->map,
                   "map_server .yaml, SDF .sdf or .world, MovingAI .map, polygons .txt; .gz may follow")
      ->required()
      ->type_name("FILE");
  add_flags(*plan, describe(*command));
  plan->callback([command, plan, &status] { status = execute(*command, *plan); });
  plan->footer(
      "\nExample: outrider plan scenarios/yard/yard.sdf --from 0,-6 --to 4,4 --compare --svg paths.svg");
}

}  // namespace outrider::cli
