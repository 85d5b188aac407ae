#include "outrider/nodes/missions/cover_mission_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "missions/limits.hpp"
#include "outrider/core/units.hpp"
#include "outrider/nodes/missions/in_the_way.hpp"

namespace outrider {
namespace {

constexpr double noted_m = 0.01, noted_rad = radians(2.0);  // between two poses of the drive
constexpr double good_part = 0.01;  // of the reach, that a drive may cover less than its track
constexpr std::uint64_t most_expansions_of_track = 20'000'000;

/// Returns true if something at that point is not on the map.
bool is_unmapped(Vec2 point, const CoverageArea& ground, bool transfers) {
  if (!transfers && !contains(ground.area, point)) return false;
  return std::ranges::all_of(
      ground.area, [&](const RingedPolygon& part) { return distance_to_border(part, point) > on_map_m; });
}

}  // namespace

struct CoverMissionNode::Work {
  CoverTask task;
  CoverPlan plan;
  CoverProof proof;
  CoverMission mission;
  PieceDriver driver;
  CoverLog log;

  Work(CoverTask of, CoverPlan planned, CoverProof proven, Log& to, const CoverScenario& scenario)
      : task(std::move(of)),
        plan(std::move(planned)),
        proof(std::move(proven)),
        mission(plan.track, task.problem.pace.pause_s),
        driver(task.problem.pace, !task.problem.curves()),
        log(to, task.problem, plan, static_cast<std::uint64_t>(scenario.seed),
            std::filesystem::path(scenario.area).filename().string()) {}
};

Status CoverMissionNode::check(const CoverScenario& scenario) {
  if (scenario.sim != "ideal")
    return bad_input("behind topics the track is driven as it is; leave this out", "sim");
  auto task = load_task(scenario);
  if (!task) return pass_on(task);
  if (!task->problem.frame.degrees) return {};
  return bad_input("the area is given in degrees; give it in metres of the map", scenario.area);
}

CoverMissionNode::CoverMissionNode(MissionNodeOptions options, CoverScenario scenario)
    : MissionNode("cover", std::move(options)), scenario_(std::move(scenario)) {
  listen_to_pose();
  listen_to_scan();
  set_status(NodeLevel::info, "waiting", "no odometry has come yet");
}

Status CoverMissionNode::begin(const Pose2& pose) {
  CoverScenario scenario = scenario_;
  if (scenario.start.empty())
    scenario.start = fmt::format("{},{},{}", pose.position.x, pose.position.y, degrees(pose.heading_rad));
  auto task = load_task(scenario);
  if (!task) return pass_on(task);
  const Vec2 robot = task->problem.frame.to_local(pose.position);
  if (auto ok = check_start(task->problem.start->position, robot, "leave the start out"); !ok) return ok;
  Budget budget;
  budget.expansions = most_expansions_of_track;
  auto plan = task->method.plan(task->problem, scenario.options, budget);
  if (!plan) return tl::unexpected<Fault>(placed(plan.error(), *task));
  auto proof = prove(*plan, task->problem, budget);
  if (!proof) return pass_on(proof);
  begin_log();
  work_ = std::make_shared<Work>(std::move(*task), std::move(*plan), std::move(*proof), log(), scenario);
  return {};
}

/// Notes where the robot is for the log and for what it covers.
void CoverMissionNode::note(const Pose2& pose) {
  const double time_s = mission_s();
  drive_.time_s = time_s;
  if (work_->driver.drives())
    drive_.tracking_error_m = std::max(drive_.tracking_error_m, work_->driver.distance_from(pose.position));
  if (!drive_.track.empty()) {
    const Pose2& before = drive_.track.back().pose;
    const double moved_m = distance(before.position, pose.position);
    const double turned_rad = std::abs(wrap_angle(pose.heading_rad - before.heading_rad));
    if (moved_m < noted_m && turned_rad < noted_rad) return;
    drive_.length_m += moved_m;
    drive_.turned_rad += turned_rad;
  }
  drive_.track.push_back({time_s, pose});
  drive_.way.push_back(pose.position);
  drive_.times_s.push_back(time_s);
  work_->log.note(drive_);
}

void CoverMissionNode::finish() {
  const CoverProblem& problem = work_->task.problem;
  std::vector<Pose2> poses;
  for (const TimedPose& timed : drive_.track) poses.push_back(timed.pose);
  const auto bar = problem.bar();
  const Region& reach = work_->plan.ground.reach;
  const Coverage driven =
      bar ? coverage_of(poses, *bar, reach) : coverage_of(drive_.way, problem.body_radius_m(), reach);
  const bool good = driven.fraction >= work_->proof.planned.fraction - good_part;
  work_->log.note(drive_);
  work_->log.finish(drive_, driven, {.finished = true, .kept = good});
  const bool strayed = drive_.tracking_error_m > problem.tracking_error_m;
  end(good ? NodeLevel::info : NodeLevel::error, good ? "done" : "not_done",
      fmt::format(
          "{:.2f} % of the reach were covered; the robot came up to {:.3f} m off its track{}",
          100.0 * driven.fraction, drive_.tracking_error_m,
          strayed
              ? fmt::format(", more than the tracking_error of {:g} m for which it is proven what it covers",
                            problem.tracking_error_m)
              : std::string()));
}

/// Notes what the newest scan shows and the map does not have.
void CoverMissionNode::note_unmapped() {
  const auto points = new_scan_on_map();
  if (!points) return;
  unmapped_.clear();
  for (const Vec2 point : *points) {
    const Vec2 at = work_->task.problem.frame.to_local(point);
    if (is_unmapped(at, work_->plan.ground, work_->task.problem.transfers)) unmapped_.push_back(at);
  }
}

void CoverMissionNode::go_on(const Pose2& pose) {
  Work& work = *work_;
  auto twist = work.driver.twist(now_s(), pose);
  note(pose);
  while (!twist) {
    if (work.mission.next > 0) drive_.ends_s.push_back(mission_s());
    const auto next = work.mission.step({});
    if (!next) return finish();
    work.driver.begin(std::get<FollowPiece>(*next), now_s());
    twist = work.driver.twist(now_s(), pose);
  }
  note_unmapped();
  const CoverProblem& problem = work.task.problem;
  auto thing =
      in_the_way(unmapped_, pose, *twist, stop_rule(problem.radius_m(), problem.pace.acceleration_mps2));
  if (thing) thing = problem.frame.to_file(*thing);
  if (has_to_stand(thing, problem.frame.to_file(pose.position))) {
    work.driver.stopped();
    moved_on_s_ = now_s();
    return;
  }
  if (distance(pose.position, stood_) > moved_on_m || !work.driver.drives()) {
    stood_ = pose.position;
    moved_on_s_ = now_s();
  }
  if (ends_stuck(moved_on_s_)) return;
  command(*twist);
  set_status(
      NodeLevel::info, "covering",
      fmt::format("piece {} of {} of the track is driven", work.mission.next, work.plan.track.pieces.size()));
}

void CoverMissionNode::act() {
  if (is_over()) return command({});
  std::string why = why_pose_is_missing();
  if (why.empty()) why = why_scan_is_missing();
  if (!why.empty()) {
    if (work_) work_->driver.stopped();
    moved_on_s_ = now_s();
    set_status(work_ ? NodeLevel::error : NodeLevel::info, work_ ? "stopped" : "waiting", why);
    return command({});
  }
  const Pose2 pose = *frames().map_T_robot();
  if (!work_) {
    command({});
    if (auto ok = begin(pose); !ok) return end(ok.error());
    moved_on_s_ = now_s();
  }
  go_on({work_->task.problem.frame.to_local(pose.position), pose.heading_rad});
}

}  // namespace outrider
