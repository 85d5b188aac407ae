#include "in_air.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "outrider/ballistics/aim.hpp"
#include "outrider/ballistics/sight.hpp"

namespace outrider {
namespace {

constexpr double coarse = 5e-5;  // accuracy of a track: 1 mm after 1.5 s

/// The distances from the yaw axis between which flights at full speed reach a height, by pitch and bearing.
/// A slower flight has a shorter range: it reaches the height closer than the farthest distance and, if the
/// height is above the muzzle, farther away than the nearest. Between bearings, the wider interval is used,
/// with a margin.
class Reach {
 public:
  /// Omits some of the pitches once the token is stopped.
  Reach(const ShotRules& rules, const std::vector<double>& pitches, const Target& target, double height_m,
        const std::stop_token& stop = {}) {
    for (const double pitch : pitches) {
      if (stop.stop_requested()) return;
      rings_.push_back(ring(rules, pitch, target, height_m));
    }
  }

  [[nodiscard]] bool holds(std::size_t pitch, Vec2 sight) const {
    const Interval& ring = rings_[pitch][sector(sight)];
    const double range = norm(sight);
    return range >= ring.low && range <= ring.high;
  }
  [[nodiscard]] double longest() const {
    double most = 0.0;
    for (const Ring& ring : rings_) {
      for (const Interval& sector : ring) most = std::max(most, sector.high);
    }
    return most;
  }

 private:
  static constexpr std::size_t sectors = 72;
  using Ring = std::array<Interval, sectors>;

  static std::size_t sector(Vec2 sight) {
    const double turn = wrap_angle(heading_of(sight)) / (2.0 * pi);
    return static_cast<std::size_t>(std::floor((turn < 0.0 ? turn + 1.0 : turn) * sectors)) % sectors;
  }

  static Ring ring(const ShotRules& rules, double pitch, const Target& target, double height_m) {
    std::array<std::optional<std::pair<Vec2, Vec2>>, sectors> ends;  // the nearest and the farthest, by yaw
    for (std::size_t i = 0; i < sectors; ++i) {
      const Shot shot{2.0 * pi * static_cast<double>(i) / sectors, pitch, rules.gun.muzzle_speed_mps};
      const Flight flight = launch(rules, {}, target, shot, coarse);
      const AirTrack& track = *flight.in_air;
      const double top = track.top_s();
      if (track.position(top).z < height_m) continue;
      double low = 0.0;
      if (flight.muzzle.z < height_m) {
        for (double high = top; high - low > 1e-4;) {
          const double middle = 0.5 * (low + high);
          (track.position(middle).z < height_m ? low : high) = middle;
        }
      }
      ends[i] = {low > 0.0 ? xy(track.position(low)) : Vec2{}, xy(track.position(track.fall_time(height_m)))};
    }
    Ring ring;
    constexpr double inf = std::numeric_limits<double>::infinity();
    ring.fill({inf, -inf});
    for (std::size_t i = 0; i < sectors; ++i) {
      const auto& a = ends[i];
      const auto& b = ends[(i + 1) % sectors];
      if (!a || !b) continue;
      const Interval range{0.98 * std::min(norm(a->first), norm(b->first)) - 0.02,
                           1.02 * std::max(norm(a->second), norm(b->second)) + 0.02};
      // The wind may deflect two neighbours into other sectors, or sectors that are not adjacent.
      const std::size_t last = (sector(b->second) + 1) % sectors;
      for (std::size_t k = (sector(a->second) + sectors - 1) % sectors;; k = (k + 1) % sectors) {
        ring[k] = {std::min(ring[k].low, range.low), std::max(ring[k].high, range.high)};
        if (k == last) break;
      }
    }
    return ring;
  }

  std::vector<Ring> rings_;  ///< by pitch
};

/// Simulates flights at one target from place to place.
class Range {
 public:
  Range(const ShotRules& rules, const FlightSpace& space, const Target& target)
      : pitches(pitch_lattice(rules)),
        rules_(rules),
        space_(space),
        target_(target),
        box_(solid_of(target)) {}

  /// Returns the shot through an aim point. `last` is the previous result; it is used as guess and updated.
  std::optional<Aimed> aim(Vec2 position, std::size_t pitch, Vec3 point, std::optional<Aimed>& last) const {
    const Platform from{position, {}};
    auto found = last ? aim_through(rules_, from, pitches[pitch], point, &*last) : std::nullopt;
    if (!found) found = aim_through(rules_, from, pitches[pitch], point);
    if (found) last = found;
    return found;
  }

  /// Returns the solid that stops a shot before the target; nothing if the shot hits.
  std::optional<std::size_t> stopped_by(Vec2 position, const Shot& shot) {
    const Flight flight = launch(rules_, {position, {}}, target_, shot, coarse);
    const double radius = rules_.gun.ball_radius_m;
    const double end = flight.in_air->end_s();
    const double touch = contact_time(flight, radius, box_, 0.0, end).value_or(end);
    const double grown = radius + rules_.margin_m;
    const auto& solids = space_.solids();
    if (last_stop_ < solids.size() && contact_time(flight, grown, solids[last_stop_], 0.0, touch)) {
      return last_stop_;
    }
    const auto first = space_.first_contact(flight, grown, touch);
    if (!first) return std::nullopt;
    last_stop_ = first->solid;
    return last_stop_;
  }

  std::vector<double> pitches;

 private:
  const ShotRules& rules_;
  const FlightSpace& space_;
  const Target& target_;
  Solid box_;
  std::size_t last_stop_ =
      std::numeric_limits<std::size_t>::max();  ///< the solid that stopped one shot often stops the next
};

class ExhaustionInAir {
 public:
  ExhaustionInAir(const ShotRules& rules, const FlightSpace& space, const Target& target,
                  const std::stop_token& stop)
      : rules_(rules), target_(target), range_(rules, space, target), last_(range_.pitches.size()) {
    result.blocked_by.assign(space.solids().size(), 0);
    for (const double up : offsets(-0.5 * target.size.z, 0.5 * target.size.z, rules.aim_step_m)) {
      heights_.push_back(target.centre().z + up);
      reaches_.emplace_back(rules, range_.pitches, target, heights_.back(), stop);
      longest_ = std::max(longest_, reaches_.back().longest());
    }
    longest_ += 0.5 * std::hypot(target.size.x, target.size.y);
  }

  /// Tries a place; returns false at the first hit.
  bool try_place(std::size_t cell, Vec2 position) {
    if (distance(xy(target_.base), position) > longest_ || !clear_of(rules_, target_, position)) return true;
    const std::uint64_t before = result.flights;
    for (const Vec2 aim : aim_points(target_, position, rules_.aim_step_m)) {
      for (std::size_t z = 0; z < heights_.size() && !result.found; ++z) {
        if (const auto shot = try_aim(position, aim, z)) {
          result.found = cell;
          result.shot = *shot;
        }
      }
    }
    result.places += result.flights > before ? 1 : 0;
    return !result.found;
  }

  Exhausted result;

 private:
  /// Returns the first shot that hits, of those through that point at that height.
  std::optional<Shot> try_aim(Vec2 position, Vec2 aim, std::size_t z) {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      if (!reaches_[z].holds(i, aim - position)) continue;
      const auto aimed = range_.aim(position, i, {aim.x, aim.y, heights_[z]}, last_[i]);
      if (!aimed) continue;
      ++result.flights;
      const auto stop = range_.stopped_by(position, aimed->shot);
      if (!stop) return aimed->shot;
      ++result.blocked_by[*stop];
    }
    return std::nullopt;
  }

  const ShotRules& rules_;
  const Target& target_;
  Range range_;
  std::vector<std::optional<Aimed>> last_;  ///< by pitch, the guess for the next place
  std::vector<double> heights_;             ///< of the aim points, world
  std::vector<Reach> reaches_;              ///< by height
  double longest_ = 0.0;
};

}  // namespace

FiringRegion firing_region_in_air(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                  const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                                  const std::stop_token& stop) {
  FiringRegion region;
  region.blocked_by.assign(space.solids().size(), 0);
  Range range(rules, space, target);
  const Vec3 centre = target.centre();
  const Reach reach(rules, range.pitches, target, centre.z, stop);
  const double longest = reach.longest();
  region.pitch = GridPart(frame, xy(centre), longest, FiringRegion::no_shot);
  region.error_ratio = GridPart(frame, xy(centre), longest, std::numeric_limits<float>::infinity());
  std::vector<std::optional<Aimed>> last(range.pitches.size());
  for (std::size_t cell = 0; cell < frame.size() && !stop.stop_requested(); ++cell) {
    if (standable[cell] == 0) continue;
    ++region.places;
    const Vec2 position = frame.centre(frame.cell(cell));
    const Vec2 sight = xy(centre) - position;
    if (norm(sight) > longest || !clear_of(rules, target, position)) continue;
    bool in_range = false;
    for (std::size_t i = 0; i < range.pitches.size() && region.error_ratio[cell] > good_error_ratio; ++i) {
      if (!reach.holds(i, sight)) continue;
      const auto aimed = range.aim(position, i, centre, last[i]);
      if (!aimed) continue;
      const auto shot_error_ratio = static_cast<float>(error_ratio(rules, target, *aimed));
      const bool first = !in_range;
      in_range = true;
      if (region.pitch[cell] != FiringRegion::no_shot && shot_error_ratio >= region.error_ratio[cell])
        continue;
      if (const auto solid = range.stopped_by(position, aimed->shot)) {
        if (first) ++region.blocked_by[*solid];
        continue;
      }
      region.error_ratio.set(cell, shot_error_ratio);
      region.pitch.set(cell, static_cast<std::uint8_t>(i));
    }
    region.in_range += in_range ? 1 : 0;
    region.hits += region.pitch[cell] != FiringRegion::no_shot ? 1 : 0;
  }
  return region;
}

Exhausted exhaust_in_air(const ShotRules& rules, const FlightSpace& space, const Target& target,
                         const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                         const std::stop_token& stop) {
  ExhaustionInAir exhaustion(rules, space, target, stop);
  for (std::size_t cell = 0; cell < frame.size() && !stop.stop_requested(); ++cell) {
    if (standable[cell] != 0 && !exhaustion.try_place(cell, frame.centre(frame.cell(cell)))) break;
  }
  return std::move(exhaustion.result);
}

double longest_range_in_air(const ShotRules& rules, const Target& target) {
  const Reach reach(rules, pitch_lattice(rules), target, target.base.z);
  return reach.longest() + 0.5 * std::hypot(target.size.x, target.size.y);
}

}  // namespace outrider
