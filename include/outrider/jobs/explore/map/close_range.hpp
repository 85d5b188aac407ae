// CloseRange: the surfaces right around a robot, finer than the cells of its map.
//
// It keeps the beam ends of the last scans and carries them along by odometry, which errs little over so
// short a way. surfaces() puts each of them on a parabola through its neighbours, which averages the
// noise, and drops those without neighbours. So the width of a gap is known to a few millimetres, where the
// map knows it to two cells. centre_path() moves a path to the middle of narrow places between these points.
// Pure functions of their arguments. Thread rule: const members may be called concurrently.
#pragma once

#include <deque>
#include <vector>

#include "outrider/control/nearby.hpp"
#include "outrider/control/steer.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

/// The beam ends of the last scans.
class CloseRange {
 public:
  static constexpr double reach_m = 1.2;  ///< farther points are left out

  /// Adds the ends of a scan in the frame of the robot, and where the robot was by odometry.
  void add(const Pose2& odometry, std::vector<Vec2> ends);
  /// Returns the surface points around the robot, in the world frame of `pose`, by columns and rows.
  [[nodiscard]] std::vector<Vec2> surfaces(const Pose2& odometry, const Pose2& pose) const;

 private:
  struct Ends {
    Pose2 odometry;
    std::vector<Vec2> points;
  };
  std::deque<Ends> scans_;
};

/// The room that a path leaves.
struct PathRoom {
  double least_m = 0.0;  ///< least clearance of the part looked at; infinite where there are no surfaces
  Vec2 narrowest;        ///< the first place of about that clearance
};

/// Looks at one narrow place from a distance, one after the other.
struct GapLooks {
  int count = 0;        ///< looks since another place was the narrowest
  Vec2 place;           ///< the place by the last look
  double room_m = 0.0;  ///< clearance there: the mean of the looks, of which the last eight count most

  void add(const PathRoom& room);
};

/// Returns points of a path from where the robot is on it, 3 cm apart, for so far ahead.
std::vector<Vec2> points_ahead(const PathProgress& path, double ahead_m);

/// Moves the next `ahead_m` of the path sideways to the middle between the surfaces where they are nearer
/// than `wanted_m`, and returns the room that is left there. The path then begins at the robot.
PathRoom centre_path(PathProgress& path, Vec2 position, const Nearby& surfaces, double ahead_m,
                     double wanted_m);

}  // namespace outrider
