// run_node(): connects a node (nodes/node.hpp) to ROS 2 until it is stopped.
//
// Topics get the names that ROS 2 gives them: in the namespace, after renaming. The node is announced on
// ros_discovery_info. The clock is that of the system; that of a simulation, from /clock; or its own, for a
// node that is the simulation: then it runs `rate` times as fast as time passes, or slower if the node does
// not keep up. The reports of a node are passed to `hear`.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/nodes/messages/message_faults.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/ros2/node.hpp"

namespace outrider {

enum class NodeClock { system, simulated, own };

struct RunNodeOptions {
  RosNodeOptions network;
  std::string space;                 ///< namespace
  std::vector<std::string> renames;  ///< from:=to
  NodeClock clock = NodeClock::system;
  double rate = 1.0;                         ///< of its own clock
  MessageFaults faults;                      ///< of the messages that come, but for /clock and /tf_static
  std::vector<OptionGroup> parameters = {};  ///< shown by services (nodes/parameters.hpp)
};

using HearNode = std::function<void(const NodeEvent&)>;

/// Runs until the stop token is raised, or for a second after the node is over, so that others hear of it.
/// Faults: bad_input for names and domains.
Status run_node(Node& node, const RunNodeOptions& options, const std::stop_token& stop, const HearNode& hear);

}  // namespace outrider
