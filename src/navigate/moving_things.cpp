#include "outrider/navigate/moving_things.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "beams.hpp"

namespace outrider {
namespace {

constexpr double join_m = 0.15;     // between points of a cluster
constexpr double join_steps = 2.5;  // the same far away, in steps from beam to beam
constexpr std::size_t fewest_points = 3;
constexpr double least_radius_m = 0.08, most_radius_m = 0.45;
constexpr double most_range_m = 8.0;  // farther clusters have too few points
constexpr double gate_m = 0.5;        // between a track and its cluster
constexpr double place_noise_m = 0.05, acceleration_noise_mps2 = 1.5, first_speed_mps = 1.5;
constexpr double lost_s = 0.4;       // without a sighting where the laser would see it
constexpr double hidden_s = 2.0;     // without one where it does not look, or something stands before
constexpr int enough_sightings = 4;  // until a track is believed
constexpr double moves_mps = 0.25, rests_mps = 0.15, sure_sigmas = 2.5;
constexpr double newest_share = 0.4;
constexpr double passed_m = 0.2;                       // by which a beam goes beyond what it passes
constexpr double least_ago_s = 0.3, most_ago_s = 2.0;  // of beams that are asked
constexpr double look_every_s = 0.1;
constexpr double rim_m = 0.15;                               // around what moves, that is left out of scans
constexpr std::size_t most_asked = 9;                        // points of a cluster
constexpr double most_standing = 0.2, again_standing = 0.5;  // share where no beam passed before

}  // namespace

void MovingThings::Track::predict(double duration_s) {
  place = place + duration_s * velocity;
  const double q = acceleration_noise_mps2 * acceleration_noise_mps2;
  const double t = duration_s, t2 = t * t;
  place_variance += 2.0 * t * covariance + t2 * velocity_variance + 0.25 * t2 * t2 * q;
  covariance += t * velocity_variance + 0.5 * t2 * t * q;
  velocity_variance += t2 * q;
}

void MovingThings::Track::update(const Cluster& seen, double time_s) {
  const double innovation = place_variance + place_noise_m * place_noise_m;
  const double to_place = place_variance / innovation, to_velocity = covariance / innovation;
  const Vec2 off = seen.place - place;
  place = place + to_place * off;
  velocity = velocity + to_velocity * off;
  velocity_variance -= to_velocity * covariance;
  covariance *= 1.0 - to_place;
  place_variance *= 1.0 - to_place;
  radius_m = std::max(seen.radius_m, radius_m + newest_share * (seen.radius_m - radius_m));
  standing += newest_share * (seen.standing - standing);
  seen_s = time_s;
  ++sightings;
}

void MovingThings::Track::judge() {
  const double speed_mps = norm(velocity);
  if (moves) {
    moves = speed_mps > rests_mps && standing < again_standing;
  } else {
    moves = sightings >= enough_sightings && standing < most_standing && speed_mps > moves_mps &&
            speed_mps > sure_sigmas * std::sqrt(velocity_variance);
  }
}

/// Returns true if beams of the scan passed a place.
bool MovingThings::Look::passed(Vec2 place) const {
  const Vec2 local = world_T_laser.to_local(place);
  const double beyond_m = norm(local) + passed_m;
  return beyond_m < scan.most_m && passes(scan, heading_of(local), beyond_m);
}

/// Returns the share of the points where no beam passed in the last seconds.
double MovingThings::standing(const std::vector<Vec2>& points, double time_s) const {
  const std::size_t stride = 1 + (points.size() - 1) / most_asked;
  std::size_t asked = 0, stood = 0;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    ++asked;
    const bool passed = std::ranges::any_of(looks_, [&](const Look& look) {
      return look.scan.time_s < time_s - least_ago_s && look.passed(points[i]);
    });
    stood += passed ? 0 : 1;
  }
  return static_cast<double>(stood) / static_cast<double>(asked);
}

void MovingThings::remember(const LaserScan& scan, const Pose2& world_T_laser) {
  while (!looks_.empty() && looks_.front().scan.time_s < scan.time_s - most_ago_s) looks_.pop_front();
  if (looks_.empty() || scan.time_s >= looks_.back().scan.time_s + look_every_s)
    looks_.push_back({scan, world_T_laser});
}

std::vector<MovingThings::Cluster> MovingThings::clusters(const LaserScan& scan,
                                                          const Pose2& world_T_laser) const {
  std::vector<Cluster> found;
  std::vector<Vec2> points;
  const auto end_cluster = [&] {
    if (points.size() >= fewest_points) {
      const double radius_m = 0.5 * distance(points.front(), points.back());
      if (radius_m <= most_radius_m) {
        found.push_back({0.5 * (points.front() + points.back()), std::max(radius_m, least_radius_m),
                         standing(points, scan.time_s)});
      }
    }
    points.clear();
  };
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double range_m = range_of(scan, beam);
    if (range_m < 0.0 || range_m > most_range_m) {
      end_cluster();
      continue;
    }
    const double bearing_rad = scan.first_rad + static_cast<double>(beam) * scan.step_rad;
    const Vec2 point = world_T_laser * (range_m * direction(bearing_rad));
    if (!points.empty() &&
        distance(points.back(), point) > std::max(join_m, join_steps * range_m * scan.step_rad))
      end_cluster();
    points.push_back(point);
  }
  end_cluster();
  return found;
}

/// Gives each track the nearest cluster, those that agree best first, and begins tracks of the others.
void MovingThings::associate(std::vector<Cluster>& seen, double time_s) {
  struct Pair {
    double away_m;
    std::size_t track, cluster;
  };
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    for (std::size_t c = 0; c < seen.size(); ++c) {
      const double away_m = distance(tracks_[t].place, seen[c].place);
      if (away_m < gate_m) pairs.push_back({away_m, t, c});
    }
  }
  std::ranges::stable_sort(pairs, {}, &Pair::away_m);
  for (const Pair& pair : pairs) {
    if (seen[pair.cluster].taken || tracks_[pair.track].seen_s == time_s) continue;
    seen[pair.cluster].taken = true;
    tracks_[pair.track].update(seen[pair.cluster], time_s);
  }
  for (const Cluster& cluster : seen) {
    if (cluster.taken) continue;
    Track track{cluster.place, {}, cluster.radius_m};
    track.place_variance = place_noise_m * place_noise_m;
    track.velocity_variance = first_speed_mps * first_speed_mps;
    track.seen_s = time_s;
    tracks_.push_back(track);
  }
}

void MovingThings::note(const LaserScan& scan, const Pose2& world_T_laser) {
  if (!check(scan) || !finite(world_T_laser)) return;
  if (scan.time_s < time_s_) clear();  // the clock was put back
  const double passed_s = scan.time_s - time_s_;
  if (!looks_.empty() && passed_s == 0.0) return;
  for (Track& track : tracks_) track.predict(passed_s);
  time_s_ = scan.time_s;
  std::vector<Cluster> seen = clusters(scan, world_T_laser);
  associate(seen, time_s_);
  remember(scan, world_T_laser);
  for (Track& track : tracks_) track.judge();
  const Look now{scan, world_T_laser};
  std::erase_if(tracks_, [&](const Track& track) {
    const double unseen_s = time_s_ - track.seen_s;
    return unseen_s > hidden_s || (unseen_s > lost_s && (!track.moves || now.passed(track.place)));
  });
}

LaserScan MovingThings::without(const LaserScan& scan, const Pose2& world_T_laser) const {
  LaserScan rest = scan;
  for (const MovingThing& thing : at(scan.time_s)) {
    const Vec2 middle = world_T_laser.to_local(thing.place);
    const double near_m = thing.radius_m + rim_m;
    for (std::size_t beam = 0; beam < rest.ranges_m.size(); ++beam) {
      const double bearing_rad = rest.first_rad + static_cast<double>(beam) * rest.step_rad;
      const Vec2 point = static_cast<double>(rest.ranges_m[beam]) * direction(bearing_rad);
      if (distance(point, middle) < near_m) rest.ranges_m[beam] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return rest;
}

std::vector<MovingThing> MovingThings::at(double time_s) const {
  std::vector<MovingThing> things;
  for (const Track& track : tracks_) {
    if (!track.moves) continue;
    const double passed_s = std::max(0.0, time_s - time_s_);
    things.push_back({track.place + passed_s * track.velocity, track.velocity, track.radius_m,
                      std::sqrt(track.velocity_variance)});
  }
  return things;
}

}  // namespace outrider
