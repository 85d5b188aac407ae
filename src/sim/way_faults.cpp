#include "outrider/sim/way_faults.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/motion/profile.hpp"

namespace outrider {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double never_s = 1e9;     ///< default of a time: it never comes
constexpr double patience_s = 1.0;  ///< after which a drive that does not go on is given up
constexpr double room_m = 0.1;      ///< least gap between the post and either end of the robot's leg
constexpr double touch_m = 1e-9;
constexpr int halvings = 40;

}  // namespace

bool WayFaults::any() const {
  return kidnapping.at_s < never_s || stuck_from_s < never_s || blocked_at_s < never_s || planner.any();
}

std::vector<Option> describe(WayFaults& faults) {
  std::vector<Option> options = describe(faults.kidnapping);
  const std::vector<Option> rest = {
      {"stuck_from", "s", 0.0, 1e9, "from then on the wheels do not turn", &faults.stuck_from_s},
      {"stuck_for", "s", 0.0, 1e9, "for how long", &faults.stuck_for_s},
      {"blocked_at", "s", 0.0, 1e9,
       "when a low post that nothing sees is put in the middle of the straight that is driven or comes next",
       &faults.blocked_at_s},
      {"blocked_for", "s", 0.0, 1e9, "for how long it stands there", &faults.blocked_for_s},
      {"blocked_radius", "m", 0.01, 10.0, "radius of the post", &faults.blocked_radius_m},
  };
  for (const std::vector<Option>& more : {rest, describe(faults.planner)})
    options.insert(options.end(), more.begin(), more.end());
  return options;
}

/// Returns the time of the first event from then on that ends a motion wherever the robot is.
double Hindrance::next_event_s(double begin_s) const {
  double next_s = never;
  if (!kidnapped_ && faults_.kidnapping.at_s < never_s) next_s = std::max(begin_s, faults_.kidnapping.at_s);
  if (begin_s < faults_.stuck_from_s + faults_.stuck_for_s)
    next_s = std::min(next_s, std::max(begin_s, faults_.stuck_from_s));
  return next_s;
}

std::optional<double> Hindrance::cuts_turn(double begin_s, double end_s) const {
  const double next_s = next_event_s(begin_s);
  return next_s < end_s ? std::optional(next_s) : std::nullopt;
}

std::optional<double> Hindrance::cuts_leg(const StraightLeg& leg) {
  put_post(leg);
  double cut_s = next_event_s(leg.begin_s) - leg.begin_s;
  const auto stops_at = [&](double way_m, std::size_t& count) {
    const double after_s = way_m < never ? time_at_m(leg, way_m) : never;
    if (after_s >= std::min(cut_s, leg.total_s)) return;
    cut_s = after_s;
    ++count;
  };
  if (kidnapped_) stops_at(way_to_wall_m(leg.line), contacts_);
  if (const double way_m = way_to_post_m(leg.line); way_m < never) {
    const double there_s = leg.begin_s + time_at_m(leg, way_m);
    if (post_stands(there_s)) stops_at(way_m, post_contacts_);
  }
  return cut_s < leg.total_s ? std::optional(cut_s) : std::nullopt;
}

double Hindrance::gives_up_after_s(double time_s) const {
  return !kidnapped_ && time_s >= faults_.kidnapping.at_s ? 0.0 : patience_s;
}

std::optional<Pose2> Hindrance::put_elsewhere(const Pose2& pose, double time_s) {
  if (kidnapped_ || time_s < faults_.kidnapping.at_s) return std::nullopt;
  kidnapped_ = true;
  Pose2 there = compose(pose, {{0.0, faults_.kidnapping.by_m}, faults_.kidnapping.by_rad});
  for (int i = 0; i < halvings && !is_free(there.position); ++i)
    there.position = 0.5 * (pose.position + there.position);
  if (!is_free(there.position)) there.position = pose.position;
  return Pose2{there.position, wrap_angle(there.heading_rad)};
}

bool Hindrance::is_free(Vec2 place) const {
  const double gap_m = robot_.radius_m + faults_.blocked_radius_m;
  return (!post_ || distance(place, *post_) >= gap_m) &&
         ground_->segment_free({place, place}, robot_.radius_m);
}

void Hindrance::put_post(const StraightLeg& leg) {
  if (post_ || leg.begin_s + leg.total_s <= faults_.blocked_at_s) return;
  const double length_m = distance(leg.line.a, leg.line.b);
  const double after_s = std::max(0.0, faults_.blocked_at_s - leg.begin_s);
  const double from_m = covered(length_m, robot_.straight(), after_s);
  const double least_m = robot_.radius_m + faults_.blocked_radius_m + room_m;
  const auto on_leg = [&](double way_m) {
    return length_m > 0.0 ? leg.line.a + way_m / length_m * (leg.line.b - leg.line.a) : leg.line.a;
  };
  const Vec2 place = faults_.blocked_place.value_or(on_leg(0.5 * (from_m + length_m)));
  if (distance(on_leg(from_m), place) < least_m) return;
  post_ = place;
  post_s_ = leg.begin_s + after_s;
}

bool Hindrance::post_stands(double time_s) const {
  return post_ && time_s >= post_s_ && time_s < post_s_ + faults_.blocked_for_s;
}

/// Returns the way along the line to the contact with the post; infinite if the robot passes by it or drives
/// away from it.
double Hindrance::way_to_post_m(const Segment& line) const {
  if (!post_) return never;
  const double length_m = distance(line.a, line.b);
  const Vec2 along = 1.0 / length_m * (line.b - line.a);
  const double ahead_m = dot(*post_ - line.a, along);
  const double aside_m = cross(*post_ - line.a, along);
  const double gap_m = robot_.radius_m + faults_.blocked_radius_m;
  const double half2 = gap_m * gap_m - aside_m * aside_m;
  if (ahead_m <= 0.0 || half2 <= touch_m) return never;
  const double way_m = std::max(0.0, ahead_m - std::sqrt(half2));
  return way_m < length_m ? way_m : never;
}

/// Returns the way along the line to the first contact with the map; infinite if there is none.
double Hindrance::way_to_wall_m(const Segment& line) const {
  const auto free = [&](double part) {
    return ground_->segment_free({line.a, line.a + part * (line.b - line.a)}, robot_.radius_m);
  };
  if (free(1.0)) return never;
  double part = 0.0, step = 0.5;
  for (int i = 0; i < halvings; ++i, step *= 0.5) {
    if (free(part + step)) part += step;
  }
  return part * distance(line.a, line.b);
}

/// Returns the time after which a leg has covered that way. Bisection.
double Hindrance::time_at_m(const StraightLeg& leg, double way_m) const {
  const double length_m = distance(leg.line.a, leg.line.b);
  double low = 0.0, high = leg.total_s;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (covered(length_m, robot_.straight(), middle) <= way_m ? low : high) = middle;
  }
  return low;
}

}  // namespace outrider
