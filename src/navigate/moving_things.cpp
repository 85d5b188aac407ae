#include "outrider/navigate/moving_things.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "beams.hpp"

namespace outrider {
namespace {

constexpr double join_m = 0.15;     // between points of a cluster
constexpr double join_steps = 2.5;  // the same far away, in steps from beam to beam
constexpr std::size_t fewest_points = 3;
constexpr double least_radius_m = 0.08, most_radius_m = 0.6;
constexpr double most_range_m = 8.0;  // farther clusters have too few points
constexpr double gate_m = 0.5;        // between a track and its cluster
constexpr double place_noise_m = 0.05, acceleration_noise_mps2 = 1.5, first_speed_mps = 1.5;
constexpr double turns_sigmas = 3.0;  // off its way, at which it has turned and its velocity is not known
constexpr double lost_s = 0.4;        // without a sighting where the laser would see it
constexpr double hidden_s = 2.0;      // without one where it does not look, or something stands before
constexpr int enough_sightings = 4;   // until a track is believed
constexpr int new_sightings = 3;      // until it counts, although it is not known where it goes
constexpr double moves_mps = 0.25, rests_mps = 0.15, sure_sigmas = 1.5;
constexpr double newest_share = 0.4;
constexpr double passed_m = 0.2;          // by which a beam goes beyond what it passes
constexpr double passed_beside_m = 0.05;  // of it, within which all beams pass: it is not the face of a wall
constexpr double least_ago_s = 0.3, most_ago_s = 2.0;  // of beams that are asked
constexpr double look_every_s = 0.1;
constexpr double rim_m = 0.15;                               // around what moves, that is left out of scans
constexpr std::size_t most_asked = 9;                        // points of a cluster
constexpr double most_standing = 0.2, again_standing = 0.5;  // share where no beam passed before
constexpr double apart_mps = 0.4;                            // between the velocities of two that are not one
constexpr double apart_m = 0.2;         // from the rim of what moves, within which points are of it
constexpr std::size_t looks_apart = 3;  // every third scan that is remembered is asked about wide clusters

/// Returns the points of neighbouring beams that end close to each other, run by run.
std::vector<std::vector<Vec2>> runs_of(const LaserScan& scan, const Pose2& world_T_laser) {
  std::vector<std::vector<Vec2>> runs;
  const auto hang_together = [&](Vec2 a, Vec2 b, double range_m) {
    return distance(a, b) <= std::max(join_m, join_steps * range_m * scan.step_rad);
  };
  bool goes_on = false, from_first = false;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double range_m = range_of(scan, beam);
    if (range_m < 0.0 || range_m > most_range_m) {
      goes_on = false;
      continue;
    }
    const double bearing_rad = scan.first_rad + static_cast<double>(beam) * scan.step_rad;
    const Vec2 point = world_T_laser * (range_m * direction(bearing_rad));
    if (!goes_on || !hang_together(runs.back().back(), point, range_m)) runs.emplace_back();
    runs.back().push_back(point);
    goes_on = true;
    from_first |= beam == 0;
  }
  // The last beam of a whole turn is beside the first.
  if (runs.size() > 1 && goes_on && from_first && is_whole_turn(scan) &&
      hang_together(runs.back().back(), runs.front().front(), range_of(scan, 0))) {
    runs.back().insert(runs.back().end(), runs.front().begin(), runs.front().end());
    runs.erase(runs.begin());
  }
  return runs;
}

/// Returns how far a run extends from its first point.
double width_of(std::span<const Vec2> points) {
  double width_m = 0.0;
  for (const Vec2 point : points) width_m = std::max(width_m, distance(points.front(), point));
  return width_m;
}

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
  const Vec2 off = seen.place - place;
  double innovation = place_variance + place_noise_m * place_noise_m;
  if (squared_norm(off) > turns_sigmas * turns_sigmas * innovation) {
    // As if its velocity had become another since the sighting before.
    const double passed_s = time_s - seen_s;
    velocity_variance = first_speed_mps * first_speed_mps;
    covariance = passed_s * velocity_variance;
    place_variance += passed_s * covariance;
    innovation = place_variance + place_noise_m * place_noise_m;
  }
  const double to_place = place_variance / innovation, to_velocity = covariance / innovation;
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
    moves = is_new() && sightings >= enough_sightings && speed_mps > moves_mps &&
            speed_mps > sure_sigmas * std::sqrt(velocity_variance);
  }
}

/// Returns true if it stands where beams passed a moment ago.
bool MovingThings::Track::is_new() const { return sightings >= new_sightings && standing < most_standing; }

/// Returns true if beams of the scan passed a place.
bool MovingThings::Look::passed(Vec2 place) const {
  const Vec2 local = world_T_laser.to_local(place);
  const double away_m = norm(local), beyond_m = away_m + passed_m;
  return beyond_m < scan.most_m &&
         passes(scan, heading_of(local), beyond_m, passed_beside_m / std::max(away_m, passed_beside_m));
}

void MovingThings::remember(const LaserScan& scan, const Pose2& world_T_laser) {
  while (!looks_.empty() && looks_.front().scan.time_s < scan.time_s - most_ago_s) looks_.pop_front();
  if (looks_.empty() || scan.time_s >= looks_.back().scan.time_s + look_every_s)
    looks_.push_back({scan, world_T_laser});
}

/// Returns true if a beam of the last seconds passed a place; every so many scans are asked.
bool MovingThings::was_passed(Vec2 place, double time_s, std::size_t stride) const {
  for (std::size_t i = 0; i < looks_.size(); i += stride) {
    if (looks_[i].scan.time_s >= time_s - least_ago_s) return false;
    if (looks_[i].passed(place)) return true;
  }
  return false;
}

/// Returns the share of the points where no beam passed in the last seconds.
double MovingThings::standing(std::span<const Vec2> points, double time_s) const {
  const std::size_t stride = 1 + (points.size() - 1) / most_asked;
  std::size_t asked = 0, stood = 0;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    ++asked;
    stood += was_passed(points[i], time_s, 1) ? 0 : 1;
  }
  return static_cast<double>(stood) / static_cast<double>(asked);
}

/// Adds a cluster of these points if it has enough of them and is narrow.
void MovingThings::add_cluster(std::span<const Vec2> points, double time_s,
                               std::vector<Cluster>& found) const {
  if (points.size() < fewest_points) return;
  const double radius_m = 0.5 * width_of(points);
  if (radius_m > most_radius_m) return;
  found.push_back(
      {0.5 * (points.front() + points.back()), std::max(radius_m, least_radius_m), standing(points, time_s)});
}

/// Returns the number of the track that counts and that a point is of, if any.
std::optional<std::size_t> MovingThings::owner_of(Vec2 point) const {
  std::optional<std::size_t> owner;
  double nearest_m = apart_m;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const double away_m = distance(tracks_[t].place, point) - tracks_[t].radius_m;
    if (!tracks_[t].counts() || away_m >= nearest_m) continue;
    nearest_m = away_m;
    owner = t;
  }
  return owner;
}

/// Adds the clusters of a run: one, or, if it would be too wide or several share it that go different ways,
/// those of each that counts and of what is newly there. So who walks by a wall is told from it.
void MovingThings::add_clusters(std::span<const Vec2> points, double time_s,
                                std::vector<Cluster>& found) const {
  if (points.size() < fewest_points) return;
  std::vector<std::optional<std::size_t>> owners;
  std::ranges::transform(points, std::back_inserter(owners), [&](Vec2 point) { return owner_of(point); });
  const bool wide = 0.5 * width_of(points) > most_radius_m;
  std::optional<std::size_t> first;
  bool several = false;
  for (const auto& owner : owners) {
    if (!first) first = owner;
    several |= owner && distance(tracks_[*owner].velocity, tracks_[*first].velocity) > apart_mps;
  }
  if (!wide && !several) {
    add_cluster(points, time_s, found);
    return;
  }
  constexpr std::size_t stands = std::numeric_limits<std::size_t>::max();
  const auto part_of = [&](std::size_t i) -> std::size_t {
    if (wide && !was_passed(points[i], time_s, looks_apart)) return stands;
    return owners[i].value_or(tracks_.size());
  };
  std::size_t begin = 0, part = part_of(0);
  for (std::size_t i = 1; i <= points.size(); ++i) {
    const std::size_t next = i < points.size() ? part_of(i) : stands;
    if (i < points.size() && next == part) continue;
    if (part != stands) add_cluster(points.subspan(begin, i - begin), time_s, found);
    begin = i;
    part = next;
  }
}

std::vector<MovingThings::Cluster> MovingThings::clusters(const LaserScan& scan,
                                                          const Pose2& world_T_laser) const {
  std::vector<Cluster> found;
  for (const std::vector<Vec2>& run : runs_of(scan, world_T_laser)) add_clusters(run, scan.time_s, found);
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
    track.standing = cluster.standing;
    track.seen_s = time_s;
    tracks_.push_back(track);
  }
}

/// Returns true if a track that was not seen now is where one is that was, and goes the same way.
bool MovingThings::is_seen_as_another(const Track& track) const {
  if (track.seen_s == time_s_) return false;
  return std::ranges::any_of(tracks_, [&](const Track& other) {
    return other.seen_s == time_s_ && distance(other.place, track.place) < other.radius_m &&
           distance(other.velocity, track.velocity) <= apart_mps;
  });
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
  std::vector<Track> kept;
  std::ranges::copy_if(tracks_, std::back_inserter(kept), [&](const Track& track) {
    const double unseen_s = time_s_ - track.seen_s;
    const bool lost = unseen_s > lost_s && (!track.moves || now.passed(track.place));
    return unseen_s <= hidden_s && !lost && !is_seen_as_another(track);
  });
  tracks_ = std::move(kept);
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
    if (!track.counts()) continue;
    const double passed_s = std::max(0.0, time_s - time_s_);
    const Vec2 velocity = track.moves ? track.velocity : Vec2{};
    things.push_back(
        {track.place + passed_s * velocity, velocity, track.radius_m, std::sqrt(track.velocity_variance)});
  }
  return things;
}

}  // namespace outrider
