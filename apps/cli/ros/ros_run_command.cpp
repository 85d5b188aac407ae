#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>

#include "flags.hpp"
#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/cover/job.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/jobs/explore/job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/pursue/job.hpp"
#include "outrider/nodes/missions/cover_mission_node.hpp"
#include "outrider/nodes/missions/drive_mission_node.hpp"
#include "outrider/nodes/missions/explore_mission_node.hpp"
#include "outrider/nodes/missions/guard_mission_node.hpp"
#include "outrider/nodes/missions/pursue_mission_node.hpp"
#include "ros/ros_request.hpp"

namespace outrider::cli {
namespace {

struct MissionRequest {
  std::string file;
  RosRequest ros;
  MissionNodeOptions node;
  double latency_s = DriveMissionNodeOptions().latency_s;
  PursueMissionNodeOptions pursue;
  GuardMissionNodeOptions guard;
};

std::vector<OptionGroup> describe_mission(MissionRequest& request) {
  std::vector<OptionGroup> all{
      describe_request(request.ros),
      describe_faults(request.ros.faults),
      {"", "the robot behind topics", describe(request.node)},
      {"drive",
       "for the job drive",
       {{"latency", "s", 0.0, 2.0, "longest time from an exposure until its image has come",
         &request.latency_s}}}};
  for (OptionGroup& group : describe(request.pursue)) {
    group.name = "pursue";
    group.sentence = "for the job pursue";
    all.push_back(std::move(group));
  }
  for (OptionGroup& group : describe(request.guard)) {
    group.name = "guard";
    group.sentence = "for the job guard";
    all.push_back(std::move(group));
  }
  return all;
}

using MadeNode = Outcome<std::unique_ptr<Node>>;

/// The key of a fault of the mission itself; `outrider ros sim` has those of its robot.
constexpr const char* outage_key = "faults.planner_fails_from";

MadeNode make_explorer(const MissionRequest& request) {
  ExploreJob job;
  if (auto ok = read_scenario(job, request.file); !ok) return pass_on(ok);
  if (auto ok = check_no_faults(job.scenario.sim.faults.planner.any(), outage_key); !ok) return pass_on(ok);
  ExploreMissionNodeOptions options;
  options.node = request.node;
  options.task = job.scenario.task;
  return std::make_unique<ExploreMissionNode>(options);
}

MadeNode make_driver(const MissionRequest& request) {
  DriveJob job;
  if (auto ok = read_scenario(job, request.file); !ok) return pass_on(ok);
  auto setup = load_wheel_drive(job.scenario);
  if (!setup) return pass_on(setup);
  warn(setup->warnings);
  return std::make_unique<DriveMissionNode>(
      DriveMissionNodeOptions{request.node, request.latency_s, std::move(setup->task)});
}

MadeNode make_coverer(const MissionRequest& request) {
  CoverJob job;
  if (auto ok = read_scenario(job, request.file); !ok) return pass_on(ok);
  if (auto ok = CoverMissionNode::check(job.scenario); !ok) return pass_on(ok);
  return std::make_unique<CoverMissionNode>(request.node, job.scenario);
}

MadeNode make_pursuer(const MissionRequest& request) {
  PursueJob job;
  if (auto ok = read_scenario(job, request.file); !ok) return pass_on(ok);
  auto task = load_task(job.scenario);
  if (!task) return pass_on(task);
  if (auto ok = PursueMissionNode::check(job.scenario, *task); !ok) return pass_on(ok);
  PursueMissionNodeOptions options = request.pursue;
  options.node = request.node;
  const std::string name = std::filesystem::path(job.scenario.map).filename().string();
  return std::make_unique<PursueMissionNode>(options, std::move(*task), name);
}

MadeNode make_guard(const MissionRequest& request) {
  GuardJob job;
  if (auto ok = read_scenario(job, request.file); !ok) return pass_on(ok);
  if (auto ok = check_no_faults(job.scenario.faults.planner.any(), outage_key); !ok) return pass_on(ok);
  auto warnings = job.load();
  if (!warnings) return pass_on(warnings);
  warn(*warnings);
  GuardMissionNodeOptions options = request.guard;
  options.node = request.node;
  auto guard = GuardMissionNode::prepare(std::move(job.scenario), options);
  if (!guard) return pass_on(guard);
  return std::make_unique<GuardMissionNode>(options, std::move(*guard));
}

/// A job whose robot can be behind topics, or why it cannot.
struct MissionKind {
  std::string_view job;
  MadeNode (*make)(const MissionRequest&) = nullptr;
  std::string_view why_not;
};

constexpr std::array<MissionKind, 8> kinds{
    {{"cover", make_coverer, ""},
     {"drive", make_driver, ""},
     {"explore", make_explorer, ""},
     {"pursue", make_pursuer, ""},
     {"guard", make_guard, ""},
     {"slam", nullptr,
      "it maps logs and drives no robot; `outrider ros mapper` does with scans on topics what it does with "
      "those of a log"},
     {"plan", nullptr,
      "it drives no robot; `outrider ros planner` plans paths on a map that comes on a topic"},
     {"fleet", nullptr,
      "its robots step on a grid at the same instants, which robots behind topics do not; give each robot a "
      "planner and a follower in a namespace of its own (`--ns`)"}}};

MadeNode make_node(const MissionRequest& request) {
  auto named = scenario_job(request.file);
  if (!named) return pass_on(named);
  for (const MissionKind& kind : kinds) {
    if (kind.job != *named) continue;
    if (kind.make != nullptr) return kind.make(request);
    return bad_input(
        fmt::format("the job {} cannot have its robot behind topics: {}", kind.job, kind.why_not),
        request.file);
  }
  return bad_input(fmt::format("the job '{}' cannot have its robot behind topics; cover, drive, explore, "
                               "guard and pursue can",
                               *named),
                   request.file);
}

int run_mission(MissionRequest& request, const Command& words, const std::stop_token& stop) {
  if (auto ok = check_ros(); !ok) return print_fault(ok.error(), false);
  if (auto ok = apply_flags(words, describe_mission(request)); !ok) return print_fault(ok.error(), false);
  const auto node = make_node(request);
  if (!node) return print_fault(node.error(), false);
  return run_ros_node(**node, request.ros, words, stop);
}

}  // namespace

void add_ros_run(Command& ros, const std::stop_token& stop) {
  Command& command = ros.add("run", "run the mission of a scenario with its robot behind topics");
  auto request = std::make_shared<MissionRequest>();
  command.positional("scenario", &request->file, "scenario of cover, drive, explore, guard or pursue")
      .required()
      .type("FILE");
  add_flags(command, describe_mission(*request));
  add_ros_remap(command);
  command.does([request, stop](const Command& words) { return run_mission(*request, words, stop); });
  command.footer("\nExample: outrider ros run scenarios/explore/office.yaml --sim-time");
}

}  // namespace outrider::cli
