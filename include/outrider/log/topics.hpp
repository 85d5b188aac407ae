// The topics of a run. docs/log.md describes each of them.
#pragma once

#include <string_view>

namespace outrider::topic {

// Standard ROS messages.
inline constexpr std::string_view transforms = "/tf";                ///< tf2_msgs/TFMessage
inline constexpr std::string_view static_transforms = "/tf_static";  ///< tf2_msgs/TFMessage, at time 0
inline constexpr std::string_view pose = "/pose";                    ///< geometry_msgs/PoseStamped: true pose
inline constexpr std::string_view belief = "/belief";            ///< geometry_msgs/PoseWithCovarianceStamped
inline constexpr std::string_view corrections = "/corrections";  ///< geometry_msgs/PoseStamped
inline constexpr std::string_view odometry = "/odom";            ///< nav_msgs/Odometry
inline constexpr std::string_view joints = "/joint_states";      ///< sensor_msgs/JointState: the gun
inline constexpr std::string_view scan = "/scan";                ///< sensor_msgs/LaserScan
inline constexpr std::string_view footprint = "/footprint";      ///< geometry_msgs/PolygonStamped, at time 0
inline constexpr std::string_view camera = "/camera/camera_info";  ///< sensor_msgs/CameraInfo
inline constexpr std::string_view plan = "/plan";  ///< nav_msgs/Path: path of the present drive
/// geometry_msgs/PoseWithCovarianceStamped: start of a planned path
inline constexpr std::string_view start = "/initialpose";
/// The prefix of topics with nav_msgs/Path: the paths of the planner of that name, one message for each query
inline constexpr std::string_view plan_of = "/plan/";
inline constexpr std::string_view goal = "/goal_pose";         ///< geometry_msgs/PoseStamped
inline constexpr std::string_view trajectory = "/trajectory";  ///< nav_msgs/Path: settled path so far
inline constexpr std::string_view reference = "/reference";    ///< nav_msgs/Path: reference for `trajectory`
inline constexpr std::string_view map = "/map";                ///< nav_msgs/OccupancyGrid
/// nav_msgs/OccupancyGrid: 100 occupied, 99 no room for the centre of the robot, 0 room
inline constexpr std::string_view costmap = "/costmap";
/// nav_msgs/OccupancyGrid: how much of a search was done when it expanded the cell, in percent; -1: never
inline constexpr std::string_view expanded = "/expanded";
inline constexpr std::string_view map_updates = "/map_updates";  ///< map_msgs/OccupancyGridUpdate
inline constexpr std::string_view target_pose =
    "/target_pose";                                    ///< geometry_msgs/PoseStamped: who is pursued
inline constexpr std::string_view events = "/rosout";  ///< rcl_interfaces/Log
/// visualization_msgs/MarkerArray, at time 0: what stands still, for viewers that do not know our messages
inline constexpr std::string_view scene = "/scene";

// Messages of our own: outrider_msgs/*.
inline constexpr std::string_view run = "/run";
inline constexpr std::string_view solids = "/solids";
inline constexpr std::string_view terrain = "/terrain";
inline constexpr std::string_view walls = "/walls";
inline constexpr std::string_view keep_out = "/keep_out_zones";
inline constexpr std::string_view slow_zones = "/slow_zones";
inline constexpr std::string_view medial_axis = "/medial_axis";
inline constexpr std::string_view shots = "/shots";
inline constexpr std::string_view firing_regions = "/firing_regions";
/// nav_msgs/OccupancyGrid: share of the targets that can be hit from the cell, in percent; -1: out of reach
inline constexpr std::string_view firing_map = "/firing_map";
inline constexpr std::string_view tours = "/tours";
/// Shot: the flight that comes nearest to a hit of a target that cannot be hit, and what is in its way
inline constexpr std::string_view blocked_flights = "/blocked_flights";
inline constexpr std::string_view targets = "/targets";
inline constexpr std::string_view target_positions = "/target_positions";
inline constexpr std::string_view supplies = "/supplies";
inline constexpr std::string_view stores = "/stores";
inline constexpr std::string_view tags = "/tags";
inline constexpr std::string_view waypoints = "/waypoints";
inline constexpr std::string_view decisions = "/decisions";
inline constexpr std::string_view refusals = "/refusals";
inline constexpr std::string_view coverage_area = "/coverage_area";
inline constexpr std::string_view coverage = "/coverage";
inline constexpr std::string_view coverage_passes = "/coverage_passes";
inline constexpr std::string_view cost_grid = "/cost_grid";
inline constexpr std::string_view paid = "/paid";
inline constexpr std::string_view bounds = "/cost_bounds";
inline constexpr std::string_view landmarks = "/landmarks";
inline constexpr std::string_view sightings = "/sightings";
inline constexpr std::string_view loops = "/loops";

}  // namespace outrider::topic
