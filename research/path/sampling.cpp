#include "research/path/sampling.hpp"

#include <fmt/format.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>

#include <limits>

#include "outrider/path/catalog.hpp"
#include "research/path/sampling_space.hpp"
#include "research/path/sampling_tree.hpp"
#include "with_options.hpp"

namespace outrider {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr std::int64_t most_iterations = 20'000;

/// PRM* without timing: OMPL grows and searches by the clock in two threads; this class first grows, then
/// searches.
struct PrmStar : og::PRMstar {
  PrmStar(const ob::SpaceInformationPtr& plane, std::uint64_t /*seed*/) : PRMstar(plane) {}
  ob::PlannerStatus solve(const ob::PlannerTerminationCondition& ended) override {
    checkValidity();
    const Vertex start = addMilestone(si_->cloneState(pis_.nextStart()));
    const Vertex goal = addMilestone(si_->cloneState(pis_.nextGoal()));
    growRoadmap(ended);
    if (!sameComponent(start, goal)) return ob::PlannerStatus::TIMEOUT;
    pdef_->addSolutionPath(constructSolution(start, goal), false, 0.0, getName());
    return ob::PlannerStatus::EXACT_SOLUTION;
  }
};

/// RRT* that decides by its own random draws when to try the goal.
struct RrtStar : og::RRTstar {
  RrtStar(const ob::SpaceInformationPtr& plane, std::uint64_t seed) : RRTstar(plane) {
    rng_.setLocalSeed(static_cast<std::uint_fast32_t>(seed & 0xffffffffU));
  }
};

struct BitStar : og::BITstar {
  BitStar(const ob::SpaceInformationPtr& plane, std::uint64_t /*seed*/) : BITstar(plane) {}
};

Status check_options(const SamplingOptions& options) {
  if (options.iterations >= 1 && options.iterations <= most_iterations) return {};
  return bad_input(fmt::format("{} is not valid; expected 1 to {}", options.iterations, most_iterations),
                   "iterations");
}

Plan plan_through(const std::vector<Vec2>& points, const Draws& draws) {
  Plan plan;
  plan.waypoints = {draws.problem.start};
  for (const Vec2 p : points) {
    const Vec2 from = plan.waypoints.back();
    if (p == from) continue;
    plan.waypoints.push_back(p);
    plan.pieces.push_back({from, p, {}, 0.0});
    plan.cost += distance(from, p);
  }
  plan.lower_bound = std::min(plan.cost, distance(draws.problem.start, draws.problem.goal));
  plan.counters.expansions = plan.counters.generated = draws.meter.spent();
  return plan;
}

ob::ProblemDefinitionPtr definition_of(const ob::SpaceInformationPtr& plane, Draws& draws) {
  auto definition = std::make_shared<ob::ProblemDefinition>(plane);
  ob::ScopedState<> start(plane), goal(plane);
  place_at(start.get(), draws.problem.start);
  place_at(goal.get(), draws.problem.goal);
  definition->setStartAndGoalStates(start, goal);
  definition->setOptimizationObjective(path_length(plane, draws));
  return definition;
}

template <class Planner>
Outcome<Plan> sample(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                     Workspace& workspace) {
  if (auto good = check_options(options); !good) return pass_on(good);
  if (auto ground = polygon_query(problem); !ground) return pass_on(ground);
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  Rng rng = Rng(static_cast<std::uint64_t>(options.seed)).child("sampling");
  const std::uint64_t own_seed = rng.bits();
  Met met;
  Draws draws{problem, rng, static_cast<std::uint64_t>(options.iterations), BudgetMeter(budget),
              workspace.trace != nullptr ? &met : nullptr};
  if (problem.start == problem.goal) return plan_through({}, draws);
  const ob::SpaceInformationPtr plane = free_plane(draws);
  const ob::ProblemDefinitionPtr definition = definition_of(plane, draws);
  Planner planner(plane, own_seed);
  planner.setProblemDefinition(definition);
  planner.setup();
  planner.solve(ob::PlannerTerminationCondition([&draws] { return draws.ended(); }));
  if (workspace.trace != nullptr) trace_tree(planner, problem, met, *workspace.trace);
  if (draws.refused) return draws.meter.refusal();
  if (!definition->hasExactSolution()) {
    return fault(FaultCode::budget_exhausted,
                 fmt::format("{} points join no path, which does not prove that there is none; raise "
                             "'iterations', or take visibility_graph, which proves it",
                             options.iterations));
  }
  std::vector<Vec2> points;
  for (const ob::State* state : definition->getSolutionPath()->as<og::PathGeometric>()->getStates()) {
    points.push_back(point_of(state));
  }
  return plan_through(points, draws);
}

}  // namespace

std::vector<Option> describe(SamplingOptions& options) {
  return {{"iterations", "", 1.0, static_cast<double>(most_iterations),
           "points drawn before the best path is the answer", &options.iterations},
          {"seed", "", 0.0, 9007199254740992.0, "of the points", &options.seed}};
}

Outcome<Plan> prm_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace) {
  return sample<PrmStar>(problem, options, budget, workspace);
}

Outcome<Plan> rrt_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace) {
  return sample<RrtStar>(problem, options, budget, workspace);
}

Outcome<Plan> bit_star(const Problem& problem, const SamplingOptions& options, const Budget& budget,
                       Workspace& workspace) {
  return sample<BitStar>(problem, options, budget, workspace);
}

void add_sampling_planners() {
  const Guarantee guarantee = {
      .complete = false,
      .among = PathClass::any_curve,
      .most_ratio = std::numeric_limits<double>::infinity(),
      .sentence = "asymptotically complete and optimal; nothing is proven after finitely many points"};
  const auto add = [&](std::string_view name, std::string_view sentence, std::string_view paper,
                       Planner<SamplingOptions> planner) {
    add_path_planner({.name = name,
                      .sentence = sentence,
                      .paper = paper,
                      .guarantee = guarantee,
                      .configure = with_options(planner),
                      .models = {},
                      .polygons = true,
                      .tells = TraceKind::tree});
  };
  const std::string_view karaman =
      "Karaman and Frazzoli, Sampling-based algorithms for optimal motion planning, 2011";
  add("prm_star", "Joins random free points with their neighbours, then searches that roadmap (OMPL).",
      karaman, prm_star);
  add("rrt_star", "Grows a tree over random free points and rewires it where that is shorter (OMPL).",
      karaman, rrt_star);
  add("bit_star", "Tries the edges between batches of random points, the most promising first (OMPL).",
      "Gammell, Srinivasa and Barfoot, Batch informed trees (BIT*), 2015", bit_star);
}

}  // namespace outrider
