// SimulatedGun: a water gun with rate-limited joints. Balls leave it with random errors and fly exactly until
// their first contact.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/robot/observation.hpp"
#include "outrider/sim/faults/execution_errors.hpp"
#include "outrider/sim/faults/guard_sim_params.hpp"

namespace outrider {

/// The obstacles and targets of flights.
struct GunScene {
  const ShotRules& rules;
  const std::vector<FlightSpace>& spaces;  ///< one for all targets, or one for each target
  const std::vector<Target>& targets;

  [[nodiscard]] const FlightSpace& space(std::size_t target) const {
    return spaces.size() == 1 ? spaces.front() : spaces[target];
  }
};

/// Makes the message of a shot, without its target, attempt and pose of the robot. `contact` names what the
/// ball touched first.
outrider_msgs::Shot shot_message(const Flight& flight, const Impact& impact, const FlightSpace& space,
                                 const Target& target, double ball_radius_m, std::string contact);

/// A ball that has left the barrel.
struct FiredShot {
  std::size_t target = 0;
  int attempt = 1;
  Flight flight;
  double fired_s = 0.0;
  Pose2 robot;        ///< when it left, and so are the next two
  Shot barrel;        ///< its direction in the world
  Vec2 platform_mps;  ///< velocity of the robot
};
/// Makes the whole message of a shot.
outrider_msgs::Shot message_of(const FiredShot& shot, const Impact& impact, const FlightSpace& space,
                               const Target& target, double ball_radius_m, std::string contact);

/// Returns the name of what a ball touches first: the target, a solid of the space, or "nothing".
std::string contact_of(const Impact& impact, const FlightSpace& space, const Target& target);

/// Sets the pose of the robot and the direction of the barrel, with its yaw in the map.
void set_pose(outrider_msgs::Shot& shot, const Pose2& robot, double gun_yaw_rad, double gun_pitch_rad);

/// Something that moves and stops a ball.
struct BallStop {
  double time_s = 0.0;  ///< of the contact, since the ball left
  std::string body;     ///< what it touches
};

/// Returns what stops a ball that leaves at `fired_s` before `until_s` of its flight, if anything does. It is
/// called once for each ball, with its true flight.
using BallStops =
    std::function<std::optional<BallStop>(const Flight& flight, double fired_s, double until_s)>;

class SimulatedGun {
 public:
  /// The objects to which the scene refers must outlive the gun. `gun` is the random stream of shot errors,
  /// `timing` that of firing times.
  SimulatedGun(const GunScene& scene, const ExecutionErrors& errors, const Rng& gun, const Rng& timing,
               const GunFaults& faults = {});

  /// A motion of both joints. Each joint turns at its own rate.
  struct Turn {
    GunState from;           ///< state at the beginning
    double yaw_rad = 0.0;    ///< change of yaw
    double pitch_rad = 0.0;  ///< change of pitch
    double yaw_s = 0.0;      ///< duration of the yaw motion
    double pitch_s = 0.0;    ///< duration of the pitch motion
    double total_s = 0.0;    ///< duration until both joints are done
  };
  /// Returns the motion to a yaw in the world frame and a pitch, for a robot with that heading.
  [[nodiscard]] Turn turn_towards(double yaw_rad, double pitch_rad, const Stance& stance,
                                  double heading_rad) const;
  /// Returns the joints with which the barrel of a robot with that heading points that way.
  [[nodiscard]] static GunState joints_towards(const Shot& barrel, const Stance& stance, double heading_rad);
  /// Sets the joints to their state `after_s` after the turn began.
  void be_on(const Turn& turn, double after_s);
  /// Sets the joints to their state `after_s` after they began to turn from `from` to `to`.
  void be_between(GunState from, GunState to, double after_s);
  /// Returns the direction of the barrel in the world frame.
  [[nodiscard]] Shot barrel(const Stance& stance, double heading_rad) const;

  /// Draws the delay of the next shot from a moving robot, s.
  double draw_delay_s();
  /// Lets other things than the solids and the targets of the scene stop balls.
  void set_stops(BallStops stops) { stops_ = std::move(stops); }
  /// Draws the errors of a shot from a robot with that stance.
  Shot draw_shot(const Shot& meant, const Stance& stance) {
    return shot_with_errors(meant, errors_.aim, gun_rng_, stance);
  }
  /// The simulated flight of a shot.
  struct Thrown {
    Flight flight;
    Impact impact;
    double speed_mps = 0.0;       ///< muzzle speed
    Target target;                ///< the target at the time of the impact
    std::string stopped_by = {};  ///< what moves and was touched first; empty: nothing of that kind
  };
  /// Simulates a shot at `target`, which is at the place of the target `stand_in` of the scene. If the target
  /// walks, `walk` is its motion and the ball leaves at `fired_s`.
  Thrown throw_ball(const Shot& shot, std::size_t target, std::size_t stand_in, const Platform& platform,
                    const Walk* walk, double fired_s);
  /// Pulls the trigger. Returns true if a ball leaves the barrel.
  bool pull_trigger(double time_s);
  /// Fills the tank.
  void fill_tank() { balls_ = faults_.balls; }
  /// Increments and returns the number of attempts at a target.
  int next_attempt(std::size_t target) { return ++attempts_[target]; }

  [[nodiscard]] const GunState& state() const { return state_; }
  [[nodiscard]] const GunScene& scene() const { return scene_; }

 private:
  GunScene scene_;
  ExecutionErrors errors_;
  Rng gun_rng_;
  Rng timing_rng_;
  GunFaults faults_;
  std::int64_t balls_;  // in the tank
  GunState state_;
  std::vector<int> attempts_;  // by target
  BallStops stops_;
};

}  // namespace outrider
