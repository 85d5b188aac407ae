#include "outrider/control/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "line_outliers.hpp"
#include "normal_equations.hpp"
#include "outrider/core/units.hpp"
#include "student.hpp"

namespace outrider {
namespace {

/// The component of a pose along a commanded direction; positive if the robot moved as commanded.
double progress(Direction direction, const Pose2& pose) {
  switch (direction) {
    case Direction::ahead: return pose.position.x;
    case Direction::back: return -pose.position.x;
    case Direction::left: return pose.position.y;
    case Direction::right: return -pose.position.y;
    case Direction::counter_clockwise: return pose.heading_rad;
    case Direction::clockwise: return -pose.heading_rad;
  }
  return 0.0;
}

Direction direction_of(const Twist2& command) {
  if (command.ahead_mps != 0.0) return command.ahead_mps > 0.0 ? Direction::ahead : Direction::back;
  if (command.left_mps != 0.0) return command.left_mps > 0.0 ? Direction::left : Direction::right;
  return command.turn_radps > 0.0 ? Direction::counter_clockwise : Direction::clockwise;
}

double size_of(const Twist2& command) {
  return std::abs(command.ahead_mps) + std::abs(command.left_mps) + std::abs(command.turn_radps);
}

bool is_turn(const Twist2& command) { return command.turn_radps != 0.0; }

constexpr double most_turn_rad = radians(300.0);

Status check_run(const Chassis& chassis, const CalibrationRun& run) {
  const int parts = (run.command.ahead_mps != 0.0 ? 1 : 0) + (run.command.left_mps != 0.0 ? 1 : 0) +
                    (run.command.turn_radps != 0.0 ? 1 : 0);
  if (parts != 1) {
    return bad_input(
        fmt::format("the run is commanded in {} directions at once; a run goes ahead, back, to a "
                    "side or turns in place",
                    parts),
        run.where);
  }
  if (run.command.left_mps != 0.0 && !chassis.moves_sideways()) {
    return bad_input(fmt::format("a {} chassis does not move sideways; leave the run out", chassis.kind),
                     run.where);
  }
  if (!(run.time_s > 0.0)) {
    return bad_input(fmt::format("the run takes {:g} s; a run takes more than 0 s", run.time_s), run.where);
  }
  if (!is_turn(run.command) && std::abs(run.start_T_end.heading_rad) >= most_turn_rad) {
    return bad_input(fmt::format("the straight run turns by {:.0f} degrees; expected less than 300",
                                 degrees(run.start_T_end.heading_rad)),
                     run.where);
  }
  return {};
}

/// The twist of a run times its duration. A turn by more than most_turn_rad has no arc; its chord stands for
/// it.
Twist2 arc_of(const CalibrationRun& run) {
  const Pose2& end = run.start_T_end;
  if (std::abs(end.heading_rad) >= most_turn_rad) return {end.position.x, end.position.y, end.heading_rad};
  return twist_between({}, end, 1.0);
}

/// The distance or angle of a run. A straight counts the length of its arc, not of the chord.
double measured(const CalibrationRun& run) {
  const Direction direction = direction_of(run.command);
  if (is_turn(run.command)) return progress(direction, run.start_T_end);
  const Twist2 arc = twist_between({}, run.start_T_end, 1.0);
  return progress(direction, {{arc.ahead_mps, arc.left_mps}, 0.0});
}

Outcome<FittedLaw> fit_law(const std::vector<const CalibrationRun*>& runs) {
  FittedLaw law;
  const CalibrationRun& first = *runs.front();
  law.direction = direction_of(first.command);
  law.command = size_of(first.command);
  for (const CalibrationRun* run : runs) law.points.push_back({run->time_s, measured(*run)});
  const auto n = static_cast<double>(law.points.size());
  Vec2 mean;
  for (const Vec2 p : law.points) mean = mean + (1.0 / n) * p;
  double product = 0.0;
  for (const Vec2 p : law.points) {
    law.time_square_sum += (p.x - mean.x) * (p.x - mean.x);
    product += (p.x - mean.x) * (p.y - mean.y);
  }
  if (law.points.size() < 3 || !(law.time_square_sum > 1e-9)) {
    return bad_input(
        fmt::format("there are {} runs like this one ({} at {:.4g}){}; a law needs at least 3, of "
                    "different times",
                    law.points.size(), to_string(law.direction),
                    is_turn(first.command) ? degrees(law.command) : law.command,
                    law.points.size() < 3 ? "" : ", all of one time"),
        first.where);
  }
  law.mean_time_s = mean.x;
  law.slope.value = product / law.time_square_sum;
  law.offset.value = mean.y - law.slope.value * mean.x;
  double square = 0.0;
  for (const Vec2 p : law.points) {
    const double left = p.y - law.offset.value - law.slope.value * p.x;
    square += left * left;
  }
  law.residual_sd = std::sqrt(square / (n - 2.0));
  law.slope.half_width =
      student_quantile(law.points.size() - 2) * law.residual_sd / std::sqrt(law.time_square_sum);
  law.offset.half_width = confidence_half_width(law, 0.0);
  if (!(law.slope.value > 0.0)) {
    return bad_input(
        fmt::format("by its runs the robot does not go {} when it is told to; are the signs right?",
                    to_string(law.direction)),
        first.where);
  }
  return law;
}

using Group = std::vector<const CalibrationRun*>;

/// Groups the runs by direction and speed.
std::vector<Group> groups_of(const std::vector<CalibrationRun>& runs) {
  Group sorted;
  for (const CalibrationRun& run : runs) sorted.push_back(&run);
  const auto key = [](const CalibrationRun* run) {
    return std::pair{direction_of(run->command), size_of(run->command)};
  };
  std::ranges::sort(sorted, {}, [&](const CalibrationRun* run) { return std::pair{key(run), run}; });
  std::vector<Group> groups;
  for (const CalibrationRun* run : sorted) {
    if (groups.empty() || key(groups.back().front()) != key(run)) groups.emplace_back();
    groups.back().push_back(run);
  }
  return groups;
}

/// Says by how much a run is off the others.
std::string misfit_sentence(const CalibrationRun& run, const Twist2& off, const std::array<bool, 3>& fits,
                            std::size_t others) {
  std::vector<std::string> parts;
  if (!fits[0]) parts.push_back(fmt::format("{:+.3f} m ahead", off.ahead_mps));
  if (!fits[1]) parts.push_back(fmt::format("{:+.3f} m to the left", off.left_mps));
  if (!fits[2]) parts.push_back(fmt::format("{:+.1f} degrees", degrees(off.turn_radps)));
  return fmt::format(
      "the run ended {} off the law of the other {} runs {} at {:.4g}; it is left out. Is it mistyped?",
      fmt::join(parts, " and "), others, to_string(direction_of(run.command)),
      is_turn(run.command) ? degrees(size_of(run.command)) : size_of(run.command));
}

/// Moves the runs that do not fit the others of their group to `left_out`. With a constant twist all three
/// components of twist * time are linear in time, whatever gains and dead time are.
Status leave_out(Group& group, std::vector<LeftOutRun>& left_out) {
  constexpr double exact = 1e-6;        // m or rad
  constexpr std::size_t most_part = 5;  // at most a fifth of the runs
  std::array<std::vector<Vec2>, 3> points;
  for (const CalibrationRun* run : group) {
    const Twist2 way = arc_of(*run);
    points[0].push_back({run->time_s, way.ahead_mps});
    points[1].push_back({run->time_s, way.left_mps});
    points[2].push_back({run->time_s, way.turn_radps});
  }
  std::array<std::vector<LineFit>, 3> fits;
  for (std::size_t part = 0; part < 3; ++part) fits[part] = fit_to_line(points[part], exact);
  Group kept;
  std::vector<LeftOutRun> found;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::array<bool, 3> fit = {fits[0][i].fits, fits[1][i].fits, fits[2][i].fits};
    if (fit[0] && fit[1] && fit[2]) {
      kept.push_back(group[i]);
      continue;
    }
    const Twist2 off{fits[0][i].off, fits[1][i].off, fits[2][i].off};
    found.push_back({group[i]->where, misfit_sentence(*group[i], off, fit, group.size() - 1)});
  }
  if (most_part * found.size() > group.size()) {
    return bad_input(
        fmt::format("{} of {} runs {} do not fit one law, this one first; are times and ends right?",
                    found.size(), group.size(), to_string(direction_of(group.front()->command))),
        found.front().where);
  }
  left_out.insert(left_out.end(), found.begin(), found.end());
  group = std::move(kept);
  return {};
}

/// Sets each direction to the mean of its laws, weighted by runs; without a law it keeps gain 1 and no dead
/// time.
void take_directions(Calibration& calibration, const std::vector<FittedLaw>& laws) {
  for (std::size_t d = 0; d < directions; ++d) {
    double runs = 0.0, gain = 0.0, dead_time_s = 0.0;
    for (const FittedLaw& law : laws) {
      if (static_cast<std::size_t>(law.direction) != d) continue;
      const auto n = static_cast<double>(law.points.size());
      runs += n;
      gain += n * law.slope.value / law.command;
      dead_time_s -= n * law.offset.value / law.slope.value;
    }
    if (runs > 0.0) calibration.laws[d] = {gain / runs, dead_time_s / runs};
  }
}

/// Adds the three equations of a run in the wheel gains, in m/s and, at a radius of 1 m, rad/s.
void add_run(NormalEquations& equations, const Chassis& chassis, const Calibration& calibration,
             const CalibrationRun& run) {
  if (std::abs(run.start_T_end.heading_rad) >= most_turn_rad) return;  // the arc says nothing of its chord
  const double dead_time_s =
      calibration.laws[static_cast<std::size_t>(direction_of(run.command))].dead_time_s;
  if (!(run.time_s > 1.5 * dead_time_s)) return;
  const Twist2 body = twist_between({}, run.start_T_end, run.time_s - dead_time_s);
  const Twist2 seen = {body.ahead_mps / ahead_law(calibration, body.ahead_mps).gain,
                       body.left_mps / left_law(calibration, body.left_mps).gain,
                       body.turn_radps / turn_law(calibration, body.turn_radps).gain};
  const WheelSpeeds4 speeds = wheel_speeds(chassis, run.command);
  const auto wheels = static_cast<Eigen::Index>(chassis.wheels.size());
  NormalEquations::Vector ahead(wheels), left(wheels), turn(wheels);
  for (std::size_t i = 0; i < chassis.wheels.size(); ++i) {
    WheelSpeeds4 alone{};
    alone[i] = speeds[i];
    const Twist2 part = twist_of(chassis, alone);
    const auto wheel = static_cast<Eigen::Index>(i);
    ahead[wheel] = part.ahead_mps;
    left[wheel] = part.left_mps;
    turn[wheel] = part.turn_radps;
  }
  equations.add(ahead, seen.ahead_mps - run.command.ahead_mps);
  if (chassis.moves_sideways()) equations.add(left, seen.left_mps - run.command.left_mps);
  equations.add(turn, seen.turn_radps - run.command.turn_radps);
}

void take_wheels(CalibrationFit& fit, const Chassis& chassis, const std::vector<Group>& groups) {
  const std::size_t wheels = chassis.wheels.size();
  NormalEquations equations(wheels);
  for (const Group& group : groups) {
    for (const CalibrationRun* run : group) add_run(equations, chassis, fit.calibration, *run);
  }
  const auto [gains, deviations] = equations.solve_with_mean_zero();
  const std::size_t unknown = wheels - 1;
  const std::size_t rest = equations.rows() > unknown ? equations.rows() - unknown : 0;
  for (std::size_t i = 0; i < wheels; ++i) {
    const auto wheel = static_cast<Eigen::Index>(i);
    fit.calibration.wheels[i] = 1.0 + gains[wheel];
    const double half_width =
        rest > 0 ? student_quantile(rest) * deviations[wheel] : std::numeric_limits<double>::infinity();
    fit.wheels.push_back({1.0 + gains[wheel], half_width});
  }
}

}  // namespace

Outcome<CalibrationFit> calibrate(const Chassis& chassis, const std::vector<CalibrationRun>& runs) {
  if (runs.empty()) return bad_input("there are no runs; record at least 3 of a direction");
  for (const CalibrationRun& run : runs) {
    if (auto ok = check_run(chassis, run); !ok) return pass_on(ok);
  }
  CalibrationFit fit;
  std::vector<Group> groups = groups_of(runs);
  for (Group& group : groups) {
    if (auto ok = leave_out(group, fit.left_out); !ok) return pass_on(ok);
    auto law = fit_law(group);
    if (!law) return pass_on(law);
    fit.laws.push_back(std::move(*law));
  }
  take_directions(fit.calibration, fit.laws);
  take_wheels(fit, chassis, groups);
  return fit;
}

double confidence_half_width(const FittedLaw& law, double time_s) {
  const auto n = static_cast<double>(law.points.size());
  const double off = time_s - law.mean_time_s;
  return student_quantile(law.points.size() - 2) * law.residual_sd *
         std::sqrt(1.0 / n + off * off / law.time_square_sum);
}

double student_quantile(std::size_t degrees_of_freedom) {
  constexpr double exact[] = {12.706204736174698, 4.302652729749464};
  if (degrees_of_freedom <= 2) return exact[degrees_of_freedom == 2 ? 1 : 0];
  constexpr double z = 1.959963984540054;
  return student_value(z, degrees_of_freedom);
}

}  // namespace outrider
