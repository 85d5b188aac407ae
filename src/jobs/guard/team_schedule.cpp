#include "team_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assemble.hpp"
#include "outrider/jobs/guard/passing.hpp"

namespace outrider {
namespace {

constexpr double no_end_s = std::numeric_limits<double>::infinity();
constexpr double piece_s = 0.25;        // longest piece of a drive that is compared at once
constexpr double wait_step_s = 0.25;    // waits that are tried
constexpr int most_admissions = 2'000;  // drives that are admitted, those taken back included

/// What has been admitted so far.
struct Admitted {
  std::vector<PlanClock> clocks;
  std::vector<std::vector<Presence>> present;  // by robot
  std::vector<MemberTimes> times;
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
      auto own = presences(member.problem.robot, clock.heading_rad(), waypoints, begin_s);
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
    times.end_s = clock.end_s();
  }

  const std::vector<TeamMember>& team_;
  double gap_m_;
  int admissions_ = 0;
};

}  // namespace

std::vector<Presence> presences(const RobotModel& robot, double heading_rad,
                                const std::vector<Vec2>& waypoints, double begin_s) {
  std::vector<Presence> result;
  double time_s = begin_s;
  for (const Straight& leg : straights(robot, heading_rad, waypoints)) {
    result.push_back({time_s, begin_s + leg.begin_s, {leg.from, leg.from}});
    const auto pieces = static_cast<int>(std::ceil(leg.length_s / piece_s));
    Vec2 at = leg.from;
    for (int i = 1; i <= pieces; ++i) {
      const double after_s = leg.length_s * i / pieces;
      const Vec2 next = i == pieces ? leg.to : platform_on(robot, leg.from, leg.to, after_s).position;
      result.push_back({result.back().end_s, begin_s + leg.begin_s + after_s, {at, next}});
      at = next;
    }
    time_s = result.back().end_s;
  }
  result.push_back({time_s, no_end_s, {waypoints.back(), waypoints.back()}});
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
    admitted.present.push_back({{0.0, no_end_s, {start, start}}});
  }
  if (!TeamScheduler(team, gap_m).finish(admitted)) return std::nullopt;
  return admitted.times;
}

}  // namespace outrider
