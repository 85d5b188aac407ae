#include "mission/look_round.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mission/look.hpp"
#include "outrider/core/units.hpp"
#include "outrider/sim/sensors/simulated_tag_camera.hpp"
#include "outrider/sim/sensors/tag_model.hpp"

namespace outrider {
namespace {

constexpr int headings = 72;              ///< that are tried, evenly spaced
constexpr double off_rad = radians(4.0);  ///< a tag is in view also if the heading is off by so much
constexpr int most_rounds = 3;            ///< at one waypoint
constexpr double most_turning_s = 10.0;   ///< until the robot stands at the new heading
constexpr double most_standing_s = 10.0;  ///< while another tag is in view
constexpr double needed_sigma_m = 0.007;  ///< of the position by one tag alone
constexpr double well_within = 0.8;       ///< of the tolerance: the belief still changes on the way back
constexpr double turning_per_s = 2.0;     ///< rate of a turn over the angle that is left
constexpr std::size_t most_headings = 2;  ///< in one round

/// The tags that the robot sees from a place, by the map.
class Views {
 public:
  Views(const DriveTask& task, const PoseBelief& belief)
      : task_(task),
        camera_(robot_camera(task.eye)),
        ground_(sight_lines(task.world, camera_.robot_T_camera.position.z)),
        belief_(belief) {}

  /// Returns how long images have to be averaged until one of the tags, seen at that heading, tells the
  /// position well, and its id; infinity if there is none. Tags of `known` do not count.
  [[nodiscard]] std::pair<double, int> averaging_s(double heading_rad, const std::set<int>& known) const {
    PoseBelief there = belief_;
    there.world_T_robot.heading_rad = heading_rad;
    Rng unused(0);
    std::pair<double, int> best{std::numeric_limits<double>::infinity(), -1};
    for (const TagSighting& sighting :
         modelled_sightings(task_.tags, camera_, {0.0, 0.0}, ground_, there.world_T_robot, unused)) {
      if (known.contains(sighting.id) || !sees(sighting.id, heading_rad - off_rad) ||
          !sees(sighting.id, heading_rad + off_rad))
        continue;
      const TagFix fix = localise({&sighting, 1}, task_.tags, camera_, there, task_.localise);
      if (!fix.belief) continue;
      const double images = std::pow(position_sigma_m(*fix.belief) / needed_sigma_m, 2);
      best = std::min(best, {images / task_.eye.rate_hz, sighting.id});
    }
    return best;
  }

 private:
  [[nodiscard]] bool sees(int id, double heading_rad) const {
    const Vec2 at = belief_.world_T_robot.position;
    const Pose3 world_T_robot{{at.x, at.y, 0.0}, Rotation::from_rpy(0.0, 0.0, heading_rad)};
    const auto tag = std::ranges::find(task_.tags.tags, id, &Tag::id);
    return in_view(*tag, camera_.camera, world_T_robot * camera_.robot_T_camera, ground_);
  }

  const DriveTask& task_;
  RobotCamera camera_;
  CollisionMap ground_;
  PoseBelief belief_;
};

/// The tags that the robot need not look for.
std::set<int> known_tags(const DriveMission& mission) {
  std::set<int> ids = indispensable_tags(mission).value_or(std::set<int>{});
  ids.insert(mission.suspects.begin(), mission.suspects.end());
  if (const TagSupport* const lone = lone_support(mission)) ids.insert(lone->tags.begin(), lone->tags.end());
  return ids;
}

/// Returns the headings at which another tag tells the position, soonest first, each by another tag.
std::vector<double> headings_with_another(const DriveMission& mission) {
  const PoseBelief& belief = mission.reckoning.belief;
  const Views views(mission.task, belief);
  const std::set<int> known = known_tags(mission);
  struct Choice {
    double time_s = 0.0;
    int tag = -1;
    double heading_rad = 0.0;
  };
  std::vector<Choice> choices;
  for (int i = 0; i < headings; ++i) {
    const double turn_rad = wrap_angle(2.0 * pi * i / headings);
    const double heading_rad = belief.world_T_robot.heading_rad + turn_rad;
    const auto [averaging_s, tag] = views.averaging_s(heading_rad, known);
    const double turning_s = 2.0 * std::abs(turn_rad) / mission.task.follow.turn_rate_radps;
    if (averaging_s <= most_standing_s) choices.push_back({turning_s + averaging_s, tag, heading_rad});
  }
  std::ranges::stable_sort(choices, {}, &Choice::time_s);
  std::vector<double> best;
  std::set<int> shown;
  for (const Choice& choice : choices) {
    if (best.size() < most_headings && shown.insert(choice.tag).second) best.push_back(choice.heading_rad);
  }
  return best;
}

/// The robot goes on to its stop, as after a leg. It faces it already, so the follower has little left to do.
void end_look_round(DriveMission& mission) {
  mission.look_round.reset();
  mission.stop.reset();
  begin_leg_anew(mission);
}

void turn_to(DriveMission& mission, LookRound& round, double heading_rad, double now_s) {
  round.began_s = now_s;
  round.stands_s.reset();
  mission.stop.reset();
  round.heading_rad = heading_rad;
}

void turn_to_next_heading(DriveMission& mission, LookRound& round, double now_s) {
  turn_to(mission, round, round.left_rad.front(), now_s);
  round.left_rad.erase(round.left_rad.begin());
}

/// Turns back to the heading of the stop. The gains of a follower are those of a drive: it takes three times
/// as long for a turn.
void turn_back(DriveMission& mission, LookRound& round, double now_s) {
  round.returns = true;
  turn_to(mission, round, mission.task.waypoints[mission.follower.next].pose.heading_rad, now_s);
}

/// Returns the command that turns the robot by what is left.
Twist2 turning(const FollowOptions& follow, double left_rad) {
  const double rate_radps =
      std::clamp(turning_per_s * std::abs(left_rad), follow.least_turn_rate_radps, follow.turn_rate_radps);
  return {0.0, 0.0, std::copysign(rate_radps, left_rad)};
}

/// Returns true if the robot has waited long enough at the present heading.
bool is_in_vain(const DriveMission& mission, const LookRound& round, double now_s) {
  if (!round.stands_s) return now_s - round.began_s > most_turning_s;
  const bool sees_another = mission.votes.votes.size() > round.votes;
  return now_s - *round.stands_s > (sees_another ? most_standing_s : 2.0 * mission.task.rules.settle_s);
}

}  // namespace

bool begin_look_round(DriveMission& mission, double now_s) {
  if (is_corroborated(mission) || !mission.task.rules.tags_move) return false;
  int& rounds = mission.rounds_at[mission.follower.next];
  if (rounds == most_rounds) return false;
  ++rounds;
  const auto headings_rad = headings_with_another(mission);
  if (headings_rad.empty()) return false;
  LookRound& round = mission.look_round.emplace(
      LookRound{headings_rad, 0.0, 0.0, std::nullopt, mission.votes.votes.size(), false});
  turn_to_next_heading(mission, round, now_s);
  return true;
}

Twist2 step_look_round(DriveMission& mission, LookRound& round, const Pose2& believed, double now_s) {
  const FollowOptions& follow = mission.task.follow;
  const bool in_vain = is_in_vain(mission, round, now_s);
  if (!round.returns) {
    if (is_corroborated(mission, well_within) || (in_vain && round.left_rad.empty())) {
      turn_back(mission, round, now_s);
    } else if (in_vain) {
      turn_to_next_heading(mission, round, now_s);
    }
  }
  const double left_rad = wrap_angle(round.heading_rad - believed.heading_rad);
  if (round.returns) {
    if (std::abs(left_rad) > follow.within_rad && now_s - round.began_s <= most_turning_s)
      return turning(follow, left_rad);
    end_look_round(mission);
    return {};
  }
  if (std::abs(left_rad) <= 0.5 * off_rad && !round.stands_s) {
    round.stands_s = now_s;
    mission.stop = StopCheck::at(now_s);
  }
  return round.stands_s ? Twist2{} : turning(follow, left_rad);
}

}  // namespace outrider
