// SlamLog: what the job slam logs while it maps a recording.
//
// Each step of the recording gives a belief and the pose by odometry alone. settle() logs the final path and
// a reference. Thread rule: one at a time.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/jobs/slam/scenario.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/messages/mapping_messages.hpp"

namespace outrider {

/// Returns the time of each step since the first one, s. A time that goes back counts as the one before. A
/// recording without times, or whose times increase in fewer than nine of ten steps, gets 0.1 s for each
/// step. O(steps).
std::vector<double> run_times(const std::vector<double>& recorded_s);

/// Returns the name of the recording.
std::string name_of(const SlamScenario& scenario);

/// Sets the position and the uncertainty of a landmark from the covariance of its position.
void set_place(outrider_msgs::Landmark& landmark, Vec2 position, const Eigen::Matrix2d& covariance);

/// Logs a path of poses with their own times; `times_s` is as long as `poses`.
void log_trajectory(Log& log, std::string_view topic, double time_s, const std::vector<double>& times_s,
                    const std::vector<Pose2>& poses);

/// Returns the length of the way through the poses, m.
double length_of(const std::vector<Pose2>& poses);

class SlamLog {
 public:
  /// Logs what is mapped. `engine` is "laser", "pose_graph" or the engine of landmark maps.
  SlamLog(Log& log, const SlamScenario& scenario, const std::string& engine);

  /// One step of the recording as it was believed at that time.
  struct Step {
    double time_s = 0.0;
    Pose2 pose;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y and heading: m^2, m rad, rad^2
    Pose2 odometry;                                        ///< pose by odometry alone
    bool recognised = false;                               ///< a known landmark or place corrected the belief
  };
  void note(const Step& step);
  /// Passes a step that is not logged; only its time counts, as the end of the run.
  void pass(double time_s) { end_s_ = time_s; }

  /// Logs the final path, with one pose for each step noted, and a reference in the same frame, which may be
  /// empty. Logs the bounds of everything, `others` included. Returns the length of the path, m.
  double settle(const std::vector<Pose2>& poses, const std::vector<Vec2>& reference, Box2 others = {});
  /// The same with the times of the poses, which need not be those of the steps noted.
  void settle_at(const std::vector<double>& times_s, const std::vector<Pose2>& poses,
                 const std::vector<Vec2>& reference, Box2 others);

  [[nodiscard]] double end_s() const { return end_s_; }
  [[nodiscard]] Log& log() { return log_; }

 private:
  Log& log_;
  outrider_msgs::RunInfo info_;
  std::vector<double> times_s_;  ///< of the steps noted
  double end_s_ = 0.0;
};

}  // namespace outrider
