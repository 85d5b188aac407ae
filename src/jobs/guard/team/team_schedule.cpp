#include "team/team_schedule.hpp"

#include <algorithm>
#include <utility>

#include "outrider/geometry/convex.hpp"
#include "plan/plan_clock.hpp"

namespace outrider {
namespace {

constexpr double wait_step_s = 0.25;    // waits that are tried
constexpr int most_admissions = 2'000;  // drives that are admitted, those taken back included

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

bool come_near(const std::vector<Vec2>& one, const std::vector<Vec2>& other, double gap_m) {
  for (std::size_t i = 1; i < one.size(); ++i) {
    for (std::size_t k = 1; k < other.size(); ++k) {
      if (distance(Segment{one[i - 1], one[i]}, Segment{other[k - 1], other[k]}) < gap_m) return true;
    }
  }
  return false;
}

/// Returns true if the drive to a stop has not begun.
bool is_to_come(const TaskBoard& board, Vec2 place) {
  const auto& queue = board.queue();
  const auto first = queue.begin() + (board.arrived() && !queue.empty() ? 1 : 0);
  return std::any_of(first, queue.end(), [&](const StopTask& task) { return task.place == place; });
}

}  // namespace

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

std::optional<std::size_t> TeamOrder::waits_for(std::size_t robot, Vec2 place,
                                                const std::vector<Vec2>& waypoints,
                                                const std::vector<const TaskBoard*>& tasks) const {
  const TeamPart& own = plan_.parts[robot];
  const auto stop = std::ranges::find(own.plan.stops, place, &PlannedStop::position);
  const auto number = static_cast<std::size_t>(stop - own.plan.stops.begin());
  if (number >= own.times.turns.size()) return std::nullopt;
  for (std::size_t other = 0; other < plan_.parts.size(); ++other) {
    const TeamPart& part = plan_.parts[other];
    for (std::size_t k = 0; other != robot && k < part.times.turns.size(); ++k) {
      const PlannedStop& before = part.plan.stops[k];
      if (part.times.turns[k] < own.times.turns[number] && is_to_come(*tasks[other], before.position) &&
          come_near(waypoints, before.waypoints, gap_m_))
        return other;
    }
  }
  return std::nullopt;
}

}  // namespace outrider
