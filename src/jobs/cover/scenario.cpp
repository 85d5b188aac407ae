#include "outrider/jobs/cover/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "outrider/core/units.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/map/cover_area.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/jobs/cover/ground/saved_map.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"

namespace outrider {
namespace {

constexpr double least_tracking_error_m = 0.01;  // of a robot that is steered

Outcome<Units> units_of(const CoverScenario& scenario) {
  if (scenario.units == "auto") return Units::told_by_size;
  if (scenario.units == "degrees") return Units::degrees;
  if (scenario.units == "metres") return Units::metres;
  return bad_input(
      fmt::format("'{}' are no units; expected auto, degrees or metres", excerpt(scenario.units)), "units");
}

Status check_names(const CoverScenario& scenario) {
  if (scenario.area.empty())
    return bad_input("missing; give the file of the polygon to cover, or a saved map", "area");
  return {};
}

/// Checks that the navigator can drive the robot, and that what it needs is asked for with it only.
Status check_sim(const CoverScenario& scenario) {
  const CoverProblem& problem = scenario.problem;
  if (scenario.sim != "navigator") {
    const ExplorerFaults& faults = scenario.navigation.faults;
    const char* asked = !scenario.things.empty() ? "things" : faults.any() ? "faults" : nullptr;
    if (asked == nullptr) return {};
    return bad_input("a track that is driven as it is meets nothing; give sim: navigator, or leave it out",
                     asked);
  }
  if (problem.bar() || problem.curves() || problem.transfers)
    return bad_input(
        fmt::format("'navigator' drives a disk that turns in place, on one area; leave {} out, or give sim: "
                    "ideal",
                    problem.bar()      ? "the bar"
                    : problem.curves() ? "the turning_radius"
                                       : "the transfers"),
        "sim");
  if (problem.tracking_error_m < least_tracking_error_m)
    return bad_input(
        fmt::format(
            "'{:g}' is not valid; a robot that is steered is up to {:g} m beside its track: give that, "
            "and an overlap for it",
            problem.tracking_error_m, least_tracking_error_m),
        "tracking_error");
  if (scenario.navigation.navigator.localiser == "laser_on_map")
    return bad_input("'laser_on_map' needs a map of cells; take exact, odometry or laser_mapping",
                     "navigator.localiser");
  return check(scenario.navigation.laser);
}

/// Reads the area: the free space of a saved map, or polygons. `start` is in its coordinates.
Outcome<CoverArea> load_area(const CoverScenario& scenario, Units units, const std::optional<Pose2>& start) {
  auto map = saved_map(scenario.area);
  if (!map) return pass_on(map);
  if (!*map) return load_cover_area(scenario.area, units);
  if (units == Units::degrees) return bad_input("a saved map is in metres; leave units at auto", "units");
  if (scenario.problem.transfers) {
    return bad_input(
        "between the parts of a saved map are walls, through which no transfer leads; leave it out",
        "transfers");
  }
  return area_of_map(**map, scenario.area, map_options(scenario, start));
}

}  // namespace

NavigationOptions CoverScenario::default_navigation() {
  constexpr double never_s = 1e6;
  NavigationOptions options;
  options.laser.rate_hz = 10.0;
  options.navigator.localiser = "exact";
  options.live_map.forget_s = options.live_map.remember_s = never_s;
  return options;
}

SavedMapOptions map_options(const CoverScenario& scenario, const std::optional<Pose2>& start) {
  SavedMapOptions options;
  options.radius_m = 0.5 * std::min(scenario.problem.width_m, scenario.problem.strip_m());
  options.tolerance_m = scenario.map_tolerance_m;
  if (start) options.start = start->position;
  return options;
}

std::vector<OptionGroup> describe(CoverScenario& scenario) {
  std::vector<Option> top{file_option("area", "file of the polygon to cover, or a saved map", &scenario.area),
                          {"units", "", 0, 0, "of its numbers: auto, degrees or metres", &scenario.units}};
  for (Option& option : describe(scenario.problem)) top.push_back(std::move(option));
  const std::vector<Option> rest{
      choice_option("method", "a cover method of 'outrider list'", &scenario.method,
                    names_of(cover_methods())),
      {"start", "", 0, 0,
       "x,y,heading of the robot at first, in the coordinates of the area and degrees; empty: where its "
       "track begins",
       &scenario.start},
      {"map_tolerance", "m", 0.0, 10.0,
       "how far inside the free space of a saved map its simplified edge may be; 0: two cells",
       &scenario.map_tolerance_m},
      {"error_factor", "", 1.0, 100.0, "how many times slower than its slowest pace the robot may be",
       &scenario.error_factor},
      {"seed", "", 0, 1e15, "seed of the simulated drive", &scenario.seed},
      choice_option("sim", "how the track is driven: as it is, or by a navigator around what stands there",
                    &scenario.sim, {"ideal", "navigator"}),
      {"things", "", 0, 0,
       "with sim: navigator: x,y,length,width of boxes and x,y,radius of posts that are on no map, m",
       &scenario.things}};
  top.insert(top.end(), rest.begin(), rest.end());
  std::vector<OptionGroup> groups = {
      {"", "the area and the robot", std::move(top)},
      {"tool", "what covers the ground", describe(scenario.problem.tool)},
      {"pace", "how fast the robot drives and turns", describe(scenario.problem.pace)},
      {"order", "in which order laps and cells are driven", describe(scenario.options)},
      {"faults", "what goes wrong with a robot that the navigator drives, without its being told",
       describe(scenario.navigation.faults)},
  };
  std::ranges::move(describe(scenario.navigation), std::back_inserter(groups));
  return groups;
}

Outcome<CoverTask> load_task(const CoverScenario& scenario) {
  if (auto ok = check_names(scenario); !ok) return pass_on(ok);
  if (auto ok = check_sim(scenario); !ok) return pass_on(ok);
  auto method = find_cover_method(scenario.method);
  if (!method) return pass_on(method);
  auto units = units_of(scenario);
  if (!units) return pass_on(units);
  std::optional<Pose2> start;
  if (!scenario.start.empty()) {
    auto given = parse_pose(scenario.start, "start");
    if (!given) return pass_on(given);
    start = *given;
  }
  auto area = load_area(scenario, *units, start);
  if (!area) return pass_on(area);
  return task_of(scenario, *method, std::move(*area), start);
}

CoverTask task_of(const CoverScenario& scenario, const CoverMethod& method, CoverArea area,
                  const std::optional<Pose2>& start) {
  CoverTask task{scenario.problem, method, {}, {}};
  task.note = std::move(area.note);
  task.problem.frame = std::move(area.frame);
  if (start)
    task.problem.start = Pose2{task.problem.frame.to_local(start->position), wrap_angle(start->heading_rad)};
  for (std::size_t i = 0; i < area.polygons.size(); ++i) {
    AreaPolygon& polygon = area.polygons[i];
    const std::string of = i == 0 ? "" : fmt::format(" of area {}", i + 1);
    AreaOutline outline{std::move(polygon.boundary.corners), {}};
    task.places.push_back({"boundary" + of, std::move(polygon.boundary.where)});
    for (AreaRing& hole : polygon.holes) {
      outline.holes.push_back(std::move(hole.corners));
      task.places.push_back({fmt::format("hole {}{}", outline.holes.size(), of), std::move(hole.where)});
    }
    if (i > 0) {
      task.problem.others.push_back(std::move(outline));
      continue;
    }
    task.problem.boundary = std::move(outline.boundary);
    task.problem.holes = std::move(outline.holes);
  }
  return task;
}

Fault placed(Fault fault, const CoverTask& task) {
  if (fault.where == "area" && task.problem.frame.degrees)
    fault.sentence += "; if the numbers of the file are metres and not degrees, say units: metres";
  for (const auto& [name, where] : task.places) {
    if (fault.where != name) continue;
    fault.where = where;
    if (name.starts_with("hole ") && !fault.sentence.starts_with("hole "))
      fault.sentence = fmt::format("{}: {}", name, fault.sentence);
    break;
  }
  return fault;
}

}  // namespace outrider
