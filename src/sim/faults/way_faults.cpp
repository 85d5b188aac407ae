#include "outrider/sim/faults/way_faults.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/motion/profile.hpp"
#include "times.hpp"

namespace outrider {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double patience_s = 1.0;  ///< after which a drive that does not go on is given up
constexpr double room_m = 0.1;      ///< least gap between the post and either end of the robot's leg
constexpr double touch_m = 1e-9;
constexpr int halvings = 40;

/// Returns the time after which a leg has covered that way. Bisection.
double time_at_m(const HinderedLeg& leg, double way_m) {
  const double length_m = distance(leg.way.a, leg.way.b);
  double low = 0.0, high = leg.total_s;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (covered(length_m, leg.limits, middle) <= way_m ? low : high) = middle;
  }
  return low;
}

}  // namespace

bool WayFaults::any() const {
  return kidnapping.at_s < never_s || stuck_from_s < never_s || blocked_at_s < never_s;
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
  options.insert(options.end(), rest.begin(), rest.end());
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

std::optional<double> Hindrance::cuts_leg(const HinderedLeg& leg) {
  put_post(leg);
  double cut_s = next_event_s(leg.begin_s) - leg.begin_s;
  const auto stops_at = [&](double way_m, std::size_t& count) {
    const double after_s = way_m < never ? time_at_m(leg, way_m) : never;
    if (after_s >= std::min(cut_s, leg.total_s)) return;
    cut_s = after_s;
    ++count;
  };
  if (leg.may_meet_map) stops_at(way_to_map_m(leg.way), contacts_);
  if (const double way_m = way_to_post_m(leg.way); way_m < never) {
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
  return (!post_ || distance(place, *post_) >= gap_m()) && free_({place, place});
}

void Hindrance::put_post(const HinderedLeg& leg) {
  if (post_ || leg.begin_s + leg.total_s <= faults_.blocked_at_s) return;
  const auto [from, to] = leg.way;
  const double length_m = distance(from, to);
  const double after_s = std::max(0.0, faults_.blocked_at_s - leg.begin_s);
  const double from_m = covered(length_m, leg.limits, after_s);
  const auto on_leg = [&](double way_m) {
    return length_m > 0.0 ? from + way_m / length_m * (to - from) : from;
  };
  const Vec2 place = faults_.blocked_place.value_or(on_leg(0.5 * (from_m + length_m)));
  if (distance(on_leg(from_m), place) < gap_m() + room_m) return;
  post_ = place;
  post_s_ = leg.begin_s + after_s;
}

bool Hindrance::post_stands(double time_s) const {
  return post_ && time_s >= post_s_ && time_s < post_s_ + faults_.blocked_for_s;
}

/// Returns the way along a leg to the contact with the post; infinite if the robot passes by it or drives
/// away from it.
double Hindrance::way_to_post_m(Segment leg) const {
  const double length_m = distance(leg.a, leg.b);
  if (!post_ || length_m == 0.0) return never;
  const Vec2 along = 1.0 / length_m * (leg.b - leg.a);
  const double ahead_m = dot(*post_ - leg.a, along), aside_m = cross(*post_ - leg.a, along);
  const double half2 = gap_m() * gap_m() - aside_m * aside_m;
  if (ahead_m <= 0.0 || half2 <= touch_m) return never;
  const double way_m = std::max(0.0, ahead_m - std::sqrt(half2));
  return way_m < length_m ? way_m : never;
}

/// Returns the way along a leg to the first contact with the map; infinite if there is none.
double Hindrance::way_to_map_m(Segment leg) const {
  const auto free = [&](double part) { return free_({leg.a, leg.a + part * (leg.b - leg.a)}); };
  if (free(1.0)) return never;
  double part = 0.0, step = 0.5;
  for (int k = 0; k < halvings; ++k, step *= 0.5) {
    if (free(part + step)) part += step;
  }
  return part * distance(leg.a, leg.b);
}

}  // namespace outrider
