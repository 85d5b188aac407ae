// A simulated robot on two wheels with a range finder and a bumper, which explores a world.
//
// Every 5 ms its twist comes nearer to the commanded one, as fast as its accelerations allow, within its
// limits of speed. Its disk is swept exactly along the way of each step against all that stands between what
// its wheels climb and its top: where it would touch, it stays where it is and only turns, while its wheels
// slip and count on. A touch counts once until the robot has left what it touched. The odometry adds up the
// turns of the wheels, each with its error of scale and noise that grows with the root of the way. The laser
// looks at the first sense() at or after each turn of it, from the true pose of that moment.
//
// Same world, start, models, seed and commands: same observations. O(obstacles near) a step.
#pragma once

#include <cstdint>
#include <optional>

#include "outrider/motion/robot_model.hpp"
#include "outrider/robot/explorer.hpp"
#include "outrider/sim/range_finder.hpp"
#include "outrider/world/ground.hpp"

namespace outrider {

/// What a disk robot of that model bumps into in a world without edges.
class ExplorerGround {
 public:
  /// What rises less than `climbs_m` above the floor is in nobody's way.
  ExplorerGround(const World& world, const RobotModel& robot, double climbs_m = ExplorerWheels{}.climbs_m);

  /// Whether the disk can be swept along the segment without touching anything. Exact.
  [[nodiscard]] bool free(Segment s) const;
  /// Distance of the disk's rim from the nearest obstacle, m, negative where it overlaps; at most 1 m.
  [[nodiscard]] double gap_m(Vec2 centre) const;
  /// The box around all obstacles; empty without one.
  [[nodiscard]] const Box2& bounds() const { return bounds_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }

 private:
  double radius_m_;
  Box2 bounds_;
  Ground ground_;  // within bounds far enough from everything
};

class SimulatedExplorer final : public ExplorerRobot {
 public:
  SimulatedExplorer(const World& world, const Pose2& start, const RobotModel& robot,
                    const ExplorerTruth& truth, std::uint64_t seed);

  ExplorerObservation sense() override;
  void act(const ExplorerCommand& command) override;

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }     ///< world_T_robot; heading not wrapped
  [[nodiscard]] const Twist2& twist() const { return twist_; }  ///< now, slip left out
  [[nodiscard]] std::int64_t contacts() const { return contacts_; }
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  [[nodiscard]] const RangeFinder& laser() const { return laser_; }
  [[nodiscard]] const ExplorerGround& ground() const { return ground_; }

 private:
  void pass(double duration_s);
  void speed_up(const Twist2& wanted, double duration_s);
  void count_wheels(double duration_s);
  double counted_m(double way_m, double scale);

  RobotModel robot_;
  ExplorerWheels wheels_;
  RangeFinder laser_;
  ExplorerGround ground_;
  Rng laser_rng_;
  Rng wheel_rng_;
  double left_scale_ = 1.0;  // of the way that each wheel counts
  double right_scale_ = 1.0;
  double time_s_ = 0.0;
  Pose2 pose_;
  Twist2 twist_;
  Pose2 odometry_;
  std::int64_t turns_ = 0;  // of the laser that have been looked at
  bool touching_ = false;   // now
  bool touched_ = false;    // since the last sense()
  std::int64_t contacts_ = 0;
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
};

}  // namespace outrider
