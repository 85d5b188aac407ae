// The plane as a state space of OMPL: free positions and motions, and the source of random points.
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

/// Points in the order in which they first occurred.
struct Met {
  std::map<std::pair<double, double>, std::size_t> order{};

  void meet(Vec2 p) { order.try_emplace({p.x, p.y}, order.size()); }
};

/// The random points of one query, all from one random stream; each point is an expansion.
struct Draws {
  const Problem& problem;
  Rng rng;
  std::uint64_t most;
  BudgetMeter meter;
  Met* met = nullptr;    ///< records the ends of motions, if set
  bool refused = false;  ///< the budget was too small for the next point
  bool over = false;     ///< more than `most` points were requested

  [[nodiscard]] bool ended() const { return refused || over; }
  /// Returns a point within the bounds of the ground.
  Vec2 anywhere();
  /// Returns a point in the ellipse of the points on paths of at most that length.
  Vec2 within(double length);

 private:
  void count();
};

/// Returns the area of that ellipse, m^2.
double area_within(const Problem& problem, double length);

/// Returns the space information for a planner of OMPL. The draws must outlive it.
ompl::base::SpaceInformationPtr free_plane(Draws& draws);

/// Returns the path length as objective; its informed samples come from the draws.
ompl::base::OptimizationObjectivePtr path_length(const ompl::base::SpaceInformationPtr& plane, Draws& draws);

}  // namespace outrider
