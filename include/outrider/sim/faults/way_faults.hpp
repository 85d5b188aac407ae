// WayFaults: what holds up a robot that drives along a planned way. Somebody puts the robot elsewhere, its
// wheels stick, or something is put in its way.
//
// Each of them ends the present drive: the robot measures where it is, and stops when that jumps; a drive
// that does not go on is given up after 1 s. The obstacle is a low round post. No sensor of the robot sees
// it, so the robot touches it.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/profile.hpp"
#include "outrider/sim/faults/kidnapping.hpp"

namespace outrider {

struct WayFaults {
  Kidnapping kidnapping;       ///< shorter than asked for if the robot would stand in something
  double stuck_from_s = 1e9;   ///< from then on the wheels do not turn
  double stuck_for_s = 1e9;    ///< for how long
  double blocked_at_s = 1e9;   ///< from then on a post stands in the middle of the present or next straight
  double blocked_for_s = 1e9;  ///< for how long
  double blocked_radius_m = 0.2;  ///< radius of the post
  /// Place of the post, where it is put once the robot is off it. Unset: on the path of the robot, as above.
  std::optional<Vec2> blocked_place = {};

  /// Returns true if any fault was asked for.
  [[nodiscard]] bool any() const;
};
std::vector<Option> describe(WayFaults& faults);

/// A straight leg on level ground, driven from rest to rest.
struct HinderedLeg {
  Segment way;
  Limits limits;
  double begin_s = 0.0;       ///< time at which the robot sets off
  double total_s = 0.0;       ///< time that the leg takes
  bool may_meet_map = false;  ///< nobody has checked that it is free of what is on the map
};

/// Returns true if a disk robot may move along the segment, or stand there if both ends are the same.
using SegmentFree = std::function<bool(Segment)>;

/// Carries out WayFaults.
class Hindrance {
 public:
  /// `free` is about a disk of that radius and the map alone.
  Hindrance(const WayFaults& faults, double radius_m, SegmentFree free)
      : faults_(faults), radius_m_(radius_m), free_(std::move(free)) {}

  /// Returns the time at which a turn in place ends before its end, if it does.
  [[nodiscard]] std::optional<double> cuts_turn(double begin_s, double end_s) const;
  /// Returns how long after it began a leg ends before its end, s, if it does. Puts the post on the leg if
  /// its time has come.
  std::optional<double> cuts_leg(const HinderedLeg& leg);
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
  void put_post(const HinderedLeg& leg);
  [[nodiscard]] bool post_stands(double time_s) const;
  [[nodiscard]] double way_to_post_m(Segment leg) const;
  [[nodiscard]] double way_to_map_m(Segment leg) const;
  [[nodiscard]] double gap_m() const { return radius_m_ + faults_.blocked_radius_m; }  // centre to centre
  [[nodiscard]] bool is_free(Vec2 place) const;

  WayFaults faults_;
  double radius_m_;
  SegmentFree free_;
  std::optional<Vec2> post_;
  double post_s_ = 0.0;  // when it was put there
  bool kidnapped_ = false;
  std::size_t cuts_ = 0;
  std::size_t contacts_ = 0;
  std::size_t post_contacts_ = 0;
};

}  // namespace outrider
