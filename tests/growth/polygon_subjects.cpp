// Visibility graphs and routes, as obstacles grow in number: small squares strewn over one yard.
#include <cmath>
#include <stdexcept>

#include "outrider/path/routes/routes.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "subject.hpp"
#include "work.hpp"

namespace outrider::growth {
namespace {

constexpr double yard_m = 40.0;
constexpr double square_m = 0.3;

/// Squares in cells of a lattice of the yard, of which the ends of the diagonal stay free.
std::vector<std::vector<Vec2>> squares(int count) {
  Rng rng = stream("squares", count);
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  const double pitch_m = (yard_m - 4.0) / side;
  std::vector<std::vector<Vec2>> all;
  for (int k = 0; k < count; ++k) {
    const Vec2 low{2.0 + pitch_m * (k % side) + rng.uniform(0.0, pitch_m - square_m),
                   2.0 + pitch_m * static_cast<double>(k / side) + rng.uniform(0.0, pitch_m - square_m)};
    const Vec2 high = low + Vec2{square_m, square_m};
    all.push_back({low, {high.x, low.y}, high, {low.x, high.y}});
  }
  return all;
}

using VisibilityPlanner = Outcome<Plan> (*)(const Problem&, const VisibilityOptions&, const Budget&,
                                            Workspace&);

std::vector<double> graph_counts(VisibilityPlanner planner, int count) {
  const auto ground =
      PolygonGround::of({{0, 0}, {yard_m, 0}, {yard_m, yard_m}, {0, yard_m}}, squares(count), 0.2);
  if (!ground) throw std::runtime_error(ground.error().sentence);
  const Problem problem{
      nullptr, {1, 1}, {yard_m - 1, yard_m - 1}, std::make_shared<const PolygonGround>(*ground)};
  Outcome<Plan> plan;
  const Work work = work_of([&] {
    Workspace workspace;
    plan = planner(problem, {}, {}, workspace);
  });
  if (!plan) throw std::runtime_error(plan.error().sentence);
  return {work.blocks, work.peak_bytes};
}

std::vector<double> ground_counts(int count) {
  const std::vector<std::vector<Vec2>> obstacles = squares(count);
  const Work work = work_of(
      [&] { (void)PolygonGround::of({{0, 0}, {yard_m, 0}, {yard_m, yard_m}, {0, yard_m}}, obstacles, 0.2); });
  return {work.blocks, work.peak_bytes};
}

CollisionMap yard_of(int count) {
  std::vector<RoundedPolygon> obstacles;
  for (const std::vector<Vec2>& corners : squares(count)) obstacles.push_back({corners, 0.0});
  return {{{0, 0}, {yard_m, yard_m}}, obstacles};
}

std::vector<double> corner_counts(int count) {
  const CollisionMap ground = yard_of(count);
  const Work work = work_of([&] { (void)find_corners(ground, {}, {}, {}, {}).value(); });
  return {work.blocks, work.peak_bytes};
}

std::vector<double> stop_counts(int stops) {
  const CollisionMap ground = yard_of(32);
  const Corners corners = find_corners(ground, {}, {}, {}, {}).value();
  Rng rng = stream("stops", stops);
  std::vector<Vec2> places;
  while (places.size() < static_cast<std::size_t>(stops)) {
    const Vec2 place{rng.uniform(1.0, yard_m - 1.0), rng.uniform(1.0, yard_m - 1.0)};
    if (ground.clearance(place, 1.0) > 0.5) places.push_back(place);
  }
  const Work work = work_of([&] { (void)routes_between(corners, places, {}).value(); });
  return {work.blocks, work.peak_bytes};
}

}  // namespace

std::vector<Subject> polygon_subjects() {
  const std::string visibility = "path/visibility/visibility_graph.hpp";
  const std::vector<int> sizes{16, 32, 64, 128, 256};
  const double nodes = 32.0 * 8.0;  // two corners at each of four rounded ones, to which stops are joined
  const auto by_stops = [=](double stops) { return stops * (nodes + stops); };
  return {
      {"polygon ground",
       "obstacles",
       "path/visibility/polygon_ground.hpp",
       sizes,
       {{"blocks", "O(n log n + n k), and an exact test O(n^2)", squared},
        {"peak bytes", "none is stated; held to the edges", [](double n) { return n; }}},
       ground_counts},
      {"visibility_graph",
       "obstacles",
       visibility,
       sizes,
       {{"blocks", "O(n^2 log n) for n arcs", [](double n) { return n * n * std::log(n); }},
        {"peak bytes", "48 bytes per leg and direction", squared}},
       [](int count) { return graph_counts(visibility_graph, count); }},
      {"visibility_graph_reduced",
       "obstacles",
       visibility,
       sizes,
       {{"blocks", "O(n^2) for n arcs", squared}, {"peak bytes", "48 bytes per leg and direction", squared}},
       [](int count) { return graph_counts(visibility_graph_reduced, count); }},
      {"find_corners",
       "obstacles",
       "path/routes/routes.hpp",
       sizes,
       {{"blocks", "O(n^2) exact sight tests", squared}, {"peak bytes", "O(n^2) memory at worst", squared}},
       corner_counts},
      {"routes_between",
       "stops",
       "path/routes/routes.hpp",
       {16, 32, 64, 128, 256},
       {{"blocks", "O(s (n + s)) sight tests, O(s n^2) relaxations", by_stops},
        {"peak bytes", "O(s n + s^2)", by_stops}},
       stop_counts}};
}

}  // namespace outrider::growth
