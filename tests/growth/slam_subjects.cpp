// Landmark SLAM, as landmarks and steps grow in number.
#include <cmath>
#include <stdexcept>

#include "outrider/core/units.hpp"
#include "outrider/slam/landmark/landmark_slam.hpp"
#include "subject.hpp"
#include "work.hpp"

namespace outrider::growth {
namespace {

constexpr int seen_in_a_step = 4;

/// A step that moves by that much and sees these landmarks, with small errors.
LogStep step_of(const Pose2& before, const Pose2& after, const std::vector<Vec2>& landmarks, int first,
                int count, Rng& rng) {
  LogStep step;
  step.odometry = relative_pose(before, after);
  step.odometry.position.x += 0.001 * rng.normal();
  step.covariance = 1e-6 * Eigen::Matrix3d::Identity();
  for (int k = first; k < first + count; ++k) {
    LandmarkSighting sighting;
    sighting.id = k;
    sighting.position = relative_pose(after, {landmarks[static_cast<std::size_t>(k)], 0.0}).position +
                        Vec2{0.01 * rng.normal(), 0.01 * rng.normal()};
    sighting.covariance = 1e-4 * Eigen::Matrix2d::Identity();
    step.sightings.push_back(sighting);
  }
  return step;
}

LandmarkSlam begun(const std::string& engine) {
  LandmarkSlamOptions options;
  options.engine = engine;
  options.patience = 1;
  options.gate = 1.0;
  return std::move(LandmarkSlam::begin(options, {}).value());
}

/// One step that sees a few landmarks of a map of so many, after a step that saw all.
std::vector<double> filtered(const std::string& engine, int count) {
  Rng rng = stream("landmarks", count);
  std::vector<Vec2> landmarks;
  for (int k = 0; k < count; ++k) landmarks.push_back({rng.uniform(-20, 20), rng.uniform(-20, 20)});
  LandmarkSlam slam = begun(engine);
  const Pose2 first{{0.1, 0.0}, 0.0}, second{{0.2, 0.0}, 0.0};
  if (!slam.advance(step_of({}, first, landmarks, 0, count, rng))) throw std::runtime_error("refused");
  const LogStep step = step_of(first, second, landmarks, count / 2, seen_in_a_step, rng);
  const Work work = work_of([&] { (void)slam.advance(step).value(); });
  if (slam.landmarks().size() != static_cast<std::size_t>(count))
    throw std::runtime_error("landmarks are missing");
  return {work.blocks, work.peak_bytes};
}

/// All steps along a corridor with a landmark a step, of which the robot sees the next four.
std::vector<double> along_a_corridor(int steps) {
  Rng rng = stream("corridor", steps);
  std::vector<Vec2> landmarks;
  for (int k = 0; k < steps + seen_in_a_step; ++k) landmarks.push_back({0.5 * k, k % 2 == 0 ? 1.0 : -1.0});
  LandmarkSlam slam = begun("graph");
  const Work work = work_of([&] {
    for (int k = 0; k < steps; ++k) {
      const Pose2 before{{0.5 * k, 0.0}, 0.0}, after{{0.5 * (k + 1), 0.0}, 0.0};
      (void)slam.advance(step_of(before, after, landmarks, k, seen_in_a_step, rng)).value();
    }
  });
  return {work.blocks, work.peak_bytes};
}

}  // namespace

std::vector<Subject> slam_subjects() {
  const std::string header = "slam/landmark/landmark_slam.hpp";
  const std::vector<int> counts{16, 32, 64, 128, 256};
  return {{"ekf, one step",
           "landmarks",
           header,
           counts,
           {{"blocks", "a step quadratic in the landmarks", squared},
            {"peak bytes", "none is stated; held to the covariance", squared}},
           [](int count) { return filtered("ekf", count); }},
          {"kalman, one step",
           "landmarks",
           header,
           counts,
           {{"blocks", "a step quadratic in the landmarks", squared},
            {"peak bytes", "none is stated; held to the covariance", squared}},
           [](int count) { return filtered("kalman", count); }},
          {"graph, all steps",
           "steps along a corridor",
           header,
           {64, 128, 256, 512, 1024},
           {{"blocks", "n steps take O(n^2)", squared},
            {"peak bytes", "none is stated; held to the steps", linear}},
           along_a_corridor}};
}

}  // namespace outrider::growth
