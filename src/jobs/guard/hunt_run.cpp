#include "outrider/jobs/guard/hunt_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "guard_scene.hpp"
#include "outrider/jobs/guard/guard_robot.hpp"

namespace outrider {
namespace {

constexpr double longest_s = 7200.0;  // of the walks; they stay at their last place then

/// What was true and what was believed, at each look.
std::vector<ReportMove> moves_of(const Walk& walk, const Track& track, const WanderOptions& options) {
  std::vector<ReportMove> moves;
  Track known;
  for (const Glimpse& glimpse : track) {
    const Vec2 believed = known.empty()
                              ? glimpse.position
                              : straight_on(stride_of(known, options), glimpse.time_s).at(glimpse.time_s);
    moves.push_back({glimpse.time_s, walk.at(glimpse.time_s), believed});
    known.push_back(glimpse);
    if (known.size() > 100) known.erase(known.begin(), known.begin() + 50);
  }
  return moves;
}

/// The intruder as it is by `now_s`.
ReportTarget entry_of(const HuntPlan& plan, const HuntMission& mission, std::size_t who, const Walk& walk,
                      const Report& report, double now_s) {
  const TargetRecord& record = mission.records[who];
  const double last_s = record.status == TargetStatus::waiting ? now_s : record.done_s;
  const Target last = moved_to(plan.problem.targets[who], walk.at(last_s));
  ReportTarget entry = target_entry(last, record, report);
  auto moves = moves_of(walk, mission.tracks[who], plan.options);
  if (!moves.empty()) {
    moves.push_back({last_s, xy(last.base), moves.back().believed});
    entry.moves = std::move(moves);
  }
  return entry;
}

void tell_of_aim(Report& report, const HuntMission& mission, const GuardProblem& problem, double time_s) {
  const auto& track = mission.tracks[mission.prey];
  report.events.push_back(
      {time_s, "lead",
       fmt::format(
           "expects {} at ({:.2f}, {:.2f}), {:.2f} m from where it was seen; a hit is {:.0f} % likely",
           problem.targets[mission.prey].name, mission.expected_at.x, mission.expected_at.y,
           distance(mission.expected_at, track.back().position), 100.0 * mission.chance)});
}

/// Of waits that follow one another the first.
void drop_repeated_waits(std::vector<ReportEvent>& events) {
  bool waited = false;
  std::erase_if(events, [&](const ReportEvent& event) {
    const bool waits = event.kind == "wait";
    return std::exchange(waited, waits) && waits;
  });
  for (ReportEvent& event : events) {
    if (event.kind == "wait") event.text = "waits for a shot";
  }
}

}  // namespace

Report run_hunt(const HuntPlan& plan, const std::vector<Walk>& walks, const GuardOptions& options,
                std::uint64_t seed, const RunWatch& watch) {
  const GuardProblem& problem = plan.problem;
  SimulatedGuard robot(problem, plan.site, seed);
  set_the_scene(robot.report, problem, options, seed);
  robot.let_walk(walks, plan.options.look_s, plan.options.sight_m);
  HuntMission mission = begin(plan);
  double expected_hits = 0.0;
  const auto list = [&](Report& report, double now_s) {
    report.targets.clear();
    for (std::size_t who = 0; who < walks.size(); ++who)
      report.targets.push_back(entry_of(plan, mission, who, walks[who], report, now_s));
  };
  const auto show = [&] {
    list(robot.report, robot.report.track.back().time_s);
    watch.show(robot.report);
  };
  bool stopped = false;
  while (const auto command = step(mission, robot.sense(), plan)) {
    if (watch.wanted()) show();
    if (std::holds_alternative<AimGun>(*command)) {
      tell_of_aim(robot.report, mission, problem, robot.report.track.back().time_s);
      expected_hits += mission.chance;
    }
    if ((stopped = watch.stopped())) break;
    robot.act(*command);
  }
  if (watch.observer != nullptr) show();
  Report report = std::move(robot.report);
  const double end_s = report.track.back().time_s;
  drop_repeated_waits(report.events);
  list(report, end_s);
  double reached = 0.0, inside_s = 0.0, last_s = 0.0;
  for (std::size_t who = 0; who < walks.size(); ++who) {
    reached += mission.records[who].status == TargetStatus::reached ? 1.0 : 0.0;
    inside_s += mission.records[who].done_s;
    last_s = std::max(last_s, mission.records[who].done_s);
  }
  const auto targets = static_cast<double>(walks.size());
  const auto shots = static_cast<double>(report.shots.size());
  report.status = reached == targets ? "done" : "not_done";
  if (reached < targets) report.reason = fmt::format("{} of {} intruders hit", reached, targets);
  report.metrics = {{"targets", targets},
                    {"reached", reached},
                    {"failed", targets - reached},
                    {"unreachable", 0.0},
                    {"mission_s", end_s},
                    {"intruder_seconds", inside_s},
                    {"makespan_s", last_s},
                    {"driven_m", robot.driven_m},
                    {"turned_rad", robot.turned_rad},
                    {"shots", shots},
                    {"chance", shots > 0.0 ? expected_hits / shots : 0.0},
                    {"expected_hits", expected_hits}};
  if (stopped) mark_cancelled(report, end_s);
  return report;
}

Outcome<Report> hunt(const GuardProblem& problem, const Site& site, const std::vector<double>& weights,
                     const std::vector<Track>& history, const WanderOptions& wander,
                     const GuardOptions& options, std::uint64_t seed, const RunWatch& watch) {
  auto walks = draw_walks(problem, site, weights, wander, seed, longest_s, watch.budget());
  if (!walks) return pass_on(walks);
  auto plan =
      plan_hunt(problem, site, visit_map(problem, site, history, wander), options, wander, watch.budget());
  if (!plan) return pass_on(plan);
  return run_hunt(*plan, *walks, options, seed, watch);
}

}  // namespace outrider
