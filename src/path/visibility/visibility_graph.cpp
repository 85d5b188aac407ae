#include "outrider/path/visibility/visibility_graph.hpp"

#include "tangent_search.hpp"

namespace outrider {

std::vector<Option> describe(VisibilityOptions& options) {
  return {{"polygonal", "", 0.0, 0.0, "straight legs in place of arcs, a little longer", &options.polygonal},
          {"arc_step", "deg", 1.0, 90.0, "largest turn between the straight legs that stand for an arc",
           &options.arc_step_rad}};
}

Outcome<Plan> visibility_graph(const Problem& problem, const VisibilityOptions& options, const Budget& budget,
                               Workspace& workspace) {
  return tangent_search(problem, {}, options, TangentForm::swept, budget, workspace);
}

Outcome<Plan> visibility_graph_reduced(const Problem& problem, const VisibilityOptions& options,
                                       const Budget& budget, Workspace& workspace) {
  return tangent_search(problem, {}, options, TangentForm::paired, budget, workspace);
}

Outcome<Plan> visibility_graph_implicit(const Problem& problem, const VisibilityOptions& options,
                                        const Budget& budget, Workspace& workspace) {
  return tangent_search(problem, {}, options, TangentForm::implicit, budget, workspace);
}

std::vector<Outcome<Plan>> visibility_graph_many(const Problem& problem, const std::vector<Vec2>& goals,
                                                 const VisibilityOptions& options, const Budget& budget,
                                                 Workspace& workspace) {
  return tangent_search_many(problem, goals, {}, options, TangentForm::swept, budget, workspace);
}

std::vector<Outcome<Plan>> visibility_graph_reduced_many(const Problem& problem,
                                                         const std::vector<Vec2>& goals,
                                                         const VisibilityOptions& options,
                                                         const Budget& budget, Workspace& workspace) {
  return tangent_search_many(problem, goals, {}, options, TangentForm::paired, budget, workspace);
}

std::vector<Outcome<Plan>> visibility_graph_implicit_many(const Problem& problem,
                                                          const std::vector<Vec2>& goals,
                                                          const VisibilityOptions& options,
                                                          const Budget& budget, Workspace& workspace) {
  return tangent_search_many(problem, goals, {}, options, TangentForm::implicit, budget, workspace);
}

std::vector<Segment> visibility_legs(const PolygonGround& ground, bool swept) {
  Workspace workspace;
  const auto graph = tangent_graph(std::make_shared<const PolygonGround>(ground),
                                   swept ? TangentForm::swept : TangentForm::paired, {}, workspace);
  std::vector<Segment> legs;
  for (Node node = 0; graph && node < (*graph)->first.size(); ++node) {
    for (std::uint32_t i = 0; i < (*graph)->count[node]; ++i) {
      const Departure& leg = (*graph)->legs[(*graph)->first[node] + i];
      const bool once = node < turned_round(leg.to);
      if (once) legs.push_back({point_at(place_of(ground, node), leg.leaves), leg.at});
    }
  }
  return legs;
}

}  // namespace outrider
