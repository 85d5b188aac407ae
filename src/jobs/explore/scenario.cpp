#include "outrider/jobs/explore/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/log/scan_mount.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/sim/faults/post_place.hpp"

namespace outrider {
namespace {

/// Refuses a start outside the box of all that stands, where the world has no end.
Status check_start(const Box2& bounds, Vec2 start) {
  if (bounds.contains(start)) return {};
  return fault(FaultCode::start_blocked,
               fmt::format("{} is outside the map, which lies between {} and {}; start it in there",
                           place_text(start.x, start.y), place_text(bounds.low.x, bounds.low.y),
                           place_text(bounds.high.x, bounds.high.y)),
               "start");
}

std::vector<Option> with(std::vector<Option> options, Option one) {
  options.push_back(std::move(one));
  return options;
}

/// Takes the size of the robot and the mount of its laser from its own file, if it has one.
Status take_robot(const ExploreScenario& scenario, ExploreSetup& setup) {
  constexpr const char* key = "laser.link";
  auto sensor = take_robot_file(scenario.robot_file, key, scenario.world.options.sdf,
                                setup.task.robot.radius_m, setup.task.robot.height_m, setup.warnings);
  if (!sensor) return pass_on(sensor);
  if (!*sensor) return {};
  auto level = scan_mount(**sensor);
  if (!level) return bad_input(level.error().sentence, key);
  setup.task.slam.robot_T_laser = level->robot_T_laser;
  setup.sim.laser.height_m = (*sensor)->position.z;
  return check_ranges(describe(setup.sim.laser), "laser");
}

/// Refuses cells of which a single scan in the world covers more than can be kept.
Status check_cells(double cell_m, double range_m, Vec2 world_m) {
  constexpr double most_cells = 1e7;
  const double area_m2 = std::min(2.0 * range_m, world_m.x) * std::min(2.0 * range_m, world_m.y);
  const double cells = area_m2 / (cell_m * cell_m);
  if (cells <= most_cells) return {};
  return bad_input(
      fmt::format("'{:g}' is not valid: a scan would cover {:.0f} million cells of this world, and "
                  "at most {:.0f} million are kept; expected at least {:.3f} m",
                  cell_m, 1e-6 * cells, 1e-6 * most_cells,
                  std::ceil(1e3 * std::sqrt(area_m2 / most_cells)) * 1e-3),
      "occupancy.resolution");
}

std::vector<Option> describe_faults(ExploreScenario& scenario) {
  ExplorerFaults& faults = scenario.sim.faults;
  std::vector<Option> options = describe(faults);
  for (const std::vector<Option>& more : {describe(faults.planner), describe(faults.walk_ins)})
    options.insert(options.end(), more.begin(), more.end());
  options.push_back({"blocked_place", "", 0, 0,
                     "x,y in m where the post is put, such as the middle of a doorway, once the robot is off "
                     "it; empty: before the robot",
                     &scenario.blocked_place});
  return options;
}

Status set_post_place(const ExploreScenario& scenario, const World& world, WalkInOptions& walk_ins) {
  if (scenario.blocked_place.empty()) return {};
  auto place = parse_place(scenario.blocked_place, "faults.blocked_place");
  if (!place) return pass_on(place);
  walk_ins.blocked_place = *place;
  return check_post_place(world, *place, walk_ins.blocked_at_s);
}

}  // namespace

std::vector<OptionGroup> describe(ExploreScenario& scenario) {
  ExploreTask& task = scenario.task;
  ExploreWorldFiles& world = scenario.world;
  return {
      {"",
       "the world and the start",
       {file_option("world", "file to explore: SDF, map_server YAML, PGM or PNG image, slices CSV",
                    &world.world),
        describe(world.options.sdf).front(),
        file_option("slices",
                    "file of slices that stand in the world too, such as those of a mesh that is missing",
                    &world.slices),
        {"walls", "", 0, 0, "walls that stand in it too, x1,y1,x2,y2 each, in m", &world.walls},
        {"resolution", "m", 1e-3, 10.0, "side of a pixel, of an image without a YAML file",
         &world.options.resolution_m},
        {"wall_height", "m", 0.01, 100.0, "of slices, walls and the cells of a map",
         &world.options.wall_height_m},
        {"start", "", 0, 0, "x,y,heading of the robot at first, m, m and degrees", &scenario.start},
        {"seed", "", 0, 1e15, "seed of every random number", &scenario.seed},
        {"perfect_pose", "", 0, 0, "wheels that count right and are believed: no SLAM",
         &scenario.perfect_pose}}},
      {"robot", "the robot, a disk on two wheels",
       with(describe(task.robot), describe_file(scenario.robot_file, "file"))},
      {"laser", "its range finder", with(describe(scenario.sim.laser), describe_link(scenario.robot_file))},
      {"wheels", "its wheels and how they count wrong", describe(scenario.sim.wheels)},
      {"faults", "what goes wrong without the robot being told", describe_faults(scenario)},
      {"link", "how scans travel to the robot's computer", describe(scenario.sim.link)},
      {"explore", "where it goes next", describe(task.explore)},
      {"navigator", "how it gets there", describe(task.navigator)},
      {"live_map", "what it remembers of what it sees around", describe(task.live_map)},
      {"motion", "how the next motion is found", describe(task.motion)},
      {"rules", "when it thinks, waits and gives up", describe(task.rules)},
      {"slam", "how it knows where it is", describe(task.slam)},
      {"occupancy", "the map that it makes", describe(task.slam.map)},
  };
}

Outcome<ExploreSetup> load_explore(const ExploreScenario& scenario) {
  auto start = parse_pose(scenario.start, "start");
  if (!start) return pass_on(start);
  if (auto ok = check(scenario.sim.laser); !ok) return pass_on(ok);
  auto loaded = load_explore_world(scenario.world);
  if (!loaded) return pass_on(loaded);
  if (auto ok = check_start(loaded->world.bounds, start->position); !ok) return pass_on(ok);
  if (auto ok = check_cells(scenario.task.slam.map.resolution_m, scenario.sim.laser.most_m,
                            loaded->world.bounds.size());
      !ok)
    return pass_on(ok);
  ExploreSetup setup{std::move(loaded->world), scenario.task, scenario.sim, std::move(loaded->warnings)};
  setup.task.start = {start->position, wrap_angle(start->heading_rad)};
  if (auto ok = take_robot(scenario, setup); !ok) return pass_on(ok);
  setup.sim.laser.robot_T_laser = setup.task.slam.robot_T_laser;
  if (auto ok = set_post_place(scenario, setup.world, setup.sim.faults.walk_ins); !ok) return pass_on(ok);
  return setup;
}

}  // namespace outrider
