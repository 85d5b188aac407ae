// The plane as OMPL sees it: where the disk may stand and move, and where points are drawn.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <map>
#include <utility>

#include "outrider/core/budget.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/path/problem.hpp"

namespace outrider {

Vec2 point_of(const ompl::base::State* state);
void place_at(ompl::base::State* state, Vec2 p);

/// Points in the order in which they were first met.
struct Met {
  std::map<std::pair<double, double>, std::size_t> order{};

  void meet(Vec2 p) { order.try_emplace({p.x, p.y}, order.size()); }
};

/// The points of one query, all from one stream; each is an expansion.
struct Draws {
  const Problem& problem;
  Rng rng;
  std::uint64_t most;
  BudgetMeter meter;
  Met* met = nullptr;    ///< of the ends of motions, where somebody asks
  bool refused = false;  ///< the budget was too small for the next one
  bool over = false;     ///< one more than `most` was asked for

  [[nodiscard]] bool ended() const { return refused || over; }
  /// Anywhere within the bounds of the ground.
  Vec2 anywhere();
  /// In the ellipse of the points on paths of at most that length.
  Vec2 within(double length);

 private:
  void count();
};

/// The area of that ellipse, m^2.
double area_within(const Problem& problem, double length);

/// Everything that a planner of OMPL needs to know of the ground. The draws outlive it.
ompl::base::SpaceInformationPtr free_plane(Draws& draws);

/// The length of the path; its informed samples are those of the draws.
ompl::base::OptimizationObjectivePtr path_length(const ompl::base::SpaceInformationPtr& plane, Draws& draws);

}  // namespace outrider
