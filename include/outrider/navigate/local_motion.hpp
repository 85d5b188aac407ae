// LocalMotion: a rule that finds the next twist of a robot from what stands around it.
//
// Rows of local_motions():
//   sampled  optimises motions of the real footprint under the real limits over the next seconds, by sampling
//            (model predictive path integral): the time that is left to the goal at their end decides, and
//            room beside them. Source: Williams, Drews, Goldfain, Rehg and Theodorou, Information theoretic
//            model predictive control (IEEE Transactions on Robotics, 2018).
//   dwa      the dynamic window approach: the best pair of constant speed and turn rate within reach. Source:
//            Fox, Burgard and Thrun, The dynamic window approach to collision avoidance (1997).
//   steer    pure pursuit of the planned way, more slowly until it can brake. Source: Coulter, the pure
//            pursuit path tracking algorithm (CMU-RI-TR-92-01, 1992).
//
// Whatever a rule proposes passes the same test before it is commanded: after it for one period, the robot
// can brake without touching anything that is marked, or entering a keep-out zone (can_brake()). If no
// proposal passes, it brakes. Deterministic. Thread rule: one at a time.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/limited_twist.hpp"
#include "outrider/navigate/goal_field.hpp"
#include "outrider/navigate/moving_things.hpp"
#include "outrider/navigate/surroundings.hpp"

namespace outrider {

/// The situation of a robot. All references must outlive the call.
struct MotionState {
  Pose2 pose;
  Twist2 twist;  ///< present
  const Footprint& footprint;
  const RobotModel& robot;
  const Surroundings& near;
  const GoalField& field;
  Vec2 goal;
  double within_m = 0.1;   ///< distance from the goal at which the robot has arrived
  double period_s = 0.05;  ///< time until the next command
  const std::vector<MovingThing>* moving = nullptr;  ///< the things that move; null if there are none
  bool may_back = true;  ///< it may drive backwards: its laser looks there, or nobody is about

  /// Returns the distance from the footprint at a pose to what moves after a time, m, at most `most`; if it
  /// is `swept`, to wherever it is until then.
  [[nodiscard]] double moving_gap(const Pose2& at, double after_s, double most, bool swept) const;
};

/// Options of the rules.
struct LocalMotionOptions {
  std::string rule = "sampled";  ///< row of local_motions()
  double margin_m = 0.03;        ///< room beside the footprint that a motion keeps
  double horizon_s = 2.0;        ///< time for which motions are predicted
  std::int64_t samples = 160;    ///< motions sampled in each round
  std::int64_t rounds = 2;       ///< rounds of sampling in each period
  double wide_m = 0.3;           ///< room beside the footprint beyond which more is worth nothing
  double room_weight = 1.5;      ///< seconds that a second without room costs at full speed
};
std::vector<Option> describe(LocalMotionOptions& options);

class LocalMotion {
 public:
  virtual ~LocalMotion() = default;
  /// Returns the twist to command for a period; none at all if nothing is better than to brake.
  virtual Twist2 choose(const MotionState& state) = 0;

 protected:
  LocalMotion() = default;
  LocalMotion(const LocalMotion&) = default;
  LocalMotion& operator=(const LocalMotion&) = default;
};

struct LocalMotionRow {
  std::string_view name;
  std::string_view sentence;
  std::unique_ptr<LocalMotion> (*make)(const LocalMotionOptions& options);
};
const std::vector<LocalMotionRow>& local_motions();

/// Returns true if the robot enters no keep-out zone and touches nothing that is marked when it is commanded
/// a twist for a period and then brakes: the gap is at least `margin_m` then, or as it is now if that is
/// less. False for a motion backwards where the robot may not. Exact in space, with steps in time between
/// which nothing can be reached. Nor does it come near to what moves, as long as that goes on as it does or
/// stops.
bool can_brake(const MotionState& state, const Twist2& commanded, double margin_m);

}  // namespace outrider
