#include "outrider/ballistics/contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace outrider {
namespace {

constexpr double clearance_tolerance_m = 1e-4;

/// Returns a part of [from, until] outside of which the flight is not in the box grown by `by`.
std::optional<Interval> passage(const Flight& flight, const Box3& box, double by, double from, double until) {
  if (flight.in_air) {
    const Vec3 reach{by, by, by};
    const auto part = flight.in_air->passage({box.low - reach, box.high + reach}, from, until);
    return part ? std::optional(Interval{part->first, part->second}) : std::nullopt;
  }
  const auto slab = [&](double p, double v, double low, double high) {
    if (v == 0.0) return p >= low && p <= high;
    const double t0 = (low - p) / v;
    const double t1 = (high - p) / v;
    from = std::max(from, std::min(t0, t1));
    until = std::min(until, std::max(t0, t1));
    return from <= until;
  };
  if (!slab(flight.muzzle.x, flight.velocity_mps.x, box.low.x - by, box.high.x + by)) return {};
  if (!slab(flight.muzzle.y, flight.velocity_mps.y, box.low.y - by, box.high.y + by)) return {};
  // Height is concave in time: its least value over the passage is at one end.
  const double lowest = std::min(flight.position(from).z, flight.position(until).z);
  if (lowest > box.high.z + by) return {};
  const double apex = std::clamp(flight.velocity_mps.z / flight.gravity_mps2, from, until);
  if (flight.position(apex).z < box.low.z - by) return {};
  return Interval{from, until};
}

/// Returns the longest time in which a ball of that speed and at most that acceleration cannot travel
/// `distance`.
double safe_step(double distance, double speed, double acceleration) {
  return 2.0 * distance / (speed + std::sqrt(speed * speed + 2.0 * acceleration * distance));
}

/// The time at which a ball is nearest to something. `distance_to` tells how far away that is from a place.
template <class DistanceTo>
struct Approach {
  const Flight& flight;
  const DistanceTo& distance_to;
  double distance_m;  ///< least so far
  double time_s;

  /// Returns the distance at that time.
  double visit(double t) {
    const double d = distance_to(flight.position(t));
    if (d < distance_m) {
      distance_m = d;
      time_s = t;
    }
    return d;
  }
  /// Refines [t0, t1] while it may hold a smaller distance than the best known.
  void search(double t0, double t1) {
    double speed = std::max(norm(flight.velocity(t0)), norm(flight.velocity(t1)));
    if (flight.in_air) speed += 0.5 * flight.most_acceleration() * (t1 - t0);  // no convex function of time
    const double middle = 0.5 * (t0 + t1);
    const double here_m = visit(middle);
    const double reach = 0.5 * speed * (t1 - t0);
    if (here_m - reach >= distance_m - clearance_tolerance_m) return;
    search(t0, middle);
    search(middle, t1);
  }
};

template <class DistanceTo>
std::optional<double> first_touch(const Flight& flight, double ball_radius_m, const DistanceTo& distance_to,
                                  double from_s, double until_s) {
  double t = from_s;
  while (t <= until_s) {
    const double gap = distance_to(flight.position(t)) - ball_radius_m;
    if (gap <= contact_tolerance_m) return t;
    t += safe_step(gap, norm(flight.velocity(t)), flight.most_acceleration());
  }
  return std::nullopt;
}

std::vector<Box3> boxes_of(const std::vector<Solid>& solids) {
  std::vector<Box3> boxes;
  boxes.reserve(solids.size());
  for (const Solid& solid : solids) boxes.push_back(bounds(solid));
  return boxes;
}

/// The solids whose boxes the flight may come as near to, in their order.
std::vector<std::uint32_t> passed(const BoxTree& tree, const Flight& flight, double by_m, double until_s) {
  return tree.near([&](const Box3& box) { return passage(flight, box, by_m, 0.0, until_s).has_value(); });
}

}  // namespace

double fall_time(const Flight& flight, double height_m) {
  if (flight.in_air) return flight.in_air->fall_time(height_m);
  const double rise = flight.velocity_mps.z;
  const double above = flight.muzzle.z - height_m;
  const double discriminant = rise * rise + 2.0 * flight.gravity_mps2 * above;
  if (discriminant <= 0.0) return 0.0;
  return std::max(0.0, (rise + std::sqrt(discriminant)) / flight.gravity_mps2);
}

std::optional<double> contact_time(const Flight& flight, double ball_radius_m, const Solid& solid,
                                   double from_s, double until_s) {
  const auto distance_to = [&](Vec3 p) { return distance(p, solid); };
  return first_touch(flight, ball_radius_m, distance_to, from_s, until_s);
}

bool touches(const Flight& flight, double ball_radius_m, const Solid& solid, double from_s, double until_s) {
  if (from_s > until_s) return false;
  const double middle = 0.5 * (from_s + until_s);
  const double gap = distance(flight.position(middle), solid) - ball_radius_m;
  if (gap <= contact_tolerance_m) return true;
  // The bound holds backwards as well: the reversed flight has the same speed and the same acceleration.
  const double clear = safe_step(gap, norm(flight.velocity(middle)), flight.most_acceleration());
  return touches(flight, ball_radius_m, solid, from_s, middle - clear) ||
         touches(flight, ball_radius_m, solid, middle + clear, until_s);
}

FlightSpace::FlightSpace(std::vector<Solid> solids)
    : solids_(std::move(solids)), boxes_(boxes_of(solids_)), tree_(boxes_) {
  for (const Solid& solid : solids_) {
    const auto* mesh = std::get_if<MeshShape>(&solid.shape);
    meshes_.push_back(mesh == nullptr ? std::nullopt : std::optional<MeshTree>(*mesh));
  }
}

double FlightSpace::distance_to(std::size_t solid, Vec3 p) const {
  const std::optional<MeshTree>& mesh = meshes_[solid];
  return mesh ? mesh->distance(solids_[solid].world_T_solid.to_local(p)) : distance(p, solids_[solid]);
}

std::optional<Contact> FlightSpace::first_contact(const Flight& flight, double ball_radius_m,
                                                  double until_s) const {
  std::optional<Contact> first;
  for (const std::uint32_t i : passed(tree_, flight, ball_radius_m + contact_tolerance_m, until_s)) {
    const auto near = passage(flight, boxes_[i], ball_radius_m + contact_tolerance_m, 0.0, until_s);
    if (!near) continue;
    const auto apart = [&](Vec3 p) { return distance_to(i, p); };
    const auto time = first_touch(flight, ball_radius_m, apart, near->low, near->high);
    if (!time || (first && *time >= first->time_s)) continue;
    first = Contact{*time, i, flight.position(*time)};
    until_s = *time;
  }
  return first;
}

Clearance FlightSpace::clearance(const Flight& flight, double ball_radius_m, double until_s,
                                 double most_m) const {
  Clearance least{most_m, 0.0, 0};
  for (const std::uint32_t i : passed(tree_, flight, most_m + ball_radius_m, until_s)) {
    const auto near = passage(flight, boxes_[i], least.distance_m + ball_radius_m, 0.0, until_s);
    if (!near) continue;
    const auto apart = [&](Vec3 p) { return distance_to(i, p); };
    Approach<decltype(apart)> approach{flight, apart, least.distance_m + ball_radius_m, near->low};
    approach.visit(near->low);
    approach.visit(near->high);
    approach.search(near->low, near->high);
    const double gap = std::max(0.0, approach.distance_m - ball_radius_m);
    if (gap < least.distance_m) least = {gap, approach.time_s, i};
  }
  return least;
}

}  // namespace outrider
