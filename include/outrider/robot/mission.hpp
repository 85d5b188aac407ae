// Mission: a value that makes a command of each observation; and the one loop that runs it.
#pragma once

#include <concepts>
#include <optional>
#include <stop_token>

#include "outrider/robot/robot.hpp"

namespace outrider {

/// step() returns the next command, or nothing when the mission is over. It changes the mission only.
template <class M>
concept Mission = requires(M& mission, const Observation& seen) {
  { mission.step(seen) } -> std::same_as<std::optional<Command>>;
};

/// Runs a mission on a robot: sense, step, note, act, until the mission gives no command. `note(seen,
/// command)` is called after each step, also after the last one, with a null pointer for its command; it
/// records and shows, and changes nothing. Returns false when the stop token ended the run: then the command
/// of the last step was not carried out.
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
