#include <memory>

#include "commands/commands.hpp"
#include "flags.hpp"
#include "output/output.hpp"
#include "outrider/nodes/coverage_node.hpp"
#include "outrider/nodes/explorer_node.hpp"
#include "outrider/nodes/follower_node.hpp"
#include "outrider/nodes/mapper_node.hpp"
#include "outrider/nodes/planner_node.hpp"
#include "ros/ros_request.hpp"

namespace outrider::cli {
namespace {

Outcome<PlannerNodeOptions> checked(PlannerNodeOptions options) { return options; }
Outcome<FollowerNodeOptions> checked(FollowerNodeOptions options) { return options; }
Outcome<MapperNodeOptions> checked(MapperNodeOptions options) {
  return MapperNode::checked(std::move(options));
}
Outcome<ExplorerNodeOptions> checked(ExplorerNodeOptions options) {
  return ExplorerNode::checked(std::move(options));
}
Outcome<CoverageNodeOptions> checked(CoverageNodeOptions options) {
  return CoverageNode::checked(std::move(options));
}

/// Adds the command of a node that is made of its options alone.
template <class Made, class Options>
void add_node(Command& ros, const std::string& name, const std::string& sentence,
              const std::stop_token& stop) {
  Command& command = ros.add(name, sentence);
  auto options = std::make_shared<Options>();
  auto request = std::make_shared<RosRequest>();
  const auto groups = [options, request] {
    auto all = describe(*options);
    all.insert(all.begin(), {describe_request(*request), describe_faults(request->faults)});
    return all;
  };
  add_flags(command, groups());
  add_ros_remap(command);
  command.does([options, request, groups, stop](const Command& words) {
    if (auto ok = check_ros(); !ok) return print_fault(ok.error(), false);
    if (auto ok = apply_flags(words, groups()); !ok) return print_fault(ok.error(), false);
    const auto good = checked(*options);
    if (!good) return print_fault(good.error(), false);
    Made node(*good);
    request->parameters = describe(*options);
    return run_ros_node(node, *request, words, stop);
  });
}

}  // namespace

void add_ros(Command& tool, const std::stop_token& stop) {
  Command& ros = tool.add("ros", "be a node of ROS 2, without ROS: mapper, explorer, planner, follower, ...");
  ros.require_command();
  add_ros_sim(ros, stop);
  add_node<MapperNode, MapperNodeOptions>(ros, "mapper", "make a map of scans, and say where the robot is",
                                          stop);
  add_node<ExplorerNode, ExplorerNodeOptions>(ros, "explorer", "choose where to go to map everything", stop);
  add_node<PlannerNode, PlannerNodeOptions>(ros, "planner", "plan paths to goals on a map", stop);
  add_node<FollowerNode, FollowerNodeOptions>(ros, "follower", "drive the robot along a path", stop);
  add_node<CoverageNode, CoverageNodeOptions>(ros, "coverage", "plan a path that covers an area", stop);
  add_ros_run(ros, stop);
  ros.footer("\nROS_DOMAIN_ID and ROS_LOCALHOST_ONLY are heeded. docs/ros2.md has the topics and recipes.");
}

}  // namespace outrider::cli
