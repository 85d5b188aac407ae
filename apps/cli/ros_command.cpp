#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "commands.hpp"
#include "flags.hpp"
#include "output.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/explore/job.hpp"
#include "outrider/nodes/coverage_node.hpp"
#include "outrider/nodes/explore_mission_node.hpp"
#include "outrider/nodes/explorer_node.hpp"
#include "outrider/nodes/follower_node.hpp"
#include "outrider/nodes/mapper_node.hpp"
#include "outrider/nodes/planner_node.hpp"
#include "outrider/nodes/sim_node.hpp"
#include "ros_network.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

/// The arguments of every node.
OptionGroup describe(RosRequest& request) {
  return {"",
          "ROS 2",
          {{"ns", "", 0, 0, "namespace of its topics", &request.space},
           {"sim_time", "", 0, 0, "the time comes from /clock, as with use_sim_time", &request.sim_time}}};
}

/// Faults of the messages that a node receives.
OptionGroup describe_faults(MessageFaults& faults) {
  return {"", "messages that get lost or come late", outrider::describe(faults)};
}

void add_remap(Command& command) {
  command.option("--remap", "another name for a topic, from:=to").type("NAMES").repeatable();
}

int run(Node& node, RosRequest request, const Command& words, const std::stop_token& stop) {
  if (words.given("--remap")) request.renames = words.values("--remap");
  if (auto ok = run_on_ros(node, request, stop); !ok) return print_fault(ok.error(), false);
  const NodeStatus& end = node.status();
  if (node.is_over()) show("{}: {}\n", end.state, end.sentence);
  return node.is_over() && end.level != NodeLevel::info ? job_not_done : job_done;
}

Outcome<MapperNodeOptions> checked(MapperNodeOptions options) { return options; }
Outcome<PlannerNodeOptions> checked(PlannerNodeOptions options) { return options; }
Outcome<FollowerNodeOptions> checked(FollowerNodeOptions options) { return options; }
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
    all.insert(all.begin(), {describe(*request), describe_faults(request->faults)});
    return all;
  };
  add_flags(command, groups());
  add_remap(command);
  command.does([options, request, groups, stop](const Command& words) {
    if (auto ok = check_ros(); !ok) return print_fault(ok.error(), false);
    if (auto ok = apply_flags(words, groups()); !ok) return print_fault(ok.error(), false);
    const auto good = checked(*options);
    if (!good) return print_fault(good.error(), false);
    Made node(*good);
    return run(node, *request, words, stop);
  });
}

/// What a scenario of the job explore says, and the flags that win over it.
struct ExploreRequest {
  ExploreJob job;
  std::string file;
  RosRequest ros;
  double rate = 1.0;  ///< of the simulation
  MessageFaults faults;
  bool plain_twist = false;
  double patience_s = 0.5;
};

/// Takes the groups of the job with these names.
std::vector<OptionGroup> groups_of(ExploreJob& job, const std::set<std::string>& names) {
  auto groups = job.options();
  std::erase_if(groups, [&](const OptionGroup& group) { return !names.contains(group.name); });
  std::erase_if(groups.front().options,
                [](const Option& option) { return option.name == "job" || option.name == "world"; });
  return groups;
}

std::vector<OptionGroup> describe_sim(ExploreRequest& request) {
  auto groups = groups_of(request.job, {"", "robot", "laser", "wheels"});
  OptionGroup ros{
      "",
      "ROS 2",
      {{"ns", "", 0, 0, "namespace of its topics", &request.ros.space},
       {"rate", "", 0.01, 100.0, "how many times faster than time it runs, if it keeps up", &request.rate},
       {"plain_twist", "", 0, 0, "commands are geometry_msgs/Twist, not TwistStamped", &request.plain_twist},
       {"patience", "s", 0.05, 1e6, "without a command, after which it stops", &request.patience_s}}};
  groups.insert(groups.begin(), {std::move(ros), describe_faults(request.faults)});
  return groups;
}

/// Reads a scenario of the job explore; another file is its world.
Status read_world(ExploreRequest& request) {
  if (request.file.ends_with(".yaml") || request.file.ends_with(".yml")) {
    const auto named = scenario_job(request.file);
    if (named && *named == "explore") return read_scenario(request.job, request.file);
    if (named)
      return bad_input(fmt::format("it is a scenario of the job {}; give one of explore", *named),
                       request.file);
  }
  return change(request.job, {{"world", request.file}});
}

int simulate(ExploreRequest& request, const Command& words, const std::stop_token& stop) {
  if (auto ok = check_ros(); !ok) return print_fault(ok.error(), false);
  if (auto ok = read_world(request); !ok) return print_fault(ok.error(), false);
  if (auto ok = apply_flags(words, describe_sim(request)); !ok) return print_fault(ok.error(), false);
  const auto setup = load_explore(request.job.scenario);
  if (!setup) return print_fault(setup.error(), false);
  warn(setup->warnings);
  SimNode node(setup->world, {setup->task.start, setup->task.robot, setup->sim,
                              static_cast<std::uint64_t>(request.job.scenario.seed), request.plain_twist,
                              request.patience_s, request.faults});
  request.ros.own_rate = request.rate;
  const int status = run(node, request.ros, words, stop);
  if (status != job_done) return status;
  const auto& body = node.robot().body<TwistBody>();
  show("{:.1f} s simulated, {:.2f} m driven, {} contacts; the robot is {:.2f} m from its start\n",
       body.time_s(), body.driven_m(), body.contacts(),
       distance(body.pose().position, setup->task.start.position));
  return job_done;
}

void add_sim(Command& ros, const std::stop_token& stop) {
  Command& command = ros.add("sim", "simulate a robot with a range finder in a known world");
  auto request = std::make_shared<ExploreRequest>();
  command
      .positional("world", &request->file,
                  "SDF, map_server YAML, PGM or PNG image, slices CSV; or a scenario of explore")
      .required()
      .type("FILE");
  add_flags(command, describe_sim(*request));
  add_remap(command);
  command.does([request, stop](const Command& words) { return simulate(*request, words, stop); });
  command.footer(
      "\nExample: outrider ros sim scenarios/explore/office.yaml --rate 2 --loss 0.01 --delay 0.1");
}

int run_mission(ExploreRequest& request, const Command& words, const std::stop_token& stop) {
  if (auto ok = check_ros(); !ok) return print_fault(ok.error(), false);
  const auto named = scenario_job(request.file);
  if (!named) return print_fault(named.error(), false);
  if (*named != "explore") {
    return print_fault(
        {FaultCode::bad_input,
         fmt::format("the job '{}' cannot have its robot behind topics yet; explore can", *named),
         request.file},
        false);
  }
  if (auto ok = read_scenario(request.job, request.file); !ok) return print_fault(ok.error(), false);
  const std::vector<OptionGroup> groups{describe(request.ros),
                                        describe_faults(request.ros.faults),
                                        {"", "", {{"plain_twist", "", 0, 0, "", &request.plain_twist}}}};
  if (auto ok = apply_flags(words, groups); !ok) return print_fault(ok.error(), false);
  ExploreMissionNodeOptions options;
  options.plain_twist = request.plain_twist;
  options.task = request.job.scenario.task;
  ExploreMissionNode node(options);
  return run(node, request.ros, words, stop);
}

void add_mission(Command& ros, const std::stop_token& stop) {
  Command& command =
      ros.add("run", "run the mission of a scenario with its robot behind topics: explore only");
  auto request = std::make_shared<ExploreRequest>();
  command.positional("scenario", &request->file, "scenario of the job explore").required().type("FILE");
  add_flags(command, {describe(request->ros),
                      describe_faults(request->ros.faults),
                      {"",
                       "ROS 2",
                       {{"plain_twist", "", 0, 0, "commands are geometry_msgs/Twist, not TwistStamped",
                         &request->plain_twist}}}});
  add_remap(command);
  command.does([request, stop](const Command& words) { return run_mission(*request, words, stop); });
  command.footer("\nExample: outrider ros run scenarios/explore/office.yaml --sim-time");
}

}  // namespace

void add_ros(Command& tool, const std::stop_token& stop) {
  Command& ros = tool.add("ros", "be a node of ROS 2, without ROS: mapper, explorer, planner, follower, ...");
  ros.require_command();
  add_sim(ros, stop);
  add_node<MapperNode, MapperNodeOptions>(ros, "mapper", "make a map of scans, and say where the robot is",
                                          stop);
  add_node<ExplorerNode, ExplorerNodeOptions>(ros, "explorer", "choose where to go to map everything", stop);
  add_node<PlannerNode, PlannerNodeOptions>(ros, "planner", "plan paths to goals on a map", stop);
  add_node<FollowerNode, FollowerNodeOptions>(ros, "follower", "drive the robot along a path", stop);
  add_node<CoverageNode, CoverageNodeOptions>(ros, "coverage", "plan a path that covers an area", stop);
  add_mission(ros, stop);
  ros.footer("\nROS_DOMAIN_ID and ROS_LOCALHOST_ONLY are heeded. docs/ros2.md has the topics and recipes.");
}

}  // namespace outrider::cli
