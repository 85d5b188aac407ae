#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "map_file.hpp"
#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/guard_scenario.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "path_picture.hpp"

namespace outrider::cli {
namespace {

struct PlanCommand {
  std::string map;
  std::string from;
  std::string to;
  std::string planner = "theta_star";
  std::string model = "cells";
  std::string svg;
  bool compare = false;
  double radius_m = -1.0;
  double height_m = 0.2;
  GridOptions grid;
  Output output;
};

struct Row {
  PathPlanner planner;
  Outcome<Plan> plan;
  double time_s = 0.0;
};

Outcome<Vec2> point(const std::string& text, const std::string& flag) {
  auto numbers = parse_numbers(text, 2, flag, "x,y in m, such as 1.5,-2");
  if (!numbers) return pass_on(numbers);
  return Vec2{(*numbers)[0], (*numbers)[1]};
}

Outcome<std::vector<PathPlanner>> chosen(const PlanCommand& command) {
  if (command.compare) return path_planners();
  auto planner = find_path_planner(command.planner);
  if (!planner) return pass_on(planner);
  return std::vector<PathPlanner>{*planner};
}

/// Plans, and has every plan judged by the grid's own rules and by the exact shapes where there are any.
Row solve(const PathPlanner& planner, const Problem& problem, const MapFile& map) {
  Workspace workspace;
  const ConfiguredPlanner configured = planner.configure();
  const auto begin = std::chrono::steady_clock::now();
  auto plan = configured.plan(problem, {}, workspace);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  if (plan) {
    auto verdict = check(*plan, problem);
    if (verdict && map.ground) verdict = check(*plan, *map.ground, map.radius_m);
    if (!verdict) throw std::logic_error(fmt::format("{}: {}", planner.name, to_string(verdict.error())));
  }
  return {planner, std::move(plan), time.count()};
}

nlohmann::ordered_json row_json(const Row& row, const MapFile& map) {
  if (!row.plan) {
    return {{"planner", row.planner.name}, {"status", "not_done"}, {"reason", row.plan.error().sentence}};
  }
  auto waypoints = nlohmann::ordered_json::array();
  for (const Vec2 p : row.plan->waypoints) {
    const Vec2 world = map.to_world(p);
    waypoints.push_back({world.x, world.y});
  }
  return {{"planner", row.planner.name},
          {"status", "done"},
          {"metrics",
           {{"cost_m", row.plan->cost},
            {"lower_bound_m", row.plan->lower_bound},
            {"planning_s", row.time_s},
            {"expansions", row.plan->counters.expansions},
            {"line_of_sight_checks", row.plan->counters.line_of_sight_checks}}},
          {"waypoints", std::move(waypoints)}};
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

Outcome<Problem> problem_on(const PlanCommand& command, const MapFile& map) {
  auto from = point(command.from, "--from");
  if (!from) return pass_on(from);
  auto to = point(command.to, "--to");
  if (!to) return pass_on(to);
  auto ground = GridGround::of(map.blocked, command.model == "cells" ? GridModel::cells : GridModel::corners);
  if (!ground) return pass_on(ground);
  return Problem{std::make_shared<const GridGround>(std::move(*ground)), map.to_grid(*from),
                 map.to_grid(*to)};
}

Status draw(const PlanCommand& command, const MapFile& map, const std::vector<Row>& rows) {
  if (command.svg.empty()) return {};
  std::vector<DrawnPath> paths;
  for (const Row& row : rows) {
    if (row.plan) paths.push_back({std::string(row.planner.name), *row.plan});
  }
  return write_file(command.svg, path_picture(map.occupied, map.blocked, paths));
}

int execute(const PlanCommand& command) {
  const auto planners = chosen(command);
  if (!planners) return say(planners.error(), command.output);
  const auto map = load_map(command.map, command.radius_m, command.height_m, command.grid);
  if (!map) return say(map.error(), command.output);
  for (const std::string& warning : map->warnings) fmt::print(stderr, "outrider: warning: {}\n", warning);
  const auto problem = problem_on(command, *map);
  if (!problem) return say(problem.error(), command.output);

  std::vector<Row> rows;
  for (const PathPlanner& planner : *planners) rows.push_back(solve(planner, *problem, *map));
  if (!command.compare && !rows.front().plan) return say(rows.front().plan.error(), command.output);
  if (auto ok = draw(command, *map, rows); !ok) return say(ok.error(), command.output);

  const bool all = std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.plan.has_value(); });
  if (!command.output.json) {
    print_table(rows);
    if (!command.svg.empty()) fmt::print("\n  picture {}\n", command.svg);
  } else if (!command.compare) {
    auto object = row_json(rows.front(), *map);
    object["job"] = "plan";
    print(object);
  } else {
    auto list = nlohmann::ordered_json::array();
    for (const Row& row : rows) list.push_back(row_json(row, *map));
    print({{"status", all ? "done" : "not_done"}, {"job", "plan"}, {"plans", list}});
  }
  return all ? job_done : job_not_done;
}

}  // namespace

void add_plan(CLI::App& app, int& status) {
  CLI::App* plan = app.add_subcommand("plan", "a collision-free path for a disk robot");
  auto command = std::make_shared<PlanCommand>();
  plan->add_option("map", command->map, "map_server .yaml, SDF world or MovingAI .map")->required();
  plan->add_option("--from", command->from, "x,y of the start, m")->required();
  plan->add_option("--to", command->to, "x,y of the goal, m")->required();
  plan->add_option("--planner", command->planner, "name from 'outrider list'")->capture_default_str();
  plan->add_flag("--compare", command->compare, "every planner of the catalogue");
  plan->add_option("--model", command->model, "cells or corners")
      ->check(CLI::IsMember({"cells", "corners"}));
  plan->add_option("--radius", command->radius_m, "of the robot, m [0.26; MovingAI 0]")
      ->check(CLI::Range(0.0, 100.0));
  plan->add_option("--height", command->height_m, "of the robot, m, for SDF worlds")
      ->check(CLI::Range(0.0, 100.0));
  plan->add_option("--resolution", command->grid.resolution_m, "of the grid, m, for SDF worlds")
      ->check(CLI::Range(0.005, 10.0));
  plan->add_option("--svg", command->svg, "write a picture");
  plan->add_flag("--json", command->output.json, "print one JSON object on standard output");
  plan->callback([command, &status] { status = execute(*command); });
}

}  // namespace outrider::cli
