#include "outrider/jobs/explore/mission/explore_log.hpp"

#include "outrider/jobs/explore/choose/catalog.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

constexpr double track_every_s = 0.4;
constexpr double belief_every_s = 1.0;

constexpr std::size_t most_candidates = 16;  // that are logged

outrider_msgs::Decision decision_message(const ExploreMission& mission, bool goes_home) {
  outrider_msgs::Decision message;
  message.kind = goes_home ? "home" : "frontier";
  message.frontiers = static_cast<std::uint32_t>(mission.frontiers().frontiers().size());
  if (goes_home) return message;
  if (const auto strategy = find_explore_strategy(mission.task().explore.strategy)) {
    message.value_of = strategy->value_of;
    message.most_is_best = strategy->most_is_best;
  }
  for (const ViewCandidate& one : mission.decision().candidates) {
    if (message.candidates.size() == most_candidates) break;
    message.candidates.push_back({point_of(one.place), one.cost_s, one.gain_m2, one.value, one.chosen});
  }
  return message;
}

}  // namespace

void ExploreLog::note_map(const ExploreMission& mission) {
  const MapUpdate& changed = mission.where().changed();
  map_.note(log_, mission.where().slam().map().occupancy(), changed.redrawn, changed.cells,
            mission.where().time_s());
}

void ExploreLog::note(const ExploreMission& mission, const Pose2& robot) {
  const bool over = mission.stage() == ExploreStage::over;
  note_decision(mission);
  for (; events_ < mission.events().size(); ++events_) {
    const ExploreEvent& event = mission.events()[events_];
    log_event(log_, event.time_s, event.kind, event.text);
  }
  if (mission.where().time_s() >= next_track_s_ || over) {
    next_track_s_ = mission.where().time_s() + track_every_s - 1e-9;
    log_pose(log_, mission.where().time_s(), robot);
  }
  if (mission.where().time_s() < next_belief_s_ && !over) return;
  next_belief_s_ = mission.where().time_s() + belief_every_s - 1e-9;
  log_belief(log_, mission.where().time_s(), mission.where().pose(), mission.where().slam().pose_covariance(),
             mission.loops() > loops_);
  loops_ = mission.loops();
}

void ExploreLog::finish(const ExploreMission& mission) {
  map_.redraw();
  map_.finish(log_, mission.explored_map(), mission.where().time_s());
  log_plan(log_, mission.where().time_s(), {});
  for (const LeftOver& left : mission.left().places)
    log_.append(topic::refusals, mission.where().time_s(),
                outrider_msgs::Refusal{point_of(left.place), left.sentence});
}

/// A new goal, or the way home.
void ExploreLog::note_decision(const ExploreMission& mission) {
  const bool goes_home = mission.stage() == ExploreStage::go_home;
  if (mission.goal_changes() == goal_changes_ && goes_home == went_home_) return;
  goal_changes_ = mission.goal_changes();
  went_home_ = goes_home;
  if (!mission.path()) return;
  const double time_s = mission.where().time_s();
  log_.append(topic::decisions, time_s, decision_message(mission, goes_home));
  log_.append(topic::goal, time_s,
              stamped(log_.time_of(time_s), goes_home ? start_ : mission.decision().goal));
  log_plan(log_, time_s, mission.path()->points);
}

}  // namespace outrider
