// NavigatedBody: a robot on two wheels, with a bumper and a range finder, which its navigator takes to places
// and lets stand there.
//
// It is driven by the twists of the navigator alone (navigate/navigator.hpp), around what no map has, and
// believes to be where the navigator localises it. Each step is a period of the navigator.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>

#include "outrider/ballistics/stance.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/sim/bodies/twist_body.hpp"
#include "outrider/sim/faults/explorer_sim_params.hpp"
#include "outrider/sim/sensors/simulated_laser.hpp"

namespace outrider {

class NavigatedBody {
 public:
  /// Receives the observation with which a period of the navigator begins, and the situation.
  using Look = std::function<void(const Observation&, const Situation&, const Navigator&)>;

  /// It stands at the start. A drive has arrived `within_m` of its goal.
  NavigatedBody(std::unique_ptr<const World> world, const Pose2& start, const RobotModel& robot,
                const ExplorerSimParams& params, std::uint64_t seed, Navigator navigator, double within_m);

  /// Lets a watcher see each period, and ends drives that it stops.
  void watch(Look look, std::stop_token stop);

  void begin_way() { why_stopped_.clear(); }
  /// Drives to a place, and stands there in the end; `goes_on` is asked after each period.
  void drive_to(Vec2 place, const std::function<bool()>& goes_on);
  void wait_until(double time_s) { go(Hold{}, time_s); }
  /// Carries an order out until that time.
  void go(const Order& order, double until_s);
  /// Returns why the last drive ended before its goal; empty if it did not.
  [[nodiscard]] const std::string& why_stopped() const { return why_stopped_; }

  [[nodiscard]] double time_s() const { return body_.time_s(); }
  [[nodiscard]] const Pose2& pose() const { return body_.pose(); }        ///< true world_T_robot
  [[nodiscard]] const Pose2& believed_pose() const { return now_.pose; }  ///< as localised
  [[nodiscard]] const World& world() const { return *world_; }
  [[nodiscard]] const LiveMap& map() const { return navigator_.map(); }
  [[nodiscard]] double driven_m() const { return body_.driven_m(); }
  [[nodiscard]] double turned_rad() const { return body_.turned_rad(); }
  /// Returns how far from its goal it may be when it believes to have arrived.
  [[nodiscard]] double position_error_m() const { return 2.0 * within_m_; }
  [[nodiscard]] double belief_error_m() const { return belief_error_m_; }  ///< the largest so far
  [[nodiscard]] std::int64_t recoveries() const { return recoveries_; }
  [[nodiscard]] const TwistBody& wheels() const { return body_; }
  [[nodiscard]] Stance stance_on(Vec2, Vec2, double) const { return {}; }  ///< the floor is level

  /// Returns true if somebody has put the robot elsewhere since it was asked before.
  bool suffer() { return std::exchange(was_put_, false); }

  // Commands take no time before they are carried out.
  double begin(const Command&) const { return time_s(); }
  void run_until(double) {}
  [[nodiscard]] Twist2 twist() const { return body_.twist(); }

 private:
  void perceive();
  void carry_out(const Order& order, double until_s);

  std::unique_ptr<const World> world_;
  TwistBody body_;
  SimulatedLaser laser_;
  Navigator navigator_;
  double within_m_;
  Kidnapping kidnapping_;
  bool kidnapped_ = false, was_put_ = false;
  Situation now_;
  std::string why_stopped_;
  double belief_error_m_ = 0.0;
  std::int64_t recoveries_ = 0;
  Look look_;
  std::stop_token stop_;
};

}  // namespace outrider
