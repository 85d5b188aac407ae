// SteadyTime: time that goes on steadily although the clock of a robot is set.
//
// A mission that commands a robot until some time expects the next observation then. If the clock has gone
// back since the last observation, or is more than 2 s later than expected, it was set: the observation is
// taken to be as late as expected. All other times are shifted with it. O(1).
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "outrider/robot/command.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

class SteadyTime {
 public:
  /// Returns the observation with steady times, to a nanosecond.
  Observation steady(Observation seen);
  /// Returns the command with the times of the robot's clock.
  Command on_clock(Command command);
  /// Returns how often the clock was set.
  [[nodiscard]] std::int64_t jumps() const { return jumps_; }

 private:
  double note(double clock_s);
  [[nodiscard]] double of(double clock_s) const;

  std::optional<double> clock_s_;  // of the newest observation
  double now_s_ = 0.0;             // the same, steady
  std::optional<double> expected_s_;
  double shift_s_ = 0.0;         // steady time less the clock's
  double shift_before_s_ = 0.0;  // the same before the last jump
  std::int64_t jumps_ = 0;
};

/// A mission on steady time.
template <class M>
struct SteadyMission {
  std::optional<Command> step(const Observation& seen) {
    auto command = mission.step(time.steady(seen));
    return command ? std::optional(time.on_clock(std::move(*command))) : std::nullopt;
  }

  M& mission;
  SteadyTime time;
};
template <class M>
SteadyMission(M&, SteadyTime) -> SteadyMission<M>;

}  // namespace outrider
