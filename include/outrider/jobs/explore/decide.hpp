// Where to go next in order to map the unknown.
//
// Every frontier has views: poses that the robot can reach on the known ground and from which the unknown
// cells beside the frontier are in sight, within range (explore/view.hpp). A row of the catalogue
// (explore/catalog.hpp) chooses among them; the way there is planned by an ordinary path planner on the known
// ground and pulled straight. Ask again whenever the map has changed: the robot need not arrive, and the
// choice before has a bonus, so that it does not swing between two of like worth. Each change of mind that
// leaves its frontier behind doubles the bonus, until something has come of a choice: it swings for ever
// between no two.
//
// A decision goes over the map only as far as it must: until enough views are reached. What it finds out of
// the surroundings of frontiers, and of the ways between views, is kept with the map; the former while
// nothing changes there, the latter for a few decisions (a tour makes anew as many as a bounded effort lets).
// Same map with the same past, same decision; it notes on the map which frontier is pursued
// (FrontierMap::pursue). Thread rule: one map and one workspace a thread. Sources: as in explore/catalog.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/jobs/explore/blacklist.hpp"
#include "outrider/jobs/explore/frontier.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct ExploreOptions {
  std::string strategy = "tour";  ///< row of explore/catalog.hpp
  std::string planner = "jps";    ///< row of path/catalog.hpp that takes the model `cells`
  FrontierOptions frontier;
  double view_m = 2.5;           ///< a view is no farther than this from what it is to see
  double least_gain_m2 = 0.05;   ///< what hides less is not worth a drive
  double momentum_s = 4.0;       ///< bonus of the choice before
  double most_extent_m = 500.0;  ///< a map wider or higher than this leaks
  double ban_s = 30.0;           ///< see Blacklist
  std::int64_t most_views = 16;  ///< nearest frontiers that a decision weighs
};

std::vector<Option> describe(ExploreOptions& options);

/// What was chosen before.
struct ExploreChoice {
  std::uint32_t frontier = 0;  ///< 0: none
  Vec2 place;
  int swings = 0;  ///< changes of mind in a row that left a frontier behind as it was
};

struct ExploreState {
  FrontierMap& map;  ///< its ground for the planners is brought up to date
  const Blacklist& blacklist;
  const RobotModel& robot;
  double range_m = 3.5;  ///< of the range finder
  Pose2 pose;
  Pose2 home;
  double time_s = 0.0;
  ExploreChoice before = {};
};

enum class DecisionKind : std::uint8_t {
  go,        ///< to the goal, in order to see more
  complete,  ///< no frontier is left that can be reached and is worth it: go home
  leak,      ///< the map has grown beyond what was said to be its extent: the world is open
};
std::string_view to_string(DecisionKind kind);

struct RefusedFrontier {
  std::uint32_t frontier = 0;
  Vec2 centroid;
  std::size_t cells = 0;
  std::string reason;  ///< a sentence
};

struct Decision {
  DecisionKind kind = DecisionKind::complete;
  std::string sentence;  ///< why
  ExploreChoice choice;
  Pose2 goal;                            ///< facing what is to be seen; home when nothing is
  std::vector<Vec2> waypoints;           ///< from the pose to the goal; empty when there is no way
  double way_m = 0.0;                    ///< length of it
  double gain_m2 = 0.0;                  ///< unknown area that the goal is expected to show
  std::vector<RefusedFrontier> refused;  ///< by id; those passed over because others are nearer are not
};

/// Faults: bad_input on an unknown strategy or planner; start_blocked when no known free ground is within
/// 0.5 m of the robot.
Outcome<Decision> decide(const ExploreState& state, const ExploreOptions& options, Workspace& workspace);

/// The way from the pose of the state to a place on the known ground, pulled straight. A robot or a place
/// that stands on blocked ground is first led to the nearest free cell within 0.5 m. Faults: those of the
/// planner.
Outcome<std::vector<Vec2>> way_to(const ExploreState& state, Vec2 place, const ExploreOptions& options,
                                  Workspace& workspace);

}  // namespace outrider
