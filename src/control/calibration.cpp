#include "outrider/control/calibration.hpp"

namespace outrider {
namespace {

constexpr std::string_view names[directions] = {"ahead",    "back", "left", "right", "counter_clockwise",
                                                "clockwise"};

const DirectionLaw& law(const Calibration& calibration, Direction direction) {
  return calibration.laws[static_cast<std::size_t>(direction)];
}

}  // namespace

std::string_view to_string(Direction direction) { return names[static_cast<std::size_t>(direction)]; }

std::vector<OptionGroup> describe(Calibration& calibration) {
  OptionGroup wheels{
      "wheels", "gains of the wheels, relative to their mean, in the order of the chassis", {}};
  for (std::size_t i = 0; i < most_wheels; ++i) {
    wheels.options.push_back({"wheel_" + std::to_string(i + 1), "", 0.1, 10.0, "speed by commanded speed",
                              &calibration.wheels[i]});
  }
  OptionGroup laws{"laws", "how the body moves when it is commanded to move in one direction", {}};
  for (std::size_t i = 0; i < directions; ++i) {
    const std::string name(names[i]);
    laws.options.push_back(
        {name + "_gain", "", 0.1, 10.0, "speed by commanded speed", &calibration.laws[i].gain});
    laws.options.push_back({name + "_dead_time", "s", -5.0, 5.0,
                            "part of a command in which it does not move", &calibration.laws[i].dead_time_s});
  }
  return {wheels, laws};
}

const DirectionLaw& ahead_law(const Calibration& calibration, double ahead_mps) {
  return law(calibration, ahead_mps < 0.0 ? Direction::back : Direction::ahead);
}
const DirectionLaw& left_law(const Calibration& calibration, double left_mps) {
  return law(calibration, left_mps < 0.0 ? Direction::right : Direction::left);
}
const DirectionLaw& turn_law(const Calibration& calibration, double turn_radps) {
  return law(calibration, turn_radps < 0.0 ? Direction::clockwise : Direction::counter_clockwise);
}

WheelSpeeds4 commanded_wheels(const Chassis& chassis, const Calibration& calibration, const Twist2& wanted) {
  const Twist2 raised = {wanted.ahead_mps / ahead_law(calibration, wanted.ahead_mps).gain,
                         wanted.left_mps / left_law(calibration, wanted.left_mps).gain,
                         wanted.turn_radps / turn_law(calibration, wanted.turn_radps).gain};
  WheelSpeeds4 speeds = wheel_speeds(chassis, raised);
  for (std::size_t i = 0; i < chassis.wheels.size(); ++i) speeds[i] /= calibration.wheels[i];
  return speeds;
}

}  // namespace outrider
