#include "outrider/jobs/guard/behaviour/arriving_targets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/jobs/guard/plan/stops.hpp"

namespace outrider {
namespace {

constexpr double never_s = std::numeric_limits<double>::infinity();

/// Returns those that are in their places.
std::vector<std::size_t> settled(const std::vector<TargetArrival>& open, double time_s) {
  std::vector<std::size_t> records;
  for (const TargetArrival& one : open) {
    if (one.settles_s <= time_s) records.push_back(one.target);
  }
  return records;
}

/// The stop at which the robot stands, or nothing.
std::optional<std::size_t> stop_here(const TaskBoard& board, const Observation& seen,
                                     const RollingPlan& plan) {
  const auto& stops = plan.stops.stops;
  const auto sent = std::find(stops.begin(), stops.end(), board.last_place());
  const double off = plan.yard.problem.errors.position_m + there_m;
  if (sent == stops.end() || distance(*sent, seen.odometry.position) > off) return std::nullopt;
  return static_cast<std::size_t>(sent - stops.begin());
}

/// From where the robot is; from the nearest stop where no corner is seen from there.
Drive drive_from(const Pose2& pose, std::size_t stop, const ArrivalYard& watch,
                 const StopTable& precomputed) {
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

RobotState state_of(const TaskBoard& board, const Observation& seen, const RollingPlan& plan,
                    const std::vector<PendingTarget>& pending) {
  const StopTable& precomputed = plan.stops;
  RobotState from{seen.time_s, seen.odometry.heading_rad, seen.gun->yaw_rad, seen.gun->pitch_rad, {}};
  const auto here = stop_here(board, seen, plan);
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

}  // namespace

TaskBoard ArrivingTargets::board() const {
  TaskBoard board(plan_->yard.problem, plan_->yard.firing_map, plan_->yard.intruders.size(),
                  plan_->stops.routes, plan_->stops.on_the_move);
  board.set_more_to_come(true);
  return board;
}

void ArrivingTargets::forget_the_done(const TaskBoard& board) {
  std::erase_if(inside_, [&](const TargetArrival& s) {
    return board.records()[s.target].status != TargetStatus::waiting;
  });
}

/// Returns those inside that no ball is on the way to.
std::vector<TargetArrival> ArrivingTargets::open_targets(const TaskBoard& board) const {
  std::vector<TargetArrival> open = inside_;
  std::erase_if(open, [&](const TargetArrival& one) { return board.is_in_air(one.target); });
  return open;
}

/// Plans for the first `count` of the open ones and sets the tasks.
void ArrivingTargets::plan_anew(const std::vector<TargetArrival>& open, TaskBoard& board,
                                const Observation& seen, std::size_t count) {
  const RollingPlan& plan = *plan_;
  std::vector<PendingTarget> pending;
  for (std::size_t i = 0; i < count; ++i)
    pending.push_back({static_cast<std::uint32_t>(open[i].place), open[i].settles_s});
  const TourProblem& table = plan.stops.table;
  const RobotState from = state_of(board, seen, plan, pending);
  const Sequence best = plan.next(pending, from, plans_ == 0);
  if (best.visits.empty())
    board.settle(open.front().target, TargetStatus::failed, "no way to a place with a shot", seen.time_s);
  std::deque<StopTask> tasks;
  for (const Visit& visit : best.visits) {
    StopTask task{plan.stops.stops[visit.stop]};
    for (const std::uint32_t who : visit.goals) {
      const auto service = std::ranges::find(table.services[visit.stop], pending[who].goal, &Service::goal);
      task.targets.push_back(open[who].target);
      task.guns.push_back({service->yaw_rad, service->pitch_rad});
    }
    tasks.push_back(std::move(task));
  }
  board.set_tasks(std::move(tasks),
                  !best.visits.empty() && stop_here(board, seen, plan) == best.visits.front().stop);
  entered_ = 0;
  ++plans_;
}

/// When the one who is next to be shot at from here is in its place, if that is still to come.
std::optional<double> ArrivingTargets::to_wait_for(const TaskBoard& board, const Observation& seen) const {
  if (board.queue().empty() || board.queue().front().call) return std::nullopt;
  const StopTask& task = board.queue().front();
  if (task.targets.empty()) return std::nullopt;
  if (!board.arrived() && distance(seen.odometry.position, task.place) > there_m) return std::nullopt;
  const auto next = std::ranges::find(inside_, task.targets.front(), &TargetArrival::target);
  if (next == inside_.end() || next->settles_s <= seen.time_s) return std::nullopt;
  return next->settles_s;
}

void ArrivingTargets::note(TaskBoard& board, const Observation& seen) {
  board.note_drive(seen);
  board.note_shots(seen);
  const ArrivalYard& yard = plan_->yard;
  for (const TargetArrival& arrival : seen.targets->arrivals) {
    if (board.records()[arrival.target].status == TargetStatus::reached) {  // it survived the hit
      ++survived_;
      std::erase_if(inside_, [&](const TargetArrival& s) { return s.target == arrival.target; });
      board.survive(arrival.target, yard.at_place(arrival.place));
    }
    if (plan_->stops.reachable[arrival.place] != 0) {
      inside_.push_back(arrival);
      ++entered_;
    } else if (yard.firing_map.regions[yard.at_place(arrival.place)].hits == 0) {
      board.settle(arrival.target, TargetStatus::unreachable, "its place cannot be hit from anywhere",
                   seen.time_s);
    } else {
      board.settle(arrival.target, TargetStatus::failed, "no stop of those chosen has a shot at its place",
                   seen.time_s);
    }
  }
  forget_the_done(board);
  board.drop_empty_tasks();
  // A drive that ended before its goal, because somebody entered, goes on.
  const double off = yard.problem.errors.position_m + there_m;
  if (plan_->policy.interrupts && !seen.targets->arrivals.empty() && !board.queue().empty() &&
      distance(seen.odometry.position, board.queue().front().place) > off)
    board.interrupt_drive(seen.time_s);
}

std::optional<Command> ArrivingTargets::propose(TaskBoard& board, const Observation& seen) {
  while (board.more_to_come()) {
    const auto open = open_targets(board);
    if (!board.is_busy()) {
      const std::size_t count = plan_->wanted(open.size(), entered_, board.queue().empty());
      if (count > 0) plan_anew(open, board, seen, count);
    }
    board.set_by_the_way(settled(open, seen.time_s));
    if (const auto until_s = to_wait_for(board, seen)) return Wait{*until_s};
    if (auto command = board.next_command(seen)) {
      if (auto* follow = std::get_if<FollowWaypoints>(&*command)) {
        follow->until_arrival = plan_->policy.interrupts;
      }
      return command;
    }
    forget_the_done(board);  // those that were just given up
    if (!inside_.empty()) continue;
    if (seen.targets->more_to_come) return Wait{never_s};
    board.set_more_to_come(false);
  }
  board.set_by_the_way({});
  return board.next_command(seen);
}

}  // namespace outrider
