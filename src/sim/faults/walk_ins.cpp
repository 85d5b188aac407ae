#include "outrider/sim/faults/walk_ins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/sim/open_ground.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {
namespace {

constexpr double person_m = 0.2;  ///< radius
constexpr double person_height_m = 1.7;
constexpr double from_robot_m = 0.3;  ///< gap that a person leaves, and who closes a door
constexpr double first_from_robot_m = 1.0;
constexpr int most_draws = 100;

bool stands_free(const std::vector<RoundedPolygon>& standing, Segment way) {
  return std::ranges::all_of(
      standing, [&](const RoundedPolygon& piece) { return signed_distance(way, piece) >= person_m; });
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
  const double now_m = distance(person.at, robot.pose.position);
  const double then_m = distance(next, robot.pose.position);
  if (options_.people_heed && then_m < now_m && then_m < person_m + robot.radius_m + from_robot_m) {
    person.to = person.at;  // somewhere else
    return;
  }
  person.at = next;
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
  const double way_m = options_.people_mps * (time_s - time_s_);
  time_s_ = time_s;
  for (Person& person : people_) walk(person, way_m, robot);
  if (!post_s_ && time_s >= options_.blocked_at_s) {
    post_ = place_for_post(robot, ground);
    if (post_) post_s_ = time_s_;
  }
  if (post_s_ && time_s >= *post_s_ + options_.blocked_for_s) post_.reset();
  disks_.clear();
  for (const Person& person : people_) disks_.push_back({{person.at}, person_m});
  if (post_) disks_.push_back({{*post_}, options_.blocked_radius_m});
}

double WalkIns::gap_m(Segment swept, double radius_m) const {
  double gap = std::numeric_limits<double>::infinity();
  for (const RoundedPolygon& disk : disks_) gap = std::min(gap, signed_distance(swept, disk) - radius_m);
  return gap;
}

}  // namespace outrider
