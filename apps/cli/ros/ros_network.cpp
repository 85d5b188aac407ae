#include "ros/ros_network.hpp"

#include "output/terminal.hpp"
#include "outrider/ros2/run_node.hpp"

namespace outrider::cli {

Status check_ros() { return {}; }

Status run_on_ros(Node& node, const RosRequest& request, const std::stop_token& stop) {
  auto network = ros_environment();
  if (!network) return pass_on(network);
  RunNodeOptions options{*network, request.space,  request.renames,   NodeClock::system,
                         1.0,      request.faults, request.parameters};
  if (request.sim_time) options.clock = NodeClock::simulated;
  if (request.own_rate > 0.0) {
    options.clock = NodeClock::own;
    options.rate = request.own_rate;
  }
  return run_node(node, options, stop, [&](const NodeEvent& event) {
    const std::string line = fmt::format("{:.2f} s: {}: {}", event.time_s, node.name(), event.sentence);
    event.level == NodeLevel::info ? complain(line) : warn(line);
  });
}

}  // namespace outrider::cli
