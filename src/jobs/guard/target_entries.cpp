#include <algorithm>

#include "guard_report.hpp"

namespace outrider {
namespace {

ReportTarget entry_of(const Target& target, const TargetRecord& record, const Report& report) {
  ReportTarget entry;
  entry.name = target.name;
  entry.status = to_string(record.status);
  entry.reason = record.reason;
  entry.centre = target.centre();
  entry.size = target.size;
  entry.yaw_rad = target.yaw_rad;
  entry.done_s = record.done_s;
  entry.shots = record.shots;
  entry.pose = record.pose;
  if (record.shot) {
    entry.pitch_rad = record.shot->shot.pitch_rad;
    entry.shot_yaw_rad = record.shot->shot.yaw_rad;
    entry.speed_mps = record.shot->shot.speed_mps;
    entry.clearance_m = record.shot->clearance_m;
  }
  for (const ReportShot& shot : report.shots) {
    if (shot.target == target.name && shot.hit) entry.clearance_m = shot.clearance_m;
  }
  return entry;
}

/// An intruder that came, at the place where it is by now.
ReportTarget arriving_entry(const ArrivalYard& yard, const StopTasks& tasks, std::size_t who,
                            const SimRecord& record, const Report& report) {
  const Intruder& one = yard.intruders[who];
  Target last = yard.problem.targets[target_of(tasks, who)];
  last.name = one.name;
  ReportTarget entry = entry_of(last, tasks.records[who], report);
  if (!one.entrance.empty()) entry.visit = ReportVisit{one.entrance, one.from, one.enters_s, one.settles_s};
  if (!record.moves[who].empty()) entry.moves = record.moves[who];
  return entry;
}

/// At each look: where a walker was, and where the robot, before that look, believed that it would be.
std::vector<ReportMove> moves_of(const Walk& walk, const Track& track, const WanderOptions& options) {
  std::vector<ReportMove> moves;
  Track known;
  for (const TimedPosition& seen : track) {
    const Vec2 believed =
        known.empty() ? seen.position : straight_on(stride_of(known, options), seen.time_s).at(seen.time_s);
    moves.push_back({seen.time_s, walk.at(seen.time_s), believed});
    known.push_back(seen);
    if (known.size() > 100) known.erase(known.begin(), known.begin() + 50);
  }
  return moves;
}

/// A walker as it is by `now_s`.
ReportTarget walking_entry(const WalkerRun& walkers, const GuardMission& mission, std::size_t who,
                           const Report& report, double now_s) {
  const TargetRecord& record = mission.tasks.records[who];
  const Walk& walk = walkers.walks[who];
  const double last_s = record.status == TargetStatus::waiting ? now_s : record.done_s;
  const Target last = moved_to(walkers.plan.problem.targets[who], walk.at(last_s));
  ReportTarget entry = entry_of(last, record, report);
  auto moves = moves_of(walk, mission.moving.tracks[who], walkers.plan.options);
  if (!moves.empty()) {
    moves.push_back({last_s, xy(last.base), moves.back().believed});
    entry.moves = std::move(moves);
  }
  return entry;
}

}  // namespace

void list_targets(Report& report, const GuardRun& run, const GuardMission& mission, const SimRecord& record) {
  report.targets.clear();
  const auto& targets = true_problem(run).targets;
  const double now_s = report.track.empty() ? 0.0 : report.track.back().time_s;
  for (std::size_t i = 0; i < mission.tasks.records.size(); ++i) {
    if (run.arrivals) {
      report.targets.push_back(arriving_entry(run.arrivals->yard, mission.tasks, i, record, report));
    } else if (run.walkers) {
      report.targets.push_back(walking_entry(*run.walkers, mission, i, report, now_s));
    } else {
      report.targets.push_back(entry_of(targets[i], mission.tasks.records[i], report));
    }
  }
}

}  // namespace outrider
