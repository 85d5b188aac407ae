// The job slam: localise and map from a recorded log, or solve a pose graph.
#pragma once

#include "outrider/job/job.hpp"
#include "outrider/jobs/slam/scenario.hpp"

namespace outrider {

class SlamJob final : public JobTask {
 public:
  SlamJob();
  ~SlamJob() override;
  Outcome<Warnings> load() override;
  Status run(Run& run, const RunWatch& watch) override;

  SlamScenario scenario;

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }

 private:
  /// Takes the pose of the laser from the log, unless an option says it.
  void take_mount(const std::optional<Pose2>& robot_T_laser);

  /// Spoils the recording, if there are faults.
  Status spoil_input();
  Status map_or_localise(Run& run, const RunWatch& watch);

  /// Loads the known map, if there is one.
  Outcome<Warnings> load_map();

  struct Input;                   ///< the log, read or opened
  std::unique_ptr<Input> input_;  ///< once loaded
};

/// Returns its row in the catalogue of jobs.
Job slam_job();

}  // namespace outrider
