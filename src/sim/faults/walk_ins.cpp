#include "outrider/sim/faults/walk_ins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/geometry/polyline.hpp"
#include "outrider/sim/open_ground.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {
namespace {

constexpr double person_m = 0.2;  ///< radius
constexpr double person_height_m = 1.7;
constexpr double from_robot_m = 0.3;  ///< gap that a person leaves, and who closes a door
constexpr double first_from_robot_m = 1.0;
constexpr int most_draws = 100;
// The values of Helbing and Molnar: the time in which a walker takes up its speed, and the strengths and
// ranges of what people and walls do to it.
constexpr double relaxation_s = 0.5;
constexpr double people_force_mps2 = 7.0, people_range_m = 0.3;
constexpr double wall_force_mps2 = 50.0, wall_range_m = 0.2;
constexpr double fastest_part = 1.3;  // of its speed
constexpr double there_m = 0.3;       // from a place at which a social walker turns to the next
constexpr double longest_s = 20.0;    // on the way to a place
constexpr double far_m = 2.0;         // beyond which forces are nothing

bool stands_free(const std::vector<RoundedPolygon>& standing, Segment way) {
  return std::ranges::all_of(
      standing, [&](const RoundedPolygon& piece) { return signed_distance(way, piece) >= person_m; });
}

/// Returns the acceleration away from something, whose middle or nearest point lies there.
Vec2 push(Vec2 at, Vec2 from, double strength_mps2, double range_m) {
  const Vec2 off = at - from;
  const double away_m = norm(off);
  if (away_m == 0.0 || away_m > far_m) return {};
  return strength_mps2 * std::exp(-away_m / range_m) / away_m * off;
}

/// Returns where a moving post is at a time.
Vec2 place_of(const MovingPost& post, double time_s) {
  const double length_m = length_of(post.path);
  if (length_m == 0.0) return post.path.front();
  double left_m = std::fmod(post.begin_m + post.speed_mps * time_s, 2.0 * length_m);
  if (left_m > length_m) left_m = 2.0 * length_m - left_m;
  for (std::size_t i = 1; i < post.path.size(); ++i) {
    const double leg_m = distance(post.path[i - 1], post.path[i]);
    if (left_m < leg_m) return post.path[i - 1] + left_m / leg_m * (post.path[i] - post.path[i - 1]);
    left_m -= leg_m;
  }
  return post.path.back();
}

Vec2 draw_place(const Box2& box, Rng& rng) {
  const double x = rng.uniform(box.low.x, box.high.x);
  return {x, rng.uniform(box.low.y, box.high.y)};
}

}  // namespace

std::vector<Option> describe(WalkInOptions& options) {
  return {
      {"people", "", 0, 1000, "who walk through the world", &options.people},
      {"people_speed", "m/s", 0.0, 10.0, "their speed", &options.people_mps},
      {"people_heed", "", 0, 0, "they stop before they come too near to the robot", &options.people_heed},
      {"people_social", "", 0, 0, "they keep away from each other and from walls, by the social force model",
       &options.people_social},
      {"blocked_at", "s", 0.0, 1e9, "from then on a post is put before the robot as soon as it drives",
       &options.blocked_at_s},
      {"blocked_for", "s", 0.0, 1e9, "for how long it stands there", &options.blocked_for_s},
      {"blocked_ahead", "m", 0.05, 10.0, "gap between the robot and the post then", &options.blocked_ahead_m},
      {"blocked_radius", "m", 0.01, 10.0, "radius of the post", &options.blocked_radius_m},
  };
}

WalkIns::WalkIns(const World& world, Vec2 robot, double climbs_m, const WalkInOptions& options,
                 const Rng& rng)
    : options_(options), bounds_(world.bounds) {
  if (options_.people == 0) return;
  standing_ = CollisionMap::of(world, person_height_m, climbs_m).obstacles();
  for (std::int64_t i = 0; i < options_.people; ++i) {
    Rng own = rng.child(static_cast<std::uint64_t>(i));
    for (int draw = 0; draw < most_draws; ++draw) {
      const Vec2 at = draw_place(bounds_, own);
      if (distance(at, robot) < first_from_robot_m || !stands_free(standing_, {at, at})) continue;
      people_.push_back({at, at, own});
      break;
    }
  }
}

void WalkIns::walk(Person& person, double way_m, const Meeting& robot) {
  if (person.at == person.to) {
    const Vec2 to = draw_place(bounds_, person.rng);
    if (stands_free(standing_, {person.at, to})) person.to = to;
  }
  const double left_m = distance(person.at, person.to);
  if (left_m == 0.0) return;
  const Vec2 next = left_m <= way_m ? person.to : person.at + way_m / left_m * (person.to - person.at);
  if (gives_way(person.at, next, robot)) {
    person.to = person.at;  // somewhere else
    return;
  }
  person.at = next;
}

/// Returns true if who heeds the robot does not go there.
bool WalkIns::gives_way(Vec2 from, Vec2 to, const Meeting& robot) const {
  const double now_m = distance(from, robot.pose.position), then_m = distance(to, robot.pose.position);
  return options_.people_heed && then_m < now_m && then_m < person_m + robot.radius_m + from_robot_m;
}

Vec2 WalkIns::force_on(const Person& person, const Meeting& robot) const {
  const Vec2 to = person.to - person.at;
  const double left_m = norm(to);
  const Vec2 wanted = left_m > 0.0 ? options_.people_mps / left_m * to : Vec2{};
  Vec2 force = 1.0 / relaxation_s * (wanted - person.velocity);
  for (const Person& other : people_) {
    if (&other != &person) force = force + push(person.at, other.at, people_force_mps2, people_range_m);
  }
  if (options_.people_heed) {
    const Vec2 off = person.at - robot.pose.position;
    const double away_m = std::max(norm(off), 1e-6);
    const Vec2 like_person = person.at - std::max(away_m + person_m - robot.radius_m, 1e-3) / away_m * off;
    force = force + push(person.at, like_person, people_force_mps2, people_range_m);
  }
  for (const RoundedPolygon& piece : standing_) {
    const double away_m = signed_distance(person.at, piece);
    if (away_m > far_m) continue;
    constexpr double step_m = 1e-3;
    const Vec2 slope{signed_distance(person.at + Vec2{step_m, 0.0}, piece) - away_m,
                     signed_distance(person.at + Vec2{0.0, step_m}, piece) - away_m};
    force = force + wall_force_mps2 * std::exp(-away_m / wall_range_m) / step_m * slope;
  }
  return force;
}

void WalkIns::walk_socially(double duration_s, const Meeting& robot) {
  std::vector<Vec2> forces;
  for (Person& person : people_) {
    if (distance(person.at, person.to) < there_m || time_s_ > person.since_s + longest_s) {
      const Vec2 to = draw_place(bounds_, person.rng);
      person.to = stands_free(standing_, {person.at, to}) ? to : person.at;
      person.since_s = time_s_;
    }
    forces.push_back(force_on(person, robot));
  }
  for (std::size_t i = 0; i < people_.size(); ++i) {
    Person& person = people_[i];
    person.velocity = person.velocity + duration_s * forces[i];
    const double speed_mps = norm(person.velocity), most_mps = fastest_part * options_.people_mps;
    if (speed_mps > most_mps) person.velocity = most_mps / speed_mps * person.velocity;
    const Vec2 next = person.at + duration_s * person.velocity;
    if (gives_way(person.at, next, robot) || !stands_free(standing_, {person.at, next}))
      person.velocity = {};
    else
      person.at = next;
  }
}

/// Returns where the post is put now, if it can be put there.
std::optional<Vec2> WalkIns::place_for_post(const Meeting& robot, const OpenGround& ground) const {
  const double radius_m = options_.blocked_radius_m;
  if (const auto& told = options_.blocked_place) {
    const bool is_free = distance(*told, robot.pose.position) > robot.radius_m + radius_m + from_robot_m;
    return is_free ? told : std::nullopt;
  }
  if (!robot.drives) return std::nullopt;
  const double ahead_m = robot.radius_m + options_.blocked_ahead_m + radius_m;
  const Vec2 place = robot.pose.position + ahead_m * direction(robot.pose.heading_rad);
  if (ground.gap_m(place) + ground.radius_m() < radius_m || !ground.free({robot.pose.position, place}))
    return std::nullopt;
  return place;
}

void WalkIns::advance(double time_s, const Meeting& robot, const OpenGround& ground) {
  const double passed_s = time_s - time_s_;
  time_s_ = time_s;
  if (options_.people_social) {
    walk_socially(passed_s, robot);
  } else {
    for (Person& person : people_) walk(person, options_.people_mps * passed_s, robot);
  }
  if (!post_s_ && time_s >= options_.blocked_at_s) {
    post_ = place_for_post(robot, ground);
    if (post_) post_s_ = time_s_;
  }
  if (post_s_ && time_s >= *post_s_ + options_.blocked_for_s) post_.reset();
  disks_.clear();
  for (const Person& person : people_) disks_.push_back({{person.at}, person_m});
  for (const MovingPost& post : options_.posts) disks_.push_back({{place_of(post, time_s)}, post.radius_m});
  if (post_) disks_.push_back({{*post_}, options_.blocked_radius_m});
}

double WalkIns::gap_m(Segment swept, double radius_m) const {
  double gap = std::numeric_limits<double>::infinity();
  for (const RoundedPolygon& disk : disks_) gap = std::min(gap, signed_distance(swept, disk) - radius_m);
  return gap;
}

}  // namespace outrider
