#include "peers.hpp"

#ifdef OUTRIDER_WITH_OMPL
#include <memory>

#include "outrider/core/rng.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "research/path/sampling.hpp"
#endif

namespace outrider::bench {

#ifndef OUTRIDER_WITH_OMPL

std::vector<PeerRow> polygon_rows() { return {}; }

#else

namespace {

constexpr double yard_m = 20.0;
constexpr std::size_t query_count = 20;

std::vector<Vec2> box(Vec2 low, Vec2 size) {
  return {low, {low.x + size.x, low.y}, {low.x + size.x, low.y + size.y}, {low.x, low.y + size.y}};
}

std::shared_ptr<const PolygonGround> yard() {
  constexpr int boxes = 60;
  Rng rng = Rng(4).child("yard");
  std::vector<std::vector<Vec2> > obstacles;
  for (int i = 0; i < boxes; ++i) {
    const Vec2 size{rng.uniform(0.3, 2.0), rng.uniform(0.3, 2.0)};
    obstacles.push_back(box({rng.uniform(0.0, yard_m - size.x), rng.uniform(0.0, yard_m - size.y)}, size));
  }
  constexpr double radius_m = 0.2;
  return std::make_shared<const PolygonGround>(
      *PolygonGround::of(box({}, {yard_m, yard_m}), obstacles, radius_m));
}

std::vector<Problem> queries_on(const std::shared_ptr<const PolygonGround>& ground,
                                const ConfiguredPlanner& planner) {
  Rng rng = Rng(5).child("queries");
  Workspace workspace;
  std::vector<Problem> queries;
  while (queries.size() < query_count) {
    const auto place = [&] { return Vec2{rng.uniform(0.5, yard_m - 0.5), rng.uniform(0.5, yard_m - 0.5)}; };
    const Vec2 start = place(), goal = place();
    const Problem problem{.grid = nullptr, .start = start, .goal = goal, .polygons = ground};
    if (planner.plan(problem, {}, workspace)) queries.push_back(problem);
  }
  return queries;
}

}  // namespace

std::vector<PeerRow> polygon_rows() {
  add_sampling_planners();
  const auto ground = yard();
  const auto queries = queries_on(ground, find_path_planner("visibility_graph")->configure());
  std::vector<PeerRow> rows;
  for (const char* name : {"visibility_graph", "prm_star", "rrt_star", "bit_star"}) {
    const ConfiguredPlanner planner = find_path_planner(name)->configure();
    Workspace workspace;
    (void)planner.plan(queries.front(), {}, workspace);
    const bool ours = name == std::string("visibility_graph");
    const std::string solver = ours ? name : std::string("OMPL, ") + name;
    rows.push_back(measure("a disk of 0.2 m among 60 boxes, 20 x 20 m", solver,
                           ours ? Whose::ours : Whose::sampling_peer, queries.size(), 1, [&](std::size_t i) {
                             const auto plan = planner.plan(queries[i], {}, workspace);
                             return plan && check(*plan, queries[i])
                                        ? plan->cost
                                        : std::numeric_limits<double>::infinity();
                           }));
  }
  return rows;
}

#endif

}  // namespace outrider::bench
