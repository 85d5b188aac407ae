#include "outrider/jobs/guard/team/team_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/run/robot.hpp"
#include "outrider/log/append.hpp"
#include "run/guard_log.hpp"
#include "team/team_balls.hpp"
#include "team/team_schedule.hpp"

namespace outrider {
namespace {

constexpr double team_wait_s = 0.5;  // until a command that had to wait is asked for again

/// A robot of the team with its mission. It is made in place and never moved.
struct TeamRobot {
  TeamRobot(const GuardProblem& team, const FiringMap& firing_map, const GuardSimParams& faults,
            const TeamPart& part, std::size_t number, std::uint64_t seed)
      : problem(started_at(team, part.start)),
        index(number),
        mission(problem, firing_map, part.plan),
        targets(run.targets, queue, team.targets),
        robot(simulated_guard(problem, firing_map, run.log, seed, {}, {}, faults)),
        present{standing(part.start.position, 0.0)} {
    run.driven.start = part.start;
  }

  static GuardProblem started_at(GuardProblem problem, const Pose2& start) {
    problem.start = start;
    return problem;
  }

  GuardProblem problem;  // with its own start
  std::size_t index;     // among the robots
  GuardMission mission;
  TeamRobotRun run;
  LogQueue queue;
  TargetLog targets;
  SimulatedRobot robot;
  std::vector<Presence> present;  // as admitted
  double stays_until_s = 0.0;     // a ball touches it where it stands then
  bool done = false;
  bool refused = false;  // its next command was, since anybody did anything else
  bool waits = false;    // its newest command was a wait for others
};

class TeamRunner {
 public:
  TeamRunner(const GuardProblem& problem, const FiringMap& firing_map, const TeamPlan& plan,
             std::uint64_t seed, const GuardSimParams& faults)
      : problem_(problem), firing_map_(firing_map), order_(plan, simulated_gap_m(problem)) {
    const Rng streams = Rng(seed).child("robot");
    for (std::size_t r = 0; r < plan.parts.size(); ++r) {
      auto& member = *team_.emplace_back(std::make_unique<TeamRobot>(
          problem, firing_map, faults, plan.parts[r], r, streams.child(r).bits()));
      member.robot.set_ball_stops([this, r](const Flight& flight, double fired_s, double until_s) {
        return note_ball(r, {flight, fired_s, fired_s + until_s});
      });
    }
    for (const Unreachable& lost : plan.unreachable)
      team_.front()->mission.board().settle(lost.target, TargetStatus::unreachable, lost.reason, 0.0);
    note_owners(plan);
  }

  TeamRun run(const RunWatch& watch) {
    while (TeamRobot* const next = earliest()) {
      if (watch.stopped()) {
        run_.ended_early = true;
        break;
      }
      next->mission.board().set_stop(watch.stop);
      const double time_s = next->robot.time_s();
      step(*next);
      next->targets.note(next->mission, time_s);
      gather_records();
      watch.part(settled_part(run_.records));
    }
    finish();
    return std::move(run_);
  }

 private:
  /// Notes for each target the robot whose part it is in. Each target is in the part of one robot.
  void note_owners(const TeamPlan& plan) {
    run_.robot_of.resize(problem_.targets.size());
    for (std::size_t r = 0; r < plan.parts.size(); ++r) {
      for (const std::size_t target : plan.parts[r].plan.targets()) run_.robot_of[target] = r;
    }
  }

  /// The robot with the earliest clock of those with something left to do.
  [[nodiscard]] TeamRobot* earliest() const {
    TeamRobot* first = nullptr;
    for (const auto& member : team_) {
      if (member->done || (first != nullptr && first->robot.time_s() <= member->robot.time_s())) continue;
      first = member.get();
    }
    return first;
  }

  void step(TeamRobot& member) {
    const Observation seen = member.robot.sense();
    member.mission.note(seen);
    GuardMission tried = member.mission;  // a command that is refused has not been begun
    auto command = tried.next(seen);
    if (!command) {
      member.mission = std::move(tried);
      member.done = true;
      return;
    }
    if (auto* drive = std::get_if<FollowWaypoints>(&*command)) {
      if (!admit_drive(member, tried, *drive, seen)) return;
    } else if (const auto* shot = std::get_if<Fire>(&*command)) {
      if (!admit_shot(member, tried, *shot, seen)) return;
    }
    member.mission = std::move(tried);
    member.robot.act(*command);
    if (std::holds_alternative<FollowWaypoints>(*command))
      member.run.driven.drives.back().waypoints.back() = member.robot.pose().position;
    member.waits = false;
    for (const auto& other : team_) other->refused = false;
  }

  // ---- Drives ------------------------------------------------------------------------------------

  /// Returns false if the drive does not begin now. `tried` is the mission as if it had. Both may become
  /// those of another way.
  bool admit_drive(TeamRobot& member, GuardMission& tried, FollowWaypoints& drive, const Observation& seen) {
    auto own = presences_of(member, drive, seen);
    if (!apart_from_balls(member, own, seen.time_s)) {  // they land
      wait(member, seen.time_s, "a ball has landed");
      return false;
    }
    const TeamRobot* hindrance = nearest_other(member, own);
    const bool blocked = hindrance != nullptr;
    if (!blocked) hindrance = whose_turn(member, tried, drive);
    if (hindrance == nullptr) hindrance = first_shot_at(member, tried, drive, seen);
    if (hindrance != nullptr && !is_stuck(member, seen.time_s)) {
      wait(member, seen.time_s, fmt::format("robot {} is out of the way", hindrance->index + 1));
      return false;
    }
    if (blocked && !lead_around(member, tried, drive, seen)) {
      give_up_stop(member, tried, drive, *hindrance, seen.time_s);
      return false;
    }
    if (blocked) own = presences_of(member, drive, seen);
    member.present.back().end_s = seen.time_s;
    member.present.insert(member.present.end(), own.begin(), own.end());
    member.run.driven.drives.push_back({seen.time_s, drive.waypoints, seen.odometry.heading_rad});
    return true;
  }

  [[nodiscard]] std::vector<Presence> presences_of(const TeamRobot& member, const FollowWaypoints& drive,
                                                   const Observation& seen) const {
    return presences(member.problem.robot, seen.odometry.heading_rad, drive.waypoints, seen.time_s,
                     problem_.errors.position_m);
  }

  /// Everybody else stands: changes the drive to one around them, and the mission. Returns false if there is
  /// none.
  bool lead_around(const TeamRobot& member, GuardMission& tried, FollowWaypoints& drive,
                   const Observation& seen) {
    constexpr double rounding_m = 1e-3;
    GuardMission around = member.mission;
    KeepAway others{{}, simulated_gap_m(problem_) + rounding_m};
    for (const auto& other : team_) {
      if (other.get() != &member) others.standing.push_back(other->present.back().within.a);
    }
    auto command = around.board().next_command_around(seen, std::move(others));
    auto* const led = command ? std::get_if<FollowWaypoints>(&*command) : nullptr;
    if (led == nullptr) return false;
    const auto own = presences_of(member, *led, seen);
    if (nearest_other(member, own) != nullptr || !apart_from_balls(member, own, seen.time_s)) return false;
    drive = std::move(*led);
    tried = std::move(around);
    return true;
  }

  /// Returns a robot whose turn comes first; null if there is none.
  [[nodiscard]] const TeamRobot* whose_turn(const TeamRobot& member, const GuardMission& tried,
                                            const FollowWaypoints& drive) const {
    std::vector<const TaskBoard*> boards;
    boards.reserve(team_.size());
    for (const auto& other : team_) boards.push_back(&other->mission.board());
    const auto first = order_.waits_for(member.index, tried.board().last_place(), drive.waypoints, boards);
    return first ? team_[*first].get() : nullptr;
  }

  /// Returns a robot that the drive would come too near to; null if there is none.
  [[nodiscard]] const TeamRobot* nearest_other(const TeamRobot& member,
                                               const std::vector<Presence>& own) const {
    for (const auto& other : team_) {
      if (other.get() != &member && !keep_apart(own, other->present, simulated_gap_m(problem_)))
        return other.get();
    }
    return nullptr;
  }

  bool apart_from_balls(const TeamRobot& member, const std::vector<Presence>& own, double time_s) {
    if (time_s < member.stays_until_s) return false;
    std::erase_if(balls_, [&](const auto& ball) { return ball.second.lands_s <= time_s; });
    return std::ranges::none_of(balls_, [&](const auto& ball) {
      return ball.first != member.index && may_touch(problem_, ball.second, own);
    });
  }

  /// Fails the targets of the present stop and of the drive to it, whose shots are not fired.
  void give_up_stop(TeamRobot& member, GuardMission tried, const FollowWaypoints& drive,
                    const TeamRobot& other, double time_s) {
    std::vector<std::size_t> targets = tried.board().drop_task();
    for (const FireInPassing& shot : drive.shots) {
      tried.board().take_back(shot.target);
      targets.push_back(shot.target);
    }
    for (const std::size_t target : targets)
      tried.board().settle(target, TargetStatus::failed,
                           fmt::format("robot {} stood in the way", other.index + 1), time_s);
    give_up(member, std::move(tried), "its next stop", other, time_s);
  }

  // ---- Shots -------------------------------------------------------------------------------------

  /// Returns false if the shot is not fired now. `tried` is the mission as if it were.
  bool admit_shot(TeamRobot& member, GuardMission tried, const Fire& fire, const Observation& seen) {
    const TeamRobot* const other = shot_at(
        member, planned_ball(tried, {seen.odometry.position, {}}, fire.target, fire.shot, seen.time_s));
    if (other == nullptr) return true;
    if (!is_stuck(member, seen.time_s)) {
      wait(member, seen.time_s, fmt::format("robot {} is out of the line of fire", other->index + 1));
      return false;
    }
    tried.board().take_back(fire.target);
    tried.board().settle(fire.target, TargetStatus::failed,
                         fmt::format("robot {} stood in the line of fire", other->index + 1), seen.time_s);
    give_up(member, std::move(tried), "a shot", *other, seen.time_s);
    return false;
  }

  /// Returns a robot that is in the way of a shot in passing; null if there is none.
  [[nodiscard]] const TeamRobot* first_shot_at(const TeamRobot& member, const GuardMission& tried,
                                               const FollowWaypoints& drive, const Observation& seen) const {
    if (drive.shots.empty()) return nullptr;
    const auto legs = straights(member.problem.robot, seen.odometry.heading_rad, drive.waypoints);
    for (const FireInPassing& shot : drive.shots) {
      const auto leg = std::ranges::find(legs, shot.leg, &Straight::leg);
      if (leg == legs.end()) continue;
      const Platform from = platform_on(member.problem.robot, leg->from, leg->to, shot.after_s);
      const double fires_s = seen.time_s + leg->begin_s + shot.after_s;
      if (const auto* other = shot_at(member, planned_ball(tried, from, shot.target, shot.shot, fires_s)))
        return other;
    }
    return nullptr;
  }

  [[nodiscard]] TeamBall planned_ball(const GuardMission& mission, const Platform& from, std::size_t target,
                                      const Shot& shot, double fired_s) const {
    const auto& planned = mission.board().records()[target].shot;
    return {launch(firing_map_.rules, from, problem_.targets[target], shot), fired_s,
            fired_s + (planned ? planned->flight_s : 0.0)};
  }

  [[nodiscard]] const TeamRobot* shot_at(const TeamRobot& member, const TeamBall& ball) const {
    for (const auto& other : team_) {
      if (other.get() != &member && may_touch(problem_, ball, other->present)) return other.get();
    }
    return nullptr;
  }

  /// A ball has left the barrel of a robot: what stops it. Others are where they have driven to, or stand.
  std::optional<BallStop> note_ball(std::size_t shooter, TeamBall ball) {
    std::optional<BallStop> stop;
    for (const auto& other : team_) {
      if (other->index == shooter) continue;
      const auto time_s = touches_body(problem_, ball, other->run.driven);
      if (!time_s) continue;
      stop = BallStop{*time_s, fmt::format("robot {}", other->index + 1)};
      ball.lands_s = ball.fired_s + *time_s;
      other->stays_until_s = std::max(other->stays_until_s, ball.lands_s);
    }
    if (stop) ++run_.stopped;
    balls_.emplace_back(shooter, std::move(ball));
    return stop;
  }

  // ---- Waiting -----------------------------------------------------------------------------------

  /// Notes that the robot cannot go on now. Returns true if waiting does not help any more.
  bool is_stuck(TeamRobot& member, double time_s) {
    member.refused = true;
    return std::ranges::all_of(team_, [&](const auto& other) {
      return (other->done || other->refused) && other->present.back().begin_s <= time_s;
    });
  }

  static void wait(TeamRobot& member, double time_s, const std::string& until) {
    if (!std::exchange(member.waits, true))
      member.robot.queue().note_event(time_s, "yield", "waits until " + until);
    member.robot.act(Wait{time_s + team_wait_s});
    member.run.waited_s += team_wait_s;
  }

  void give_up(TeamRobot& member, GuardMission tried, const std::string& what, const TeamRobot& other,
               double time_s) {
    ++run_.given_up;
    member.mission = std::move(tried);
    member.refused = false;
    member.robot.queue().note_event(
        time_s, "give_up", fmt::format("gives {} up: robot {} stands in the way", what, other.index + 1));
  }

  // ---- Its result -------------------------------------------------------------------------------

  void gather_records() {
    run_.records.resize(problem_.targets.size());
    for (std::size_t t = 0; t < run_.records.size(); ++t)
      run_.records[t] = team_[run_.robot_of[t]]->mission.board().records()[t];
  }

  void finish() {
    gather_records();
    for (const auto& member : team_) {
      member->run.end_s = member->robot.time_s();
      member->run.record = member->robot.record;
      run_.mission_s = std::max(run_.mission_s, member->run.end_s);
      run_.waited_s += member->run.waited_s;
      member->robot.queue().flush(member->run.log, member->run.end_s);
      member->targets.note(member->mission, member->run.end_s);
    }
    for (const auto& member : team_) {
      // A robot that is done stands there until all are.
      if (member->run.end_s < run_.mission_s) log_pose(member->run.log, run_.mission_s, member->robot.pose());
      run_.robots.push_back(std::move(member->run));
    }
  }

  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  TeamOrder order_;
  TeamRun run_;
  std::vector<std::unique_ptr<TeamRobot>> team_;
  std::vector<std::pair<std::size_t, TeamBall>> balls_;  // with who fired them
};

}  // namespace

TeamRun run_team(const GuardProblem& problem, const FiringMap& firing_map, const TeamPlan& plan,
                 std::uint64_t seed, const RunWatch& watch, const GuardSimParams& faults) {
  return TeamRunner(problem, firing_map, plan, seed, faults).run(watch);
}

}  // namespace outrider
