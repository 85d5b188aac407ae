// The common parts of the commands of nodes.
#pragma once

#include <stop_token>

#include "command.hpp"
#include "outrider/core/options.hpp"
#include "ros/ros_network.hpp"

namespace outrider::cli {

/// Describes the namespace and the clock.
OptionGroup describe_request(RosRequest& request);
/// Describes faults of the messages that come.
OptionGroup describe_faults(MessageFaults& faults);
/// Adds --remap.
void add_ros_remap(Command& command);

/// Runs the node until it is stopped or over, and returns the exit status of the tool.
int run_ros_node(Node& node, RosRequest request, const Command& words, const std::stop_token& stop);

/// Add the commands `ros sim` and `ros run`.
void add_ros_sim(Command& ros, const std::stop_token& stop);
void add_ros_run(Command& ros, const std::stop_token& stop);

}  // namespace outrider::cli
