#include "ros/ros_request.hpp"

#include "output/output.hpp"
#include "output/terminal.hpp"

namespace outrider::cli {

OptionGroup describe_request(RosRequest& request) {
  return {"",
          "ROS 2",
          {{"ns", "", 0, 0, "namespace of its topics", &request.space},
           {"sim_time", "", 0, 0, "the time comes from /clock, as with use_sim_time", &request.sim_time}}};
}

OptionGroup describe_faults(MessageFaults& faults) {
  return {"", "messages that get lost or come late", describe(faults)};
}

void add_ros_remap(Command& command) {
  command.option("--remap", "another name for a topic, from:=to").type("NAMES").repeatable();
}

int run_ros_node(Node& node, RosRequest request, const Command& words, const std::stop_token& stop) {
  if (words.given("--remap")) request.renames = words.values("--remap");
  request.parameters.push_back(
      {"", "", {{"use_sim_time", "", 0, 0, "the time comes from /clock", &request.sim_time}}});
  if (auto ok = run_on_ros(node, request, stop); !ok) return print_fault(ok.error(), false);
  const NodeStatus& end = node.status();
  if (node.is_over()) show("{}: {}\n", end.state, end.sentence);
  return node.is_over() && end.level != NodeLevel::info ? job_not_done : job_done;
}

}  // namespace outrider::cli
