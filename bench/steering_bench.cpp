// Compares the planners of robots that steer on one generated yard of 20 x 20 m, and with planners over the
// paths of Reeds and Shepp by OMPL, where that is installed. The cost is the length alone. It measures times
// itself, and prints a table: of each planner the median and the worst time, and the mean of its cost over
// that of the best one.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <numeric>

#include "outrider/core/rng.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/steering/hybrid_a_star.hpp"
#include "outrider/path/steering/state_lattice.hpp"
#ifdef OUTRIDER_WITH_OMPL
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>
#endif

namespace outrider {
namespace {

constexpr std::size_t query_count = 24;
constexpr double radius_m = 0.5;
constexpr double yard_m = 20.0;

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

std::shared_ptr<const GridMap> yard() {
  Rng rng = Rng(3).child("yard");
  Grid<std::uint8_t> blocked(GridFrame{{}, 0.1, 200, 200});
  for (int i = 0; i < 60; ++i) {
    const int w = 1 + static_cast<int>(rng.below(24)), h = 1 + static_cast<int>(rng.below(24));
    const int x0 = static_cast<int>(rng.below(200)), y0 = static_cast<int>(rng.below(200));
    for (int y = y0; y < std::min(200, y0 + h); ++y) {
      for (int x = x0; x < std::min(200, x0 + w); ++x) blocked[{x, y}] = 1;
    }
  }
  return std::make_shared<const GridMap>(*GridMap::of(blocked, GridModel::cells));
}

SteeringOptions robot() {
  SteeringOptions robot;
  robot.turning_radius_m = radius_m;
  robot.cusp_price_m = 0.0;
  return robot;
}

/// Queries that hybrid_a_star answers for a robot with that outline, or for a disk.
std::vector<Problem> queries_on(const std::shared_ptr<const GridMap>& ground,
                                const std::vector<Vec2>& outline = {}) {
  Rng rng = Rng(5).child("queries");
  std::vector<Problem> queries;
  Workspace workspace;
  while (queries.size() < query_count) {
    const auto point = [&] { return Vec2{rng.uniform(0.5, yard_m - 0.5), rng.uniform(0.5, yard_m - 0.5)}; };
    Problem problem{ground, point(), point()};
    problem.start_heading_rad = rng.uniform(-3.0, 3.0);
    problem.goal_heading_rad = rng.uniform(-3.0, 3.0);
    problem.outline = outline;
    HybridAStarOptions options;
    options.steering = robot();
    if (hybrid_a_star(problem, options, {}, workspace)) queries.push_back(problem);
  }
  return queries;
}

/// An answer to each query: time, ms, and cost, infinite without one.
struct Answers {
  std::string name;
  std::vector<double> times_ms;
  std::vector<double> costs;
};

Answers measure(const std::string& name, const std::vector<Problem>& queries,
                const std::function<double(const Problem&)>& cost_of) {
  Answers answers{name, {}, {}};
  for (const Problem& problem : queries) {
    const auto begin = Clock::now();
    answers.costs.push_back(cost_of(problem));
    answers.times_ms.push_back(ms_since(begin));
  }
  return answers;
}

double checked(const Outcome<Plan>& plan, const Problem& problem) {
  if (!plan) return std::numeric_limits<double>::infinity();
  if (auto ok = check(*plan, problem); !ok) fmt::print("WRONG: {}\n", to_string(ok.error()));
  return plan->cost;
}

#ifdef OUTRIDER_WITH_OMPL
/// The length that a planner of OMPL finds in that time: RRT* uses all of it, RRT-Connect ends with its first
/// path, which is then shortened as OMPL does by default.
double ompl_length(const Problem& problem, double most_s, bool connect) {
  namespace ob = ompl::base;
  namespace og = ompl::geometric;
  auto space = std::make_shared<ob::ReedsSheppStateSpace>(radius_m);
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0.0);
  bounds.setHigh(yard_m);
  space->setBounds(bounds);
  og::SimpleSetup setup(space);
  const GridMap& ground = *problem.grid;
  setup.setStateValidityChecker([&](const ob::State* state) {
    const auto* pose = state->as<ob::SE2StateSpace::StateType>();
    return !ground.blocked(ground.frame.cell_at({pose->getX(), pose->getY()}));
  });
  space->setLongestValidSegmentFraction(0.5 * ground.frame.resolution_m / space->getMaximumExtent());
  ob::ScopedState<ob::ReedsSheppStateSpace> start(space), goal(space);
  start->setXY(problem.start.x, problem.start.y);
  start->setYaw(*problem.start_heading_rad);
  goal->setXY(problem.goal.x, problem.goal.y);
  goal->setYaw(*problem.goal_heading_rad);
  setup.setStartAndGoalStates(start, goal, 1e-6);
  const auto& plane = setup.getSpaceInformation();
  if (connect) setup.setPlanner(std::make_shared<og::RRTConnect>(plane));
  if (!connect) setup.setPlanner(std::make_shared<og::RRTstar>(plane));
  setup.solve(most_s);
  if (connect && setup.haveExactSolutionPath()) setup.simplifySolution();
  return setup.haveExactSolutionPath() ? setup.getSolutionPath().length()
                                       : std::numeric_limits<double>::infinity();
}
#endif

void print(const std::vector<Answers>& all) {
  std::vector<double> best(query_count, std::numeric_limits<double>::infinity());
  for (const Answers& answers : all) {
    for (std::size_t i = 0; i < query_count; ++i) best[i] = std::min(best[i], answers.costs[i]);
  }
  fmt::print("{:<34} {:>9} {:>10} {:>10} {:>12}\n", "planner", "answered", "median ms", "worst ms",
             "cost / best");
  for (const Answers& answers : all) {
    std::vector<double> times = answers.times_ms;
    std::ranges::sort(times);
    double ratio = 0.0;
    int answered = 0;
    for (std::size_t i = 0; i < query_count; ++i) {
      if (answers.costs[i] == std::numeric_limits<double>::infinity()) continue;
      ratio += answers.costs[i] / best[i];
      ++answered;
    }
    fmt::print("{:<34} {:>6}/{} {:>10.2f} {:>10.2f} {:>12.4f}\n", answers.name, answered, query_count,
               times[times.size() / 2], times.back(), ratio / std::max(1, answered));
  }
}

void run() {
  const auto ground = yard();
  const std::vector<Problem> queries = queries_on(ground);
  std::vector<Answers> all;
  for (const double weight : {1.0, 1.3, 2.0}) {
    HybridAStarOptions options;
    options.steering = robot();
    options.weight = weight;
    Workspace workspace;
    const auto plan = [&](const Problem& problem) {
      return checked(hybrid_a_star(problem, options, {}, workspace), problem);
    };
    if (weight == 1.3) all.push_back(measure("hybrid_a_star, first time", queries, plan));
    all.push_back(measure(fmt::format("hybrid_a_star, weight {}", weight), queries, plan));
  }
  for (const double weight : {1.0, 1.3, 2.0}) {
    StateLatticeOptions options;
    options.steering = robot();
    options.weight = weight;
    Workspace workspace;
    all.push_back(
        measure(fmt::format("state_lattice, weight {}", weight), queries, [&](const Problem& problem) {
          return checked(state_lattice(problem, options, {}, workspace), problem);
        }));
  }
#ifdef OUTRIDER_WITH_OMPL
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(1);
  all.push_back(measure("OMPL RRT-Connect, shortened", queries,
                        [](const Problem& problem) { return ompl_length(problem, 5.0, true); }));
  for (const double most_s : {1.0, 5.0}) {
    all.push_back(measure(fmt::format("OMPL RRT*, {} s", most_s), queries,
                          [&](const Problem& problem) { return ompl_length(problem, most_s, false); }));
  }
#endif
  print(all);
}

/// The same for a robot of 0.6 x 0.4 m, on queries of its own.
void run_outline() {
  const auto queries = queries_on(yard(), {{-0.1, -0.2}, {0.5, -0.2}, {0.5, 0.2}, {-0.1, 0.2}});
  std::vector<Answers> all;
  Workspace workspace;
  HybridAStarOptions hybrid;
  hybrid.steering = robot();
  all.push_back(measure("hybrid_a_star, 0.6 x 0.4 m", queries, [&](const Problem& problem) {
    return checked(hybrid_a_star(problem, hybrid, {}, workspace), problem);
  }));
  StateLatticeOptions lattice;
  lattice.steering = robot();
  lattice.weight = hybrid.weight;
  all.push_back(measure("state_lattice, 0.6 x 0.4 m", queries, [&](const Problem& problem) {
    return checked(state_lattice(problem, lattice, {}, workspace), problem);
  }));
  print(all);
}

}  // namespace
}  // namespace outrider

int main() {
  outrider::run();
  outrider::run_outline();
}
