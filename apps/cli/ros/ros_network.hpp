// The network of ROS 2 as the tool uses it; one of two sources, whether Outrider was built with it or not.
#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/nodes/messages/message_faults.hpp"
#include "outrider/nodes/node.hpp"

namespace outrider::cli {

/// The connection of a node to ROS 2.
struct RosRequest {
  std::string space;                         ///< namespace
  std::vector<std::string> renames;          ///< from:=to
  bool sim_time = false;                     ///< the time comes from /clock
  double own_rate = 0.0;                     ///< above 0: the node is the simulation, and runs at that rate
  MessageFaults faults;                      ///< of the messages that come
  std::vector<OptionGroup> parameters = {};  ///< of the node, which its services show
};

/// Returns a fault if Outrider was built without ROS 2.
Status check_ros();

/// Runs the node until the stop token is raised or the node is over; prints what it tells. Faults: those of
/// check_ros() and of run_node().
Status run_on_ros(Node& node, const RosRequest& request, const std::stop_token& stop);

}  // namespace outrider::cli
