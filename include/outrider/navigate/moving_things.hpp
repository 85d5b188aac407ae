// MovingThings: who moves around a robot, from scans: disks with velocities.
//
// Neighbouring beams that end close to each other make a cluster; one that is no wider than a person with a
// cart is followed by a Kalman filter with constant velocity and the white noise of an acceleration. It moves
// if it is faster than 0.25 m/s beyond doubt, and if beams of the last seconds passed where most of it is
// now: so nothing moves only because a robot that drives sees ever other parts of it. Who walks straight away
// from the robot counts as standing. What has come to a place that beams passed counts too, with no velocity,
// until it has stood there for two seconds. What moves and is hidden, or behind the robot where its laser
// does not look, is followed for two seconds more. Source: Bar-Shalom, Li and Kirubarajan, Estimation with
// applications to tracking and navigation (2001), ch. 6.
//
// Frames: the world of the live map. Thread rule: one at a time. O(beams + clusters * (tracks + scans that
// are remembered)) for a scan.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

/// A disk that moves.
struct MovingThing {
  Vec2 place;     ///< the middle, at the time of the observation
  Vec2 velocity;  ///< m/s
  double radius_m = 0.0;
  double sigma_mps = 0.0;  ///< standard deviation of the velocity along each axis

  /// Returns where it will be after a time, if it goes on so.
  [[nodiscard]] Vec2 place_after(double duration_s) const { return place + duration_s * velocity; }
};

class MovingThings {
 public:
  void note(const LaserScan& scan, const Pose2& world_T_laser);
  /// Returns those that move, at a time not before that of the last scan.
  [[nodiscard]] std::vector<MovingThing> at(double time_s) const;
  /// Returns a scan without the readings of what moves: they say nothing about where the robot is.
  [[nodiscard]] LaserScan without(const LaserScan& scan, const Pose2& world_T_laser) const;
  /// Forgets all, as after the pose was corrected.
  void clear() { *this = {}; }

 private:
  struct Cluster {
    Vec2 place;
    double radius_m = 0.0;
    double standing = 0.0;  ///< share of its points where no beam passed before
    bool taken = false;
  };
  struct Track {
    Vec2 place, velocity;
    double radius_m = 0.0;
    double place_variance = 0.0, covariance = 0.0, velocity_variance = 0.0;  ///< the same for each axis
    double standing = 0.0;  ///< mean share of the last clusters
    double seen_s = 0.0;
    int sightings = 1;
    bool moves = false;

    void predict(double duration_s);
    void update(const Cluster& seen, double time_s);
    void judge();
    [[nodiscard]] bool is_new() const;
    [[nodiscard]] bool counts() const { return moves || is_new(); }
  };

  /// A scan of the last seconds.
  struct Look {
    LaserScan scan;
    Pose2 world_T_laser;

    [[nodiscard]] bool passed(Vec2 place) const;
  };

  [[nodiscard]] std::vector<Cluster> clusters(const LaserScan& scan, const Pose2& world_T_laser) const;
  [[nodiscard]] bool was_passed(Vec2 place, double time_s, std::size_t stride) const;
  [[nodiscard]] double standing(std::span<const Vec2> points, double time_s) const;
  void add_cluster(std::span<const Vec2> points, double time_s, std::vector<Cluster>& found) const;
  [[nodiscard]] std::optional<std::size_t> owner_of(Vec2 point) const;
  void add_clusters(std::span<const Vec2> points, double time_s, std::vector<Cluster>& found) const;
  [[nodiscard]] bool is_seen_as_another(const Track& track) const;
  void remember(const LaserScan& scan, const Pose2& world_T_laser);
  void associate(std::vector<Cluster>& seen, double time_s);

  std::deque<Look> looks_;  // oldest first
  std::vector<Track> tracks_;
  double time_s_ = 0.0;
};

}  // namespace outrider
