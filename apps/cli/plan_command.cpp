#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "commands.hpp"
#include "flags.hpp"
#include "map_changes.hpp"
#include "map_file.hpp"
#include "output.hpp"
#include "outrider/core/units.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/io/values.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/jobs/plan/scenario.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/safety.hpp"
#include "path_picture.hpp"
#include "plan_command.hpp"
#include "polygon_plan.hpp"
#include "progress.hpp"
#include "scenario_words.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

constexpr int most_goals = 10'000;

/// A row of the catalogue, with the options that the flags set.
struct Candidate {
  PathPlanner planner;
  ConfiguredPlanner configured;
};

/// What was said, where silence means something else than the default.
struct Said {
  bool radius = false;
  bool planner = false;
  bool model = false;
  bool resolution = false;
};

struct PlanCommand {
  std::string map;
  std::string from;
  std::string to;
  std::vector<std::string> goals;  ///< all that was given as --to
  std::string query;
  std::string planner = "theta_star";
  bool compare = false;
  std::string model = "cells";
  RobotModel robot;
  GridOptions grid;
  bool json = false;
  std::string svg;
  bool trace = false;
  std::string out;
  std::vector<Candidate> catalogue;
  Said said;
  const Command* changes = nullptr;  ///< words that change cells of the map; none in a scenario
};

struct Row {
  PathPlanner planner;
  Vec2 goal;  ///< on the grid
  Outcome<Plan> plan;
  double time_s = 0.0;  ///< of the search, which may answer for several goals
  Safety safety = {};
};

struct Question {
  Problem problem;
  std::vector<Vec2> goals;
};

std::vector<OptionGroup> describe(PlanCommand& command) {
  OptionGroup question{
      "",
      "what is asked",
      {{"from", "", 0, 0, "x,y of the start, m (MovingAI: cells, y from the bottom)", &command.from},
       {"to", "", 0, 0, "x,y of the goal, m; several times for many goals from one start", &command.to},
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
        {"trace", "", 0, 0, "show what the search expands, in the picture and in JSON; on grids",
         &command.trace},
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

/// Refuses a start and a single goal where no path can begin or end, under the name of the flag.
Outcome<Question> question_on(const PlanCommand& command, const MapFile& map, GridModel model) {
  auto from = point(command.from, "--from");
  if (!from) return pass_on(from);
  auto ground = GridGround::of(map.blocked, model);
  if (!ground) return pass_on(ground);
  Question question{{std::make_shared<const GridGround>(std::move(*ground)), map.to_grid(*from), {}}, {}};
  for (const std::string& goal : command.goals) {
    auto to = point(goal, "--to");
    if (!to) return pass_on(to);
    question.goals.push_back(map.to_grid(*to));
  }
  Problem& problem = question.problem;
  problem.goal = question.goals.front();
  const std::optional<Cell> start = problem.grid->vertex_at(problem.start);
  const bool bad_start = !start || !problem.grid->place(*start);
  if (!bad_start && question.goals.size() > 1) return question;
  if (auto query = grid_query(problem); !query) {
    Fault fault = query.error();
    fault.where = bad_start ? "--from " + command.from : "--to " + command.to;
    if (map.yaw_rad != 0.0)
      fault.where += fmt::format(" in the map turned by {:.4g} degrees", degrees(map.yaw_rad));
    return tl::unexpected(std::move(fault));
  }
  return question;
}

/// Plans, and has every plan judged by the grid's own rules and by the exact shapes where there are any.
std::vector<Row> solve(const Candidate& candidate, const Question& question, const MapFile& map,
                       Trace* trace) {
  Workspace workspace;
  workspace.trace = trace;
  const auto begin = std::chrono::steady_clock::now();
  auto plans = plan_each(candidate.configured, question.problem, question.goals, {}, workspace);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    Problem problem = question.problem;
    problem.goal = question.goals[i];
    if (plans[i]) {
      auto verdict = check(*plans[i], problem);
      if (verdict && map.ground) verdict = check(*plans[i], *map.ground, map.radius_m);
      if (!verdict)
        throw std::logic_error(fmt::format("{}: {}", candidate.planner.name, to_string(verdict.error())));
    }
    const Safety safety = plans[i] ? safety_of(*plans[i], problem) : Safety{};
    rows.push_back({candidate.planner, problem.goal, std::move(plans[i]), time.count(), safety});
  }
  return rows;
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
            {"length_m", length_of(*row.plan)},
            {"clearance_m", row.safety.clearance_m},
            {"exposure", row.safety.exposure},
            {"reached_within_m", row.plan->reached_within},
            {"planning_s", row.time_s},
            {"expansions", row.plan->counters.expansions},
            {"line_of_sight_checks", row.plan->counters.line_of_sight_checks}}},
          {"waypoints", std::move(waypoints)}};
}

/// The vertices in the order in which the search expanded them; costs in cells.
nlohmann::ordered_json trace_json(const Trace& trace, const GridGround& ground) {
  auto expansions = nlohmann::ordered_json::array();
  for (const Expansion& expansion : trace.expansions) {
    const Cell v = ground.at(expansion.state), parent = ground.at(expansion.parent);
    expansions.push_back({{"vertex", {v.x, v.y}},
                          {"parent", {parent.x, parent.y}},
                          {"f", expansion.f},
                          {"g", expansion.g},
                          {"h", expansion.h}});
  }
  return expansions;
}

struct Answer {
  MapFile map;
  Question question;
  std::vector<Row> rows;
  Trace trace;
};

nlohmann::ordered_json plan_json(const PlanCommand& command, const Answer& answer, bool all) {
  const auto& [map, question, rows, trace] = answer;
  nlohmann::ordered_json object = {
      {"status", all ? "done" : "not_done"}, {"job", "plan"}, {"radius_m", map.radius_m}};
  if (command.compare || rows.size() > 1) {
    object["plans"] = nlohmann::ordered_json::array();
    for (const Row& row : rows) {
      object["plans"].push_back(row_json(row, map));
      const Vec2 goal = map.to_world(row.goal);
      if (question.goals.size() > 1) object["plans"].back()["goal"] = {goal.x, goal.y};
    }
  } else {
    object.update(row_json(rows.front(), map));
  }
  if (command.trace) object["trace"] = trace_json(trace, *question.problem.grid);
  object["warnings"] = map.warnings;
  return object;
}

void print_table(const std::vector<Row>& rows, const MapFile& map, bool many) {
  show("  {:<18} {:>11} {:>11} {:>11} {:>8} {:>9} {:>5} {:>11} {:>10}{}\n", "planner", "length m", "cost m",
       "bound m", "clear m", "exposure", "legs", "expansions", "ms", many ? "  goal" : "");
  for (const Row& row : rows) {
    const Vec2 at = map.to_world(row.goal);
    const std::string goal = many ? fmt::format("  {:g},{:g}", at.x, at.y) : "";
    if (!row.plan) {
      show("  {:<18} {}{}\n", row.planner.name, row.plan.error().sentence, goal);
      continue;
    }
    show("  {:<18} {:>11.3f} {:>11.3f} {:>11.3f} {:>8.3f} {:>9.3f} {:>5} {:>11} {:>10.2f}{}\n",
         row.planner.name, length_of(*row.plan), row.plan->cost, row.plan->lower_bound,
         row.safety.clearance_m, row.safety.exposure,
         row.plan->waypoints.empty() ? 0 : row.plan->waypoints.size() - 1, row.plan->counters.expansions,
         1e3 * row.time_s, goal);
  }
}

std::string picture_of(const PlanCommand& command, const Answer& answer) {
  const auto& [map, question, rows, trace] = answer;
  PathPicture picture{map.occupied, map.blocked, {}, question.problem.start, question.goals, {}};
  if (map.ground) picture.obstacles = map.ground->obstacles();
  if (command.trace) picture.ground = question.problem.grid;
  picture.trace = trace;
  for (const Row& row : rows) {
    if (row.plan) picture.paths.push_back({std::string(row.planner.name), *row.plan});
  }
  return to_svg(picture);
}

Outcome<Answer> answer(const PlanCommand& command) {
  auto model = model_of(command);
  if (!model) return pass_on(model);
  auto candidates = chosen(command, *model);
  if (!candidates) return pass_on(candidates);
  Progress progress(1 + static_cast<int>(candidates->size()));
  progress.next("reading the map");
  auto map = load_map(command.map, command.said.radius ? std::optional(command.robot.radius_m) : std::nullopt,
                      command.robot, command.grid);
  if (!map) return pass_on(map);
  if (command.changes != nullptr) {
    if (auto ok = change_cells(*command.changes, *map); !ok) return pass_on(ok);
  }
  auto question = question_on(command, *map, *model);
  if (!question) return pass_on(question);
  Answer answer{std::move(*map), std::move(*question), {}, {}};
  for (const Candidate& candidate : *candidates) {
    progress.next(std::string(candidate.planner.name));
    for (Row& row : solve(candidate, answer.question, answer.map, command.trace ? &answer.trace : nullptr)) {
      answer.rows.push_back(std::move(row));
    }
  }
  return answer;
}

int execute_on_polygons(const PlanCommand& command) {
  const auto model = model_of(command);
  if (!model) return say(model.error(), command.json);
  PolygonPlan request;
  request.map = command.map;
  request.from = command.from;
  request.to = command.goals;
  request.query = command.query;
  request.out = command.out;
  request.svg = command.svg;
  if (command.said.planner) request.planner = command.planner;
  if (command.said.model) request.model = *model;
  if (command.said.radius || !is_polygon_map(command.map)) request.radius_m = command.robot.radius_m;
  request.height_m = command.robot.height_m;
  if (command.said.resolution) request.resolution_m = command.grid.resolution_m;
  request.compare = command.compare;
  request.json = command.json;
  for (const Candidate& candidate : command.catalogue) {
    request.planners.emplace_back(candidate.planner, candidate.configured);
  }
  return plan_on_polygons(request);
}

/// A world of solids, asked of a planner on polygons.
bool is_polygon_question(const PlanCommand& command) {
  if (is_polygon_map(command.map)) return true;
  const auto planner = find_path_planner(command.planner);
  return !command.compare && is_world(command.map) && planner && planner->polygons;
}

/// What a trace needs to be shown.
Status check_trace(const PlanCommand& command, bool on_polygons) {
  if (!command.trace) return {};
  if (on_polygons) return bad_input("it shows searches on grids; leave it out, or take a grid", "--trace");
  if (command.compare || command.goals.size() > 1)
    return bad_input("it shows one search; leave out --compare, and give one --to", "--trace");
  if (!command.svg.empty() || command.json) return {};
  return bad_input("it has nowhere to go; give --svg FILE to draw it, or --json", "--trace");
}

/// What only a polygon environment takes, and what only it may leave out.
Status check_grid_flags(const Command& flags) {
  for (const char* flag : {"--query", "--out"}) {
    if (flags.given(flag))
      return bad_input("it works with a polygon environment (.txt) only; leave it out", flag);
  }
  for (const char* flag : {"--from", "--to"}) {
    if (!flags.given(flag)) return bad_input("it is missing; give x,y in m, such as 1.5,-2", flag);
  }
  return {};
}

/// The picture and the answer, where they were asked for.
Status write_answer(const PlanCommand& command, const Answer& answer, bool all) {
  if (!command.svg.empty()) {
    if (auto ok = write_file(command.svg, picture_of(command, answer)); !ok) return ok;
  }
  if (command.out.empty()) return {};
  return cli::write_files(command.out, {{"plan.json", json_text(plan_json(command, answer, all), 1) + "\n"},
                                        {"plan.svg", picture_of(command, answer)}});
}

int execute_on_grid(const PlanCommand& command) {
  const auto found = answer(command);
  if (!found) return say(found.error(), command.json);
  const auto& [map, question, rows, trace] = *found;
  warn(map.warnings);

  const bool all = std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.plan.has_value(); });
  if (auto ok = write_answer(command, *found, all); !ok) return say(ok.error(), command.json);
  if (command.json) {
    print(plan_json(command, *found, all));
  } else if (all || rows.size() > 1) {
    print_table(rows, map, question.goals.size() > 1);
    if (!command.svg.empty()) show("\n  picture  {}\n", command.svg);
    if (!command.out.empty()) show("\n  picture  {}/plan.svg\n", command.out);
  }
  const auto failed = std::find_if(rows.begin(), rows.end(), [](const Row& row) { return !row.plan; });
  if (failed == rows.end()) return job_done;
  const int status = say(failed->plan.error(), false);
  return question.goals.size() > 1 ? job_not_done : status;
}

int execute(PlanCommand& command, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, describe(command)); !ok) return say(ok.error(), json);
  command.goals = flags.values("--to");
  command.said = {flags.given("--radius"), flags.given("--planner"), flags.given("--model"),
                  flags.given("--resolution")};
  const bool on_polygons = is_polygon_question(command);
  if (auto ok = check_trace(command, on_polygons); !ok) return say(ok.error(), json);
  if (on_polygons) {
    if (auto ok = refuse_changes(flags); !ok) return say(ok.error(), json);
    return execute_on_polygons(command);
  }
  if (auto ok = check_grid_flags(flags); !ok) return say(ok.error(), json);
  command.changes = &flags;
  return execute_on_grid(command);
}

struct ScenarioRequest {
  std::string scenario_path;
  bool json = false;
  std::string out;
  PlanScenario scenario;
};

OptionGroup describe_output(ScenarioRequest& request) {
  return {"",
          "output",
          {{"json", "", 0, 0, "print one JSON object on standard output", &request.json},
           {"out", "", 0, 0, "folder for plan.json and pictures", &request.out}}};
}

/// A scenario says everything, so its defaults are what it says.
PlanCommand command_of(const ScenarioRequest& request) {
  const PlanScenario& scenario = request.scenario;
  PlanCommand command;
  command.map = scenario.map;
  command.from = scenario.from;
  command.goals = {scenario.to};
  command.planner = scenario.planner;
  command.model = scenario.model;
  command.robot.radius_m = scenario.radius_m;
  command.robot.height_m = scenario.height_m;
  command.grid = scenario.grid;
  command.json = request.json;
  command.out = request.out;
  for (const auto& [planner, configured] : scenario.planners)
    command.catalogue.push_back({planner, configured});
  command.said = {true, true, true, true};
  return command;
}

}  // namespace

int run_plan_scenario(const std::string& path, const Command& flags) {
  ScenarioRequest request;
  if (auto ok = read_run_words(flags, path, "plan", request); !ok)
    return say(ok.error(), flags.given("--json"));
  if (auto ok = check(request.scenario); !ok) {
    ok.error().where = path + ": " + ok.error().where;
    return say(ok.error(), request.json);
  }
  const PlanCommand command = command_of(request);
  return is_polygon_question(command) ? execute_on_polygons(command) : execute_on_grid(command);
}

void add_plan(Command& tool) {
  Command& plan = tool.add("plan", "find a collision-free path for a disk robot");
  auto command = std::make_shared<PlanCommand>();
  for (const PathPlanner& planner : path_planners())
    command->catalogue.push_back({planner, planner.configure()});
  plan.positional("map", &command->map,
                  "map_server .yaml, SDF .sdf or .world, MovingAI .map, polygons .txt; .gz may follow")
      .required()
      .type("FILE");
  add_flags(plan, describe(*command));
  add_change_flags(plan);
  plan.parameter("--to").repeatable(most_goals);
  plan.does([command](const Command& flags) { return execute(*command, flags); });
  plan.footer(
      "\nExample: outrider plan scenarios/yard/yard.sdf --from 0,-6 --to 4,4 --compare --svg paths.svg");
}

}  // namespace outrider::cli
