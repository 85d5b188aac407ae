#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "run/guard_log.hpp"
#include "team/team_report.hpp"

namespace outrider {
namespace {

/// The parts of a plan as one plan: its stops, its time and its bound.
GuardPlan whole_plan(const TeamPlan& plan, const FiringMap& firing_map) {
  GuardPlan whole;
  for (const TeamPart& part : plan.parts) {
    whole.stops.insert(whole.stops.end(), part.plan.stops.begin(), part.plan.stops.end());
    whole.on_the_move = whole.on_the_move || part.plan.on_the_move;
  }
  whole.unreachable = plan.unreachable;
  whole.cost_s = plan.makespan_s;
  whole.lower_bound_s = whole.anywhere_lower_bound_s = plan.lower_bound_s;
  whole.places = static_cast<std::size_t>(
      std::ranges::count_if(firing_map.reachable, [](std::uint8_t cell) { return cell != 0; }));
  return whole;
}

SimRecord sum_of(const std::vector<TeamRobotRun>& robots) {
  SimRecord sum;
  for (const TeamRobotRun& robot : robots) {
    sum.driven_m += robot.record.driven_m;
    sum.turned_rad += robot.record.turned_rad;
    sum.shots += robot.record.shots;
  }
  return sum;
}

/// Returns a row for the work of each robot, with its start.
Table robot_table(const TeamPlan& plan, const TeamRun& team) {
  Table table{"robots",
              {"robot", "targets", "stops", "shots", "driven_m", "time_s", "waited_s", "start_x", "start_y",
               "start_heading_rad"},
              {}};
  for (std::size_t r = 0; r < team.robots.size(); ++r) {
    const TeamRobotRun& robot = team.robots[r];
    double targets = 0.0;
    for (std::size_t t = 0; t < team.records.size(); ++t) {
      const bool is_its = team.robot_of[t] == r && team.records[t].status != TargetStatus::unreachable;
      targets += is_its ? 1.0 : 0.0;
    }
    const Pose2& start = robot.driven.start;
    table.rows.push_back({static_cast<double>(r + 1), targets,
                          static_cast<double>(plan.parts[r].plan.stops.size()),
                          static_cast<double>(robot.record.shots), robot.record.driven_m, robot.end_s,
                          robot.waited_s, start.position.x, start.position.y, start.heading_rad});
  }
  return table;
}

/// Says which robots came too near to each other; empty if none did.
std::string why_not_apart(const RobotModel& robot, const Outcome<ClosestApproach>& nearest) {
  constexpr double rounding_m = 1e-6;
  if (!nearest) return "nobody can tell whether the robots kept apart: " + nearest.error().sentence;
  if (nearest->distance_m >= 2.0 * robot.radius_m - rounding_m) return {};
  return fmt::format("robots {} and {} were {:.2f} m apart after {:.1f} s, nearer than their bodies allow",
                     nearest->one + 1, nearest->other + 1, nearest->distance_m, nearest->time_s);
}

void add_metrics(Report& report, const TeamPlan& plan, const TeamRun& team,
                 const Outcome<ClosestApproach>& nearest) {
  constexpr std::string_view of_tours[] = {"expected_s", "tour_proven", "stops_offered"};
  std::erase_if(report.metrics, [&](const auto& one) { return std::ranges::count(of_tours, one.first) > 0; });
  const auto count = [](std::size_t number) { return static_cast<double>(number); };
  report.metrics.insert(report.metrics.end(), {{"robots", count(team.robots.size())},
                                               {"alone_s", plan.alone_s},
                                               {"waited_s", team.waited_s},
                                               {"given_up", count(team.given_up)},
                                               {"stopped_balls", count(team.stopped)}});
  if (nearest) report.metrics.emplace_back("closest_m", nearest->distance_m);
}

/// A message that waits for its turn.
struct TeamMessage {
  std::int64_t time_ns = 0;
  std::function<void(Log&)> append;
};

/// Adds the messages of one topic of a robot, which get another one.
template <class Message>
void collect(std::vector<TeamMessage>& all, const Log& from, std::string_view topic, const std::string& to) {
  for (const Stamped<Message>& one : from.messages<Message>(topic))
    all.push_back({one.time_ns, [&one, to](Log& log) { log.append(to, one.time_s(), one.message); }});
}

/// Adds what became of the targets of a robot. Only the first one tells how all of them were at first.
void collect_targets(std::vector<TeamMessage>& all, const Log& from, bool first) {
  std::set<std::string_view> told;
  for (const auto& one : from.messages<outrider_msgs::Target>(topic::targets)) {
    const bool at_first = told.insert(one.message.name).second;
    if (at_first && !first) continue;
    all.push_back({one.time_ns, [&one](Log& log) { log.append(topic::targets, one.time_s(), one.message); }});
  }
  if (first)
    collect<outrider_msgs::TargetPosition>(all, from, topic::target_positions,
                                           std::string(topic::target_positions));
}

void collect_events(std::vector<TeamMessage>& all, const Log& from, const std::string& who) {
  for (const auto& one : from.messages<rcl_interfaces::Log>(topic::events)) {
    all.push_back({one.time_ns, [&one, who](Log& log) {
                     rcl_interfaces::Log event = one.message;
                     event.msg = who + event.msg;
                     log.append(topic::events, one.time_s(), std::move(event));
                   }});
  }
}

}  // namespace

Report judge_team(const GuardScenario& scenario, const FiringMap& firing_map, const TeamPlan& plan,
                  const TeamRun& team, const Log& log) {
  const GuardProblem& problem = scenario.problem;
  const GuardPlan whole = whole_plan(plan, firing_map);
  const SimRecord record = sum_of(team.robots);
  const EndedMission ended{problem,           team.records,         record, log, team.mission_s,
                           whole.on_the_move, scenario.faults.any()};
  Report report = judge(ended, tour_metrics(whole, ended));

  Table& targets = report.tables.front();
  targets.columns.emplace_back("robot");
  for (std::size_t t = 0; t < targets.rows.size(); ++t)
    targets.rows[t].emplace_back(static_cast<double>(team.robot_of[t] + 1));
  report.tables.push_back(robot_table(plan, team));

  std::vector<TimedDrives> driven;
  driven.reserve(team.robots.size());
  for (const TeamRobotRun& robot : team.robots) driven.push_back(robot.driven);
  const auto nearest = closest_approach(problem.robot, driven);
  add_metrics(report, plan, team, nearest);
  if (const std::string why = why_not_apart(problem.robot, nearest); !why.empty()) {
    report.status = "not_done";
    report.reason += (report.reason.empty() ? "" : "; ") + why;
  }
  return report;
}

void append_team(Log& log, const TeamRun& team) {
  std::vector<TeamMessage> all;
  for (std::size_t r = 0; r < team.robots.size(); ++r) {
    const Log& from = team.robots[r].log;
    const auto named = [&](std::string_view topic) {
      return r == 0 ? std::string(topic) : fmt::format("/robot_{}{}", r + 1, topic);
    };
    collect<geometry_msgs::PoseStamped>(all, from, topic::pose, named(topic::pose));
    if (r == 0) collect<tf2_msgs::TFMessage>(all, from, topic::transforms, std::string(topic::transforms));
    collect<sensor_msgs::JointState>(all, from, topic::joints, named(topic::joints));
    collect<nav_msgs::Path>(all, from, topic::plan, named(topic::plan));
    collect<outrider_msgs::Shot>(all, from, topic::shots, std::string(topic::shots));
    collect_targets(all, team.robots[r].targets, r == 0);
    collect_events(all, from, fmt::format("robot {}: ", r + 1));
  }
  std::ranges::stable_sort(all, {}, &TeamMessage::time_ns);
  for (const TeamMessage& message : all) message.append(log);
}

}  // namespace outrider
