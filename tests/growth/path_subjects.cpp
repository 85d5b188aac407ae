// Grid planners, as the side of the map grows: cells blocked at random, from one corner to the opposite one.
#include <cmath>
#include <stdexcept>

#include "outrider/path/grid/a_star.hpp"
#include "outrider/path/grid/dijkstra.hpp"
#include "outrider/path/grid/jps/jps.hpp"
#include "outrider/path/grid/theta_star.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"
#include "subject.hpp"
#include "support/random_grid.hpp"
#include "work.hpp"

namespace outrider::growth {
namespace {

constexpr double blocked_share = 0.2;

Problem across(int side, GridModel model) {
  Rng rng = stream("grid", side);
  Grid<std::uint8_t> grid = strewn(rng, side, side, blocked_share);
  constexpr int room = 6;  // free at either end
  for (int k = 0; k < room * room; ++k) {
    grid[{k % room, k / room}] = 0;
    grid[{side - 1 - k % room, side - 1 - k / room}] = 0;
  }
  const double end = side - 0.5;
  return {std::make_shared<const GridMap>(*GridMap::of(grid, model)), {0.5, 0.5}, {end, end}};
}

/// The first query on the ground, with all that is built for it.
template <class Planner, class Options>
std::vector<double> first_query(Planner planner, const Options& options, GridModel model, int side) {
  const Problem problem = across(side, model);
  Outcome<Plan> plan;
  const Work work = work_of([&] {
    Workspace workspace;
    plan = planner(problem, options, {}, workspace);
  });
  if (!plan) throw std::runtime_error(plan.error().sentence);
  return {static_cast<double>(plan->counters.expansions), work.blocks, work.peak_bytes};
}

double cells(double side) { return side * side; }
double sorted_cells(double side) { return cells(side) * std::log(cells(side)); }

template <class Planner, class Options>
Subject grid_subject(const std::string& name, Planner planner, const Options& options, GridModel model,
                     const std::vector<std::string>& sentences) {
  return {name,
          "map side, cells",
          "path/grid/" + name + ".hpp",
          {64, 128, 256, 512, 1024},
          {{"expansions", sentences[0], cells},
           {"blocks", sentences[1], sorted_cells},
           {"peak bytes", sentences[2], cells}},
          [=](int side) { return first_query(planner, options, model, side); }};
}

/// The same without the expansions: their share of the cells still grows at these sizes, as only some are
/// reached.
Subject without_expansions(Subject subject) {
  subject.claims.erase(subject.claims.begin());
  subject.run = [run = subject.run](int side) {
    const std::vector<double> counts = run(side);
    return std::vector<double>(counts.begin() + 1, counts.end());
  };
  return subject;
}

/// Polyanya's files are not compiled for counting.
Subject mesh_subject() {
  const auto run = [](int side) {
    return std::vector<double>{first_query(polyanya, PolyanyaOptions{}, GridModel::corners, side)[2]};
  };
  return {"polyanya",
          "map side, cells",
          "path/mesh/mesh.hpp",
          {64, 128, 256, 512, 1024},
          {{"peak bytes", "4 bytes per cell, 110 to 150 per corner of obstacles", cells}},
          run};
}

}  // namespace

std::vector<Subject> path_subjects() {
  const std::string all = "n vertices, at most the cells";
  const std::string log = "O(n log n) for n vertices";
  const std::string labels = "labels of the vertices reached";
  return {grid_subject("dijkstra", dijkstra, DijkstraOptions{}, GridModel::cells, {all, log, labels}),
          grid_subject("a_star", a_star, AStarOptions{}, GridModel::cells, {all, log, labels}),
          without_expansions(grid_subject("jps", jps, JpsOptions{}, GridModel::cells,
                                          {"", "the first query O(cells), and A*", "O(cells)"})),
          grid_subject("theta_star", theta_star, ThetaStarOptions{}, GridModel::corners, {all, log, labels}),
          mesh_subject()};
}

}  // namespace outrider::growth
