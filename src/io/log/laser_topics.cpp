#include "outrider/io/log/laser_topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "log/robot_log.hpp"
#include "outrider/core/text.hpp"
#include "outrider/geometry/spatial_pose.hpp"
#include "outrider/io/log/log_file.hpp"
#include "outrider/io/log/scan_mount.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

constexpr std::int64_t farthest_odometry_ns = 500'000'000;
constexpr std::size_t most_waiting_bytes = std::size_t{64} << 20U;

/// Facts about the robot from the beginning of a log.
struct Survey {
  std::string laser_frame;
  std::string base_frame;
  TransformBuffer frames;
  bool has_scan = false;
};

/// Reads the beginning of a log until the pose of the laser on the robot is known, or for a minute after the
/// first scan.
Outcome<Survey> survey_log(const std::string& path, const RobotChannels& channels,
                           const LaserTopicsOptions& options) {
  constexpr std::int64_t longest_ns = 60'000'000'000;
  auto log = RobotLog::open(path, channels, true);
  if (!log) return pass_on(log);
  Survey survey;
  survey.base_frame = options.base_frame;
  const bool in_transforms = channels.odometry_topic.empty();
  if (survey.base_frame.empty() && in_transforms) survey.base_frame = "base_link";
  std::int64_t first_scan_ns = 0;
  for (;;) {
    auto message = log->next();
    if (!message) return pass_on(message);
    if (!*message) break;
    if ((*message)->transforms != nullptr) {
      static_cast<void>(
          survey.frames.add(*(*message)->transforms, (*message)->kind));  // wrong ones do not count
    } else if ((*message)->odometry != nullptr && survey.base_frame.empty()) {
      const std::string& frame = (*message)->odometry->child_frame_id;
      survey.base_frame = frame.empty() ? "base_link" : frame;
    } else if ((*message)->scan != nullptr && !std::exchange(survey.has_scan, true)) {
      survey.laser_frame = (*message)->scan->header.frame_id;
      first_scan_ns = (*message)->time_ns;
    }
    if (!survey.has_scan || survey.base_frame.empty()) continue;
    const bool moves = !in_transforms || survey.frames.known_until_ns(options.odom_frame, survey.base_frame);
    if (moves && survey.frames.find(survey.base_frame, survey.laser_frame, first_scan_ns)) break;
    if ((*message)->time_ns - first_scan_ns > longest_ns) break;
  }
  if (survey.base_frame.empty()) survey.base_frame = "base_link";
  return survey;
}

Status check_frames(const Survey& survey, const RobotChannels& channels, const LaserTopicsOptions& options) {
  if (!survey.has_scan) return bad_input("it has no message; name another topic", channels.scan_topic);
  const bool in_transforms = channels.odometry_topic.empty();
  if (!in_transforms || survey.frames.known_until_ns(options.odom_frame, survey.base_frame)) return {};
  return bad_input(
      fmt::format("the log has no nav_msgs/Odometry, and /tf does not join '{}' and '{}'; name the frames "
                  "with --odom-frame and --base-frame",
                  excerpt(options.odom_frame), excerpt(survey.base_frame)),
      "--odom");
}

class MappedLog final : public LaserSource {
 public:
  MappedLog(std::unique_ptr<const RobotChannels> channels, RobotLog log, LaserTopicsOptions options,
            std::string base_frame, std::optional<ScanMount> mount)
      : channels_(std::move(channels)),
        log_(std::move(log)),
        options_(std::move(options)),
        base_frame_(std::move(base_frame)),
        mount_(mount) {}

  Outcome<std::optional<LaserLogStep>> next() override;
  [[nodiscard]] double progress() const override { return log_.reader().progress(); }
  [[nodiscard]] std::vector<std::string> warnings() const override;
  [[nodiscard]] std::optional<Pose2> robot_T_laser() const override {
    return mount_ ? std::optional(mount_->robot_T_laser) : std::nullopt;
  }

 private:
  struct Waiting {
    std::int64_t time_ns = 0;
    LaserScan scan;
  };

  Status receive(const RobotMessage& message);
  Status receive_scan(const RobotMessage& message);
  [[nodiscard]] bool is_due(std::int64_t time_ns) const;
  [[nodiscard]] std::optional<Pose2> odometry_at(std::int64_t time_ns) const;
  std::optional<LaserLogStep> take_first();
  [[nodiscard]] tl::unexpected<Fault> nothing_usable() const;

  std::unique_ptr<const RobotChannels> channels_;
  RobotLog log_;
  LaserTopicsOptions options_;
  std::string base_frame_;
  std::optional<ScanMount> mount_;
  OdometryTrack odometry_;
  TransformBuffer frames_;
  std::deque<Waiting> waiting_;  ///< scans whose odometry has not come yet
  std::size_t waiting_bytes_ = 0;
  std::optional<std::int64_t> last_scan_ns_;
  std::optional<Pose2> before_;  ///< odometry of the scan before
  bool ended_ = false;
  std::size_t without_odometry_ = 0;
  std::size_t unusable_ = 0;
  std::string why_unusable_;  ///< the first of them
};

Status MappedLog::receive_scan(const RobotMessage& message) {
  if (last_scan_ns_ && message.time_ns < *last_scan_ns_) {
    return bad_input(
        fmt::format("the time of the scans goes back from {:.3f} s to {:.3f} s; cut the log there",
                    seconds(*last_scan_ns_), seconds(message.time_ns)),
        channels_->scan_topic);
  }
  last_scan_ns_ = message.time_ns;
  LaserScan scan = scan_of(*message.scan, mount_ && mount_->upside_down, seconds(message.time_ns));
  if (auto usable = check(scan); !usable) {
    if (unusable_++ == 0) why_unusable_ = usable.error().sentence;
    return {};
  }
  waiting_bytes_ += sizeof(Waiting) + scan.ranges_m.size() * sizeof(float);
  waiting_.push_back({message.time_ns, std::move(scan)});
  return {};
}

Status MappedLog::receive(const RobotMessage& message) {
  if (message.scan != nullptr) return receive_scan(message);
  if (message.transforms != nullptr) {
    static_cast<void>(frames_.add(*message.transforms, message.kind));  // wrong ones do not count
    return {};
  }
  auto added = odometry_.add(message.time_ns, pose_of(message.odometry->pose.pose));
  if (!added) return bad_input(std::move(added.error().sentence), channels_->odometry_topic);
  return {};
}

/// Returns true if the pose at this time cannot become better known.
bool MappedLog::is_due(std::int64_t time_ns) const {
  if (ended_ || waiting_bytes_ > most_waiting_bytes) return true;
  if (!channels_->odometry_topic.empty()) return !odometry_.empty() && odometry_.last_ns() >= time_ns;
  const auto known_ns = frames_.known_until_ns(options_.odom_frame, base_frame_);
  return known_ns && *known_ns >= time_ns;
}

std::optional<Pose2> MappedLog::odometry_at(std::int64_t time_ns) const {
  const auto is_near = [&](std::int64_t first_ns, std::int64_t last_ns) {
    return time_ns - last_ns <= farthest_odometry_ns && first_ns - time_ns <= farthest_odometry_ns;
  };
  if (!channels_->odometry_topic.empty()) {
    if (odometry_.empty() || !is_near(odometry_.first_ns(), odometry_.last_ns())) return std::nullopt;
    return odometry_.at(time_ns);
  }
  const auto from_ns = frames_.known_from_ns(options_.odom_frame, base_frame_);
  const auto to_ns = frames_.known_until_ns(options_.odom_frame, base_frame_);
  if (!from_ns || !is_near(std::max(*from_ns, std::int64_t{0}), *to_ns)) return std::nullopt;
  return plan_pose(*frames_.find(options_.odom_frame, base_frame_, time_ns));
}

/// Takes the first scan that waits; nothing if it has no odometry.
std::optional<LaserLogStep> MappedLog::take_first() {
  Waiting first = std::move(waiting_.front());
  waiting_.pop_front();
  waiting_bytes_ -= sizeof(Waiting) + first.scan.ranges_m.size() * sizeof(float);
  const auto odometry = odometry_at(first.time_ns);
  if (!odometry) {
    ++without_odometry_;
    return std::nullopt;
  }
  const Pose2 before = std::exchange(before_, odometry).value_or(*odometry);
  return LaserLogStep{wrap_heading(relative_pose(before, *odometry)), std::move(first.scan)};
}

tl::unexpected<Fault> MappedLog::nothing_usable() const {
  if (unusable_ > 0) return bad_input(why_unusable_, channels_->scan_topic);
  const std::string from = channels_->odometry_topic.empty() ? "/tf" : printable(channels_->odometry_topic);
  return bad_input(fmt::format("none of its {} scans has odometry of {} within {} s", without_odometry_, from,
                               short_number(seconds(farthest_odometry_ns))),
                   channels_->scan_topic);
}

Outcome<std::optional<LaserLogStep>> MappedLog::next() {
  for (;;) {
    while (!waiting_.empty() && is_due(waiting_.front().time_ns)) {
      if (auto step = take_first()) return step;
    }
    if (ended_ && !before_) return nothing_usable();
    if (ended_) return std::optional<LaserLogStep>{};
    auto message = log_.next();
    if (!message) return pass_on(message);
    ended_ = !*message;
    if (ended_) continue;
    if (auto ok = receive(**message); !ok) return pass_on(ok);
  }
}

std::vector<std::string> MappedLog::warnings() const {
  std::vector<std::string> all;
  if (const std::string cut = log_.reader().cut_short(); !cut.empty()) all.push_back(cut);
  if (!mount_) {
    all.push_back(
        fmt::format("the log does not say where the laser of {} stands on '{}'; laser_x, laser_y and "
                    "laser_heading say it",
                    excerpt(channels_->scan_topic), excerpt(base_frame_)));
  }
  if (without_odometry_ > 0)
    all.push_back(fmt::format("{} scans without odometry were left out", without_odometry_));
  if (unusable_ > 0) all.push_back(fmt::format("{} scans were left out: {}", unusable_, why_unusable_));
  return all;
}

}  // namespace

std::vector<Option> describe(LaserTopicsOptions& options) {
  return {
      {"scan", "", 0, 0, "topic of the scans in a log of ROS; needed if it has several", &options.scan},
      {"odom", "", 0, 0, "topic of the odometry in a log of ROS; needed if it has several", &options.odom},
      {"odom_frame", "", 0, 0, "frame in which /tf moves the robot, if there is no topic with odometry",
       &options.odom_frame},
      {"base_frame", "", 0, 0, "frame of the robot; empty: that of the odometry, or base_link",
       &options.base_frame}};
}

Outcome<std::unique_ptr<LaserSource>> open_laser_topics(const std::string& path,
                                                        const LaserTopicsOptions& options) {
  auto contents = open_log_file(path);
  if (!contents) return pass_on(contents);
  auto found = find_robot_channels((*contents)->channels(), options);
  if (!found) {
    const std::string cut = (*contents)->cut_short();  // the topic may be in the part that is missing
    if (!cut.empty()) found.error().sentence += "; " + cut;
    return pass_on(found);
  }
  contents->reset();
  auto channels = std::make_unique<const RobotChannels>(std::move(*found));
  auto survey = survey_log(path, *channels, options);
  if (!survey) return pass_on(survey);
  if (auto ok = check_frames(*survey, *channels, options); !ok) return pass_on(ok);
  std::optional<ScanMount> mount;
  if (const auto pose = survey->frames.find(survey->base_frame, survey->laser_frame, 0)) {
    auto level = scan_mount(*pose);
    if (!level) return bad_input(std::move(level.error().sentence), channels->scan_topic);
    mount = *level;
  }
  auto log = RobotLog::open(path, *channels, channels->odometry_topic.empty());
  if (!log) return pass_on(log);
  return std::make_unique<MappedLog>(std::move(channels), std::move(*log), options, survey->base_frame,
                                     mount);
}

}  // namespace outrider
