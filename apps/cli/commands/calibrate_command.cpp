#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "flags.hpp"
#include "output/calibration_picture.hpp"
#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/core/units.hpp"
#include "outrider/io/log/calibration_runs.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/jobs/drive/run.hpp"

namespace outrider::cli {
namespace {

struct CalibrateCommand {
  std::string runs_path;
  bool json = false;
  std::string out;
  std::string record;
  std::int64_t repeats = 5;
  std::int64_t seed = 1;
  double measured_m = 0.002;
  double measured_rad = radians(0.3);
  std::string chassis = "mecanum";
  double wheel_radius_m = 0.03;
  double wheel_reach_m = 0.1225;
};

std::vector<OptionGroup> describe(CalibrateCommand& command) {
  return {
      {"",
       "output",
       {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
        {"out", "", 0, 0, "folder for calibration.yaml, a picture, and the runs where they are recorded",
         &command.out}}},
      {"",
       "the robot",
       {{"chassis", "", 0, 0, "mecanum, differential or holonomic", &command.chassis},
        {"wheel_radius", "m", 1e-3, 10.0, "of every wheel", &command.wheel_radius_m},
        {"wheel_reach", "m", 1e-3, 10.0,
         "half length plus half width (mecanum), half track (differential), or middle to wheel (holonomic)",
         &command.wheel_reach_m}}},
      {"",
       "recording",
       {{"record", "", 0, 0, "scenario of a drive, whose simulated robot makes the runs", &command.record},
        {"repeats", "", 1, 100, "runs of each direction and time", &command.repeats},
        {"measured", "m", 0.0, 1.0, "error with which the end of a run is measured", &command.measured_m},
        {"measured_angle", "deg", 0.0, 30.0, "error of its heading", &command.measured_rad},
        {"seed", "", 0, 1e15, "seed of every random number", &command.seed}}}};
}

struct Recorded {
  Chassis chassis;
  std::vector<CalibrationRun> runs;
};

/// Returns the runs from the file, or records them by driving the simulated robot.
Outcome<Recorded> runs_of(const CalibrateCommand& command) {
  if (command.record.empty()) {
    auto chassis = make_chassis(command.chassis, command.wheel_radius_m, command.wheel_reach_m);
    if (!chassis) return pass_on(chassis);
    auto runs = load_calibration_runs(command.runs_path);
    if (!runs) return pass_on(runs);
    return Recorded{std::move(*chassis), std::move(*runs)};
  }
  DriveJob job;
  if (auto ok = read_scenario(job, command.record); !ok) return pass_on(ok);
  job.scenario.calibration.clear();
  auto setup = load_wheel_drive(job.scenario);
  if (!setup) return pass_on(setup);
  auto runs = record_runs(setup->task, setup->sim, static_cast<int>(command.repeats), command.measured_m,
                          command.measured_rad, static_cast<std::uint64_t>(command.seed));
  return Recorded{std::move(setup->task.chassis), std::move(runs)};
}

Status write_files(const CalibrateCommand& command, const Recorded& recorded, CalibrationFit fit) {
  std::vector<NamedText> files = {{"calibration.svg", calibration_picture(fit, recorded.chassis)},
                                  {"calibration.yaml", scenario_text(describe(fit.calibration))}};
  if (!command.record.empty()) files.emplace_back("runs.csv", calibration_runs_text(recorded.runs));
  return cli::write_files(command.out, files);
}

bool is_turn(const FittedLaw& law) {
  return law.direction == Direction::counter_clockwise || law.direction == Direction::clockwise;
}

void print_text(const CalibrationFit& fit, const Chassis& chassis) {
  show("distance = a t + b, angle = a t + b, with 95 % confidence\n\n");
  for (const FittedLaw& law : fit.laws) {
    const double unit = is_turn(law) ? degrees(1.0) : 1.0;
    const char* name = is_turn(law) ? "deg" : "m";
    show("  {:<18} a {:>8.4f} +- {:.4f} {}/s   b {:>8.4f} +- {:.4f} {}   commanded {:.4g}, {} runs\n",
         to_string(law.direction), unit * law.slope.value, unit * law.slope.half_width, name,
         unit * law.offset.value, unit * law.offset.half_width, name, unit * law.command, law.points.size());
  }
  show("\ngains of the wheels, relative to their mean\n\n");
  for (std::size_t i = 0; i < fit.wheels.size(); ++i) {
    const Estimate95& gain = fit.wheels[i];
    show("  {:<18} {}\n", chassis.wheels[i].name,
         std::isfinite(gain.half_width) ? fmt::format("{:.4f} +- {:.4f}", gain.value, gain.half_width)
                                        : "not told by these runs");
  }
}

nlohmann::ordered_json estimate_json(const Estimate95& estimate) {
  nlohmann::ordered_json half = nullptr;
  if (std::isfinite(estimate.half_width)) half = estimate.half_width;
  return {{"value", estimate.value}, {"half_width", half}};
}

nlohmann::ordered_json fit_json(const CalibrationFit& fit, const Chassis& chassis) {
  auto laws = nlohmann::ordered_json::array();
  for (const FittedLaw& law : fit.laws) {
    laws.push_back({{"direction", to_string(law.direction)},
                    {"command", law.command},
                    {"unit", is_turn(law) ? "rad" : "m"},
                    {"a", estimate_json(law.slope)},
                    {"b", estimate_json(law.offset)},
                    {"spread", law.residual_sd},
                    {"runs", law.points.size()}});
  }
  auto wheels = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < fit.wheels.size(); ++i) {
    wheels.push_back({{"wheel", chassis.wheels[i].name}, {"gain", estimate_json(fit.wheels[i])}});
  }
  auto directions_list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < directions; ++i) {
    const DirectionLaw& law = fit.calibration.laws[i];
    directions_list.push_back({{"direction", to_string(static_cast<Direction>(i))},
                               {"gain", law.gain},
                               {"dead_time_s", law.dead_time_s}});
  }
  auto left_out = nlohmann::ordered_json::array();
  for (const LeftOutRun& run : fit.left_out)
    left_out.push_back({{"where", run.where}, {"reason", run.sentence}});
  return {{"status", "done"},
          {"laws", laws},
          {"directions", directions_list},
          {"wheels", wheels},
          {"left_out", left_out}};
}

int execute(CalibrateCommand& command, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, describe(command)); !ok) return print_fault(ok.error(), json);
  if (flags.given("runs") == flags.given("--record")) {
    return print_fault({FaultCode::bad_input, "give a file of runs, or --record and a scenario", "runs"},
                       json);
  }
  if (flags.given("--out")) {
    if (auto ok = check_folder(command.out); !ok) return print_fault(ok.error(), json);
  }
  const auto recorded = runs_of(command);
  if (!recorded) return print_fault(recorded.error(), json);
  const auto fit = calibrate(recorded->chassis, recorded->runs);
  if (!fit) return print_fault(fit.error(), json);
  for (const LeftOutRun& run : fit->left_out) warn(fmt::format("{}: {}", run.where, run.sentence));
  if (flags.given("--out")) {
    if (auto ok = write_files(command, *recorded, *fit); !ok) return print_fault(ok.error(), json);
  }
  if (json) {
    print(fit_json(*fit, recorded->chassis));
    return job_done;
  }
  print_text(*fit, recorded->chassis);
  if (flags.given("--out")) {
    show("\n  keep     {0}/calibration.yaml\n  picture  {0}/calibration.svg\n", command.out);
  }
  return job_done;
}

}  // namespace

void add_calibrate(Command& tool) {
  Command& calibrate = tool.add("calibrate", "fit how a robot answers to its commands, from recorded runs");
  auto command = std::make_shared<CalibrateCommand>();
  calibrate.positional("runs", &command->runs_path, "recorded runs, CSV; may be gzip-compressed")
      .type("FILE");
  add_flags(calibrate, describe(*command));
  calibrate.does([command](const Command& flags) { return execute(*command, flags); });
  calibrate.footer("\nExample: outrider calibrate scenarios/waypoints/runs.csv --out out");
}

}  // namespace outrider::cli
