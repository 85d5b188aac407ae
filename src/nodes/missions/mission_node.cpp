#include "outrider/nodes/missions/mission_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/known_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {

std::vector<Option> describe(MissionNodeOptions& options) {
  std::vector<Option> all{
      {"plain_twist", "", 0, 0, "commands are geometry_msgs/Twist, not TwistStamped", &options.plain_twist},
      {"patience", "s", 0.05, 1e6, "age of odometry, pose or scan at which the robot stands still",
       &options.patience_s}};
  for (Option& option : describe(options.frames)) {
    option.name = "frame_" + std::string(option.name);
    all.push_back(std::move(option));
  }
  return all;
}

namespace {

constexpr double watched_m = 2.0;   // length of the beams that matter
constexpr double longest_s = 30.0;  // that it stands before something
constexpr double drove_on_m = 0.1;
constexpr double stuck_s = 30.0;
constexpr double at_start_m = 0.3;

}  // namespace

Status check_no_faults(bool are_asked, const std::string& key) {
  if (!are_asked) return {};
  return bad_input("with a robot behind topics nothing goes wrong on purpose; leave this out", key);
}

/// Sends what is logged.
class MissionNode::Topics final : public LogSink {
 public:
  explicit Topics(MissionNode& node) : node_(node) {}

  void add_channel(const Channel& channel) override {
    const MessageType* type = find_message_type(channel.type);
    const bool left_out = channel.topic == topic::events || type == nullptr || hears(channel.topic);
    outputs_.push_back(
        left_out ? std::nullopt
                 : std::optional(node_.add_output(channel.topic.substr(1), *type, Delivery::latched)));
    by_topic_[channel.topic] = outputs_.back();
  }
  void append(std::size_t channel, std::int64_t, std::string_view data) override {
    if (outputs_[channel]) node_.send_bytes({*outputs_[channel], std::string(data)});
  }
  [[nodiscard]] std::optional<std::size_t> output_of(std::string_view topic) const {
    const auto found = by_topic_.find(topic);
    return found == by_topic_.end() ? std::nullopt : found->second;
  }

 private:
  [[nodiscard]] bool hears(std::string_view topic) const {
    return std::ranges::any_of(node_.inputs(), [&](const NodeTopic& input) {
      return input.name == topic || input.name == topic.substr(1);
    });
  }

  MissionNode& node_;
  std::vector<std::optional<std::size_t>> outputs_;  ///< by channel
  std::map<std::string, std::optional<std::size_t>, std::less<>> by_topic_;
};

MissionNode::MissionNode(std::string name, MissionNodeOptions options, double period_s)
    : Node(std::move(name), period_s, "~/status"),
      options_(std::move(options)),
      frames_(options_.frames),
      scan_(watched_m),
      topics_(std::make_unique<Topics>(*this)) {
  command_output_ = options_.plain_twist
                        ? add_output<geometry_msgs::Twist>("cmd_vel", Delivery::reliable)
                        : add_output<geometry_msgs::TwistStamped>("cmd_vel", Delivery::reliable);
}

MissionNode::~MissionNode() { log_.remove_sink(*topics_); }

void MissionNode::listen_to_pose() {
  listen<nav_msgs::Odometry>("odom", Delivery::sensor,
                             [this](const auto& odometry) { return take_odometry(odometry); });
  listen_to_transforms(frames_);
}

Status MissionNode::take_odometry(const nav_msgs::Odometry& odometry) {
  const std::optional<double> before_s = odometries_.newest_s();
  const auto time_s = odometries_.take(odometry.header.stamp);
  if (!time_s) return pass_on(time_s);
  if (auto ok = frames_.add(odometry); !ok) return ok;
  if (before_s != *time_s) odometry_came_s_ = now_s();
  odometry_came();
  return {};
}

void MissionNode::listen_to_scan() {
  listen<sensor_msgs::LaserScan>("scan", Delivery::sensor,
                                 [this](const auto& scan) { return scan_.take(scan, frames_, now_s()); });
}

std::optional<std::vector<Vec2>> MissionNode::new_scan_on_map() {
  if (!scan_.came_s() || scan_.time_s() == placed_s_) return std::nullopt;
  const auto odom_T_then = frames_.odom_T_robot(scan_.time_s());
  const auto map_T_odom = frames_.map_T_odom();
  if (!odom_T_then || !map_T_odom) return std::nullopt;
  placed_s_ = scan_.time_s();
  const Pose2 map_T_then = compose(*map_T_odom, *odom_T_then);
  std::vector<Vec2> points;
  points.reserve(scan_.points().size());
  for (const Vec2 point : scan_.points()) points.push_back(map_T_then * point);
  return points;
}

std::string MissionNode::why_scan_is_missing() const {
  return scan_.came_s() ? why_missing("scan", scan_.came_s(), options_.patience_s) : std::string();
}

void MissionNode::stand_before(Vec2 thing, Vec2 robot) {
  if (!stands_s_ || distance(robot, stands_at_) > drove_on_m) {
    stands_s_ = now_s();
    stands_at_ = robot;
  }
  const std::string what =
      fmt::format("the scan shows something in the way that is not on the map, at about {:.1f}, {:.1f}",
                  thing.x, thing.y);
  if (now_s() - *stands_s_ <= longest_s) {
    set_status(NodeLevel::error, "stopped", what);
  } else {
    end(NodeLevel::error, "blocked",
        fmt::format("for {:g} s {}; take it away, or put it on the map", longest_s, what));
  }
}

bool MissionNode::has_to_stand(const std::optional<Vec2>& thing, Vec2 robot) {
  if (thing) {
    command({});
    stand_before(*thing, robot);
  } else {
    way_is_free(robot);
  }
  return thing.has_value();
}

void MissionNode::way_is_free(Vec2 robot) {
  if (stands_s_ && distance(robot, stands_at_) > drove_on_m) stands_s_.reset();
}

bool MissionNode::ends_stuck(double moved_on_s) {
  if (now_s() - moved_on_s <= stuck_s) return false;
  end(NodeLevel::error, "stuck", fmt::format("the robot has not moved on for {:g} s", stuck_s));
  return true;
}

Status MissionNode::check_start(Vec2 start, Vec2 robot, std::string_view remedy) {
  const double away_m = distance(start, robot);
  if (away_m <= at_start_m) return {};
  return bad_input(
      fmt::format("the robot stands {:.2f} m from the start of the scenario; drive it there, or {}", away_m,
                  remedy),
      "start");
}

std::string MissionNode::why_odometry_is_missing() const {
  return why_missing("odometry", odometry_came_s_, options_.patience_s);
}

std::string MissionNode::why_pose_is_missing() const {
  std::string why = why_odometry_is_missing();
  if (why.empty()) {
    why = why_missing(fmt::format("transform from {} to {}", options_.frames.map, options_.frames.odom),
                      frames_.localised_s(), options_.patience_s);
  }
  if (why.empty() && !frames_.map_T_robot()) why = "no transform says where the robot is";
  return why;
}

std::optional<std::size_t> MissionNode::output_of(std::string_view topic) const {
  return topics_->output_of(topic);
}

void MissionNode::begin_log(double time_s) {
  began_s_ = time_s;
  log_.begin_at(began_s_);
  log_.keep_newest(kept);
  log_.add_sink(*topics_);
}

void MissionNode::command(const Twist2& twist) {
  geometry_msgs::TwistStamped message;
  message.header = header_of(now_s(), options_.frames.base);
  message.twist.linear.x = twist.ahead_mps;
  message.twist.linear.y = twist.left_mps;
  message.twist.angular.z = twist.turn_radps;
  options_.plain_twist ? send(command_output_, message.twist) : send(command_output_, message);
}

void MissionNode::end(NodeLevel level, std::string state, std::string sentence) {
  over_ = true;
  command({});
  set_status(level, std::move(state), std::move(sentence));
}

void MissionNode::end(const Fault& fault) {
  end(NodeLevel::error, std::string(to_string(fault.code)), to_string(fault));
}

}  // namespace outrider
