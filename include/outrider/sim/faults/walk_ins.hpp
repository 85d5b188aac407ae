// WalkIns: what a world does not have at the start of a run: people who walk through it, posts that move, and
// a post that somebody puts before the robot. A laser sees them all, and a robot can touch them.
//
// A person is a disk of 0.2 m radius. It walks straight to one place after another, drawn at random, if the
// way there is free of what stands. It stands still rather than come nearer than 0.3 m to the robot, if it
// heeds it; who does not walks into a robot that stands. Social people keep away from each other and from
// walls by forces, and from the robot too if they heed it. Source: Helbing and Molnar, Social force model for
// pedestrian dynamics, Physical Review E 51 (1995) 4282.
//
// Moving posts go along their paths whatever is there. The other post is put on free ground ahead of the
// robot when that drives, or at a place that is told once the robot is off it, as a door that closes; and it
// may be taken away again.
//
// Same world, options and random stream: same motion. O(people) per step, O(people * people) if social.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

class OpenGround;
struct World;

/// A post that moves along a path, there and back.
struct MovingPost {
  std::vector<Vec2> path;  ///< two points or more
  double speed_mps = 1.0;
  double radius_m = 0.3;
  double begin_m = 0.0;  ///< length of the path that lies behind it at first
};

struct WalkInOptions {
  std::int64_t people = 0;                 ///< number of people
  double people_mps = 0.8;                 ///< their speed
  bool people_heed = true;                 ///< they stop before the robot
  bool people_social = false;              ///< they keep away from each other
  double blocked_at_s = 1e9;               ///< from then on a post is put before the robot when it drives
  double blocked_for_s = 1e9;              ///< how long it stands there
  double blocked_ahead_m = 0.6;            ///< gap between the robot and the post at first
  double blocked_radius_m = 0.2;           ///< radius of the post
  std::optional<Vec2> blocked_place = {};  ///< where the post is put; empty: before the robot
  std::vector<MovingPost> posts = {};      ///< that move
};
std::vector<Option> describe(WalkInOptions& options);

class WalkIns {
 public:
  WalkIns() = default;
  /// Solids that stand higher than `climbs_m` are obstacles for people.
  WalkIns(const World& world, Vec2 robot, double climbs_m, const WalkInOptions& options, const Rng& rng);

  /// The robot that they come upon.
  struct Meeting {
    Pose2 pose;
    double radius_m = 0.0;
    bool drives = false;  ///< ahead
  };
  /// Goes on until `time_s`. `ground` is that of the robot.
  void advance(double time_s, const Meeting& robot, const OpenGround& ground);

  /// Returns the disks that are there now.
  [[nodiscard]] const std::vector<RoundedPolygon>& disks() const { return disks_; }
  /// Returns the gap between a disk and the nearest of them, m; negative if they overlap, and infinite if
  /// there is none.
  [[nodiscard]] double gap_m(Segment swept, double radius_m) const;
  /// Returns the post, while it stands.
  [[nodiscard]] std::optional<RoundedPolygon> post() const {
    return post_ ? std::optional(RoundedPolygon{{*post_}, options_.blocked_radius_m}) : std::nullopt;
  }
  /// Returns the time at which the post was put there, if it was.
  [[nodiscard]] std::optional<double> blocked_s() const { return post_s_; }

 private:
  struct Person {
    Vec2 at;
    Vec2 to;
    Rng rng;
    Vec2 velocity = {};    // if social
    double since_s = 0.0;  // that it has walked to there
  };
  void walk(Person& person, double way_m, const Meeting& robot);
  void walk_socially(double duration_s, const Meeting& robot);
  [[nodiscard]] Vec2 force_on(const Person& person, const Meeting& robot) const;
  [[nodiscard]] bool gives_way(Vec2 from, Vec2 to, const Meeting& robot) const;
  [[nodiscard]] std::optional<Vec2> place_for_post(const Meeting& robot, const OpenGround& ground) const;

  WalkInOptions options_;
  std::vector<RoundedPolygon> standing_;  // what is in the way of people
  Box2 bounds_;
  std::vector<Person> people_;
  std::optional<Vec2> post_;
  std::optional<double> post_s_;
  double time_s_ = 0.0;
  std::vector<RoundedPolygon> disks_;
};

}  // namespace outrider
