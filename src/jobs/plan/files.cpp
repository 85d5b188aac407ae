#include "files.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "outrider/path/visibility/visibility_graph.hpp"
#include "path_picture.hpp"
#include "polygon_picture.hpp"
#include "report.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_query_pictures = 100;
constexpr std::size_t most_edges_with_legs = 1000;  // the legs of more are too many to see

NamedContent grid_picture(const PlanQuestion& question, const PlanAnswer& answer, const Trace* trace) {
  const PlanGround& ground = *question.ground;
  PathPicture picture{ground.occupied, ground.blocked, {}, {}, {}, {}};
  if (ground.shapes) picture.obstacles = ground.shapes->obstacles();
  for (const PlanQuery& query : question.queries) picture.goals.push_back(ground.to_grid(query.to));
  picture.start = ground.to_grid(question.queries.front().from);
  if (trace != nullptr) {
    picture.ground = ground.grid;
    picture.trace = *trace;
  }
  for (const PlanRow& row : answer.rows) {
    if (row.found()) picture.paths.push_back({row.planner, *row.plan});
  }
  return {"plan.svg", to_svg(picture)};
}

/// One picture for each query, with the ways of all planners; and one of all queries, each its shortest way.
std::vector<NamedContent> polygon_pictures(const PlanQuestion& question, const PlanAnswer& answer) {
  const PlanGround& ground = *question.ground;
  PolygonPicture base{ground.polygons, ground.grid ? &ground.blocked : nullptr, {}, {}};
  if (ground.polygons->edges.size() <= most_edges_with_legs) {
    base.legs = visibility_legs(*ground.polygons, false);
  }
  PolygonPicture best = base;
  std::vector<NamedContent> files;
  const std::size_t queries = question.queries.size(), planners = question.planners.size();
  for (std::size_t q = 0; q < queries; ++q) {
    PolygonPicture one = base;
    std::vector<const PlanRow*> rows;
    for (std::size_t i = q * planners; i < (q + 1) * planners; ++i) {
      rows.push_back(&answer.rows[i]);
      if (rows.back()->found()) one.ways.push_back({rows.back()->planner, *rows.back()->plan});
    }
    if (queries == 1) return {{"plan.svg", polygon_picture(one)}};
    const std::size_t number = question.queries[q].number.value_or(q + 1);
    const PlanRow* row = shortest(rows);
    if (row != nullptr) best.ways.push_back({fmt::format("query {}", number), *row->plan});
    if (q < most_query_pictures) files.push_back({fmt::format("query_{}.svg", number), polygon_picture(one)});
  }
  files.push_back({"plan.svg", polygon_picture(best)});
  return files;
}

}  // namespace

std::vector<NamedContent> plan_pictures(const PlanQuestion& question, const PlanAnswer& answer,
                                        const Trace* trace) {
  if (question.queries.empty() || answer.rows.empty()) return {};
  if (question.ground->polygons) return polygon_pictures(question, answer);
  return {grid_picture(question, answer, trace)};
}

std::string trace_json(const Trace& trace, const GridMap& ground) {
  auto expansions = nlohmann::ordered_json::array();
  for (const Expansion& expansion : trace.expansions) {
    const Cell v = ground.at(expansion.state), parent = ground.at(expansion.parent);
    expansions.push_back({{"vertex", {v.x, v.y}},
                          {"parent", {parent.x, parent.y}},
                          {"f", expansion.f},
                          {"g", expansion.g},
                          {"h", expansion.h}});
  }
  return expansions.dump() + "\n";
}

}  // namespace outrider
