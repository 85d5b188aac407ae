#include "outrider/nodes/explorer_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/jobs/explore/mission/task.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_marker_messages.hpp"

namespace outrider {
namespace {

constexpr double goal_every_s = 1.0;
constexpr double verdict_s = 4.0;        // the mapper judges its map 1 s after the robot stands
constexpr std::int32_t sphere_list = 7;  // of visualization_msgs/Marker
constexpr double at_goal_m = 0.08;
constexpr int looked_at = 1000;                           // tries of a narrow place: no more are made
constexpr double moved_on_m = 0.04, turned_on_rad = 0.3;  // that count as moving on

}  // namespace

ExplorerNodeOptions::ExplorerNodeOptions() : robot(burger()) {
  explore.least_gain_m2 = 0.05;    // looks at walls from nearer, or holes are left in them that it asks about
  explore.frontier.patience = 24;  // maps, of which one comes in a second
}

std::vector<OptionGroup> describe(ExplorerNodeOptions& options) {
  return {
      {"",
       "the exploration",
       {{"home", "", 0, 0, "x,y,heading on the map, m, m and degrees; empty: where the robot is at first",
         &options.home},
        {"return_home", "", 0, 0, "it goes home in the end", &options.return_home},
        {"home_within", "m", 1e-3, 100.0, "of home, where the robot is home", &options.home_within_m},
        {"range", "m", 0.1, 1000.0, "of the range finder", &options.range_m},
        {"patience", "s", 0.5, 1e5, "without moving on, after which a goal has failed", &options.patience_s},
        {"look", "s", 0.0, 1e5, "that it stands at a goal before that has failed", &options.look_s},
        {"most_failures", "", 1, 100000, "goals that fail before it goes home", &options.most_failures}}},
      {"robot", "the robot, a disk on two wheels", describe(options.robot)},
      {"explore", "where it goes next", describe(options.explore)},
      {"frame", "names of the frames", describe(options.frames)}};
}

Outcome<ExplorerNodeOptions> ExplorerNode::checked(ExplorerNodeOptions options) {
  if (options.home.empty()) return options;
  if (auto home = parse_pose(options.home, "home"); !home) return pass_on(home);
  return options;
}

ExplorerNode::ExplorerNode(ExplorerNodeOptions options)
    : Node("explorer", 0.1, "explore/status"),
      options_(std::move(options)),
      frames_(options_.frames),
      scan_(2.0 * CloseRange::reach_m),
      frontiers_(options_.explore.frontier, options_.robot.radius_m) {
  blacklist_.ban_s = options_.explore.ban_s;
  if (const auto home = parse_pose(options_.home, "home")) home_ = *home;
  listen<nav_msgs::OccupancyGrid>("map", Delivery::latched,
                                  [this](const auto& map) { return take_map(map); });
  listen<sensor_msgs::LaserScan>("scan", Delivery::sensor,
                                 [this](const auto& scan) { return take_scan(scan); });
  listen<diagnostic_msgs::DiagnosticStatus>("mapper/status", Delivery::latched,
                                            [this](const auto& mapper) { return take_verdict(mapper); });
  listen_to_transforms(frames_);
  goal_output_ = add_output<geometry_msgs::PoseStamped>("goal_pose", Delivery::reliable);
  frontier_output_ = add_output<visualization_msgs::MarkerArray>("frontiers", Delivery::reliable);
  set_status(NodeLevel::info, "waiting", "no map has come yet");
}

Status ExplorerNode::take_map(const nav_msgs::OccupancyGrid& map) {
  if (auto time_s = maps_.take(map.header.stamp); !time_s) return pass_on(time_s);
  const auto grid = checked_map(map);
  if (!grid) return pass_on(grid);
  if (beginning_.is_another(map) && !over_) {
    over_ = true;
    set_status(NodeLevel::error, "map_lost",
               "the map was begun anew, so home is not known on it; start the explorer anew");
  }
  if (over_) return {};
  if (has_map_ && !grown_from(grid->frame, frame_)) {
    frontiers_ = FrontierMap(options_.explore.frontier, options_.robot.radius_m);
    decision_.reset();
    if (end_state_.empty()) goal_.reset();
    narrow_way_.reset();
  }
  frame_ = grid->frame;
  frontiers_.update(*grid, {true, {}});
  has_map_ = new_map_ = true;
  return {};
}

/// The odometry at the time of a scan may come after it.
Status ExplorerNode::take_scan(const sensor_msgs::LaserScan& scan) {
  gap_.add(scan_, frames_);
  return scan_.take(scan, frames_, now_s());
}

Status ExplorerNode::take_verdict(const diagnostic_msgs::DiagnosticStatus& mapper) {
  const bool doubts = std::ranges::any_of(mapper.values, [](const diagnostic_msgs::KeyValue& value) {
    return value.key == "state" && value.value == "doubtful";
  });
  doubt_ = doubts ? printable(mapper.message) : "";
  return {};
}

ExploreState ExplorerNode::state() {
  return {frontiers_, blacklist_, options_.robot, options_.range_m,
          pose_,      *home_,     now_s(),        decision_ ? decision_->choice : ExploreChoice{}};
}

/// Decides. Where nothing can be reached, it tries the goals that failed once more.
Outcome<Decision> ExplorerNode::decision_with_tries() {
  constexpr int most_tries = 3;
  auto decision = decide(state(), options_.explore, workspace_);
  if (!decision || decision->kind != DecisionKind::complete) return decision;
  if (!blacklist_.lift(most_tries, now_s())) return decision;
  return decide(state(), options_.explore, workspace_);
}

void ExplorerNode::moved_on() {
  stood_ = pose_;
  moved_on_s_ = now_s();
}

void ExplorerNode::go_home(std::string state, std::string sentence) {
  end_state_ = std::move(state);
  end_sentence_ = std::move(sentence);
  goal_ = *home_;
  arrived_s_.reset();
  moved_on();
  if (!options_.return_home) return end();
  set_status(NodeLevel::info, "going_home", end_sentence_);
  send_goal();
}

bool ExplorerNode::has_explored() const { return end_state_ == "complete" || end_state_ == "left_over"; }

/// Ends, or first waits for what the mapper says of its map once the robot stands.
void ExplorerNode::end() {
  if (!has_explored() || !doubt_) return end_as_judged();
  asked_s_ = now_s();
  set_status(NodeLevel::info, "asking", "it waits for what the mapper says of its map");
}

void ExplorerNode::end_as_judged() {
  over_ = true;
  const bool home = distance(pose_.position, home_->position) <= options_.home_within_m;
  if (has_explored() && !doubt_) end_sentence_ += "; no mapper says whether its map can be believed";
  if (has_explored() && doubt_ && !doubt_->empty()) {
    end_state_ = "lost";
    end_sentence_ = "the mapper doubts its map: " + *doubt_;
  }
  const bool good = end_state_ == "complete" && (home || !options_.return_home);
  set_status(good ? NodeLevel::info : NodeLevel::error, end_state_,
             home && end_state_ != "lost" ? end_sentence_ + "; the robot is home" : end_sentence_);
}

/// Looks at the narrow ways from near, one after the other, then goes home.
void ExplorerNode::nothing_to_reach(const Decision& decision) {
  if (narrow_way_) return;  // it is on its way to one
  LeftOvers left = left_over(state(), options_.explore, decision.refused, false, narrow_);
  if (!left.worth_a_try.empty()) {
    narrow_way_ = left.worth_a_try.front();
    const Vec2 stand = narrow_way_->points.front();
    goal_ = Pose2{stand, heading_of(narrow_way_->narrowest - stand)};
    moved_on();
    arrived_s_.reset();
    gap_.begin_anew();
    set_status(NodeLevel::info, "exploring",
               fmt::format("to {:.2f}, {:.2f} to look at a narrow place from near", stand.x, stand.y));
    return send_goal();
  }
  const LeftOvers behind = take_behind_gaps(left, narrow_);
  for (const LeftOver& one : behind.places) {
    tell(NodeLevel::info,
         fmt::format("behind a gap at {:.2f}, {:.2f}: the gap at {:.2f}, {:.2f} is {:.2f} m wide",
                     one.place.x, one.place.y, one.narrowest.x, one.narrowest.y, one.width_m));
  }
  for (const LeftOver& one : left.places) {
    tell(NodeLevel::info, fmt::format("left over at {:.2f}, {:.2f}: up to {:.1f} m2: {}", one.place.x,
                                      one.place.y, one.area_m2, one.sentence));
  }
  if (!left.places.empty()) {
    go_home("left_over", left.sentence(wanted_width_m(options_.robot, options_.explore)));
    return;
  }
  go_home("complete", behind.places.empty()
                          ? decision.sentence
                          : decision.sentence + "; " + behind.behind_gaps(2.0 * wanted_room_m()));
}

/// Returns the least room on each side of its centre where the robot drives.
double ExplorerNode::wanted_room_m() const {
  return options_.robot.radius_m + options_.explore.frontier.ground.margin_m;
}

void ExplorerNode::decide_where(const Decision& decision) {
  const bool elsewhere =
      !goal_ || !end_state_.empty() || !decision_ || decision.choice.frontier != decision_->choice.frontier;
  decision_ = decision;
  if (decision.kind == DecisionKind::leak) return go_home("leak", decision.sentence);
  if (decision.kind == DecisionKind::complete) {
    if (!end_state_.empty()) return;  // on its way home
    return nothing_to_reach(decision);
  }
  end_state_.clear();
  narrow_way_.reset();
  goal_ = decision.goal;
  if (elsewhere) {
    moved_on();
    arrived_s_.reset();
  }
  set_status(NodeLevel::info, "exploring",
             fmt::format("to {:.2f}, {:.2f} {}", goal_->position.x, goal_->position.y, decision.sentence));
  send_goal();
}

void ExplorerNode::decide_anew() {
  if (end_state_ == "stuck" || end_state_ == "leak") return;
  const auto decision = decision_with_tries();
  if (decision) return decide_where(*decision);
  if (end_state_.empty()) tell(NodeLevel::warning, decision.error().sentence);
}

/// Bans a goal that failed; ends at home.
void ExplorerNode::judge_goal() {
  const bool moved = distance(pose_.position, stood_.position) > moved_on_m ||
                     std::abs(wrap_angle(pose_.heading_rad - stood_.heading_rad)) > turned_on_rad;
  if (moved) moved_on();
  const bool going_home = !end_state_.empty();
  if (distance(pose_.position, goal_->position) <= (going_home ? options_.home_within_m : at_goal_m)) {
    if (going_home) return end();
    if (!arrived_s_) arrived_s_ = now_s();
  }
  if (narrow_way_ && arrived_s_) gap_.look(*narrow_way_, pose_, options_.robot.radius_m);
  const bool seen_in_vain = arrived_s_ && now_s() - *arrived_s_ > options_.look_s;
  if (!seen_in_vain && now_s() - moved_on_s_ <= options_.patience_s) return;
  if (!seen_in_vain) {
    tell(NodeLevel::warning,
         fmt::format("the robot does not move on at {:.2f}, {:.2f}", pose_.position.x, pose_.position.y));
  }
  moved_on();
  arrived_s_.reset();
  if (++failures_ > options_.most_failures) {
    if (going_home) {
      end_state_ = "stuck";
      end_sentence_ = fmt::format("{} goals have failed, and the robot does not come home", failures_);
      return end();
    }
    return go_home("stuck", fmt::format("{} goals have failed", failures_));
  }
  if (going_home) return;
  if (narrow_way_) {  // what is narrow still, after a look from near, is too narrow
    const auto gap = gap_.gap();
    const bool too_narrow = gap && gap->width_m < 2.0 * wanted_room_m();
    narrow_.push_back(too_narrow ? *gap : NarrowPlace{narrow_way_->narrowest, 0.0, false, looked_at});
    narrow_way_.reset();
    return decide_anew();
  }
  blacklist_.add(decision_->choice.place, now_s());
  decide_anew();
}

void ExplorerNode::send_goal() {
  goal_sent_s_ = now_s();
  send(goal_output_, stamped(now_s(), *goal_, options_.frames.map));
}

void ExplorerNode::send_frontiers() {
  visualization_msgs::MarkerArray array;
  visualization_msgs::Marker marker;
  marker.header = header_of(now_s(), options_.frames.map);
  marker.ns = "frontiers";
  marker.shape = sphere_list;
  marker.scale = {0.08, 0.08, 0.08};
  marker.color = {0.1F, 0.4F, 0.9F, 1.0F};
  marker.pose.orientation.w = 1.0;
  for (const auto& [id, frontier] : frontiers_.frontiers()) {
    marker.points.push_back({frontier.centroid.x, frontier.centroid.y, 0.05});
  }
  array.markers.push_back(std::move(marker));
  send(frontier_output_, array);
}

void ExplorerNode::act() {
  if (over_ || !has_map_) return;
  const auto pose = frames_.map_T_robot();
  if (!pose) {
    return set_status(
        NodeLevel::warning, "waiting",
        fmt::format("no transform says where '{}' is on '{}'", options_.frames.base, options_.frames.map));
  }
  pose_ = *pose;
  if (!home_) home_ = pose_;
  if (asked_s_) {
    if (now_s() - *asked_s_ >= verdict_s) end_as_judged();
    return;
  }
  if (std::exchange(new_map_, false)) {
    decide_anew();
    send_frontiers();
  }
  if (over_ || !goal_) return;
  judge_goal();
  if (!over_ && now_s() - goal_sent_s_ >= goal_every_s) send_goal();
}

}  // namespace outrider
