#include "outrider/jobs/guard/arriving_targets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/jobs/guard/sequence.hpp"
#include "outrider/jobs/guard/stops.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_planned = 64;
constexpr double never_s = std::numeric_limits<double>::infinity();

void forget_the_done(ArrivingTargets& targets, const StopTasks& tasks) {
  std::erase_if(targets.inside, [&](const TargetArrival& s) {
    return tasks.records[s.target].status != TargetStatus::waiting;
  });
}

/// Those inside that no ball is on the way to.
std::vector<TargetArrival> open_targets(const ArrivingTargets& targets, const StopTasks& tasks) {
  std::vector<TargetArrival> open = targets.inside;
  std::erase_if(open, [&](const TargetArrival& one) {
    return std::ranges::count(tasks.flying, one.target, &FlyingBall::target) > 0;
  });
  return open;
}

/// Of those, the ones in their places.
std::vector<std::size_t> settled(const std::vector<TargetArrival>& open, double time_s) {
  std::vector<std::size_t> records;
  for (const TargetArrival& one : open) {
    if (one.settles_s <= time_s) records.push_back(one.target);
  }
  return records;
}

/// The shots of a drive that has ended before its goal are not fired after that.
void take_back_shots(StopTasks& tasks, double time_s) {
  std::erase_if(tasks.flying, [&](const FlyingBall& ball) {
    const bool unfired = ball.in_passing && ball.leaves_s > time_s;
    if (unfired) --tasks.records[ball.target].shots;
    return unfired;
  });
}

/// Somebody was hit and goes elsewhere: all begins again for it, with the shots it has had.
void go_on(ArrivingTargets& targets, StopTasks& tasks, const TargetArrival& arrival,
           const ArrivalYard& yard) {
  for (std::size_t i = tasks.stands_at.size(); i < tasks.records.size(); ++i) tasks.stands_at.push_back(i);
  ++targets.survived;
  std::erase_if(targets.inside, [&](const TargetArrival& s) { return s.target == arrival.target; });
  tasks.stands_at[arrival.target] = yard.at_place(arrival.place);
  TargetRecord& record = tasks.records[arrival.target];
  record = {TargetStatus::waiting, {}, record.shots, 0, record.shot, record.pose, 0.0};
  tasks.more_to_come = true;
  tasks.second_pass = false;  // there will be another, for all who have failed
}

/// The stop at which the robot stands, or nothing.
std::optional<std::size_t> stop_here(const StopTasks& tasks, const Observation& seen,
                                     const ArrivalPlan& plan) {
  const auto& stops = plan.stops.stops;
  const auto sent = std::find(stops.begin(), stops.end(), tasks.last_place);
  const double off = plan.yard.problem.errors.position_m + there_m;
  if (sent == stops.end() || distance(*sent, seen.odometry.position) > off) return std::nullopt;
  return static_cast<std::size_t>(sent - stops.begin());
}

/// From where the robot is; from the nearest stop where no corner is seen from there.
Drive drive_from(const Pose2& pose, std::size_t stop, const ArrivalYard& watch,
                 const PrecomputedStops& precomputed) {
  const auto& stops = precomputed.stops;
  const auto route = precomputed.routes.route(pose, stops[stop]);
  if (!route) {
    const auto nearest = std::min_element(stops.begin(), stops.end(), [&](Vec2 a, Vec2 b) {
      return distance(a, pose.position) < distance(b, pose.position);
    });
    return precomputed.routes.between(static_cast<std::size_t>(nearest - stops.begin()), stop);
  }
  if (route->waypoints.size() < 2) return {0.0, pose.heading_rad, pose.heading_rad};
  const auto& way = route->waypoints;
  const double departure = heading_of(way[1] - way[0]);
  const DriveCost cost = drive_cost(watch.problem.robot, departure, way, watch.firing_map.ground.terrain());
  return {cost.time_s, departure, cost.heading_rad};
}

RobotState state_of(const StopTasks& tasks, const Observation& seen, const ArrivalPlan& plan,
                    const std::vector<PendingTarget>& pending) {
  const PrecomputedStops& precomputed = plan.stops;
  RobotState from{seen.time_s, seen.odometry.heading_rad, seen.gun->yaw_rad, seen.gun->pitch_rad, {}};
  const auto here = stop_here(tasks, seen, plan);
  for (std::size_t stop = 0; stop < precomputed.stops.size(); ++stop) {
    const auto& services = precomputed.table.services[stop];
    const bool useful = std::any_of(services.begin(), services.end(), [&](const Service& service) {
      return std::any_of(pending.begin(), pending.end(),
                         [&](const PendingTarget& w) { return w.goal == service.goal; });
    });
    Drive drive;
    if (useful && here) {
      drive = precomputed.routes.between(*here, stop);
      if (*here == stop) drive.time_s = 0.0;
    } else if (useful) {
      drive = drive_from(seen.odometry, stop, plan.yard, precomputed);
    }
    from.drives.push_back(drive);
  }
  return from;
}

/// The tour answers this very question: all its targets there at the start, and the makespan.
bool is_the_still_yard(const ArrivingTargets& targets, const ArrivalPlan& plan,
                       const std::vector<PendingTarget>& pending, double time_s) {
  std::size_t toured = 0;
  for (const Visit& visit : plan.stops.tour) toured += visit.goals.size();
  return plan.objective == ArrivalObjective::makespan && targets.plans == 0 && pending.size() == toured &&
         std::all_of(pending.begin(), pending.end(),
                     [&](const PendingTarget& w) { return w.settles_s <= time_s; });
}

/// Plans for the first `count` of the open ones and sets the tasks.
void plan_anew(ArrivingTargets& targets, const std::vector<TargetArrival>& open, StopTasks& tasks,
               const Observation& seen, const ArrivalPlan& plan, std::size_t count) {
  std::vector<PendingTarget> pending;
  count = std::min({count, open.size(), most_planned});
  for (std::size_t i = 0; i < count; ++i)
    pending.push_back({static_cast<std::uint32_t>(open[i].place), open[i].settles_s});
  const TourProblem& table = plan.stops.table;
  const RobotState from = state_of(tasks, seen, plan, pending);
  const Sequence best = sequence_beside(plan.stops.tour, table, pending, from, plan.objective, plan.beam,
                                        is_the_still_yard(targets, plan, pending, seen.time_s));
  if (best.visits.empty()) {
    TargetRecord& record = tasks.records[open.front().target];
    record = {TargetStatus::failed, "no way to a place with a shot", 0, 0, {}, seen.odometry, seen.time_s};
  }
  tasks.queue.clear();
  for (const Visit& visit : best.visits) {
    StopTask task{plan.stops.stops[visit.stop]};
    for (const std::uint32_t who : visit.goals) {
      const auto service = std::ranges::find(table.services[visit.stop], pending[who].goal, &Service::goal);
      task.targets.push_back(open[who].target);
      task.guns.push_back({service->yaw_rad, service->pitch_rad});
    }
    tasks.queue.push_back(std::move(task));
  }
  tasks.arrived = !best.visits.empty() && stop_here(tasks, seen, plan) == best.visits.front().stop;
  tasks.aimed = false;
  targets.entered = 0;
  ++targets.plans;
}

/// When the one who is next to be shot at from here is in its place, if that is still to come.
std::optional<double> to_wait_for(const ArrivingTargets& targets, const StopTasks& tasks,
                                  const Observation& seen) {
  if (tasks.queue.empty() || tasks.queue.front().call) return std::nullopt;
  const StopTask& task = tasks.queue.front();
  if (task.targets.empty()) return std::nullopt;
  if (!tasks.arrived && distance(seen.odometry.position, task.place) > there_m) return std::nullopt;
  const auto next = std::ranges::find(targets.inside, task.targets.front(), &TargetArrival::target);
  if (next == targets.inside.end() || next->settles_s <= seen.time_s) return std::nullopt;
  return next->settles_s;
}

/// Whether something is under way that no plan drops: an aimed gun, or a visit to a station.
bool is_busy(const StopTasks& tasks) {
  return tasks.aimed || (!tasks.queue.empty() && tasks.queue.front().call);
}

}  // namespace

StopTasks tasks_of(const ArrivalPlan& plan) {
  StopTasks tasks;
  tasks.records.resize(plan.yard.intruders.size());
  tasks.last_place = plan.yard.problem.start.position;
  tasks.routes = plan.stops.routes;
  tasks.on_the_move = plan.stops.on_the_move;
  tasks.more_to_come = true;
  return tasks;
}

void note_arrivals(ArrivingTargets& targets, StopTasks& tasks, const Observation& seen,
                   const ArrivalPlan& plan) {
  for (const TargetArrival& arrival : seen.targets->arrivals) {
    TargetRecord& record = tasks.records[arrival.target];
    if (record.status == TargetStatus::reached) go_on(targets, tasks, arrival, plan.yard);
    if (plan.stops.reachable[arrival.place] != 0) {
      targets.inside.push_back(arrival);
      ++targets.entered;
    } else if (plan.yard.firing_map.regions[plan.yard.at_place(arrival.place)].hits == 0) {
      settle(record, TargetStatus::unreachable, "its place cannot be hit from anywhere", seen.time_s);
    } else {
      settle(record, TargetStatus::failed, "no stop of those chosen has a shot at its place", seen.time_s);
    }
  }
  forget_the_done(targets, tasks);
  auto& queue = tasks.queue;
  while (!queue.empty() && queue.front().targets.empty() && !queue.front().call) {
    queue.pop_front();
    tasks.arrived = false;
  }
  // A drive that ended before its goal, because somebody entered, goes on.
  const double off = plan.yard.problem.errors.position_m + there_m;
  if (plan.policy.interrupts && !seen.targets->arrivals.empty() && !queue.empty() &&
      distance(seen.odometry.position, queue.front().place) > off) {
    tasks.arrived = false;
    take_back_shots(tasks, seen.time_s);
  }
}

std::optional<Command> next_command(ArrivingTargets& targets, StopTasks& tasks, const Observation& seen,
                                    const ArrivalPlan& plan) {
  const auto& [problem, firing_map, intruders] = plan.yard;
  while (tasks.more_to_come) {
    const auto open = open_targets(targets, tasks);
    if (!is_busy(tasks)) {
      const std::size_t count =
          plan.policy.take({open.size(), targets.entered, tasks.queue.empty(), plan.group});
      if (count > 0) plan_anew(targets, open, tasks, seen, plan, count);
    }
    tasks.by_the_way = settled(open, seen.time_s);
    if (const auto until_s = to_wait_for(targets, tasks, seen)) return Wait{*until_s};
    if (auto command = next_command(tasks, seen, problem, firing_map)) {
      if (auto* follow = std::get_if<FollowWaypoints>(&*command)) {
        follow->until_arrival = plan.policy.interrupts;
        if (plan.policy.interrupts) tasks.cut.driving = false;  // it may end anywhere without a fault
      }
      return command;
    }
    forget_the_done(targets, tasks);  // those that were just given up
    if (!targets.inside.empty()) continue;
    if (seen.targets->more_to_come) return Wait{never_s};
    tasks.more_to_come = false;
  }
  tasks.by_the_way.clear();
  return next_command(tasks, seen, problem, firing_map);
}

}  // namespace outrider
