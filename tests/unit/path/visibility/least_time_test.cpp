#include "outrider/path/visibility/least_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <queue>

#include "outrider/path/check.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "polygon_worlds.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::PolygonWorld;

std::shared_ptr<const PolygonGround> ground_of(const PolygonWorld& world) {
  auto ground = PolygonGround::of(world.boundary, world.obstacles, world.radius_m);
  EXPECT_TRUE(ground.has_value()) << ground.error().sentence;
  return std::make_shared<const PolygonGround>(std::move(*ground));
}

double ratio_of(const LeastTimeOptions& options) {
  const double half = 0.5 * options.arc_step_rad;
  return std::tan(half) / half;
}

double angle_between(Vec2 a, Vec2 b) { return std::abs(std::atan2(cross(a, b), dot(a, b))); }

/// The time of driving along the points, turning in place between.
double time_along(const std::vector<Vec2>& points, const LeastTimeOptions& options) {
  double length = 0.0, turning = 0.0;
  Vec2 faced = options.first_turn ? direction(options.heading_rad) : Vec2{};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec2 leg = points[i] - points[i - 1];
    length += norm(leg);
    if (faced != Vec2{}) turning += angle_between(faced, leg);
    faced = leg;
  }
  return length / options.speed_mps + options.turn_price_s_per_rad * turning;
}

/// Nodes close round every corner and anywhere else, all that see each other joined, and Dijkstra's
/// algorithm over pairs of nodes (where it is, whence it came). None of its paths may beat the planner.
class DenseOracle {
 public:
  DenseOracle(const PolygonWorld& world, Vec2 start, Vec2 goal, Rng& rng) : nodes_{start, goal} {
    const std::vector<Segment> edges = testing::edges_of(world);
    const auto free = [&](Vec2 p) { return testing::room(world, edges, p) >= world.radius_m; };
    for (const Segment& edge : edges) {
      for (int i = 0; i < 24; ++i) {
        const Vec2 p = edge.a + (1.0001 * world.radius_m / std::cos(pi / 24)) * direction(i * pi / 12);
        if (free(p)) nodes_.push_back(p);
      }
    }
    for (int i = 0; i < 30; ++i) {
      const Vec2 p = testing::random_place(rng, world);
      if (free(p)) nodes_.push_back(p);
    }
    const std::size_t n = nodes_.size();
    seen_.assign(n, {});
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        if (a == b || nodes_[a] == nodes_[b]) continue;
        const auto clear = [&](const Segment& edge) {
          return distance(Segment{nodes_[a], nodes_[b]}, edge) >= world.radius_m;
        };
        if (std::all_of(edges.begin(), edges.end(), clear)) seen_[a].push_back(b);
      }
    }
  }

  double least_time(const LeastTimeOptions& options) const {
    struct Arrival {
      double time;
      std::size_t from, at;
      bool operator<(const Arrival& other) const { return time > other.time; }
    };
    const std::size_t n = nodes_.size();
    std::vector<double> best(n * n, std::numeric_limits<double>::infinity());
    std::priority_queue<Arrival> open;
    const auto push = [&](double time, std::size_t from, std::size_t at) {
      if (time >= best[from * n + at]) return;
      best[from * n + at] = time;
      open.push({time, from, at});
    };
    for (const std::size_t b : seen_[0]) push(time_along({nodes_[0], nodes_[b]}, options), 0, b);
    LeastTimeOptions onwards = options;
    onwards.first_turn = true;
    while (!open.empty()) {
      const Arrival now = open.top();
      open.pop();
      if (now.at == 1) return now.time;
      if (now.time > best[now.from * n + now.at]) continue;
      onwards.heading_rad = heading_of(nodes_[now.at] - nodes_[now.from]);
      for (const std::size_t b : seen_[now.at]) {
        push(now.time + time_along({nodes_[now.at], nodes_[b]}, onwards), now.at, b);
      }
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  std::vector<Vec2> nodes_;
  std::vector<std::vector<std::size_t>> seen_;
};

LeastTimeOptions random_options(Rng& rng) {
  LeastTimeOptions options;
  options.speed_mps = rng.uniform(0.2, 3.0);
  options.turn_price_s_per_rad = rng.uniform(0.0, 6.0);
  options.first_turn = rng.below(2) == 0;
  options.heading_rad = rng.uniform(-pi, pi);
  return options;
}

TEST(LeastTime, NoPathOfADenseGraphIsFaster) {
  Rng rng = Rng(31).child("dense");
  Workspace workspace;
  int joined = 0, near = 0, other_way = 0;
  for (int i = 0; i < testing::cases(500); ++i) {
    PolygonWorld world = testing::scattered_world(rng, 3);
    world.radius_m = std::max(world.radius_m, 0.1);
    const Problem problem{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                          ground_of(world)};
    const LeastTimeOptions options = random_options(rng);
    const auto answer = least_time(problem, options, {}, workspace);
    if (!answer || problem.start == problem.goal) continue;
    ++joined;
    const double dense = DenseOracle(world, problem.start, problem.goal, rng).least_time(options);
    ASSERT_GE(dense, answer->lower_bound - 1e-9) << "world " << i;
    if (dense <= 1.02 * answer->lower_bound) ++near;
    const auto shortest = visibility_graph_reduced(problem, {}, {}, workspace);
    if (length_of(*answer) > 1.01 * shortest->cost) ++other_way;
  }
  EXPECT_GT(joined, 150);
  EXPECT_GT(near, 9 * joined / 10);  // so the bound is no empty one
  EXPECT_GT(other_way, 0);
}

TEST(LeastTime, ItsLegsTakeTheTimeThatItStatesWithinTheRatio) {
  Rng rng = Rng(32).child("ratio");
  Workspace workspace;
  int bent = 0;
  for (int i = 0; i < testing::cases(400); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const Problem problem{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                          ground_of(world)};
    LeastTimeOptions options = random_options(rng);
    options.arc_step_rad = radians(rng.uniform(1.0, 90.0));
    const auto answer = least_time(problem, options, {}, workspace);
    const auto shortest = visibility_graph_reduced(problem, {}, {}, workspace);
    ASSERT_EQ(answer.has_value(), shortest.has_value());
    if (!answer) {
      EXPECT_EQ(answer.error().sentence, shortest.error().sentence);
      continue;
    }
    const auto verdict = check(*answer, problem);
    ASSERT_TRUE(verdict.has_value()) << "world " << i << ": " << verdict.error().sentence;
    EXPECT_LE(answer->cost, ratio_of(options) * answer->lower_bound + 1e-9) << "world " << i;
    EXPECT_GE(answer->lower_bound * options.speed_mps, shortest->cost * (1.0 - 1e-9)) << "world " << i;
    const bool straight = std::all_of(answer->pieces.begin(), answer->pieces.end(),
                                      [](const PathPiece& piece) { return piece.turn_rad == 0.0; });
    if (!straight) continue;
    const double slack = 1e-6 * (1.0 + answer->cost);  // short legs have rounded headings
    EXPECT_NEAR(answer->cost, time_along(answer->waypoints, options), slack) << "world " << i;
    if (answer->waypoints.size() > 2) ++bent;
    Plan cheaper = *answer;
    cheaper.cost -= 1e-3 * (1.0 + cheaper.cost);
    EXPECT_FALSE(check(cheaper, problem).has_value());
  }
  EXPECT_GT(bent, 40);
}

TEST(LeastTime, WithoutAPriceOfTurningItIsTheShortestPath) {
  Rng rng = Rng(33).child("free turns");
  Workspace workspace;
  for (int i = 0; i < testing::cases(200); ++i) {
    const PolygonWorld world = testing::random_world(rng);
    const Problem problem{nullptr, testing::random_place(rng, world), testing::random_place(rng, world),
                          ground_of(world)};
    LeastTimeOptions options;
    options.speed_mps = 0.5;
    options.turn_price_s_per_rad = 0.0;
    const auto answer = least_time(problem, options, {}, workspace);
    const auto shortest = visibility_graph_reduced(problem, {}, {}, workspace);
    ASSERT_EQ(answer.has_value(), shortest.has_value());
    if (answer) {
      EXPECT_NEAR(answer->lower_bound, 2.0 * shortest->cost, 1e-9 * (1.0 + shortest->cost));
    }
  }
}

TEST(LeastTime, RoundOneCornerTheTimeIsKnown) {
  Workspace workspace;
  PolygonWorld world{{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}, {{{-5, -5}, {0, -5}, {0, 0}, {-5, 0}}}, 0.5};
  const Problem problem{nullptr, {-3, 0.5}, {0.5, -3}, ground_of(world)};
  LeastTimeOptions options{2.0, 3.0, true, radians(90.0), radians(10.0)};
  const auto answer = least_time(problem, options, {}, workspace);
  ASSERT_TRUE(answer.has_value());
  // A quarter turn to face east, 3 m, a quarter round the corner, 3 m.
  EXPECT_NEAR(answer->lower_bound, (6.0 + 0.25 * pi) / 2.0 + 3.0 * pi, 1e-12);
  EXPECT_NEAR(answer->cost, (6.0 + 9.0 * std::tan(radians(5.0))) / 2.0 + 3.0 * pi, 1e-12);
  EXPECT_EQ(answer->waypoints.size(), 13U);  // nine turns, and where the legs meet the arc
}

TEST(LeastTime, TakesALongerWayWithFewerTurns) {
  // A slalom of three posts reaches from wall to wall; a plain way leads round the long wall above it.
  PolygonWorld world;
  world.boundary = {{0, 0}, {20, 0}, {20, 12}, {0, 12}};
  world.obstacles = {{{2, 7}, {18, 7}, {18, 7.5}, {2, 7.5}}};
  for (const double x : {4.0, 9.0, 14.0})
    world.obstacles.push_back({{x, 0}, {x + 0.5, 0}, {x + 0.5, 6}, {x, 6}});
  for (const double x : {6.5, 11.5}) world.obstacles.push_back({{x, 1}, {x + 0.5, 1}, {x + 0.5, 7}, {x, 7}});
  world.radius_m = 0.2;
  const Problem problem{nullptr, {1, 6.5}, {19, 6.5}, ground_of(world)};
  Workspace workspace;
  LeastTimeOptions options;
  options.speed_mps = 1.0;
  double length = 0.0, before = 0.0;
  for (const double price : {0.0, 0.1, 1.0, 10.0}) {
    options.turn_price_s_per_rad = price;
    const auto answer = least_time(problem, options, {}, workspace);
    ASSERT_TRUE(answer.has_value());
    length = length_of(*answer);
    EXPECT_GE(length, before - 0.01) << price;
    before = std::max(before, length);
  }
  const auto shortest = visibility_graph_reduced(problem, {}, {}, workspace);
  EXPECT_LT(length, 2.0 * shortest->cost);
}

TEST(LeastTime, RefusesBadPrices) {
  const Problem any{
      nullptr, {0, 0}, {1, 1}, ground_of(testing::PolygonWorld{{{-5, -5}, {5, -5}, {5, 5}}, {}})};
  Workspace workspace;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const LeastTimeOptions& options :
       {LeastTimeOptions{0.0}, LeastTimeOptions{nan}, LeastTimeOptions{1.0, -1.0}, LeastTimeOptions{1.0, nan},
        LeastTimeOptions{1.0, 1.0, true, nan}, LeastTimeOptions{1.0, 1.0, false, 0.0, 0.0}}) {
    EXPECT_EQ(least_time(any, options, {}, workspace).error().code, FaultCode::bad_input);
    EXPECT_EQ(least_time_many(any, {{0, 0}}, options, {}, workspace)[0].error().code, FaultCode::bad_input);
  }
}

}  // namespace
}  // namespace outrider
