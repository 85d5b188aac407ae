#include "slam_log.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "outrider/job/sensor_log.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

constexpr double step_s = 0.1;
constexpr double least_going_on = 0.9;  // fraction of the steps of a recording whose times are used
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<double> run_times(const std::vector<double>& recorded_s) {
  std::vector<double> times;
  if (recorded_s.empty()) return times;
  double latest_s = recorded_s.front();
  std::size_t going_on = 0;
  for (const double time_s : recorded_s) {
    going_on += time_s > latest_s ? 1 : 0;
    latest_s = std::max(latest_s, time_s);
    times.push_back(latest_s - recorded_s.front());
  }
  const double steps = static_cast<double>(times.size() - 1);
  if (std::isfinite(times.back()) && static_cast<double>(going_on) >= least_going_on * steps) return times;
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = step_s * static_cast<double>(i);
  return times;
}

std::string name_of(const SlamScenario& scenario) {
  std::filesystem::path path(scenario.log);
  if (!path.has_filename()) path = path.parent_path();  // a folder with a slash at its end
  const std::string name = path.filename().string();
  return name.substr(0, name.find('.'));
}

void set_place(outrider_msgs::Landmark& landmark, Vec2 position, const Eigen::Matrix2d& covariance) {
  landmark.position = point_of(position);
  landmark.sigma_x = std::sqrt(std::max(0.0, covariance(0, 0)));
  landmark.sigma_y = std::sqrt(std::max(0.0, covariance(1, 1)));
  const double product = landmark.sigma_x * landmark.sigma_y;
  landmark.correlation = product > 0.0 ? std::clamp(covariance(0, 1) / product, -1.0, 1.0) : 0.0;
  landmark.truth = {unknown, unknown};
}

void log_trajectory(Log& log, std::string_view topic, double time_s, const std::vector<double>& times_s,
                    const std::vector<Pose2>& poses) {
  nav_msgs::Path path = path_of(times_s, poses);
  path.header = header_of(log.time_of(time_s), "map");
  log.append(topic, time_s, std::move(path));
}

SlamLog::SlamLog(Log& log, const SlamScenario& scenario, const std::string& engine) : log_(log) {
  info_.job = "slam";
  info_.engine = engine;
  info_.world = name_of(scenario);
  info_.low = info_.high = {unknown, unknown};
  info_.robot_radius = unknown;
  log.append(topic::run, 0.0, info_);
}

void SlamLog::note(const Step& step) {
  times_s_.push_back(step.time_s);
  end_s_ = step.time_s;
  log_belief(log_, step.time_s, step.pose, step.covariance, step.recognised);
  log_odometry(log_, step.time_s, step.odometry);
}

double length_of(const std::vector<Pose2>& poses) {
  double way_m = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) way_m += distance(poses[i - 1].position, poses[i].position);
  return way_m;
}

double SlamLog::settle(const std::vector<Pose2>& poses, const std::vector<Vec2>& reference, Box2 others) {
  const auto count = static_cast<std::ptrdiff_t>(std::min(times_s_.size(), poses.size()));
  settle_at({times_s_.begin(), times_s_.begin() + count}, poses, reference, others);
  return length_of(poses);
}

void SlamLog::settle_at(const std::vector<double>& times_s, const std::vector<Pose2>& poses,
                        const std::vector<Vec2>& reference, Box2 box) {
  for (const Pose2& pose : poses) box.include(pose.position);
  for (const Vec2 place : reference) box.include(place);
  log_trajectory(log_, topic::trajectory, end_s(), times_s, poses);
  if (!reference.empty()) log_.append(topic::reference, end_s(), path_of(log_.time_of(end_s()), reference));
  if (!box.empty()) box = box.grown(0.5 + 0.01 * norm(box.size()));
  info_.low = point_of(box.low);
  info_.high = point_of(box.high);
  log_.append(topic::run, end_s(), info_);
}

}  // namespace outrider
