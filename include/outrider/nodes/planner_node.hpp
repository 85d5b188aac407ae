// PlannerNode: plans paths on a map and judges them before it sends them.
//
//   map        nav_msgs/OccupancyGrid     ->   plan            nav_msgs/Path
//   goal_pose  geometry_msgs/PoseStamped       planner/status  done, or the fault of the planner
//   /tf, /tf_static
//
// The robot is a disk that keeps to known free cells (jobs/explore/map/traversability_grid.hpp). A start or a
// goal that is nearer to an obstacle is moved by up to 0.5 m. The plan is made again once in `period`, for
// the map and the pose of that time, until there is another goal. A plan that `check` (path/check.hpp)
// refuses is not sent. When the map is begun anew, the goal holds no more, and an empty path is sent.
#pragma once

#include <optional>

#include "outrider/jobs/explore/map/traversability_grid.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/nodes/robot_frames.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct PlannerNodeOptions {
  FrameNames frames;
  std::string planner = "theta_star";  ///< name of a path planner for the model `cells`
  double radius_m = 0.0;               ///< of the robot
  double period_s = 1.0;
  KnownGroundOptions ground;

  PlannerNodeOptions();
};
std::vector<OptionGroup> describe(PlannerNodeOptions& options);

class PlannerNode final : public Node {
 public:
  explicit PlannerNode(PlannerNodeOptions options);

 private:
  Status take_map(const nav_msgs::OccupancyGrid& map);
  Status take_goal(const geometry_msgs::PoseStamped& goal);
  void act() override;
  Outcome<Plan> plan(const Pose2& pose);
  void send_plan(const Plan& plan);

  PlannerNodeOptions options_;
  RobotFrames frames_;
  NewestStamp maps_;
  MapBeginning beginning_;
  TraversabilityGrid ground_;
  GridFrame frame_;  ///< of the newest map
  bool has_map_ = false;
  Workspace workspace_;
  std::optional<Pose2> goal_;
  double planned_s_ = -1e9;
  std::size_t plan_output_;
};

}  // namespace outrider
