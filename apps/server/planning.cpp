#include "planning.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "message.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/safety.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_legs = 20'000;

struct Question {
  GroundRequest ground;
  Vec2 start;
  Vec2 goal;
  PathPlanner planner;
  ConfiguredPlanner configured;
  std::size_t trace = 0;
  bool blocked = false;
  bool legs = false;
};

Outcome<std::shared_ptr<const KnownMap>> map_of(Fields& fields, PlanningMemory& memory) {
  const int named = fields.has("map"), cells = fields.has("grid"), polygons = fields.has("polygons");
  if (named + cells + polygons != 1) return bad_input("give one of map, grid and polygons", "map");
  if (named != 0) {
    auto map = memory.maps.find(fields.text("map"));
    if (map) return map;
    return bad_input("this map is not known any more; post it again", "map");
  }
  const Json* shape = fields.object(cells != 0 ? "grid" : "polygons");
  if (shape == nullptr) return tl::unexpected(fields.end().error());
  auto map = cells != 0 ? grid_map_from_json(*shape, "grid") : polygon_map_from_json(*shape, "polygons");
  if (!map) return pass_on(map);
  return memory.maps.keep(std::move(*map));
}

Status configure(ConfiguredPlanner& planner, const Json* options) {
  if (options == nullptr) return {};
  for (const auto& [name, value] : options->items()) {
    const auto found = std::find_if(planner.options.begin(), planner.options.end(),
                                    [&](const Option& option) { return option.name == name; });
    const std::string where = "options." + name.substr(0, 64);
    if (found == planner.options.end()) return bad_input("this planner has no such option", where);
    if (value.is_structured() || value.is_null())
      return bad_input("it takes a number, a word or true", where);
    auto ok = assign(*found, value.is_string() ? value.get<std::string>() : value.dump());
    if (!ok) return bad_input(ok.error().sentence, where);
  }
  return {};
}

/// The grid that the planner takes: the one that is asked for, or its first.
Outcome<GridModel> model_of(const PathPlanner& planner, const std::string& asked) {
  if (asked.empty()) return planner.models.empty() ? GridModel::corners : planner.models.front();
  for (const GridModel model : {GridModel::cells, GridModel::corners}) {
    if (to_string(model) != asked) continue;
    if (planner.polygons || planner.takes(model)) return model;
    return bad_input(fmt::format("{} takes no grid of {}", planner.name, asked), "model");
  }
  return bad_input("it takes cells or corners", "model");
}

Outcome<Question> question_of(const Json& request, PlanningMemory& memory) {
  Fields fields(request, "");
  auto map = map_of(fields, memory);
  if (!map) return pass_on(map);
  auto planner = find_path_planner(fields.text("planner", "a_star"));
  if (!planner) return bad_input(planner.error().sentence, "planner");
  Question question{{*map, {}, {}}, {}, {}, *planner, planner->configure()};
  GroundRequest& ground = question.ground;
  ground.polygons = planner->polygons;
  question.start = fields.point("start");
  question.goal = fields.point("goal");
  const double least_radius = std::holds_alternative<CellMap>((*map)->shape) ? 0.0 : least_polygon_radius_m;
  ground.radius_m = fields.number("radius_m", least_radius, 1e3, (*map)->radius_m);
  ground.resolution_m = fields.number("resolution_m", 1e-3, 1e3, 0.1);
  question.trace = static_cast<std::size_t>(fields.integer("trace", 0, most_traced, 0));
  question.blocked = fields.boolean("blocked", false);
  question.legs = fields.boolean("legs", false);
  const std::string asked = fields.text("model", "");
  const Json* options = fields.object("options");
  const Json* edits = fields.list("edits");
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  auto model = model_of(*planner, asked);
  if (!model) return pass_on(model);
  ground.model = *model;
  if (auto ok = configure(question.configured, options); !ok) return pass_on(ok);
  auto changes = edits_from_json(*edits, **map);
  if (!changes) return pass_on(changes);
  ground.edits = std::move(*changes);
  ground.edits_text = edits->dump();
  if (!edits->empty()) {
    Json earlier = *edits;
    earlier.erase(earlier.size() - 1);
    ground.earlier_text = earlier.dump();
  }
  return question;
}

Json point_json(Vec2 p) { return {p.x, p.y}; }

/// x, y, so many expansions, x, y, ...: where and when a vertex was first put into the queue.
Json openings_json(const Trace& trace, const GridGround& grid) {
  Json list = Json::array();
  for (const Opening& opening : trace.openings) {
    const Cell v = grid.at(opening.state);
    for (const auto value : {static_cast<std::uint32_t>(v.x), static_cast<std::uint32_t>(v.y), opening.after})
      list.push_back(value);
  }
  return list;
}

/// Of a search without a grid: its states are numbers, and `places` says where they are.
Json placed_trace_json(const Trace& trace, Measure measure) {
  Json rows = Json::array(), openings = Json::array(), places = Json::array();
  for (const Expansion& e : trace.expansions) rows.push_back({e.state, e.parent, e.f, e.g, e.h});
  for (const auto& [state, after] : trace.openings) {
    openings.push_back(state);
    openings.push_back(after);
  }
  for (const auto& [x, y] : trace.places) places.push_back({x, y});
  return {{"columns", {"state", "parent", "f", "g", "h"}},
          {"rows", std::move(rows)},
          {"openings", std::move(openings)},
          {"unit", unit_of(measure)},
          {"model", "places"},
          {"places", std::move(places)},
          {"truncated", trace.expansions.size() == trace.most}};
}

Json trace_json(const Trace& trace, const PreparedGround& ground) {
  const GridGround& grid = *ground.grid;
  Json rows = Json::array();
  for (const Expansion& expansion : trace.expansions) {
    const Cell v = grid.at(expansion.state), parent = grid.at(expansion.parent);
    rows.push_back({v.x, v.y, parent.x, parent.y, expansion.f, expansion.g, expansion.h});
  }
  const GridFrame& frame = grid.frame;
  return {{"columns", {"x", "y", "parent_x", "parent_y", "f", "g", "h"}},
          {"rows", std::move(rows)},
          {"openings", openings_json(trace, grid)},
          {"unit", "cells"},
          {"model", to_string(grid.model)},
          {"frame",
           {{"origin", point_json(frame.origin)},
            {"resolution_m", frame.resolution_m},
            {"width", frame.width},
            {"height", frame.height},
            {"yaw_rad", ground.yaw_rad}}},
          {"truncated", trace.expansions.size() == trace.most}};
}

Json pieces_json(const Plan& plan) {
  Json pieces = Json::array();
  for (const PathPiece& piece : plan.pieces) {
    Json one = {{"from", point_json(piece.from)}, {"to", point_json(piece.to)}};
    if (piece.turn_rad != 0.0) one["centre"] = point_json(piece.centre);
    if (piece.turn_rad != 0.0) one["turn_rad"] = piece.turn_rad;
    pieces.push_back(std::move(one));
  }
  return pieces;
}

Json plan_json(const Question& question, const Problem& problem, const PreparedGround& ground,
               const Plan& plan) {
  Json waypoints = Json::array();
  for (const Vec2 p : plan.waypoints) waypoints.push_back(point_json(ground.to_world(p)));
  const double clearance_m = safety_of(plan, problem).clearance_m;
  return {{"status", "done"},
          {"planner", question.planner.name},
          {"model", problem.polygons ? "polygons" : to_string(ground.grid->model)},
          {"cost", plan.cost},
          {"cost_unit", unit_of(question.planner.guarantee.measure)},
          {"lower_bound", plan.lower_bound},
          {"length_m", length_of(plan)},
          {"reached_within_m", plan.reached_within},
          {"clearance_m", clearance_m},
          {"counters",
           {{"expansions", plan.counters.expansions},
            {"generated", plan.counters.generated},
            {"line_of_sight_checks", plan.counters.line_of_sight_checks}}},
          {"waypoints", std::move(waypoints)},
          {"pieces", pieces_json(plan)}};
}

/// That nothing was found, in the words of the planner.
Json fault_answer(const Question& question, const Fault& fault) {
  const bool searched = fault.code == FaultCode::no_path || fault.code == FaultCode::budget_exhausted ||
                        fault.code == FaultCode::cancelled;
  Json object = {{"status", searched ? "not_done" : "refused"}, {"planner", question.planner.name}};
  object.update(error_json(fault.sentence, to_string(fault.code), fault.where));
  return object;
}

Json legs_json(const PolygonGround& ground) {
  Json legs = Json::array();
  for (const Segment& leg : visibility_legs(ground, false)) {
    if (legs.size() == most_legs) break;
    legs.push_back({leg.a.x, leg.a.y, leg.b.x, leg.b.y});
  }
  return legs;
}

/// One search at a time by each thread; its plan is judged before anybody sees it.
Outcome<Json> solve(const Question& question, const PreparedGround& ground, Workspace& workspace,
                    const std::stop_token& stop, Trace& trace) {
  Problem problem{nullptr, ground.to_grid(question.start), ground.to_grid(question.goal)};
  (question.planner.polygons ? void(problem.polygons = ground.polygons) : void(problem.grid = ground.grid));
  Budget budget;
  budget.wall_time = longest_planning;
  budget.stop = stop;
  trace.most = question.trace;
  const bool traces = question.trace > 0;
  workspace.trace = traces ? &trace : nullptr;
  const auto begin = std::chrono::steady_clock::now();
  auto plan = question.configured.plan(problem, budget, workspace);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
  workspace.trace = nullptr;
  if (!plan && plan.error().code == FaultCode::bad_input) return pass_on(plan);
  if (plan) {
    if (auto verdict = check(*plan, problem); !verdict) throw std::logic_error(to_string(verdict.error()));
  }
  Json answer = plan ? plan_json(question, problem, ground, *plan) : fault_answer(question, plan.error());
  answer["time_ms"] = time.count();
  if (traces && problem.grid) answer["trace"] = trace_json(trace, ground);
  if (traces && problem.polygons)
    answer["trace"] = placed_trace_json(trace, question.planner.guarantee.measure);
  return answer;
}

}  // namespace

Outcome<Json> answer_plan(const Json& request, PlanningMemory& memory, Workspace& workspace,
                          const std::stop_token& stop) {
  auto question = question_of(request, memory);
  if (!question) return pass_on(question);
  auto ground = memory.grounds.get(question->ground);
  if (!ground) return pass_on(ground);
  Trace trace;
  auto answer = solve(*question, **ground, workspace, stop, trace);
  if (!answer) return answer;
  if (question->blocked && (*ground)->grid) {
    (*answer)["blocked"] = grid_json((*ground)->blocked, (*ground)->yaw_rad);
  }
  if (question->legs && question->planner.polygons) (*answer)["legs"] = legs_json(*(*ground)->polygons);
  return answer;
}

Outcome<QuestionScenario> scenario_of_question(const Json& request, PlanningMemory& memory) {
  auto question = question_of(request, memory);
  if (!question) return pass_on(question);
  const GroundRequest& ground = question->ground;
  auto map = edited(*ground.map, ground.edits);
  if (!map) return pass_on(map);
  QuestionScenario found{{}, std::move(*map)};
  PlanScenario& scenario = found.scenario;
  scenario.from = fmt::format("{},{}", question->start.x, question->start.y);
  scenario.to = fmt::format("{},{}", question->goal.x, question->goal.y);
  scenario.planner = question->planner.name;
  scenario.model = to_string(ground.model);
  scenario.radius_m = ground.radius_m;
  scenario.grid.resolution_m = ground.resolution_m;
  scenario.grid.most_cells = static_cast<std::int64_t>(most_map_cells);
  const auto row = std::find_if(scenario.planners.begin(), scenario.planners.end(), [&](const auto& planner) {
    return planner.first.name == question->planner.name;
  });
  row->second = std::move(question->configured);
  if (auto* polygons = std::get_if<PolygonMap>(&found.map.shape)) {
    polygons->queries = {{question->start, question->goal}};
  }
  return found;
}

}  // namespace outrider::server
