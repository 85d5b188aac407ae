#include "outrider/jobs/guard/watch_mission.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/jobs/guard/sequence.hpp"

namespace outrider {
namespace {

constexpr double there_m = 1e-6;
constexpr std::size_t most_planned = 64;
constexpr double never_s = std::numeric_limits<double>::infinity();

void forget_the_done(WatchMission& mission) {
  std::erase_if(mission.inside, [&](const TargetArrival& s) {
    return mission.guard.records[s.target].status != TargetStatus::waiting;
  });
}

/// Somebody was hit and goes elsewhere: all begins again for it, with the shots it has had.
void go_on(WatchMission& mission, const TargetArrival& sighting, const Watch& watch) {
  GuardMission& guard = mission.guard;
  for (std::size_t i = guard.at.size(); i < guard.records.size(); ++i) guard.at.push_back(i);
  ++mission.survived;
  std::erase_if(mission.inside, [&](const TargetArrival& s) { return s.target == sighting.target; });
  guard.at[sighting.target] = watch.at_place(sighting.place);
  TargetRecord& record = guard.records[sighting.target];
  record = {TargetStatus::waiting, {}, record.shots, 0, record.shot, record.pose, 0.0};
  guard.keeps_watch = true;
  guard.second_pass = false;  // there will be another, for all who have failed
}

/// Those who have just entered are inside now; those who are done are not.
void look_around(WatchMission& mission, const Observation& seen, const WatchPlan& plan) {
  for (const TargetArrival& sighting : seen.targets->arrivals) {
    TargetRecord& record = mission.guard.records[sighting.target];
    if (record.status == TargetStatus::reached) go_on(mission, sighting, plan.watch);
    if (plan.outlook.reachable[sighting.place] != 0) {
      mission.inside.push_back(sighting);
      ++mission.entered;
    } else {
      record.status = TargetStatus::unreachable;
      record.reason = "its place cannot be hit from anywhere";
      record.done_s = seen.time_s;
    }
  }
  forget_the_done(mission);
  GuardMission& guard = mission.guard;
  auto& errands = guard.errands;
  while (!errands.empty() && errands.front().targets.empty()) {
    errands.pop_front();
    guard.arrived = false;
  }
  // A drive that ended before its goal, because of the news, goes on.
  const double off = plan.watch.problem.errors.position_m + there_m;
  if (plan.policy.interrupts && !seen.targets->arrivals.empty() && !errands.empty() &&
      distance(seen.odometry.position, errands.front().place) > off) {
    guard.arrived = false;
  }
}

/// The stop at which the robot stands, or nothing.
std::optional<std::size_t> stop_here(const WatchMission& mission, const Observation& seen,
                                     const WatchPlan& plan) {
  const auto& stops = plan.outlook.stops;
  const auto sent = std::find(stops.begin(), stops.end(), mission.guard.last_place);
  const double off = plan.watch.problem.errors.position_m + there_m;
  if (sent == stops.end() || distance(*sent, seen.odometry.position) > off) return std::nullopt;
  return static_cast<std::size_t>(sent - stops.begin());
}

/// From where the robot is; from the nearest stop where no corner is seen from there.
Drive drive_from(const Pose2& pose, std::size_t stop, const Watch& watch, const Outlook& outlook) {
  const auto& stops = outlook.stops;
  const auto route = outlook.routes.route(pose, stops[stop]);
  if (!route) {
    const auto nearest = std::min_element(stops.begin(), stops.end(), [&](Vec2 a, Vec2 b) {
      return distance(a, pose.position) < distance(b, pose.position);
    });
    return outlook.routes.between(static_cast<std::size_t>(nearest - stops.begin()), stop);
  }
  if (route->waypoints.size() < 2) return {0.0, pose.heading_rad, pose.heading_rad};
  const auto& way = route->waypoints;
  const double departure = heading_of(way[1] - way[0]);
  const DriveCost cost = drive_cost(watch.problem.robot, departure, way, watch.site.ground.terrain());
  return {cost.time_s, departure, cost.heading_rad};
}

Standing standing(const WatchMission& mission, const Observation& seen, const WatchPlan& plan,
                  const std::vector<Wanted>& wanted) {
  const Outlook& outlook = plan.outlook;
  Standing from{seen.time_s, seen.odometry.heading_rad, seen.gun->yaw_rad, seen.gun->pitch_rad, {}};
  const auto here = stop_here(mission, seen, plan);
  for (std::size_t stop = 0; stop < outlook.stops.size(); ++stop) {
    const auto& services = outlook.table.services[stop];
    const bool useful = std::any_of(services.begin(), services.end(), [&](const Service& service) {
      return std::any_of(wanted.begin(), wanted.end(),
                         [&](const Wanted& w) { return w.goal == service.goal; });
    });
    Drive drive;
    if (useful && here) {
      drive = outlook.routes.between(*here, stop);
      if (*here == stop) drive.time_s = 0.0;
    } else if (useful) {
      drive = drive_from(seen.odometry, stop, plan.watch, outlook);
    }
    from.drives.push_back(drive);
  }
  return from;
}

/// The tour answers this very question: all its targets there at the start, and the makespan.
bool is_the_still_yard(const WatchMission& mission, const WatchPlan& plan, const std::vector<Wanted>& wanted,
                       double time_s) {
  std::size_t toured = 0;
  for (const Visit& visit : plan.outlook.tour) toured += visit.goals.size();
  return plan.objective == WatchObjective::makespan && mission.plans == 0 && wanted.size() == toured &&
         std::all_of(wanted.begin(), wanted.end(), [&](const Wanted& w) { return w.settles_s <= time_s; });
}

/// Plans for the first `count` of those inside and sets the errands.
void plan_anew(WatchMission& mission, const Observation& seen, const WatchPlan& plan, std::size_t count) {
  std::vector<Wanted> wanted;
  count = std::min({count, mission.inside.size(), most_planned});
  for (std::size_t i = 0; i < count; ++i) {
    const TargetArrival& sighting = mission.inside[i];
    wanted.push_back({static_cast<std::uint32_t>(sighting.place), sighting.settles_s});
  }
  const TourProblem& table = plan.outlook.table;
  const Standing from = standing(mission, seen, plan, wanted);
  const Sequence best = sequence_beside(plan.outlook.tour, table, wanted, from, plan.objective, plan.beam,
                                        is_the_still_yard(mission, plan, wanted, seen.time_s));

  GuardMission& guard = mission.guard;
  if (best.visits.empty()) {
    TargetRecord& record = guard.records[mission.inside.front().target];
    record = {TargetStatus::failed, "no way to a place with a shot", 0, 0, {}, seen.odometry, seen.time_s};
  }
  guard.errands.clear();
  for (const Visit& visit : best.visits) {
    Errand errand{plan.outlook.stops[visit.stop], {}};
    for (const std::uint32_t who : visit.goals) {
      const auto service = std::ranges::find(table.services[visit.stop], wanted[who].goal, &Service::goal);
      errand.targets.push_back(mission.inside[who].target);
      errand.pitches.push_back(service->pitch_rad);
    }
    guard.errands.push_back(std::move(errand));
  }
  guard.arrived = !best.visits.empty() && stop_here(mission, seen, plan) == best.visits.front().stop;
  guard.aimed = false;
  mission.entered = 0;
  ++mission.plans;
}

/// When the one who is next to be shot at from here is in its place, if that is still to come.
std::optional<double> to_wait_for(const WatchMission& mission, const Observation& seen) {
  if (mission.guard.errands.empty()) return std::nullopt;
  const Errand& errand = mission.guard.errands.front();
  if (!mission.guard.arrived && distance(seen.odometry.position, errand.place) > there_m) return std::nullopt;
  const auto next = std::find_if(mission.inside.begin(), mission.inside.end(),
                                 [&](const TargetArrival& s) { return s.target == errand.targets.front(); });
  if (next == mission.inside.end() || next->settles_s <= seen.time_s) return std::nullopt;
  return next->settles_s;
}

}  // namespace

WatchMission begin(const WatchPlan& plan) {
  WatchMission mission;
  mission.guard.records.resize(plan.watch.intruders.size());
  mission.guard.last_place = plan.watch.problem.start.position;
  mission.guard.routes = plan.outlook.routes;
  mission.guard.keeps_watch = true;
  return mission;
}

std::optional<Command> step(WatchMission& mission, const Observation& seen, const WatchPlan& plan) {
  const auto& [problem, site, intruders] = plan.watch;
  GuardMission& guard = mission.guard;
  hear(guard, seen, problem);
  look_around(mission, seen, plan);
  while (guard.keeps_watch) {
    if (!guard.aimed) {
      const std::size_t count =
          plan.policy.take({mission.inside.size(), mission.entered, guard.errands.empty(), plan.group});
      if (count > 0) plan_anew(mission, seen, plan, count);
    }
    if (const auto until = to_wait_for(mission, seen)) return Wait{*until};
    if (auto command = step(guard, seen, problem, site)) {
      if (auto* follow = std::get_if<FollowWaypoints>(&*command)) {
        follow->until_arrival = plan.policy.interrupts;
      }
      return command;
    }
    forget_the_done(mission);  // those that were just given up
    if (!mission.inside.empty()) continue;
    if (seen.targets->more_to_come) return Wait{never_s};
    guard.keeps_watch = false;
  }
  return step(guard, seen, problem, site);
}

}  // namespace outrider
