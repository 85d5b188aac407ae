#include "outrider/io/guard_scenario.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>

#include "outrider/io/arrivals.hpp"
#include "outrider/io/sdf.hpp"
#include "outrider/io/targets.hpp"

namespace outrider {
namespace {

constexpr double most_m = 1e6;

Outcome<Pose2> start_pose(const GuardScenario& scenario) {
  auto numbers =
      parse_numbers(scenario.start, 3, "start", "x,y,heading in m, m and degrees, such as 0,-9.5,90");
  if (!numbers) return pass_on(numbers);
  return Pose2{{(*numbers)[0], (*numbers)[1]}, wrap_angle(radians((*numbers)[2]))};
}

Outcome<Box2> bounds_of(const GuardScenario& scenario, const Box2& walls) {
  if (scenario.bounds.empty()) return walls;
  auto n =
      parse_numbers(scenario.bounds, 4, "bounds", "low x,low y,high x,high y in m, such as -10,-10,10,10");
  if (!n) return pass_on(n);
  const Box2 box{{(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]}};
  if (box.size().x <= 0.0 || box.size().y <= 0.0) {
    return bad_input(fmt::format("'{}' is empty; the low corner comes first", scenario.bounds), "bounds");
  }
  return box;
}

Status need(const std::string& value, const std::string& key, const std::string& what) {
  if (!value.empty()) return {};
  return bad_input(fmt::format("missing; give {}", what), key);
}

}  // namespace

std::vector<OptionGroup> describe(GuardScenario& scenario) {
  GuardProblem& problem = scenario.problem;
  return {
      {"",
       "the mission",
       {{"job", "", 0, 0, "what the robot does; guard", &scenario.job},
        {"world", "", 0, 0, "SDF file of the yard", &scenario.world},
        {"targets", "", 0, 0, "file of targets, one a line: type=T x= y= [z=] [rz=]", &scenario.targets},
        {"start", "", 0, 0, "x,y,heading of the robot at first, m, m and degrees", &scenario.start},
        {"bounds", "", 0, 0, "low x,low y,high x,high y of the yard, m; empty: the box of its walls",
         &scenario.bounds},
        {"seed", "", 0, 1e15, "seed of every random number", &scenario.seed},
        {"targets_block", "", 0, 0, "targets stop the robot and the shots at other targets",
         &problem.targets_block},
        {"tries", "", 1, 100, "shots at a target before it has failed", &problem.tries}}},
      {"robot", "the robot", describe(problem.robot)},
      {"gun", "the water gun", describe(problem.gun)},
      {"errors", "the largest errors of the execution", describe(problem.errors)},
      {"plan", "the planner", describe(scenario.options)},
      {"arrivals", "intruders that keep coming", describe(scenario.arrivals)},
  };
}

void resolve_paths(GuardScenario& scenario, const std::string& scenario_path) {
  const auto folder = std::filesystem::path(scenario_path).parent_path();
  for (std::string* path : {&scenario.world, &scenario.targets, &scenario.arrivals.list}) {
    if (!path->empty()) *path = (folder / *path).lexically_normal().string();
  }
}

Outcome<std::vector<std::string>> load_problem(GuardScenario& scenario) {
  if (scenario.job != "guard") {
    return bad_input(fmt::format("'{}' is not a job of this scenario; the job is guard", scenario.job),
                     "job");
  }
  if (auto ok = need(scenario.world, "world", "the SDF file of the yard"); !ok) return pass_on(ok);
  if (auto ok = need(scenario.targets, "targets", "the file of the targets"); !ok) return pass_on(ok);
  if (scenario.problem.gun.pitch_low_rad > scenario.problem.gun.pitch_high_rad) {
    return bad_input("the lowest pitch is above the highest; swap them", "gun.pitch_low");
  }
  auto start = start_pose(scenario);
  if (!start) return pass_on(start);
  auto loaded = load_sdf(scenario.world);
  if (!loaded) return pass_on(loaded);
  auto bounds = bounds_of(scenario, loaded->world.bounds);
  if (!bounds) return pass_on(bounds);
  auto targets = load_targets(scenario.targets);
  if (!targets) return pass_on(targets);

  scenario.problem.start = *start;
  scenario.problem.world = std::move(loaded->world);
  scenario.problem.world.bounds = *bounds;
  scenario.problem.targets = std::move(*targets);
  auto intruders =
      load_arrivals(scenario.problem, scenario.arrivals, static_cast<std::uint64_t>(scenario.seed));
  if (!intruders) return pass_on(intruders);
  scenario.intruders = std::move(*intruders);
  return std::move(loaded->warnings);
}

Outcome<std::vector<double>> parse_numbers(const std::string& text, std::size_t count,
                                           const std::string& where, const std::string& form) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (numbers.size() < count) {
    while (at != end && *at == ' ') ++at;
    double number = 0.0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || !std::isfinite(number) || std::abs(number) > most_m) break;
    numbers.push_back(number);
    at = next;
    while (at != end && *at == ' ') ++at;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (numbers.size() != count || at != end) {
    return bad_input(fmt::format("'{}' is no good; it takes {}", text, form), where);
  }
  return numbers;
}

}  // namespace outrider
