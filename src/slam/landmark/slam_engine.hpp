// The interface of landmark SLAM engines, and their common parts: candidates, and the detection of a lost
// robot.
#pragma once

#include <span>

#include "archive.hpp"
#include "outrider/slam/landmark/landmark_slam.hpp"

namespace outrider {

class SlamEngine {
 public:
  virtual ~SlamEngine() = default;
  virtual StepOutcome advance(const LogStep& step) = 0;
  virtual void settle() {}
  [[nodiscard]] virtual Pose2 pose() const = 0;
  [[nodiscard]] virtual Eigen::Matrix3d pose_covariance() const = 0;
  [[nodiscard]] virtual LandmarkMap landmarks() const = 0;
  [[nodiscard]] virtual std::vector<Pose2> trajectory() const = 0;
  [[nodiscard]] virtual double cost() const = 0;
  [[nodiscard]] virtual std::int64_t degrees_of_freedom() const = 0;
  [[nodiscard]] virtual const LandmarkSlamOptions& options() const = 0;
  virtual void save(StateWriter& writer) const = 0;
};

std::unique_ptr<SlamEngine> make_filter_engine(const LandmarkSlamOptions& options, const Pose2& start);
std::unique_ptr<SlamEngine> make_graph_engine(const LandmarkSlamOptions& options, const Pose2& start);
/// Restores an engine; returns null if the state is damaged.
std::unique_ptr<SlamEngine> load_filter_engine(const LandmarkSlamOptions& options, StateReader& reader);
std::unique_ptr<SlamEngine> load_graph_engine(const LandmarkSlamOptions& options, StateReader& reader);

/// Counters of a landmark in the map.
struct LandmarkRecord {
  std::int64_t id = 0;
  std::int64_t sightings = 0;
  std::int64_t refused = 0;  ///< consecutive refusals while others were used
  std::int64_t missed = 0;   ///< consecutive misses where it should have been seen

  template <class Archive>
  void exchange(Archive& archive) {
    archive(id, sightings, refused, missed);
  }
};

/// A landmark that is not in the map yet.
struct Candidate {
  std::int64_t id = -1;             ///< -1 if ids are unknown
  Vec2 position;                    ///< last sighted position in the world
  std::vector<std::int64_t> steps;  ///< steps of its sightings
  std::vector<LandmarkSighting> sightings;

  template <class Archive>
  void exchange(Archive& archive) {
    archive(id, position.x, position.y, steps, sightings);
  }
};

/// The candidates, and the number of steps in which nothing fitted.
struct Memory {
  std::vector<Candidate> candidates;
  std::int64_t step = 0;  ///< number of the present step; the first is 1
  std::int64_t misfits = 0;
  std::int64_t next_id = 0;  ///< id of the next landmark without one

  [[nodiscard]] bool lost(const LandmarkSlamOptions& options) const { return misfits >= options.lost_after; }

  /// Adds a sighting to its candidate, or to a new one. If the candidate then has enough sightings, removes
  /// and returns it.
  std::optional<Candidate> remember(const LandmarkSighting& sighting, Vec2 world,
                                    const LandmarkSlamOptions& options);

  template <class Archive>
  void exchange(Archive& archive) {
    archive(candidates, step, misfits, next_id);
  }
};

/// Counts consecutive steps in which no sighting of the map fitted.
void note_fit(Memory& memory, const StepOutcome& outcome);

/// Returns true if a landmark at that position in the robot frame is well within range and field of view.
bool has_to_be_seen(Vec2 in_robot_frame, const LandmarkSlamOptions& options);

}  // namespace outrider
