// decide(): chooses the next goal of an exploration.
//
// Every frontier has views: poses that the robot can reach on known free cells and from which it sees the
// unknown cells beside the frontier within range (choose/view.hpp). A strategy of the catalogue
// (choose/catalog.hpp) chooses one of them. A path planner plans the path on the known cells, and the path
// is pulled straight. Call decide() again whenever the map has changed; the robot need not arrive first.
//
// The previous choice gets a bonus, so the robot does not switch between two goals of similar value. Each
// switch that leaves the previous frontier unseen doubles the bonus, until the robot has seen its goal or
// failed. So the robot never oscillates between two frontiers.
//
// A decision searches the map only until enough views are reached. Results about the surroundings of
// frontiers are kept with the map until something changes there. Travel times between views are kept for a
// few decisions; each decision computes as many of them again as a bounded effort allows. The same map with
// the same past gives the same decision. A decision marks the pursued frontier on the map
// (FrontierMap::pursue). Thread rule: one map and one workspace for each thread. Sources: as in
// choose/catalog.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/explore/choose/blacklist.hpp"
#include "outrider/jobs/explore/map/frontier.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of the decisions.
struct ExploreOptions {
  std::string strategy = "tour";  ///< name of a row of choose/catalog.hpp
  std::string planner = "jps";    ///< name of a path planner for the model `cells`
  FrontierOptions frontier;       ///< of the frontier map
  double view_m = 2.5;            ///< largest distance from a view to the unknown cells that it sees
  double least_gain_m2 = 0.1;     ///< frontiers with less unknown area are refused
  double least_left_m2 = 0.25;    ///< less unknown area in sight of a frontier that cannot be seen is nothing
  double least_opening_m = 0.2;   ///< a narrower frontier is a gap in a wall, which noise leaves
  double gap_margin_m = 0.015;    ///< room to either side of the robot without which it enters no gap
  double momentum_s = 4.0;        ///< bonus of the previous choice
  double most_extent_m = 500.0;   ///< a wider or higher map counts as an open world
  double ban_s = 30.0;            ///< duration of the first ban of a failed goal; see Blacklist
  std::int64_t most_views = 16;   ///< number of nearest frontiers that a decision compares
};

/// Describes the options by name.
std::vector<Option> describe(ExploreOptions& options);

/// The previous choice.
struct ExploreChoice {
  std::uint32_t frontier = 0;  ///< 0: none
  Vec2 place;                  ///< the chosen view
  int switches = 0;            ///< consecutive switches that left the previous frontier unseen
};

/// The state of the robot and the map at a decision.
struct ExploreState {
  FrontierMap& map;  ///< decisions update its grid for the planners
  const Blacklist& blacklist;
  const RobotModel& robot;
  double range_m = 3.5;  ///< of the range finder
  Pose2 pose;            ///< current pose
  Pose2 home;            ///< where the robot returns to in the end
  double time_s = 0.0;
  ExploreChoice before = {};
  Budget budget = {};  ///< of each path
};

/// The kind of a decision.
enum class DecisionKind : std::uint8_t {
  go,        ///< drive to the goal to see more
  complete,  ///< no reachable frontier with enough unknown area is left: go home
  leak,      ///< the map exceeds most_extent_m: the world is open
};
std::string_view to_string(DecisionKind kind);

/// The reason why a frontier is not visited.
enum class Refusal : std::uint8_t {
  closed,    ///< the robot fits nowhere into it, or nowhere in sight of it
  no_way,    ///< no known way leads to where it would be seen
  banned,    ///< going there failed lately
  given_up,  ///< it stayed unknown although the robot was near it for long
  small,     ///< it hides less than least_gain_m2
};

/// A frontier that is not worth a visit or cannot be seen.
struct RefusedFrontier {
  std::uint32_t frontier = 0;  ///< id
  Vec2 centroid;
  std::size_t cells = 0;  ///< number of its cells
  Refusal kind = Refusal::no_way;
  std::string reason;  ///< one sentence
};

/// A view that a decision compared.
struct ViewCandidate {
  Vec2 place;
  double cost_s = 0.0;   ///< time to turn and drive there
  double gain_m2 = 0.0;  ///< unknown area that the robot expects to see from there
  double value = 0.0;    ///< to the strategy (catalog.hpp); NaN if another view stands for this one
  bool chosen = false;
};

/// A decision.
struct Decision {
  DecisionKind kind = DecisionKind::complete;
  std::string sentence;  ///< the reason, one sentence
  ExploreChoice choice;
  Pose2 goal;                             ///< faces the unknown cells; home if there is nothing to see
  std::vector<Vec2> waypoints;            ///< path from the pose to the goal; empty if there is none
  double way_m = 0.0;                     ///< length of the path
  double gain_m2 = 0.0;                   ///< unknown area that the robot expects to see from the goal
  std::vector<RefusedFrontier> refused;   ///< by id, without frontiers that were skipped for nearer ones
  std::vector<ViewCandidate> candidates;  ///< the views that were compared, the best first
};

/// Chooses the next goal. Faults: bad_input on an unknown strategy or planner; start_blocked when no known
/// free ground is within 0.5 m of the robot; budget_exhausted when the budget of the path ends first.
Outcome<Decision> decide(const ExploreState& state, const ExploreOptions& options, Workspace& workspace);

/// Plans a path from the pose of the state to a place over known free cells, and pulls it straight. A robot
/// or a place in a blocked cell is first moved to the nearest free cell within 0.5 m. Faults: those of the
/// planner.
Outcome<std::vector<Vec2>> way_to(const ExploreState& state, Vec2 place, const ExploreOptions& options,
                                  Workspace& workspace);

}  // namespace outrider
