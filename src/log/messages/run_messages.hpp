// The types of the messages that a run leaves.
#pragma once

#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/messages/mapping_messages.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/messages/ros_marker_messages.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/messages/scene_messages.hpp"

namespace outrider {

template <class... Messages>
struct MessageList {};

using RunMessages = MessageList<
    geometry_msgs::PoseStamped, geometry_msgs::PoseWithCovarianceStamped, geometry_msgs::PolygonStamped,
    nav_msgs::Odometry, nav_msgs::Path, nav_msgs::OccupancyGrid, map_msgs::OccupancyGridUpdate,
    tf2_msgs::TFMessage, rcl_interfaces::Log, sensor_msgs::LaserScan, sensor_msgs::JointState,
    sensor_msgs::CameraInfo, visualization_msgs::MarkerArray, outrider_msgs::RunInfo, outrider_msgs::Solids,
    outrider_msgs::Terrain, outrider_msgs::Outlines, outrider_msgs::Shot, outrider_msgs::FiringRegion,
    outrider_msgs::Tour, outrider_msgs::Target, outrider_msgs::TargetPosition, outrider_msgs::Supplies,
    outrider_msgs::StoreLevels, outrider_msgs::Tags, outrider_msgs::Waypoints, outrider_msgs::Decision,
    outrider_msgs::Refusal, outrider_msgs::CoverageArea, outrider_msgs::Coverage, outrider_msgs::CoveragePass,
    outrider_msgs::CostGrid, outrider_msgs::PaidCost, outrider_msgs::CostBound, outrider_msgs::Landmarks,
    outrider_msgs::Sightings, outrider_msgs::Loops>;

}  // namespace outrider
