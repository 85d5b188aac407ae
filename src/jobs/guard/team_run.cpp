#include "outrider/jobs/guard/team_run.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/robot.hpp"
#include "team_schedule.hpp"

namespace outrider {
namespace {

constexpr double team_wait_s = 0.5;  // until a drive is asked for again

/// A robot of the team with its mission. It is made in place and never moved.
struct TeamRobot {
  TeamRobot(const GuardProblem& yard, const FiringMap& firing_map, const TeamPart& part, Log& log,
            std::uint64_t seed)
      : problem(yard) {
    problem.start = part.start;
    tasks = tasks_of(problem, part.plan);
    robot.emplace(simulated_guard(problem, firing_map, log, seed));
  }

  GuardProblem problem;  // with its own start
  StopTasks tasks;
  std::optional<SimulatedRobot> robot;
  std::vector<Presence> present;  // as admitted
  TimedDrives driven;
  bool done = false;
  bool refused = false;  // its next drive was, since anybody did anything else
};

class TeamRunner {
 public:
  TeamRunner(const GuardProblem& problem, const FiringMap& firing_map, const TeamPlan& plan,
             std::uint64_t seed)
      : problem_(problem), firing_map_(firing_map) {
    run_.logs.resize(plan.parts.size());
    const Rng streams = Rng(seed).child("robot");
    for (std::size_t r = 0; r < plan.parts.size(); ++r) {
      const Pose2& start = plan.parts[r].start;
      auto& member = *team_.emplace_back(std::make_unique<TeamRobot>(problem, firing_map, plan.parts[r],
                                                                     run_.logs[r], streams.child(r).bits()));
      member.present = {standing(start.position, 0.0)};
      member.driven.start = start;
    }
    for (const Unreachable& lost : plan.unreachable)
      settle(team_.front()->tasks.records[lost.target], TargetStatus::unreachable, lost.reason, 0.0);
  }

  TeamRun run(const std::stop_token& stop) {
    while (TeamRobot* const next = earliest()) {
      if (stop.stop_requested()) {
        run_.ended_early = true;
        break;
      }
      step(*next);
    }
    finish();
    return std::move(run_);
  }

 private:
  /// The robot with the earliest clock of those with something left to do.
  [[nodiscard]] TeamRobot* earliest() const {
    TeamRobot* first = nullptr;
    for (const auto& member : team_) {
      if (member->done || (first != nullptr && first->robot->time_s() <= member->robot->time_s())) continue;
      first = member.get();
    }
    return first;
  }

  void step(TeamRobot& member) {
    const Observation seen = member.robot->sense();
    note_shots(member.tasks, seen, member.problem, firing_map_);
    StopTasks tried = member.tasks;  // a drive that is refused has not been begun
    const auto command = next_command(tried, seen, member.problem, firing_map_);
    if (!command) {
      member.tasks = std::move(tried);
      member.done = true;
      return;
    }
    if (const auto* drive = std::get_if<FollowWaypoints>(&*command)) {
      auto own = presences(member.problem.robot, seen.odometry.heading_rad, drive->waypoints, seen.time_s,
                           problem_.errors.position_m);
      if (!apart_from_others(member, own)) return refuse(member, std::move(tried), *drive, seen.time_s);
      admit(member, std::move(own), seen.time_s);
      member.driven.drives.push_back({seen.time_s, drive->waypoints, seen.odometry.heading_rad});
    }
    member.tasks = std::move(tried);
    member.robot->act(*command);
    if (std::holds_alternative<FollowWaypoints>(*command))
      member.driven.drives.back().waypoints.back() = member.robot->pose().position;
    for (const auto& other : team_) other->refused = false;
  }

  [[nodiscard]] bool apart_from_others(const TeamRobot& member, const std::vector<Presence>& own) const {
    return std::ranges::all_of(team_, [&](const auto& other) {
      return other.get() == &member || keep_apart(own, other->present, team_gap_m(problem_));
    });
  }

  static void admit(TeamRobot& member, std::vector<Presence> own, double time_s) {
    member.present.back().end_s = time_s;
    member.present.insert(member.present.end(), own.begin(), own.end());
  }

  /// Lets a robot wait, or give its present stop up if waiting does not help any more. `tried` are its tasks
  /// as if it had begun the drive.
  void refuse(TeamRobot& member, StopTasks tried, const FollowWaypoints& drive, double time_s) {
    member.refused = true;
    const bool stuck = std::ranges::all_of(team_, [&](const auto& other) {
      return (other->done || other->refused) && other->present.back().begin_s <= time_s;
    });
    if (stuck) {
      member.tasks = std::move(tried);
      give_up_stop(member, drive, time_s);
      return;
    }
    member.robot->act(Wait{time_s + team_wait_s});
    run_.waited_s += team_wait_s;
  }

  /// Fails the targets of the present stop and of the drive to it, whose shots are not fired.
  void give_up_stop(TeamRobot& member, const FollowWaypoints& drive, double time_s) {
    ++run_.given_up;
    StopTasks& tasks = member.tasks;
    std::vector<std::size_t> targets = std::move(tasks.queue.front().targets);
    for (const FireInPassing& shot : drive.shots) {
      --tasks.records[shot.target].shots;
      std::erase_if(tasks.flying, [&](const FlyingBall& ball) { return ball.target == shot.target; });
      targets.push_back(shot.target);
    }
    for (const std::size_t target : targets)
      settle(tasks.records[target], TargetStatus::failed, "another robot stood in the way", time_s);
    tasks.queue.pop_front();
    tasks.arrived = tasks.aimed = false;
    member.refused = false;
  }

  /// Gathers what has become of the targets: each was left to one robot.
  void finish() {
    run_.records.resize(problem_.targets.size());
    for (const auto& member : team_) {
      for (std::size_t t = 0; t < run_.records.size(); ++t) {
        TargetRecord& record = member->tasks.records[t];
        if (record.status != TargetStatus::waiting) run_.records[t] = std::move(record);
      }
      run_.driven.push_back(std::move(member->driven));
      run_.mission_s = std::max(run_.mission_s, member->robot->time_s());
    }
  }

  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  TeamRun run_;
  std::vector<std::unique_ptr<TeamRobot>> team_;
};

}  // namespace

TeamRun run_team(const GuardProblem& problem, const FiringMap& firing_map, const TeamPlan& plan,
                 std::uint64_t seed, const std::stop_token& stop) {
  return TeamRunner(problem, firing_map, plan, seed).run(stop);
}

}  // namespace outrider
