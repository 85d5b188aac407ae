// The catalogue of path planners: the rows of src/path/catalog.cpp, and those that a program adds. The
// command line tool, the web page, benchmarks, bindings, documentation and contract tests all read it.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/path/stored_index.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The class of paths for which the lower bound of a planner holds.
enum class PathClass {
  along_moves,    ///< paths along the eight moves of the grid
  any_direction,  ///< paths of straight legs between vertices, in any direction
  any_curve,      ///< all paths that the disk can drive on the ground
  widest_curve,   ///< those of them that keep the largest clearance, or the share of it that was asked for
  turning_curve,  ///< those of them that a robot with a turning radius can drive
  lattice_curve,  ///< those of them that consist of the motions of a lattice
};

/// The quantity that a planner minimises, which is the cost of its plans.
enum class Measure {
  length,     ///< length, m
  time,       ///< driving time, s
  safety,     ///< length plus weighted exposure (the integral of 1 / clearance), m eq
  terrain,    ///< length times the cost per metre of each cell, m eq
  manoeuvre,  ///< length plus the prices of cusps and of driving backwards, m eq
};
/// Returns the unit of a measure: "m", "s" or "m eq".
std::string_view unit_of(Measure measure);

/// The events that a planner reports to a Trace while it works.
enum class TraceKind {
  search,  ///< each expansion, and each state when it first enters the queue
  tree,    ///< each point that it connects to the start, with its parent; there is no queue
  lookup,  ///< nothing: it looks the answer up in an index
};
std::string_view to_string(TraceKind tells);

/// The guarantees of a planner with its default options.
struct Guarantee {
  bool complete = true;                        ///< finds a path whenever one exists on its ground
  PathClass among = PathClass::any_direction;  ///< class of its paths and of its lower bound
  double most_ratio = 1.0;    ///< cost <= most_ratio * least cost of the class; infinite: no guarantee
  std::string_view sentence;  ///< the guarantee in words
  Measure measure = Measure::length;  ///< quantity that it minimises
};

/// A planner with its own set of options.
struct ConfiguredPlanner {
  std::vector<Option> options;  ///< set them at any time; `plan` reads them at each call
  std::function<Outcome<Plan>(const Problem&, const Budget&, Workspace&)> plan;
  /// Plans from the start to each of several goals in one search. Empty if the planner has no such search.
  std::function<std::vector<Outcome<Plan>>(const Problem&, const std::vector<Vec2>& goals, const Budget&,
                                           Workspace&)>
      plan_many = nullptr;
  /// Returns the index of a ground as bytes; builds it if the workspace has none. Empty if the planner has no
  /// index that can be kept.
  std::function<Outcome<std::string>(const IndexedGround&, const Budget&, Workspace&)> save_index = nullptr;
  /// Puts such bytes into the workspace. Faults: bad_input with the remedy, for bytes that were made for
  /// another ground, other options or another planner, or are not whole.
  std::function<Status(const IndexedGround&, const StoredIndex&, Workspace&)> load_index = nullptr;
};

/// Plans from the start of the problem to each of the goals, in one search if the planner has one, otherwise
/// one goal after another.
std::vector<Outcome<Plan>> plan_each(const ConfiguredPlanner& planner, const Problem& problem,
                                     const std::vector<Vec2>& goals, const Budget& budget,
                                     Workspace& workspace);

/// A planner in the catalogue.
struct PathPlanner {
  std::string_view name;
  std::string_view sentence;                     ///< one sentence that says what the planner does
  std::string_view paper;                        ///< source of the algorithm
  Guarantee guarantee;                           ///< guarantee with the default options
  std::function<ConfiguredPlanner()> configure;  ///< makes a planner with default options
  std::vector<GridModel> models = {GridModel::cells, GridModel::corners};  ///< accepted grid models
  bool index = false;                   ///< builds an index at the first query on a ground and reuses it
  bool polygons = false;                ///< accepts polygons as ground
  TraceKind tells = TraceKind::search;  ///< events that it reports to a Trace
  bool axis = false;                    ///< searches the medial axis, which pictures show
  std::optional<Guarantee> on_polygons = std::nullopt;  ///< if it differs from that on grids
  bool incremental = false;  ///< repairs the search of the previous query: later queries count less work
  bool weighs = false;       ///< weighs the costs of the ground (Problem::costs)
  bool steers = false;       ///< plans poses for a robot that cannot turn in place; see Plan::steering

  /// Returns the guarantee on a kind of ground.
  [[nodiscard]] const Guarantee& guarantee_on(bool is_polygons) const {
    return is_polygons && on_polygons ? *on_polygons : guarantee;
  }

  /// Returns true if the planner accepts grids of that model; it refuses others with bad_input.
  [[nodiscard]] bool takes(GridModel model) const {
    return std::find(models.begin(), models.end(), model) != models.end();
  }
};

/// Returns all path planners, in the order of display.
const std::vector<PathPlanner>& path_planners();

/// Adds a row at the end, for all who read the catalogue later. Before the first thread starts.
void add_path_planner(PathPlanner row);

/// Returns the names of the planners of robots that turn in place: those that take such a grid, or all.
std::vector<std::string> names_of_planners_in_place(std::optional<GridModel> model = std::nullopt);

/// Returns the planner of that name. Fault: bad_input, with the nearest known name.
Outcome<PathPlanner> find_path_planner(std::string_view name);

/// Plans a path with the planner of that name, its default options and a new workspace. For many queries,
/// keep a ConfiguredPlanner and a Workspace instead. Faults: those of the planner; bad_input for an unknown
/// name.
Outcome<Plan> plan_path(const Problem& problem, std::string_view planner, const Budget& budget = {});

}  // namespace outrider
