// WayFaults: what holds up a robot that drives from waypoint to waypoint. Somebody puts the robot elsewhere,
// its wheels stick, something is put in its way, or no way is planned.
//
// Each of the first three ends the present drive: the robot measures where it is, and stops when that jumps;
// a drive that does not go on is given up after 1 s. The obstacle is a low round post. No sensor of the robot
// sees it, so the robot touches it.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/planner_outage.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/sim/kidnapping.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

struct WayFaults {
  Kidnapping kidnapping;       ///< shorter than asked for if the robot would stand in something
  double stuck_from_s = 1e9;   ///< from then on the wheels do not turn
  double stuck_for_s = 1e9;    ///< for how long
  double blocked_at_s = 1e9;   ///< from then on a post stands in the middle of the present or next straight
  double blocked_for_s = 1e9;  ///< for how long
  double blocked_radius_m = 0.2;  ///< radius of the post
  std::optional<Vec2> blocked_place =
      {};  ///< where the post stands, once the robot is off it; empty: see above

  PlannerOutage planner = {};  ///< none by default

  /// Returns true if any fault was asked for.
  [[nodiscard]] bool any() const;
};
std::vector<Option> describe(WayFaults& faults);

/// A straight leg on level ground.
struct StraightLeg {
  Segment line;
  double begin_s = 0.0;  ///< time at which the robot sets off
  double total_s = 0.0;  ///< time that the leg takes
};

/// Carries out WayFaults.
class Hindrance {
 public:
  /// The ground must outlive it.
  Hindrance(const WayFaults& faults, const RobotModel& robot, const CollisionMap& ground)
      : faults_(faults), robot_(robot), ground_(&ground) {}

  /// Returns the time at which a turn in place ends before its end, if it does.
  [[nodiscard]] std::optional<double> cuts_turn(double begin_s, double end_s) const;
  /// Returns how long after it began a leg ends before its end, s, if it does. Puts the post on the leg if
  /// its time has come. A robot that was put elsewhere may meet obstacles of the map too, which stop it.
  std::optional<double> cuts_leg(const StraightLeg& leg);
  /// Returns the time for which a robot stands before it gives up a drive that was cut at that time, s.
  [[nodiscard]] double gives_up_after_s(double time_s) const;
  /// Returns where somebody puts the robot, once, when the time has come.
  std::optional<Pose2> put_elsewhere(const Pose2& pose, double time_s);

  [[nodiscard]] std::size_t cut_drives() const { return cuts_; }  ///< number of drives that were cut
  void note_cut() { ++cuts_; }
  [[nodiscard]] std::size_t contacts() const { return contacts_; }  ///< with the map
  [[nodiscard]] std::size_t post_contacts() const { return post_contacts_; }
  [[nodiscard]] bool kidnapped() const { return kidnapped_; }

 private:
  [[nodiscard]] double next_event_s(double begin_s) const;
  void put_post(const StraightLeg& leg);
  [[nodiscard]] bool post_stands(double time_s) const;
  [[nodiscard]] double way_to_post_m(const Segment& line) const;
  [[nodiscard]] double way_to_wall_m(const Segment& line) const;
  [[nodiscard]] double time_at_m(const StraightLeg& leg, double way_m) const;
  [[nodiscard]] bool is_free(Vec2 place) const;

  WayFaults faults_;
  RobotModel robot_;
  const CollisionMap* ground_;
  std::optional<Vec2> post_;
  double post_s_ = 0.0;  // when it was put there
  bool kidnapped_ = false;
  std::size_t cuts_ = 0;
  std::size_t contacts_ = 0;
  std::size_t post_contacts_ = 0;
};

}  // namespace outrider
