// Mission: a state machine that answers each observation with a command; run_mission() is the loop that runs
// it on a robot.
#pragma once

#include <concepts>
#include <optional>
#include <stop_token>

#include "outrider/robot/robot.hpp"

namespace outrider {

/// A type with `step(observation)`, which returns the next command, or nothing when the mission is over.
/// step() has no effect outside the mission object.
template <class M>
concept Mission = requires(M& mission, const Observation& seen) {
  { mission.step(seen) } -> std::same_as<std::optional<Command>>;
};

/// Runs a mission on a robot. The loop senses, steps the mission, calls `note` and acts, until the mission
/// returns no command. `note(seen, command)` is for recording and display and must not change anything; it
/// is called after every step, and after the last one `command` is null.
/// Returns false if the stop token ended the run; the command of the last step was not carried out then.
template <Mission M, class Note>
bool run_mission(M& mission, Robot& robot, const std::stop_token& stop, const Note& note) {
  for (;;) {
    const Observation seen = robot.sense();
    const std::optional<Command> command = mission.step(seen);
    note(seen, command ? &*command : nullptr);
    if (!command) return true;
    if (stop.stop_requested()) return false;
    robot.act(*command);
  }
}

}  // namespace outrider
