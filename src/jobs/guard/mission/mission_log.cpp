#include "outrider/jobs/guard/mission/mission_log.hpp"

#include <algorithm>
#include <utility>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "run/guard_log.hpp"

namespace outrider {
namespace {

/// Returns where the robot, before its newest look at a walker, believed that the walker would be.
Vec2 believed_at(const Track& track, std::size_t look, const WanderOptions& options) {
  constexpr std::size_t most_known = 50;
  const TimedPosition& seen = track[look];
  if (look == 0) return seen.position;
  const std::size_t first = look > most_known ? look - most_known : 0;
  const Track known(track.begin() + static_cast<std::ptrdiff_t>(first),
                    track.begin() + static_cast<std::ptrdiff_t>(look));
  return straight_on(stride_of(known, options), seen.time_s).at(seen.time_s);
}

}  // namespace

TargetLog::TargetLog(Log& log, LogQueue& queue, const std::vector<Target>& targets,
                     const std::vector<Intruder>* intruders, const std::vector<Walk>* walks)
    : log_(log), queue_(queue), walks_(walks) {
  const std::size_t count = intruders == nullptr ? targets.size() : intruders->size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool comes = intruders != nullptr && !(*intruders)[i].entrance.empty();
    begin(targets[i], comes ? &(*intruders)[i] : nullptr);
  }
  queue_.flush(log, 0.0);
}

void TargetLog::begin(const Target& target, const Intruder* comes) {
  const std::size_t who = told_.size();
  seen_.push_back(0);
  heights_m_.push_back(target.centre().z);
  told_.push_back({target.name, comes != nullptr ? "outside" : "waiting", "", vector_of(target.size),
                   target.yaw_rad, 0, comes != nullptr ? comes->entrance : ""});
  log_.append(topic::targets, 0.0, told_[who]);
  const Vec2 settled = xy(target.base);
  if (comes == nullptr) {
    place(0.0, who, walks_ != nullptr ? (*walks_)[who].at(0.0) : settled, settled);
    return;
  }
  told_[who].status = "waiting";
  queue_.note(comes->enters_s, topic::targets, told_[who]);
  place(comes->enters_s, who, comes->from, comes->from);
  place(comes->settles_s, who, settled, settled);
}

void TargetLog::place(double time_s, std::size_t who, Vec2 at, Vec2 believed) {
  queue_.note(
      time_s, topic::target_positions,
      outrider_msgs::TargetPosition{told_[who].name, {at.x, at.y, heights_m_[who]}, point_of(believed)});
}

void TargetLog::note_walker(const MovingTargets& moving, std::size_t who) {
  const Track& track = moving.tracks()[who];
  for (std::size_t& look = seen_[who]; look < track.size(); ++look) {
    place(track[look].time_s, who, (*walks_)[who].at(track[look].time_s),
          believed_at(track, look, moving.plan().options));
  }
}

void TargetLog::place_last(double time_s, std::size_t who) {
  if (walks_ == nullptr) return;
  const Vec2 at = (*walks_)[who].at(time_s);
  place(time_s, who, at, at);
}

void TargetLog::note_record(const TargetRecord& record, std::size_t who, double time_s) {
  outrider_msgs::Target& told = told_[who];
  const auto shots = static_cast<std::uint32_t>(record.shots);
  const std::string_view status = to_string(record.status);
  if (told.shots == shots && told.status == status && told.reason == record.reason) return;
  const bool ended = told.status != status && record.status != TargetStatus::waiting;
  told.shots = shots;
  told.status = status;
  told.reason = record.reason;
  // The result of a ball that nobody waited for is of a time in between.
  const double since_s = ended ? std::clamp(record.done_s, noted_s_, time_s) : time_s;
  queue_.note(since_s, topic::targets, told);
  if (ended) place_last(time_s, who);
}

void TargetLog::note(const GuardMission& mission, double time_s) {
  for (std::size_t i = 0; i < told_.size(); ++i) {
    if (walks_ != nullptr && told_[i].status == "waiting") note_walker(*mission.moving(), i);
    note_record(mission.board().records()[i], i, time_s);
  }
  noted_s_ = time_s;
  queue_.flush(log_, time_s);
}

void TargetLog::finish(const GuardMission& mission, double time_s) {
  for (std::size_t i = 0; i < told_.size(); ++i) {
    if (mission.board().records()[i].status == TargetStatus::waiting) place_last(time_s, i);
  }
  note(mission, time_s);
}

void log_prepared(Log& log, const PreparedGuard& guard) {
  const GuardProblem& problem = guard.scenario.problem;
  log_yard(log, problem, guard.scenario);
  log_firing_map(log, guard.plan->firing_map);
  log_blocked_flights(log, problem, guard.plan->firing_map);
  log_tour(log, problem, draft_of(problem, *guard.plan->tour));
}

}  // namespace outrider
