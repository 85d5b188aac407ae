#include "outrider/nodes/missions/pursue_mission_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "missions/limits.hpp"
#include "outrider/nodes/missions/in_the_way.hpp"

namespace outrider {
namespace {

constexpr double silent_seconds = 2.0;  // of the mission, without the target, after which the robot stands
constexpr double there_part = 0.05;     // of a cell: nearer to its middle the robot is there
constexpr std::uint64_t most_expansions_a_plan = 5'000'000;

}  // namespace

/// Planning costs no time of the mission: a plan that comes late lets a second take longer.
class PursueMissionNode::Clock final : public StopWatch {
 public:
  double lap_s() override { return 0.0; }
  void restart() override {}
};

PursueMissionNodeOptions::PursueMissionNodeOptions() {
  pace.speed_mps = 2.0;
  pace.acceleration_mps2 = 4.0;
  pace.turn_rate_radps = 6.0;
  pace.turn_acceleration_radps2 = 30.0;
  pace.pause_s = 0.0;
}

std::vector<OptionGroup> describe(PursueMissionNodeOptions& options) {
  return {{"",
           "the robot",
           {{"cell", "m", 0.01, 1000.0, "side of a cell of the map", &options.cell_m},
            {"radius", "m", 0.01, 100.0, "of a disk that contains the robot", &options.radius_m},
            {"second", "s", 0.1, 3600.0, "for which a second of the mission takes", &options.second_s},
            {"speed", "m/s", 0.01, 100.0, "at which it drives from cell to cell", &options.pace.speed_mps},
            {"acceleration", "m/s2", 0.01, 100.0, "of the drive", &options.pace.acceleration_mps2},
            {"turn_rate", "rad/s", 0.01, 100.0, "at which it turns in place", &options.pace.turn_rate_radps},
            {"turn_acceleration", "rad/s2", 0.01, 1000.0, "of the turn",
             &options.pace.turn_acceleration_radps2}}}};
}

Status PursueMissionNode::check(const PursuitScenario& scenario, const PursuitTask& task) {
  if (auto ok = check_no_faults(scenario.faults.any()); !ok) return ok;
  if (task.robots.size() > 1) return bad_input("a node is one robot; give one pursuer", "pursuers");
  if (scenario.clock == "wall")
    return bad_input("behind topics time passes by itself; give the clock virtual", "clock");
  return {};
}

PursueMissionNode::PursueMissionNode(PursueMissionNodeOptions options, PursuitTask task,
                                     const std::string& name)
    : MissionNode("pursue", options.node),
      options_(std::move(options)),
      task_(std::move(task)),
      name_(name),
      clock_(std::make_unique<Clock>()),
      driver_(options_.pace, true) {
  task_.rules.known_s = 0;
  task_.rules.budget.expansions = std::min(task_.rules.budget.expansions, most_expansions_a_plan);
  listen_to_pose();
  listen_to_scan();
  listen<geometry_msgs::PoseStamped>("target_pose", Delivery::sensor,
                                     [this](const auto& target) { return take_target(target); });
  set_status(NodeLevel::info, "waiting", "no odometry has come yet");
}

PursueMissionNode::~PursueMissionNode() = default;

Status PursueMissionNode::take_target(const geometry_msgs::PoseStamped& target) {
  const std::optional<double> before_s = targets_.newest_s();
  const auto time_s = targets_.take(target.header.stamp);
  if (!time_s) return pass_on(time_s);
  const auto pose = plane_pose(target.pose);
  if (!pose) return pass_on(pose);
  if (!task_.problem.costs->contains(cell_of(pose->position)))
    return bad_input(
        fmt::format("the target is at {:g}, {:g}, outside of the map", pose->position.x, pose->position.y));
  target_ = pose->position;
  if (before_s != *time_s) target_came_s_ = now_s();
  return {};
}

Cell PursueMissionNode::cell_of(Vec2 point) const {
  return task_.problem.costs->frame.cell_at(1.0 / options_.cell_m * point);
}

std::string PursueMissionNode::why_to_stop() const {
  if (std::string why = why_pose_is_missing(); !why.empty()) return why;
  if (std::string why = why_scan_is_missing(); !why.empty()) return why;
  if (!target_) return "the target was not seen yet";
  if (now_s() - target_came_s_ <= silent_seconds * options_.second_s) return {};
  return fmt::format("the target was not seen for {:g} s", silent_seconds * options_.second_s);
}

void PursueMissionNode::begin(Cell robot) {
  task_.problem.start = robot;
  const std::size_t seconds = task_.problem.target.size();
  std::ranges::fill(task_.problem.target, cell_of(*target_));
  if (auto ok = outrider::check(task_.problem); !ok) return end(ok.error());
  begin_log();
  mission_ = std::make_unique<PursuitMission>(task_.problem, seconds, task_.rules, *clock_);
  run_log_ = std::make_unique<PursuitLog>(log(), task_.problem, name_);
  next_s_ = now_s();
}

/// Lets a second of the mission pass.
void PursueMissionNode::step(const Pose2& pose) {
  const Cell target = cell_of(*target_);
  if (seconds_ < task_.problem.target.size()) task_.problem.target[seconds_] = target;
  Observation seen;
  seen.time_s = static_cast<double>(seconds_++);
  seen.grid = GridObservation{{cell_of(pose.position)}, {target}};
  next_s_ = now_s() + options_.second_s;
  const auto command = mission_->step(seen);
  run_log_->note(mission_->run);
  if (!command) return finish();
  const Vec2 to = options_.cell_m * task_.problem.costs->frame.centre(std::get<StepToCell>(*command).cell);
  if (distance(pose.position, to) < there_part * options_.cell_m) return;
  FollowPiece drive;
  drive.piece.from = pose.position;
  drive.piece.to = to;
  driver_.begin(drive, now_s());
}

/// Returns true if something at that point is not on the map, and not the target.
bool PursueMissionNode::is_unmapped(Vec2 point) const {
  if (target_ && distance(point, *target_) <= options_.cell_m) return false;
  const auto can_enter = [&](Vec2 at) {
    const Cell cell = cell_of(at);
    return task_.problem.costs->contains(cell) && (*task_.problem.costs)[cell] < task_.problem.threshold;
  };
  for (const double x : {-on_map_m, on_map_m}) {
    for (const double y : {-on_map_m, on_map_m}) {
      if (!can_enter(point + Vec2{x, y})) return false;
    }
  }
  return true;
}

/// Drives on, or stands before what is in the way.
void PursueMissionNode::drive(const Pose2& pose) {
  const Twist2 twist = driver_.twist(now_s(), pose).value_or(Twist2{});
  if (const auto points = new_scan_on_map()) {
    unmapped_.clear();
    std::ranges::copy_if(*points, std::back_inserter(unmapped_),
                         [&](Vec2 point) { return is_unmapped(point); });
  }
  const StopRule rule = stop_rule(options_.radius_m, options_.pace.acceleration_mps2);
  if (has_to_stand(in_the_way(unmapped_, pose, twist, rule), pose.position)) return driver_.stopped();
  command(twist);
  set_status(NodeLevel::info, "pursuing",
             fmt::format("second {} of the mission", mission_->run.state.time_s));
}

void PursueMissionNode::finish() {
  if (mission_->fault) return end(*mission_->fault);
  const PursuitState& state = mission_->run.state;
  end(state.caught ? NodeLevel::info : NodeLevel::error, state.caught ? "caught" : "not_caught",
      fmt::format("{} in second {}, at a cost of {}",
                  state.caught ? "the target was caught" : "no catch was possible any more", state.time_s,
                  state.cost));
}

void PursueMissionNode::act() {
  if (is_over()) return command({});
  if (const std::string why = why_to_stop(); !why.empty()) {
    driver_.stopped();
    set_status(mission_ ? NodeLevel::error : NodeLevel::info, mission_ ? "stopped" : "waiting", why);
    return command({});
  }
  const Pose2 pose = *frames().map_T_robot();
  if (!task_.problem.costs->contains(cell_of(pose.position))) {
    return end(
        NodeLevel::error, "outside_map",
        fmt::format("the robot is at {:.2f}, {:.2f}, outside of the map", pose.position.x, pose.position.y));
  }
  if (!mission_) begin(cell_of(pose.position));
  if (!is_over() && now_s() + soon_s >= next_s_) step(pose);
  if (!is_over()) drive(pose);
}

}  // namespace outrider
