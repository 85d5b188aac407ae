#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "flags.hpp"
#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/jobs/explore/job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/nodes/sim/guard_sim_node.hpp"
#include "outrider/nodes/sim/sim_node.hpp"
#include "outrider/nodes/sim/tag_sim_node.hpp"
#include "ros/ros_request.hpp"

namespace outrider::cli {
namespace {

struct SimRequest {
  ExploreJob job;
  std::string file;
  RosRequest ros;
  double rate = 1.0;  ///< of the simulation
  MessageFaults faults;
  bool plain_twist = false;
  bool localised = false;
  bool images = false;
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

/// The flags of the robots of all jobs.
std::vector<OptionGroup> describe_any(SimRequest& request) {
  return {
      {"",
       "ROS 2",
       {{"ns", "", 0, 0, "namespace of its topics", &request.ros.space},
        {"rate", "", 0.01, 100.0, "how many times faster than time it runs, if it keeps up", &request.rate},
        {"plain_twist", "", 0, 0, "commands are geometry_msgs/Twist, not TwistStamped", &request.plain_twist},
        {"patience", "s", 0.05, 1e6, "without a command, after which it stops", &request.patience_s}}},
      describe_faults(request.faults)};
}

std::vector<OptionGroup> describe_own(SimRequest& request) {
  return {{"",
           "what it publishes",
           {{"localised", "", 0, 0, "map -> odom is sent too, as a localiser does that makes no errors",
             &request.localised},
            {"images", "", 0, 0, "images are sent, and no detections of tags; scenarios of drive only",
             &request.images}}}};
}

std::vector<OptionGroup> describe_sim(SimRequest& request) {
  auto all = describe_any(request);
  for (OptionGroup& group : describe_own(request)) all.push_back(std::move(group));
  for (OptionGroup& group : groups_of(request.job, {"", "robot", "laser", "wheels"}))
    all.push_back(std::move(group));
  return all;
}

/// Returns the job of a scenario; nothing for other files.
std::string job_of(const std::string& file) {
  if (!file.ends_with(".yaml") && !file.ends_with(".yml")) return {};
  return scenario_job(file).value_or("");
}

/// Reads a scenario of the job explore; another file is its world.
Status read_world(SimRequest& request, const std::string& job) {
  if (job == "explore") return read_scenario(request.job, request.file);
  if (!job.empty()) {
    return bad_input(
        fmt::format("it is a scenario of the job {}; give a world, or one of explore, drive or guard", job),
        request.file);
  }
  return change(request.job, {{"world", request.file}});
}

int simulate_explorer(SimRequest& request, const Command& words, const std::stop_token& stop) {
  if (auto ok = apply_flags(words, describe_sim(request)); !ok) return print_fault(ok.error(), false);
  const auto setup = load_explore(request.job.scenario);
  if (!setup) return print_fault(setup.error(), false);
  warn(setup->warnings);
  SimNodeOptions options;
  options.start = setup->task.start;
  options.robot = setup->task.robot;
  options.sim = setup->sim;
  options.seed = static_cast<std::uint64_t>(request.job.scenario.seed);
  options.plain_twist = request.plain_twist;
  options.localised = request.localised;
  options.patience_s = request.patience_s;
  options.faults = request.faults;
  SimNode node(setup->world, options);
  const int status = run_ros_node(node, request.ros, words, stop);
  if (status != job_done) return status;
  const auto& body = node.robot().body<TwistBody>();
  show("{:.1f} s simulated, {:.2f} m driven, {} contacts; the robot is {:.2f} m from its start\n",
       body.time_s(), body.driven_m(), body.contacts(),
       distance(body.pose().position, setup->task.start.position));
  return job_done;
}

/// Refuses flags of the robot of explore: that of another job is as its scenario says.
Status check_flags_of(const std::string& job, const std::string& why_localised, SimRequest& request,
                      const Command& words) {
  for (const OptionGroup& group : groups_of(request.job, {"", "robot", "laser", "wheels"})) {
    for (const Option& option : group.options) {
      const std::string flag = flag_of(group.name, option.name);
      if (words.given(flag) && flag != "--seed") {
        return bad_input(
            fmt::format("the robot of a scenario of {} is as the scenario says; change it there", job), flag);
      }
    }
  }
  if (words.given("--localised")) {
    return bad_input(fmt::format("the robot of a scenario of {} {}; leave it out", job, why_localised),
                     "--localised");
  }
  return {};
}

int simulate_driver(SimRequest& request, const Command& words, const std::stop_token& stop) {
  if (auto ok = check_flags_of("drive", "finds itself by its tags", request, words); !ok)
    return print_fault(ok.error(), false);
  DriveJob job;
  if (auto ok = read_scenario(job, request.file); !ok) return print_fault(ok.error(), false);
  const auto setup = load_wheel_drive(job.scenario);
  if (!setup) return print_fault(setup.error(), false);
  warn(setup->warnings);
  if (request.images && !setup->rendered) {
    return print_fault(
        {FaultCode::bad_input, "without rendered images none can be sent; give sight: rendered", "--images"},
        false);
  }
  TagSimNodeOptions options;
  options.seed =
      static_cast<std::uint64_t>(words.given("--seed") ? request.job.scenario.seed : job.scenario.seed);
  options.plain_twist = request.plain_twist;
  options.images = request.images;
  options.patience_s = request.patience_s;
  options.faults = request.faults;
  TagSimNode node(*setup, options);
  const int status = run_ros_node(node, request.ros, words, stop);
  if (status != job_done) return status;
  const auto& body = node.robot().body<WheelBody>();
  const Waypoint& last = setup->task.waypoints.back();
  show("{:.1f} s simulated, {:.2f} m driven; the robot is {:.3f} m from its last waypoint\n", body.time_s(),
       body.driven_m(), distance(body.pose().position, last.pose.position));
  return job_done;
}

int simulate_guard(SimRequest& request, const Command& words, const std::stop_token& stop) {
  if (auto ok = check_flags_of("guard", "is always told where it is", request, words); !ok)
    return print_fault(ok.error(), false);
  GuardJob job;
  if (auto ok = read_scenario(job, request.file); !ok) return print_fault(ok.error(), false);
  const auto warnings = job.load();
  if (!warnings) return print_fault(warnings.error(), false);
  warn(*warnings);
  const auto yard = GuardSimYard::make(job.scenario);
  if (!yard) return print_fault(yard.error(), false);
  RobotSimOptions options;
  options.seed =
      static_cast<std::uint64_t>(words.given("--seed") ? request.job.scenario.seed : job.scenario.seed);
  options.plain_twist = request.plain_twist;
  options.patience_s = request.patience_s;
  options.faults = request.faults;
  GuardSimNode node(*yard, options);
  const int status = run_ros_node(node, request.ros, words, stop);
  if (status != job_done) return status;
  const auto& body = node.robot().body<TwistBody>();
  show("{:.1f} s simulated, {:.2f} m driven, {} contacts; {} of {} targets were hit, by {} shots\n",
       body.time_s(), body.driven_m(), body.contacts(), node.hits(), node.gone().size(), node.shots());
  return job_done;
}

int simulate(SimRequest& request, const Command& words, const std::stop_token& stop) {
  if (auto ok = check_ros(); !ok) return print_fault(ok.error(), false);
  const std::string job = job_of(request.file);
  if (auto ok = apply_flags(words, describe_sim(request)); !ok) return print_fault(ok.error(), false);
  request.ros.own_rate = request.rate;
  if (job == "drive") return simulate_driver(request, words, stop);
  if (request.images) {
    return print_fault({FaultCode::bad_input, "only robots of scenarios of drive have a camera", "--images"},
                       false);
  }
  if (job == "guard") return simulate_guard(request, words, stop);
  if (auto ok = read_world(request, job); !ok) return print_fault(ok.error(), false);
  return simulate_explorer(request, words, stop);
}

}  // namespace

void add_ros_sim(Command& ros, const std::stop_token& stop) {
  Command& command = ros.add(
      "sim", "simulate a robot with a range finder in a known world, one that sees tags, or one with a gun");
  auto request = std::make_shared<SimRequest>();
  command
      .positional(
          "world", &request->file,
          "SDF, map_server YAML, PGM or PNG image, slices CSV; or a scenario of explore, drive or guard")
      .required()
      .type("FILE");
  add_flags(command, describe_sim(*request));
  add_ros_remap(command);
  command.does([request, stop](const Command& words) { return simulate(*request, words, stop); });
  command.footer(
      "\nExample: outrider ros sim scenarios/explore/office.yaml --rate 2 --loss 0.01 --delay 0.1");
}

}  // namespace outrider::cli
