#include "goal_drive.hpp"

#include <optional>

#include "outrider/core/units.hpp"

namespace outrider::bench {

NavigatorSetup jackal(const std::string& rule) {
  NavigatorSetup setup;
  setup.robot.speed_mps = 2.0;
  setup.robot.acceleration_mps2 = 5.0;
  setup.robot.turn_rate_radps = 1.57;
  setup.robot.turn_acceleration_radps2 = 10.0;
  setup.robot.height_m = 0.25;
  setup.footprint = Footprint({{{-0.21, -0.165}, {0.21, -0.165}, {0.21, 0.165}, {-0.21, 0.165}}, 0.0});
  setup.robot.radius_m = setup.footprint.outer_m();
  setup.robot_T_laser = {{-0.065, 0.0}, 0.0};
  setup.motion.rule = rule;
  return setup;
}

ExplorerSimParams jackal_devices(const NavigatorSetup& setup) {
  ExplorerSimParams params;
  params.laser = {.beams = 960,
                  .view_rad = radians(270.0),
                  .rate_hz = 40.0,
                  .least_m = 0.1,
                  .most_m = 10.0,
                  .noise_m = 0.01,
                  .height_m = 0.2,
                  .robot_T_laser = setup.robot_T_laser};
  params.wheels = {.track_m = 0.37, .climbs_m = 0.05, .scale_error = 0.02, .noise_m = 0.002};
  params.faults.slip = 0.01;
  params.footprint = setup.footprint;
  return params;
}

GoalRun run(const GoalDrive& drive, std::uint64_t seed) {
  SimulatedRobot robot = simulated_explorer(drive.world, drive.start, drive.setup.robot, drive.devices, seed);
  auto navigator =
      Navigator::make(drive.setup, drive.start_unknown ? std::nullopt : std::optional(drive.start));
  GoalRun run;
  if (!navigator) {
    run.why = to_string(navigator.error());
    return run;
  }
  const auto& body = robot.body<TwistBody>();
  const GoTo order{drive.goal, drive.aimed_m};
  std::optional<double> set_off_s, located_m;
  bool asked = false;
  while (robot.time_s() < drive.limit_s && !run.done && !run.touched && !run.claims) {
    const Situation now = navigator->perceive(robot.sense());
    run.claims = asked && now.progress.state == Progress::State::arrived;
    run.why = now.progress.why;
    run.lost = now.progress.state == Progress::State::lost;
    if (!run.why.empty()) break;
    robot.act(navigator->act(order));
    asked = true;
    if (!set_off_s && body.driven_m() > drive.set_off_m) set_off_s = robot.time_s();
    if (!located_m && navigator->is_located()) located_m = body.driven_m();
    run.touched = body.contacts() > 0;
    const bool near = distance(body.pose().position, drive.goal) < drive.reached_m;
    run.done = !run.touched && near && (drive.ends_when_near || run.claims);
  }
  run.walked_into = body.walked_into();
  run.time_s = robot.time_s() - set_off_s.value_or(0.0);
  run.driven_m = body.driven_m();
  run.located_m = located_m.value_or(-1.0);
  return run;
}

Status check_rules(const std::vector<std::string>& rules) {
  for (const std::string& rule : rules) {
    if (const auto row = find_row(local_motions(), "rule of motion", rule, "--rules"); !row)
      return pass_on(row);
  }
  return {};
}

}  // namespace outrider::bench
