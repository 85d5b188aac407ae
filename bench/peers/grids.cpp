#include <fmt/format.h>

#include <algorithm>
#include <boost/version.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "boost_search.hpp"
#include "lemon_search.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "peers.hpp"

namespace outrider::bench {
namespace {

constexpr int side = 512;
constexpr std::size_t query_count = 60;
constexpr int rounds = 3;

Grid<std::uint8_t> blocks() {
  constexpr int count = 700, largest = 30;
  Rng rng = Rng(1).child("blocks");
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, side, side});
  for (int i = 0; i < count; ++i) {
    const int x = static_cast<int>(rng.below(side)), y = static_cast<int>(rng.below(side));
    const int right = std::min(side, x + 1 + static_cast<int>(rng.below(largest)));
    const int top = std::min(side, y + 1 + static_cast<int>(rng.below(largest)));
    for (Cell c{x, y}; c.y < top; ++c.y) {
      for (c.x = x; c.x < right; ++c.x) grid[c] = 1;
    }
  }
  return grid;
}

Grid<std::uint8_t> strewn() {
  constexpr double share = 0.1;
  Rng rng = Rng(2).child("strewn");
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, side, side});
  for (std::uint8_t& cell : grid.cells) cell = rng.uniform() < share ? 1 : 0;
  return grid;
}

MoveGraph graph_of(const GridMap& ground) {
  MoveGraph graph{.side = side};
  for (int v = 0; v < side * side; ++v) {
    const Cell from{v % side, v / side};
    for (std::size_t m = 0; m < grid_moves.size(); ++m) {
      if ((ground.moves[ground.index(from)] >> m & 1U) == 0) continue;
      graph.arcs.emplace_back(v, v + grid_moves[m].y * side + grid_moves[m].x);
      graph.lengths.push_back(m < 4 ? 1.0 : std::numbers::sqrt2);
    }
  }
  return graph;
}

/// Queries with an answer between random places.
std::vector<Problem> queries_on(const std::shared_ptr<const GridMap>& ground,
                                const ConfiguredPlanner& planner) {
  Rng rng = Rng(3).child("queries");
  Workspace workspace;
  std::vector<Problem> queries;
  const auto place = [&] {
    while (true) {
      const Cell c{static_cast<int>(rng.below(side)), static_cast<int>(rng.below(side))};
      if (ground->place(c)) return ground->point(c);
    }
  };
  while (queries.size() < query_count) {
    const Problem problem{ground, place(), place()};
    if (planner.plan(problem, {}, workspace)) queries.push_back(problem);
  }
  return queries;
}

std::vector<PeerRow> rows_on(const std::string& task, const Grid<std::uint8_t>& blocked) {
  const auto ground = std::make_shared<const GridMap>(*GridMap::of(blocked, GridModel::cells));
  const auto queries = queries_on(ground, find_path_planner("jps")->configure());
  std::vector<PeerRow> rows;
  for (const char* name : {"dijkstra", "a_star", "jps", "jps_plus", "octile_labels"}) {
    const ConfiguredPlanner planner = find_path_planner(name)->configure();
    Workspace workspace;
    (void)planner.plan(queries.front(), {}, workspace);  // prepares the map, as the graphs below are prepared
    std::vector<Outcome<Plan>> plans(queries.size(), Plan{});
    rows.push_back(measure(task, name, Whose::ours, queries.size(), rounds, [&](std::size_t i) {
      plans[i] = planner.plan(queries[i], {}, workspace);
      return plans[i] ? plans[i]->cost : std::numeric_limits<double>::infinity();
    }));
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (!plans[i] || !check(*plans[i], queries[i])) rows.back().costs[i] = std::nan("");
    }
  }
  const MoveGraph graph = graph_of(*ground);
  const auto vertex = [&](Vec2 p) {
    const Cell c = *ground->vertex_at(p);
    return c.y * side + c.x;
  };
  const auto add = [&](const std::string& solver, const std::function<double(int, int)>& search) {
    rows.push_back(measure(task, solver, Whose::exact_peer, queries.size(), rounds, [&](std::size_t i) {
      return search(vertex(queries[i].start), vertex(queries[i].goal));
    }));
  };
  BoostSearch boost_search(graph);
  const std::string boost =
      fmt::format("Boost.Graph {}.{}, ", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000);
  add(boost + "dijkstra_shortest_paths", [&](int s, int g) { return boost_search.dijkstra(s, g); });
  add(boost + "astar_search", [&](int s, int g) { return boost_search.a_star(s, g); });
#ifdef OUTRIDER_WITH_LEMON
  LemonSearch lemon_search(graph);
  add("LEMON, Dijkstra", [&](int s, int g) { return lemon_search.dijkstra(s, g); });
#endif
  return rows;
}

}  // namespace

std::vector<PeerRow> grid_rows() {
  auto rows = rows_on("shortest paths on 512 x 512 cells with blocks", blocks());
  for (PeerRow& row : rows_on("shortest paths on 512 x 512 cells, a tenth blocked", strewn())) {
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace outrider::bench
