#include "planning/planning.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "outrider/jobs/plan/answer.hpp"
#include "outrider/path/clearance/medial_axis.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "outrider/report/run_json.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_legs = 20'000;

/// Holds a question whose ground is not yet made, and what to show of the answer.
struct Question {
  GroundRequest ground;
  PlanQuery query;
  ChosenPlanner planner;
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
  if (shape == nullptr) {
    auto refused = fields.end();
    return pass_on(refused);
  }
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
      return bad_input("expected a number, a word or true", where);
    auto ok = assign(*found, value.is_string() ? value.get<std::string>() : value.dump());
    if (!ok) return bad_input(ok.error().sentence, where);
  }
  return {};
}

/// Returns the requested grid model, or else the first one that the planner takes.
Outcome<GridModel> model_of(const PathPlanner& planner, const std::string& asked) {
  if (!asked.empty()) return find_grid_model(asked);
  return planner.models.empty() ? GridModel::corners : planner.models.front();
}

Outcome<Question> question_from_json(const Json& request, PlanningMemory& memory) {
  Fields fields(request, "");
  auto map = map_of(fields, memory);
  if (!map) return pass_on(map);
  auto planner = find_path_planner(fields.text("planner", "a_star"));
  if (!planner) return bad_input(planner.error().sentence, "planner");
  const bool cells = std::holds_alternative<MapCells>((*map)->shape);
  Question question{{*map, {}, {}, {}, {}}, {}, {*planner, planner->configure()}};
  GroundRequest& ground = question.ground;
  ground.options.needs_grid = !planner->polygons;
  ground.options.grid.most_cells = static_cast<std::int64_t>(most_map_cells);
  question.query.from = fields.point("start");
  question.query.to = fields.point("goal");
  ground.options.radius_m =
      fields.number("radius_m", cells ? 0.0 : least_polygon_radius_m, 1e3, (*map)->radius_m);
  ground.options.grid.resolution_m =
      fields.number("resolution_m", 1e-3, 1e3, ground.options.grid.resolution_m);
  question.trace = static_cast<std::size_t>(fields.integer("trace", 0, most_traced, 0));
  question.blocked = fields.boolean("blocked", false);
  question.legs = fields.boolean("legs", false);
  const std::string asked = fields.text("model", "");
  const Json* options = fields.object("options");
  const Json* edits = fields.list("edits");
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  auto model = model_of(*planner, asked);
  if (!model) return pass_on(model);
  if (auto ok = check_takes(*planner, *model, !cells); !ok) return pass_on(ok);
  ground.options.model = *model;
  if (auto ok = configure(question.planner.second, options); !ok) return pass_on(ok);
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

/// Returns x, y, expansions, x, y, expansions, ...: where and after how many expansions a vertex was first
/// queued.
Json openings_json(const Trace& trace, const GridMap& grid) {
  Json list = Json::array();
  for (const Opening& opening : trace.openings) {
    const Cell v = grid.at(opening.state);
    for (const auto value : {static_cast<std::uint32_t>(v.x), static_cast<std::uint32_t>(v.y), opening.after})
      list.push_back(value);
  }
  return list;
}

/// Returns the trace of a search without a grid: its states are numbers, and `places` holds their positions.
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

Json trace_json(const Trace& trace, const PlanGround& ground) {
  const GridMap& grid = *ground.grid;
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
           {{"origin", point_json<Json>(frame.origin)},
            {"resolution_m", frame.resolution_m},
            {"width", frame.width},
            {"height", frame.height},
            {"yaw_rad", ground.yaw_rad}}},
          {"truncated", trace.expansions.size() == trace.most}};
}

Json legs_json(const PolygonGround& ground) {
  Json legs = Json::array();
  for (const Segment& leg : visibility_legs(ground, false)) {
    if (legs.size() == most_legs) break;
    legs.push_back({leg.a.x, leg.a.y, leg.b.x, leg.b.y});
  }
  return legs;
}

Json axis_json(const PolygonGround& ground) {
  Json legs = Json::array();
  for (const std::vector<Vec2>& line : medial_axis_lines(ground)) {
    for (std::size_t i = 1; i < line.size() && legs.size() < most_legs; ++i)
      legs.push_back({line[i - 1].x, line[i - 1].y, line[i].x, line[i].y});
  }
  return legs;
}

Json view_json(const Question& question, const PlanGround& ground, const Trace& trace) {
  Json view = Json::object();
  const PathPlanner& planner = question.planner.first;
  const bool on_polygons = planner.polygons && ground.polygons;
  if (trace.most > 0) {
    view["trace"] = on_polygons || planner.steers ? placed_trace_json(trace, planner.guarantee.measure)
                                                  : trace_json(trace, ground);
  }
  if (question.blocked && ground.grid) view["blocked"] = grid_json(ground.blocked, ground.yaw_rad);
  if (question.legs && on_polygons)
    view["legs"] = planner.axis ? axis_json(*ground.polygons) : legs_json(*ground.polygons);
  return view;
}

}  // namespace

Outcome<Json> answer_plan(const Json& request, PlanningMemory& memory, Workspace& workspace,
                          const std::stop_token& stop) {
  auto question = question_from_json(request, memory);
  if (!question) return pass_on(question);
  auto ground = memory.grounds.get(question->ground);
  if (!ground) return pass_on(ground);
  Budget budget;
  budget.wall_time = longest_planning;
  budget.stop = stop;
  Trace trace;
  trace.most = question->trace;
  const PlanQuestion asked{*ground, {question->planner}, {question->query}};
  const PlanTools tools{.trace = trace.most > 0 ? &trace : nullptr, .workspace = &workspace};
  const auto found = answer(asked, tools, budget);
  if (!found) return pass_on(found);
  const auto& fault = found->rows.front().fault;
  if (fault && fault->code == FaultCode::bad_input) return tl::unexpected<Fault>(*fault);
  auto object = run_json<Json>(plan_report(asked, *found));
  object["warnings"] = question->ground.map->warnings;
  object["view"] = view_json(*question, **ground, trace);
  return object;
}

Outcome<QuestionScenario> scenario_of_question(const Json& request, PlanningMemory& memory) {
  auto question = question_from_json(request, memory);
  if (!question) return pass_on(question);
  const GroundRequest& ground = question->ground;
  auto map = edited(*ground.map, ground.edits);
  if (!map) return pass_on(map);
  QuestionScenario found{{}, std::move(*map)};
  PlanScenario& scenario = found.scenario;
  const Vec2 from = question->query.from, to = question->query.to;
  scenario.from = fmt::format("{},{}", from.x, from.y);
  scenario.to = fmt::format("{},{}", to.x, to.y);
  scenario.planner = question->planner.first.name;
  scenario.model = to_string(ground.options.model);
  scenario.radius_m = ground.options.radius_m;
  scenario.grid = ground.options.grid;
  const auto row = std::find_if(scenario.planners.begin(), scenario.planners.end(),
                                [&](const auto& planner) { return planner.first.name == scenario.planner; });
  row->second = std::move(question->planner.second);
  if (auto* polygons = std::get_if<PolygonMap>(&found.map.shape)) {
    polygons->queries = {{from, to}};
  }
  return found;
}

}  // namespace outrider::server
