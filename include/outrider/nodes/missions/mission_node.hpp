// MissionNode: what the missions of all jobs have in common whose robot is on the other side of topics.
//
// It sends commands, as TwistStamped or Twist, and the messages of the run as they are logged: each channel
// of the log is a latched topic of the same name, in the namespace of the node, and of the same type with the
// same bytes. Left out are the channels that the node hears, since there the robot and others say what is so:
// /tf and /tf_static, for pursue /target_pose, for drive camera/camera_info; and /rosout, where the node
// speaks. Times of the log begin when the mission begins, and are those of the node on topics.
// Missions begin when begin_log() is called.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/log.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/nodes/robot_frames.hpp"
#include "outrider/nodes/scan_points.hpp"

namespace outrider {

struct MissionNodeOptions {
  FrameNames frames;
  bool plain_twist = false;  ///< commands are Twist, not TwistStamped
  double patience_s = 0.4;   ///< age of odometry, pose or scan at which the robot stands still
};
std::vector<Option> describe(MissionNodeOptions& options);

/// Returns a fault, at the key, if a scenario asks for what goes wrong with a simulated robot.
Status check_no_faults(bool are_asked, const std::string& key = "faults");

class MissionNode : public Node {
 public:
  ~MissionNode() override;
  [[nodiscard]] bool is_over() const override { return over_; }
  /// Returns the newest messages of the run: at least `kept` of each channel, if there are so many.
  [[nodiscard]] const Log& log() const { return log_; }
  static constexpr std::size_t kept = 50;

 protected:
  explicit MissionNode(std::string name, MissionNodeOptions options, double period_s = 0.02);

  /// Listens to odometry and transforms, which say where the robot is.
  void listen_to_pose();
  /// Listens to transforms alone, which say where devices are on the robot.
  void listen_to_mounts() { listen_to_transforms(frames_); }
  /// Listens to scans, which show what is in the way; the mission goes on without them if none ever comes.
  void listen_to_scan();
  [[nodiscard]] const ScanPoints& scan() const { return scan_; }
  /// Returns where beams of the newest scan end on the map, once for each scan; nothing if it was returned
  /// before, or the pose at its time is not known.
  [[nodiscard]] std::optional<std::vector<Vec2>> new_scan_on_map();
  /// Returns why the robot has to stand still because of its scans; empty if it does not.
  [[nodiscard]] std::string why_scan_is_missing() const;
  /// Says that the robot stands before a thing that the scan shows; ends the mission if it does for 30 s.
  /// Both are on the map.
  void stand_before(Vec2 thing, Vec2 robot);
  /// Lets the robot stand before that thing; if there is none, its way is free. Returns true if it stands.
  bool has_to_stand(const std::optional<Vec2>& thing, Vec2 robot);
  /// Says that the way of the robot is free.
  void way_is_free(Vec2 robot);
  /// Ends the mission, and returns true, if the robot has not moved on for 30 s.
  bool ends_stuck(double moved_on_s);
  /// Fault: bad_input, at `start`, if the robot is more than 0.3 m from there; `remedy` is that beside
  /// driving it there.
  [[nodiscard]] static Status check_start(Vec2 start, Vec2 robot, std::string_view remedy);
  /// Called when odometry has come.
  virtual void odometry_came() {}
  [[nodiscard]] const std::optional<double>& odometry_s() const { return odometries_.newest_s(); }
  /// Return why the robot has to stand still because of its odometry, or of its pose on the map; empty if it
  /// does not.
  [[nodiscard]] std::string why_odometry_is_missing() const;
  [[nodiscard]] std::string why_pose_is_missing() const;
  [[nodiscard]] const RobotFrames& frames() const { return frames_; }
  [[nodiscard]] const MissionNodeOptions& options() const { return options_; }

  /// Begins the mission and its log; now, or at the time of the node when its first scan was taken.
  void begin_log() { begin_log(now_s()); }
  void begin_log(double time_s);
  /// Returns the output on which a channel of the log is published; nothing before its first message.
  [[nodiscard]] std::optional<std::size_t> output_of(std::string_view topic) const;
  [[nodiscard]] Log& log() { return log_; }
  /// Returns the time of the mission.
  [[nodiscard]] double mission_s() const { return now_s() - began_s_; }
  [[nodiscard]] double began_s() const { return began_s_; }

  void command(const Twist2& twist);
  /// Ends the mission; the robot stands.
  void end(NodeLevel level, std::string state, std::string sentence);
  void end(const Fault& fault);

 private:
  class Topics;

  Status take_odometry(const nav_msgs::Odometry& odometry);

  MissionNodeOptions options_;
  RobotFrames frames_;
  NewestStamp odometries_;
  std::optional<double> odometry_came_s_;
  ScanPoints scan_;
  double placed_s_ = -1.0;          ///< time of the scan that was returned last
  std::optional<double> stands_s_;  ///< since when it stands before something
  Vec2 stands_at_;
  std::unique_ptr<Topics> topics_;
  Log log_;
  double began_s_ = 0.0;
  bool over_ = false;
  std::size_t command_output_;
};

}  // namespace outrider
