// The catalogue of path planners. Command line, page, bench, bindings, documentation and the contract
// tests walk it; src/path/catalog.cpp is the only list.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The paths among which a planner claims its bound.
enum class PathClass {
  along_moves,    ///< along the eight moves of the grid
  any_direction,  ///< legs between vertices in any direction
  any_curve,      ///< whatever way the disk can go over the ground
};

/// What a planner makes least, and counts as the cost of a plan.
enum class Measure {
  length,  ///< m
  time,    ///< s
  safety,  ///< m eq: metres of length, and those that the integral of 1 / clearance counts as
};
std::string_view unit_of(Measure measure);

/// What a planner tells a Trace of how it found its answer.
enum class TraceKind {
  search,  ///< each expansion, and each state when it is first put into the queue
  tree,    ///< each point that it joined to the start, with its parent; it has no queue
  lookup,  ///< nothing: it finds its answer in an index, without a search
};
std::string_view to_string(TraceKind tells);

/// What a planner promises with its default options.
struct Guarantee {
  bool complete = true;                        ///< finds a path whenever the grid has one
  PathClass among = PathClass::any_direction;  ///< the class of its paths and of its lower bound
  double most_ratio = 1.0;  ///< cost <= most_ratio * the least of the class; infinite: none claimed
  std::string_view sentence;
  Measure measure = Measure::length;
};

/// A planner with an instance of its options, which `plan` reads at each call.
struct ConfiguredPlanner {
  std::vector<Option> options;
  std::function<Outcome<Plan>(const Problem&, const Budget&, Workspace&)> plan;
  /// From the start to each of the goals in one search; empty for planners that take one at a time.
  std::function<std::vector<Outcome<Plan>>(const Problem&, const std::vector<Vec2>& goals, const Budget&,
                                           Workspace&)>
      plan_many = nullptr;
};

/// From the start of the problem to each of the goals: in one search, or one after another.
std::vector<Outcome<Plan>> plan_each(const ConfiguredPlanner& planner, const Problem& problem,
                                     const std::vector<Vec2>& goals, const Budget& budget,
                                     Workspace& workspace);

struct PathPlanner {
  std::string_view name;
  std::string_view sentence;
  std::string_view paper;
  Guarantee guarantee;
  std::function<ConfiguredPlanner()> configure;
  std::vector<GridModel> models = {GridModel::cells, GridModel::corners};  ///< grids; others are bad_input
  bool index = false;     ///< builds something that outlasts the first query on a ground, for the next ones
  bool polygons = false;  ///< takes polygons as its ground
  TraceKind tells = TraceKind::search;

  [[nodiscard]] bool takes(GridModel model) const {
    return std::find(models.begin(), models.end(), model) != models.end();
  }
};

/// All of them, in the order of showing.
const std::vector<PathPlanner>& path_planners();

/// Fault: bad_input with the nearest known name.
Outcome<PathPlanner> find_path_planner(std::string_view name);

/// The path by the planner of that name, with its default options and fresh memory. For many questions keep
/// a ConfiguredPlanner and a Workspace. Faults: those of the planner; bad_input on an unknown name.
Outcome<Plan> plan_path(const Problem& problem, std::string_view planner, const Budget& budget = {});

}  // namespace outrider
