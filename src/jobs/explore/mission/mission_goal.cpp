#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "outrider/jobs/explore/mission/mission.hpp"

namespace outrider {
namespace {

/// Returns true if the frontier is still there, but no way leads to where it would be seen any more.
bool lost_way(const Decision& decision, std::uint32_t frontier) {
  const auto is_lost = [&](const RefusedFrontier& one) {
    return one.frontier == frontier && one.kind == Refusal::no_way;
  };
  return std::ranges::any_of(decision.refused, is_lost);
}

}  // namespace

/// Returns true if all poses were optimised lately; otherwise requests it with the next scan. Before the
/// robot goes home that may show that something is left to see, and when it believes that it is home, that it
/// is not.
bool ExploreMission::settled(double lately_m) {
  if (where_->settled_within(lately_m)) return true;
  where_->settle_soon();
  path_.reset();
  return false;
}

/// Returns the way home along the driven trail: the robot has come on it, whatever the map says now. Where
/// the trail comes by the same place again, what lies between is left out.
std::vector<Vec2> ExploreMission::trail_home() const {
  constexpr double same_m = 0.03;
  const std::vector<Pose2> came = where_->slam().trajectory();
  std::vector<Vec2> way{where_->pose().position};
  for (std::size_t at = came.size(); at-- > 0;) {
    std::size_t earliest = at;
    for (std::size_t i = 0; i < at; ++i) {
      if (distance(came[i].position, came[at].position) > same_m) continue;
      earliest = i;
      break;
    }
    at = earliest;
    if (distance(way.back(), came[at].position) > 0.01) way.push_back(came[at].position);
  }
  if (way.size() == 1) way.push_back(task_.start.position);
  return way;
}

/// Sends the robot home, or ends the mission if it is there or need not return.
void ExploreMission::turn_home(const std::string& stop_reason, const std::string& reason) {
  if (stop_reason_ != stop_reason) add_event("home", reason);
  stop_reason_ = stop_reason;
  reason_ = reason;
  home_.is_there = distance(where_->pose().position, task_.start.position) <= task_.rules.home_within_m;
  constexpr double here_m = 0.5;
  if (task_.rules.return_home && home_.is_there && !settled(here_m)) {
    home_.arriving = true;
    return;
  }
  if (home_.is_there && explored() && goes_out_again()) return;
  if (!task_.rules.return_home || home_.is_there) return end(stop_reason, reason);
  auto way = way_to(state(), task_.start.position, task_.explore, workspace_);
  stage_ = ExploreStage::go_home;
  home_.on_trail = !way;
  follow(way ? std::move(*way) : trail_home());
}

/// Returns the reason to stop, and its sentence, by what is left over. What lies behind gaps that are too
/// narrow is named, and not asked of the robot.
std::pair<std::string, std::string> ExploreMission::verdict() const {
  const double wanted_m = wanted_width_m(task_.robot, task_.explore);
  LeftOvers asked = left_;
  const LeftOvers behind = take_behind_gaps(asked, gaps_.places());
  if (!asked.places.empty()) return {"left_over", left_.sentence(wanted_m)};
  return {"complete", behind.places.empty() ? decision_.sentence
                                            : decision_.sentence + "; " + behind.behind_gaps(wanted_m)};
}

void ExploreMission::nothing_to_reach() {
  if (!settled(std::numeric_limits<double>::infinity())) return;
  const auto [stop_reason, sentence] = verdict();
  turn_home(stop_reason, sentence);
}

void ExploreMission::take(Decision decision) {
  const bool elsewhere =
      decision.choice.frontier != decision_.choice.frontier || stage_ != ExploreStage::seek || !path_;
  decision_ = std::move(decision);
  if (decision_.kind == DecisionKind::complete) return nothing_to_reach();
  if (decision_.kind == DecisionKind::leak) return turn_home("leak", decision_.sentence);
  if (elsewhere) {
    ++goal_changes_;
    moved_on_s_ = where_->time_s();
    where_->forget_settling();
    home_.left_m.fill(no_way_m);
    add_event("goal", decision_.sentence);
  }
  stage_ = ExploreStage::seek;
  home_.on_trail = false;
  stop_reason_.clear();
  reason_.clear();
  follow(decision_.waypoints);
}

bool ExploreMission::spent() const {
  const ExploreRules& rules = task_.rules;
  return where_->time_s() - where_->started_s() > rules.most_time_s ||
         where_->driven_m() > rules.most_distance_m;
}

bool ExploreMission::explored() const { return stop_reason_ == "complete" || stop_reason_ == "left_over"; }

/// Opens the roomiest way that is worth a try, or of those beside the robot. Returns false if there is none.
bool ExploreMission::opens_narrow_way(bool beside) {
  const std::optional<std::string> sentence = gaps_.open_way(
      left_, beside ? std::optional(where_->pose().position) : std::nullopt, frontiers_.ground());
  if (sentence && !sentence->empty()) add_event("narrow", *sentence);
  return sentence.has_value();
}

/// Decides. Where nothing can be reached, it judges what is left over, and tries the narrow ways and the
/// goals that failed once more; before it leaves for a goal far off, the narrow ways beside it, or it would
/// come back for them.
Outcome<Decision> ExploreMission::decide_with_tries() {
  constexpr int most_failures = 3;
  constexpr double far_m = 3.0;
  constexpr int most_rounds = 4;
  constexpr double valid_s = 2.0;  // of a judgement on the way home
  // On the way home it turns round only for what would count as left over.
  ExploreOptions options = task_.explore;
  if (explored()) options.least_gain_m2 = std::max(options.least_gain_m2, options.least_left_m2);
  for (int i = 0;; ++i) {
    auto decision = decide(state(), options, workspace_);
    if (!decision || decision->kind == DecisionKind::leak) return decision;
    const bool goes = decision->kind == DecisionKind::go;
    if (goes && (decision->way_m < far_m || decision->choice.frontier == decision_.choice.frontier))
      return decision;
    if (stage_ == ExploreStage::go_home && where_->time_s() - left_s_ < valid_s) return decision;
    left_ = left_over(state(), options, decision->refused, false, gaps_.places());
    left_s_ = where_->time_s();
    const bool failed = !goes && std::ranges::count(left_.places, LeftReason::failed, &LeftOver::reason) > 0;
    if (i == most_rounds ||
        (!opens_narrow_way(goes) && !(failed && blacklist_.lift(most_failures, where_->time_s()))))
      return decision;
  }
}

/// Decides at home, on the settled map, whether something is left to see.
bool ExploreMission::goes_out_again() {
  constexpr int most_returns = 2;
  if (home_.returns == most_returns || !task_.rules.return_home) return false;
  left_s_ = -1.0;  // what it knew on its way does not count
  auto decision = decide_with_tries();
  if (!decision || decision->kind != DecisionKind::go) return false;
  ++home_.returns;
  home_.arriving = false;
  take(std::move(*decision));
  return true;
}

/// The planner has had no budget for a decision: waits for a while, then goes home.
void ExploreMission::go_without_planner(const Fault& fault) {
  constexpr double patience_s = 10.0;
  if (!planless_s_) add_event("stuck", "no way is planned, so it waits: " + fault.sentence);
  const double since_s = planless_s_.value_or(where_->time_s());
  planless_s_ = since_s;
  path_.reset();
  if (where_->time_s() - since_s < patience_s) return;
  turn_home("stuck", fmt::format("no way can be planned since {:.1f} s: {}", since_s, fault.sentence));
}

bool ExploreMission::sees_nothing_new() const {
  constexpr double patience_s = 200.0, ways = 2.0;
  if (stage_ != ExploreStage::seek) return false;
  const TraversabilityGrid& ground = frontiers_.ground();
  const int cells = ground.highest().x - ground.lowest().x + ground.highest().y - ground.lowest().y + 2;
  const double across_s = cells * ground.frame().resolution_m / task_.robot.speed_mps;
  return where_->time_s() - learned_s_ > patience_s + ways * across_s;
}

void ExploreMission::decide_anew() {
  const bool arrived = path_ && stage_ == ExploreStage::seek && remaining_m(*path_) < arrived_m();
  const std::uint32_t goal = decision_.choice.frontier;
  decided_s_ = where_->time_s();
  ++decisions_;
  if (spent()) {
    return turn_home("budget", fmt::format("its budget is spent after {:.0f} s and {:.1f} m",
                                           where_->time_s(), where_->driven_m()));
  }
  if (sees_nothing_new()) {
    return turn_home(
        "stuck", fmt::format("nothing new was seen since {:.0f} s, though the map is open; are its cells and "
                             "odds right for this robot?",
                             learned_s_));
  }
  const bool for_good = stage_ == ExploreStage::go_home && !explored() && !planless_s_;
  if (home_.arriving || for_good) {
    turn_home(stop_reason_, reason_);
    return;
  }
  // Looked at from where it was to be seen, and still there: it will not be seen.
  if (arrived && frontiers_.frontiers().contains(goal))
    blacklist_.add(decision_.choice.place, where_->time_s());
  auto decision = decide_with_tries();
  if (!decision && decision.error().code == FaultCode::budget_exhausted) {
    go_without_planner(decision.error());
    return;
  }
  planless_s_.reset();
  if (!decision) return turn_home("stuck", decision.error().sentence);
  if (path_ && stage_ == ExploreStage::seek && lost_way(*decision, goal))
    blacklist_.add(decision_.choice.place, where_->time_s());
  take(std::move(*decision));
}

}  // namespace outrider
