// A simulated robot on wheels with a camera: moves as wheel_motion.hpp says, and sees tags at the rate of its
// camera, in rendered images or by the model of tag_model.hpp.
#pragma once

#include <memory>

#include "outrider/jobs/drive/mission.hpp"
#include "outrider/sim/tag_camera.hpp"
#include "outrider/sim/wheel_motion.hpp"
#include "outrider/world/ground.hpp"

namespace outrider {

class SimulatedDrive final : public WheeledRobot {
 public:
  /// The references must outlive the robot.
  SimulatedDrive(const DriveTask& task, const DriveTruth& truth, bool rendered, std::uint64_t seed);

  DriveObservation sense() override;
  void act(const DriveCommand& command) override;

  [[nodiscard]] const WheelMotion& motion() const { return motion_; }
  [[nodiscard]] std::int64_t images() const { return images_; }  ///< taken so far

 private:
  void look();

  const DriveTask& task_;
  const DriveTruth& truth_;
  WheelMotion motion_;
  Ground sight_lines_;                 // what stands at the height of the camera
  std::unique_ptr<TagCamera> camera_;  // where images are rendered
  Rng sight_rng_;
  std::int64_t images_ = 0;
  bool kidnapped_ = false;
  DriveObservation seen_;
};

}  // namespace outrider
