#include "team/team_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/jobs/guard/plan/passing.hpp"
#include "outrider/motion/profile.hpp"
#include "plan/plan_clock.hpp"

namespace outrider {
namespace {

constexpr double no_end_s = std::numeric_limits<double>::infinity();
constexpr double piece_s = 0.25;        // longest piece of a drive that is compared at once
constexpr double wait_step_s = 0.25;    // waits that are tried
constexpr int most_admissions = 2'000;  // drives that are admitted, those taken back included

/// Bounds on what a drive may be off its leg if it ends beside the end of the leg.
struct LegError {
  double shift_s = 0.0;  // the turn to the leg takes so much more or less
  double delay_s = 0.0;  // the drive is so much later at its end, at most
  double along_m = 0.0;  // at a time after the turn, from its place on the leg
};

LegError leg_error(const RobotModel& robot, const Straight& leg, double error_m) {
  if (error_m == 0.0) return {};
  const double length = distance(leg.from, leg.to);
  const double shift_s = duration(error_m < length ? std::asin(error_m / length) : pi, robot.turning());
  // The way driven after some time changes by no more than the length, and so does its part of the length.
  return {shift_s, shift_s + duration(length + error_m, robot.straight()) - leg.length_s, 2.0 * error_m};
}

/// Adds where a robot is while it turns to a leg, from `time_s` on, and drives it.
void add_leg(std::vector<Presence>& present, const RobotModel& robot, const Straight& leg, double time_s,
             double leaves_s, const LegError& error) {
  present.push_back({time_s, leaves_s + error.shift_s, {leg.from, leg.from}});
  const Limits straight = robot.straight();
  const double length = distance(leg.from, leg.to);
  const Vec2 ahead = 1.0 / length * (leg.to - leg.from);
  const auto pieces = static_cast<int>(std::ceil(leg.length_s / piece_s));
  for (int i = 0; i < pieces; ++i) {
    const double begin_s = leg.length_s * i / pieces, end_s = leg.length_s * (i + 1) / pieces;
    const double rear = std::max(0.0, covered(length, straight, begin_s) - error.along_m);
    const double front = std::min(length, covered(length, straight, end_s) + error.along_m);
    present.push_back({std::max(time_s, leaves_s + begin_s - error.shift_s),
                       leaves_s + end_s + (i + 1 < pieces ? error.shift_s : error.delay_s),
                       {leg.from + rear * ahead, i + 1 < pieces ? leg.from + front * ahead : leg.to}});
  }
}

/// The robots that have been admitted so far.
struct Admitted {
  std::vector<PlanClock> clocks;
  std::vector<std::vector<Presence>> present;  // by robot
  std::vector<MemberTimes> times;
  std::size_t number = 0;  // of drives
};

/// A drive that could be admitted next.
struct Admission {
  double begin_s = 0.0;
  std::size_t robot = 0;
  std::vector<Presence> present;
};

class TeamScheduler {
 public:
  TeamScheduler(const std::vector<TeamMember>& team, double gap_m) : team_(team), gap_m_(gap_m) {}

  /// Admits all drives that are left, the soonest first; false if that was not possible.
  bool finish(Admitted& admitted) {
    std::vector<Admission> next;
    for (std::size_t r = 0; r < team_.size(); ++r) {
      if (admitted.clocks[r].done()) continue;
      if (auto admission = soonest(admitted, r)) next.push_back(std::move(*admission));
    }
    if (next.empty())
      return std::ranges::all_of(admitted.clocks, [](const PlanClock& clock) { return clock.done(); });
    std::ranges::stable_sort(next, {}, &Admission::begin_s);
    for (const Admission& admission : next) {
      if (++admissions_ > most_admissions) return false;
      Admitted after = admitted;
      admit(after, admission);
      if (!finish(after)) continue;
      admitted.times = std::move(after.times);
      return true;
    }
    return false;
  }

 private:
  /// The next drive of a robot, begun as soon as it keeps apart from everybody.
  [[nodiscard]] std::optional<Admission> soonest(const Admitted& admitted, std::size_t robot) const {
    const TeamMember& member = team_[robot];
    const PlanClock& clock = admitted.clocks[robot];
    double last_s = clock.free_s();  // when all others stand where they are admitted to
    for (const auto& present : admitted.present) last_s = std::max(last_s, present.back().begin_s);
    const auto& waypoints = member.plan.stops[clock.stops_made()].waypoints;
    for (double begin_s = clock.free_s(); begin_s < last_s + wait_step_s; begin_s += wait_step_s) {
      auto own = presences(member.problem.robot, clock.heading_rad(), waypoints, begin_s,
                           member.problem.errors.position_m);
      bool apart = true;
      for (std::size_t other = 0; apart && other < team_.size(); ++other)
        apart = other == robot || keep_apart(own, admitted.present[other], gap_m_);
      if (apart) return Admission{begin_s, robot, std::move(own)};
    }
    return std::nullopt;
  }

  static void admit(Admitted& admitted, const Admission& admission) {
    auto& present = admitted.present[admission.robot];
    present.back().end_s = admission.begin_s;
    present.insert(present.end(), admission.present.begin(), admission.present.end());
    PlanClock& clock = admitted.clocks[admission.robot];
    clock.make_stop(admission.begin_s);
    MemberTimes& times = admitted.times[admission.robot];
    times.begins_s.push_back(admission.begin_s);
    times.turns.push_back(admitted.number++);
    times.end_s = clock.end_s();
  }

  const std::vector<TeamMember>& team_;
  double gap_m_;
  int admissions_ = 0;
};

}  // namespace

Presence standing(Vec2 place, double begin_s) { return {begin_s, no_end_s, {place, place}}; }

std::vector<Presence> presences(const RobotModel& robot, double heading_rad,
                                const std::vector<Vec2>& waypoints, double begin_s, double arrival_error_m) {
  std::vector<Presence> result;
  const std::vector<Straight> legs = straights(robot, heading_rad, waypoints);
  double time_s = begin_s;
  for (std::size_t k = 0; k < legs.size(); ++k) {
    const bool last = k + 1 == legs.size();
    const LegError error = last ? leg_error(robot, legs[k], arrival_error_m) : LegError{};
    add_leg(result, robot, legs[k], time_s, begin_s + legs[k].begin_s, error);
    time_s = result.back().end_s;
  }
  result.push_back(standing(waypoints.back(), time_s));
  return result;
}

bool keep_apart(const std::vector<Presence>& one, const std::vector<Presence>& other, double gap_m) {
  auto first = other.begin();
  for (const Presence& own : one) {
    while (first != other.end() && first->end_s < own.begin_s) ++first;
    for (auto theirs = first; theirs != other.end() && theirs->begin_s <= own.end_s; ++theirs) {
      if (distance(own.within, theirs->within) < gap_m) return false;
    }
  }
  return true;
}

std::optional<std::vector<MemberTimes>> schedule_team(const FiringMap& firing_map,
                                                      const std::vector<TeamMember>& team, double gap_m) {
  Admitted admitted;
  admitted.times.resize(team.size());
  for (const TeamMember& member : team) {
    const Vec2 start = member.problem.start.position;
    admitted.clocks.emplace_back(member.problem, firing_map, member.plan);
    admitted.present.push_back({standing(start, 0.0)});
  }
  if (!TeamScheduler(team, gap_m).finish(admitted)) return std::nullopt;
  return admitted.times;
}

}  // namespace outrider
