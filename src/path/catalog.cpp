#include "outrider/path/catalog.hpp"

#include <limits>
#include <utility>

#include "outrider/path/clearance/medial_axis.hpp"
#include "outrider/path/clearance/safest.hpp"
#include "outrider/path/clearance/widest.hpp"
#include "outrider/path/grid/a_star.hpp"
#include "outrider/path/grid/d_star_lite.hpp"
#include "outrider/path/grid/dijkstra.hpp"
#include "outrider/path/grid/jps/jps.hpp"
#include "outrider/path/grid/jps/jps_plus.hpp"
#include "outrider/path/grid/terrain/terrain_a_star.hpp"
#include "outrider/path/grid/theta_star.hpp"
#include "outrider/path/hubs/any_angle/hub_labels.hpp"
#include "outrider/path/hubs/octile/octile_labels.hpp"
#include "outrider/path/hubs/terrain_labels.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"
#include "outrider/path/visibility/least_time.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "steering/steering_rows.hpp"
#include "with_options.hpp"

namespace outrider {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// The guarantee of a planner that finds a path whenever there is one.
Guarantee complete(PathClass among, double most_ratio, std::string_view sentence,
                   Measure measure = Measure::length) {
  return {
      .complete = true, .among = among, .most_ratio = most_ratio, .sentence = sentence, .measure = measure};
}

Guarantee shortest_along_moves() {
  return complete(PathClass::along_moves, 1.0, "complete; shortest along the eight moves of the grid");
}

Guarantee cheapest_along_moves() {
  return complete(PathClass::along_moves, 1.0, "complete; cheapest along the eight moves of the grid",
                  Measure::terrain);
}

/// Returns the guarantee of searches on the medial axis.
Guarantee along_the_axis() {
  return complete(PathClass::any_curve, unbounded,
                  "complete; no path has more clearance (to 0.1 %); costs at most 1.006 times the least "
                  "along the axis, and states a bound for all paths",
                  Measure::safety);
}

std::vector<PathPlanner> planners_along_moves() {
  return {
      {.name = "dijkstra",
       .sentence = "Searches in all directions until the goal is reached.",
       .paper = "Dijkstra, A note on two problems in connexion with graphs, 1959",
       .guarantee = shortest_along_moves(),
       .configure = with_options(dijkstra, dijkstra_many)},
      {.name = "a_star",
       .sentence = "Searches towards the goal, led by the distance along the moves of an empty grid.",
       .paper =
           "Hart, Nilsson and Raphael, A formal basis for the heuristic determination of minimum cost paths, "
           "1968",
       .guarantee = complete(PathClass::along_moves, 1.0,
                             "complete; shortest along the eight moves of the grid (at most `weight` times "
                             "as long above weight 1)"),
       .configure = with_options(a_star)},
      {.name = "jps",
       .sentence = "A* that expands only the cells where an obstacle forces a turn; runs over the others 64 "
                   "at a time.",
       .paper = "Harabor and Grastien, Improving jump point search, 2014",
       .guarantee = shortest_along_moves(),
       .configure = with_options(jps),
       .models = {GridModel::cells}},
      {.name = "jps_plus",
       .sentence =
           "Jump point search with an index of how far each run goes from each cell; for many queries on one "
           "grid.",
       .paper = "Rabin and Silva, JPS+: an extreme A* speed optimization for static uniform cost grids, 2015",
       .guarantee = shortest_along_moves(),
       .configure = with_options(jps_plus),
       .models = {GridModel::cells},
       .index = true},
      {.name = "octile_labels",
       .sentence =
           "Looks the shortest path along the moves up in an index of hubs that most paths pass; for many "
           "queries on one grid.",
       .paper =
           "Uras, Koenig and Hernandez, Subgoal graphs for optimal pathfinding in eight-neighbor grids, "
           "2013; Abraham, Delling, Goldberg and Werneck, Hierarchical hub labelings for shortest paths, "
           "2012",
       .guarantee = shortest_along_moves(),
       .configure = with_index<octile_labels, save_octile_labels, load_octile_labels>(),
       .models = {GridModel::cells},
       .index = true,
       .tells = TraceKind::lookup},
  };
}

std::vector<PathPlanner> planners_of_changing_maps() {
  return {
      {.name = "d_star_lite",
       .sentence = "A* from the goal that is kept, and repaired where the map has changed; for a robot that "
                   "corrects its map on the way.",
       .paper = "Koenig and Likhachev, D* Lite, 2002",
       .guarantee = shortest_along_moves(),
       .configure = with_options(d_star_lite),
       .incremental = true},
      {.name = "lpa_star",
       .sentence = "A* from the start that is kept, and repaired where the map has changed; for one start.",
       .paper = "Koenig, Likhachev and Furcy, Lifelong Planning A*, 2004",
       .guarantee = shortest_along_moves(),
       .configure = with_options(lpa_star),
       .incremental = true},
  };
}

std::vector<PathPlanner> planners_on_terrain() {
  return {
      {.name = "terrain_a_star",
       .sentence = "A* on ground that costs more in some cells, along the eight moves.",
       .paper =
           "Hart, Nilsson and Raphael, A formal basis for the heuristic determination of minimum cost paths, "
           "1968",
       .guarantee = cheapest_along_moves(),
       .configure = with_options(terrain_a_star),
       .models = {GridModel::cells},
       .weighs = true},
      {.name = "terrain_labels",
       .sentence =
           "Looks the cheapest path along the eight moves up in an index of hubs, on ground that costs more "
           "in some cells; for many queries on one grid.",
       .paper = "Akiba, Iwata and Yoshida, Fast exact shortest-path distance queries on large networks by "
                "pruned landmark labeling, 2013",
       .guarantee = cheapest_along_moves(),
       .configure = with_index<terrain_labels, save_terrain_labels, load_terrain_labels>(),
       .models = {GridModel::cells},
       .index = true,
       .tells = TraceKind::lookup,
       .weighs = true},
      {.name = "terrain_theta_star",
       .sentence = "Theta* on ground that costs more in some cells: straight legs where they cost no more.",
       .paper = "Choi and Yu, Any-angle path planning on non-uniform costmaps, 2011",
       .guarantee = complete(PathClass::any_direction, unbounded,
                             "complete; near the cheapest path, without a proven ratio", Measure::terrain),
       .configure = with_options(terrain_theta_star),
       .models = {GridModel::cells},
       .weighs = true},
  };
}

std::vector<PathPlanner> planners_in_any_direction() {
  return {
      {.name = "theta_star",
       .sentence =
           "A* whose legs may point in any direction: each vertex takes the parent of its parent if seen.",
       .paper = "Nash, Daniel, Koenig and Felner, Theta*: any-angle path planning on grids, 2007",
       .guarantee = complete(PathClass::any_direction, unbounded,
                             "complete; near the shortest path, without a proven ratio"),
       .configure = with_options(theta_star)},
      {.name = "lazy_theta_star",
       .sentence = "Free-direction A* that looks along a line only when it expands a vertex.",
       .paper = "Nash, Koenig and Tovey, Lazy Theta*: any-angle path planning and path length analysis in "
                "3D, 2010",
       .guarantee = complete(PathClass::any_direction, unbounded,
                             "complete; near the shortest path, without a proven ratio"),
       .configure = with_options(lazy_theta_star)},
      {.name = "polyanya",
       .sentence = "Looks from corner to corner over a navigation mesh, and finds the shortest path in any "
                   "direction.",
       .paper = "Cui, Harabor and Grastien, Compromise-free pathfinding on a navigation mesh, 2017",
       .guarantee = complete(PathClass::any_direction, 1.0, "complete; shortest of all paths"),
       .configure = with_options(polyanya),
       .models = {GridModel::corners}},
      {.name = "hub_labels",
       .sentence =
           "Looks the shortest path in any direction up in an index of hubs that most paths pass; for many "
           "queries on one grid.",
       .paper = "Du, Shen and Cheema, Ultrafast Euclidean shortest path computation using hub labeling, 2023",
       .guarantee = complete(PathClass::any_direction, 1.0, "complete; shortest of all paths"),
       .configure = with_index<hub_labels, save_hub_labels, load_hub_labels>(),
       .models = {GridModel::corners},
       .index = true,
       .tells = TraceKind::lookup},
      {.name = "safest",
       .sentence = "Keeps the largest clearance that can be kept, then is as short and as far from "
                   "everything as can be.",
       .paper =
           "Pollack, The maximum capacity through a network, 1960; Wein, van den Berg and Halperin, Planning "
           "high-quality paths and corridors amidst obstacles, 2008",
       .guarantee = complete(PathClass::along_moves, 1.0,
                             "complete; no path along the eight moves has more clearance, and none of those "
                             "costs less; on polygons that of medial_axis",
                             Measure::safety),
       .configure = with_options(safest),
       .models = {GridModel::cells},
       .polygons = true,
       .axis = true,
       .on_polygons = along_the_axis()},
  };
}

std::vector<PathPlanner> planners_round_corners() {
  return {
      {.name = "visibility_graph",
       .sentence = "Joins all grown corners that see each other, found by a sweep round each, beforehand.",
       .paper = "Lee, Proximity and reachability in the plane, 1978; Liu and Arimoto, Path planning using a "
                "tangent "
                "graph, 1992",
       .guarantee =
           complete(PathClass::any_curve, 1.0, "complete; shortest of all paths of the disk, with true arcs"),
       .configure = with_options(visibility_graph, visibility_graph_many),
       .models = {},
       .index = true,
       .polygons = true},
      {.name = "visibility_graph_reduced",
       .sentence =
           "Joins the convex corners whose tangents support or separate, found pair by pair, beforehand.",
       .paper = "Liu and Arimoto, Path planning using a tangent graph for mobile robots among polygonal and "
                "curved "
                "obstacles, 1992",
       .guarantee =
           complete(PathClass::any_curve, 1.0, "complete; shortest of all paths of the disk, with true arcs"),
       .configure = with_options(visibility_graph_reduced, visibility_graph_reduced_many),
       .models = {},
       .index = true,
       .polygons = true},
      {.name = "visibility_graph_implicit",
       .sentence =
           "Looks round a corner, by a sweep, only when A* first comes to it; builds nothing beforehand.",
       .paper = "Lee, Proximity and reachability in the plane, 1978; Hart, Nilsson and Raphael, 1968",
       .guarantee =
           complete(PathClass::any_curve, 1.0, "complete; shortest of all paths of the disk, with true arcs"),
       .configure = with_options(visibility_graph_implicit, visibility_graph_implicit_many),
       .models = {},
       .polygons = true},
  };
}

std::vector<PathPlanner> planners_with_prices() {
  return {
      {.name = "least_time",
       .sentence =
           "Least time for a robot that turns in place before each straight, when turning has a price.",
       .paper = "Liu and Arimoto, 1992; Milnor, On the total curvature of knots, 1950",
       .guarantee = complete(
           PathClass::any_curve, 1.0026,
           "complete; at most 1.0026 times the least time of all paths, nearer with a smaller `arc_step`",
           Measure::time),
       .configure = with_options(least_time, least_time_many),
       .models = {},
       .index = true,
       .polygons = true},
      {.name = "widest",
       .sentence = "Shortest of the paths that keep the largest clearance that any path can keep.",
       .paper = "O'Dunlaing and Yap, A retraction method for planning the motion of a disc, 1985; Liu and "
                "Arimoto, "
                "1992",
       .guarantee = complete(PathClass::widest_curve, 1.0,
                             "complete; no path has more clearance, and none of those is shorter"),
       .configure = with_options(widest),
       .models = {},
       .index = true,
       .polygons = true,
       .axis = true},
      {.name = "medial_axis",
       .sentence =
           "As far from everything as can be: along the lines on which two obstacles are equally near, bent "
           "where leaving them costs less.",
       .paper = "O'Dunlaing and Yap, A retraction method for planning the motion of a disc, 1985",
       .guarantee = along_the_axis(),
       .configure = with_options(medial_axis),
       .models = {},
       .index = true,
       .polygons = true,
       .axis = true},
  };
}

std::vector<PathPlanner>& rows() {
  static std::vector<PathPlanner> planners = [] {
    std::vector<PathPlanner> all;
    for (const auto& part :
         {planners_along_moves(), planners_of_changing_maps(), planners_in_any_direction(),
          planners_on_terrain(), planners_round_corners(), planners_with_prices(), planners_that_steer()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return planners;
}

}  // namespace

std::string_view to_string(TraceKind tells) {
  switch (tells) {
    case TraceKind::search: return "search";
    case TraceKind::tree: return "tree";
    case TraceKind::lookup: return "lookup";
  }
  return "";
}

std::string_view unit_of(Measure measure) {
  switch (measure) {
    case Measure::length: return "m";
    case Measure::time: return "s";
    case Measure::safety:
    case Measure::terrain:
    case Measure::manoeuvre: return "m eq";
  }
  return "";
}

std::vector<Outcome<Plan>> plan_each(const ConfiguredPlanner& planner, const Problem& problem,
                                     const std::vector<Vec2>& goals, const Budget& budget,
                                     Workspace& workspace) {
  if (planner.plan_many) return planner.plan_many(problem, goals, budget, workspace);
  std::vector<Outcome<Plan>> plans;
  for (const Vec2 goal : goals) {
    Problem one = problem;
    one.goal = goal;
    plans.push_back(planner.plan(one, budget, workspace));
  }
  return plans;
}

const std::vector<PathPlanner>& path_planners() { return rows(); }

void add_path_planner(PathPlanner row) { rows().push_back(std::move(row)); }

std::vector<std::string> names_of_planners_in_place(std::optional<GridModel> model) {
  std::vector<std::string> names;
  for (const PathPlanner& planner : path_planners())
    if (!planner.steers && (!model || planner.takes(*model))) names.emplace_back(planner.name);
  return names;
}

Outcome<Plan> plan_path(const Problem& problem, std::string_view planner, const Budget& budget) {
  auto row = find_path_planner(planner);
  if (!row) return pass_on(row);
  Workspace workspace;
  return row->configure().plan(problem, budget, workspace);
}

Outcome<PathPlanner> find_path_planner(std::string_view name) {
  return find_row(path_planners(), "planner", name, "planner");
}

}  // namespace outrider
