// Nodes: whatever comes on whichever topic, a node goes on, and what it refuses it tells in a sentence.
//
// The first byte of an input chooses the node. Messages follow: a byte that chooses the topic, two with the
// length, and so many bytes of CDR after the four that name the encoding; the node acts after each.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "fuzz_entry.hpp"
#include "outrider/nodes/coverage_node.hpp"
#include "outrider/nodes/explorer_node.hpp"
#include "outrider/nodes/follower_node.hpp"
#include "outrider/nodes/mapper_node.hpp"
#include "outrider/nodes/missions/cover_mission_node.hpp"
#include "outrider/nodes/missions/drive_mission_node.hpp"
#include "outrider/nodes/missions/explore_mission_node.hpp"
#include "outrider/nodes/missions/guard_mission_node.hpp"
#include "outrider/nodes/missions/pursue_mission_node.hpp"
#include "outrider/nodes/planner_node.hpp"
#include "outrider/nodes/sim/guard_sim_node.hpp"

namespace {

using namespace outrider;

/// A robot that drives to a waypoint by one tag.
std::unique_ptr<Node> driver() {
  DriveMissionNodeOptions options;
  options.task.tags.tags = {upright_tag(1, {2.0, 0.0, 0.3}, 3.14)};
  options.task.world.bounds = {{-5.0, -5.0}, {5.0, 5.0}};
  options.task.waypoints = {Waypoint{{{1.0, 0.0}, 0.0}, true}};
  return std::make_unique<DriveMissionNode>(options);
}

std::unique_ptr<Node> pursuer() {
  PursuitTask task;
  task.problem.costs = std::make_shared<CostGrid>(GridFrame{{0.0, 0.0}, 1.0, 8, 8}, 1U);
  task.problem.threshold = 100;
  task.problem.target.assign(50, Cell{4, 4});
  task.robots = {Cell{1, 1}};
  return std::make_unique<PursueMissionNode>(PursueMissionNodeOptions(), task, "field");
}

std::unique_ptr<Node> coverer() {
  CoverageNodeOptions options;
  options.from_map = true;
  return std::make_unique<CoverageNode>(options);
}

/// The mission of covering a rectangle.
std::unique_ptr<Node> covering() {
  const auto file = std::filesystem::temp_directory_path() / "outrider_node_inputs_fuzz.geojson";
  static const bool written = [&] {
    std::ofstream(file) << R"({"type": "Polygon", "coordinates": [[[0,0],[2,0],[2,1],[0,1],[0,0]]]})";
    return true;
  }();
  CoverScenario scenario;
  if (written) scenario.area = file.string();
  scenario.units = "metres";
  scenario.problem.width_m = 0.5;
  return std::make_unique<CoverMissionNode>(MissionNodeOptions(), scenario);
}

/// A yard with one target.
GuardScenario yard() {
  GuardScenario scenario;
  scenario.problem.world.bounds = {{-3.0, -3.0}, {3.0, 3.0}};
  scenario.problem.start = {{0.0, -1.0}, 1.5};
  Target target;
  target.name = "tom";
  target.base = {1.0, 2.0, 0.0};
  target.size = {0.5, 0.3, 0.4};
  scenario.problem.targets = {target};
  scenario.options.resolution_m = 0.5;
  return scenario;
}

std::unique_ptr<Node> guard() {
  auto prepared = GuardMissionNode::prepare(yard(), {});
  if (!prepared) std::abort();
  return std::make_unique<GuardMissionNode>(GuardMissionNodeOptions(), std::move(*prepared));
}

std::unique_ptr<Node> gunner() {
  const auto made = GuardSimYard::make(yard());
  if (!made) std::abort();
  return std::make_unique<GuardSimNode>(*made, RobotSimOptions());
}

std::unique_ptr<Node> node_of(std::uint8_t choice) {
  switch (choice % 11) {
    case 0: return std::make_unique<MapperNode>(MapperNodeOptions());
    case 1: return std::make_unique<PlannerNode>(PlannerNodeOptions());
    case 2: return std::make_unique<ExplorerNode>(ExplorerNodeOptions());
    case 3: return std::make_unique<FollowerNode>(FollowerNodeOptions());
    case 4: return driver();
    case 5: return pursuer();
    case 6: return coverer();
    case 8: return covering();
    case 9: return guard();
    case 10: return gunner();
    default: return std::make_unique<ExploreMissionNode>(ExploreMissionNodeOptions());
  }
}

/// A command to a robot must be a motion.
void check(const std::string& topic, const std::string& bytes) {
  if (topic == "gun/fire") {
    const auto speed = decode<std_msgs::Float64>(MessageEncoding::cdr, bytes);
    if (!speed || !(speed->data > 0.0 && speed->data < 100.0)) std::abort();
  }
  if (topic != "cmd_vel") return;
  const auto command = decode<geometry_msgs::TwistStamped>(MessageEncoding::cdr, bytes);
  if (!command || !std::isfinite(command->twist.linear.x) || !std::isfinite(command->twist.angular.z))
    std::abort();
}

}  // namespace

extern "C" int FUZZ_ENTRY(node_inputs)(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto node = node_of(data[0]);
  double time_s = 1.0;
  for (std::size_t at = 1; at + 3 <= size; time_s += 0.05) {
    const std::size_t input = data[at] % node->inputs().size();
    const std::size_t length = std::min<std::size_t>(data[at + 1] + 256U * data[at + 2], size - at - 3);
    std::string cdr("\0\1\0\0", 4);
    cdr.append(reinterpret_cast<const char*>(data) + at + 3, length);
    at += 3 + length;
    node->receive(input, cdr, time_s);
    node->tick(time_s);
    for (const NodeEvent& event : node->take_events()) {
      if (event.sentence.empty()) std::abort();
    }
    for (const NodeOutput& output : node->take_outputs())
      check(node->outputs()[output.topic].name, output.bytes);
  }
  return 0;
}
