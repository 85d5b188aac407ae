#include "outrider/jobs/drive/scenario.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "outrider/io/files/text.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/io/map/world_file.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/io/scenario/things.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/path/catalog.hpp"
#include "tag_warnings.hpp"

namespace outrider {
namespace {

constexpr double open_ground_m = 2.0;  ///< around waypoints and tags, where there is no world
constexpr std::size_t most_waypoints = 10'000;

Outcome<std::vector<Waypoint>> waypoints_from(const std::string& text) {
  std::vector<Waypoint> waypoints;
  for (std::string_view word : words(text)) {
    const bool stop = !word.ends_with('!');
    if (!stop) word.remove_suffix(1);
    auto pose = parse_pose(std::string(word), "waypoints");
    if (!pose) return pass_on(pose);
    waypoints.push_back({*pose, stop});
  }
  if (waypoints.empty()) {
    return bad_input("there are none; give waypoints, or a goal", "waypoints");
  }
  if (waypoints.size() > most_waypoints) {
    return bad_input(fmt::format("there are {}; at most {} are taken", waypoints.size(), most_waypoints),
                     "waypoints");
  }
  if (!waypoints.back().stop) return bad_input("the last one is a stop; take its ! away", "waypoints");
  return waypoints;
}

Outcome<Tag> tag_from(std::string_view word, double height_m, double size_m, const char* key) {
  const std::string form = "id=x,y,facing[,height] in m and degrees, such as 1=2,1,180";
  const std::size_t equals = word.find('=');
  const auto id = number<int>(word.substr(0, equals));
  if (equals == word.npos || !id) {
    return bad_input(fmt::format("'{}' is no tag; expected {}", excerpt(word), form), key);
  }
  const std::string rest(word.substr(equals + 1));
  const std::size_t count = std::ranges::count(rest, ',') == 3 ? 4 : 3;
  auto n = parse_numbers(rest, count, key, form);
  if (!n) return pass_on(n);
  return upright_tag(*id, {(*n)[0], (*n)[1], count == 4 ? (*n)[3] : height_m}, radians((*n)[2]), size_m);
}

Outcome<TagMap> tags_from(const DriveScenario& scenario, const std::string& text, const char* key) {
  auto families = parse_tag_families(scenario.tag_family);
  if (families && families->size() != 1) families = bad_input("it takes one family, that of all tags");
  if (!families) {
    families.error().where = "tag_family";
    return pass_on(families);
  }
  TagMap map{{}, families->front()};
  for (const std::string_view word : words(text)) {
    auto tag = tag_from(word, scenario.task.eye.height_m, scenario.tag_size_m, key);
    if (!tag) return pass_on(tag);
    map.tags.push_back(*tag);
  }
  if (auto ok = check_tags(map); !ok) {
    ok.error().where = key;
    return pass_on(ok);
  }
  return map;
}

/// The box around all that the task names, with room to drive.
Box2 around(const DriveTask& task, const std::optional<Pose2>& goal) {
  Box2 box;
  box.include(task.start.position);
  if (goal) box.include(goal->position);
  for (const Waypoint& waypoint : task.waypoints) box.include(waypoint.pose.position);
  for (const Tag& tag : task.tags.tags) box.include(xy(tag.world_T_tag.position));
  return box.grown(open_ground_m + task.radius_m);
}

Status load_ground(const DriveScenario& scenario, const std::optional<Pose2>& goal, DriveSetup& setup) {
  World& world = setup.task.world;
  const std::string& file = scenario.world.empty() ? scenario.map : scenario.world;
  if (!file.empty()) {
    auto loaded = load_world(file, {.sdf = scenario.sdf});
    if (!loaded) return pass_on(loaded);
    world = std::move(loaded->world);
    if (world.bounds.empty()) world.bounds = standing_bounds(world);  // as of a map
    setup.warnings.insert(setup.warnings.end(), loaded->warnings.begin(), loaded->warnings.end());
  } else {
    world.name = "open ground";
  }
  if (!scenario.bounds.empty()) {
    auto bounds = parse_box(scenario.bounds, "bounds");
    if (!bounds) return pass_on(bounds);
    world.bounds = *bounds;
  } else if (file.empty()) {
    world.bounds = around(setup.task, goal);
  }
  return add_things(scenario.things, scenario.height_m, world);
}

/// Loads the map that the robot has.
Outcome<KnownMap> known_map(const DriveScenario& scenario) {
  auto loaded = load_map(scenario.map, {.sdf = scenario.sdf});
  if (!loaded) return pass_on(loaded);
  auto* const cells = std::get_if<MapCells>(&loaded->shape);
  if (cells == nullptr)
    return bad_input(fmt::format("{} has no cells; a robot with a laser takes a map of cells: a YAML file of "
                                 "map_server, or an image",
                                 excerpt(scenario.map)),
                     "map");
  return KnownMap{std::move(cells->occupancy), cells->yaw_rad};
}

Status check_argument(const std::string& value, const char* key, const std::vector<std::string>& names) {
  if (std::ranges::count(names, value) > 0) return {};
  return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(value), fmt::join(names, " or ")),
                   key);
}

/// A drive is planned before it begins, and never again.
Status check_outage(const DriveScenario& scenario) {
  constexpr const char* key = "faults.planner_fails_from";
  const double from_s = scenario.sim.planner.from_s;
  if (!scenario.sim.planner.any()) return {};
  if (scenario.planner.empty())
    return bad_input("waypoints need no planner; give a goal and a planner, or leave it out", key);
  if (from_s == 0.0) return {};
  return bad_input(fmt::format("'{:g}' is not valid; a drive is planned at 0 s and never again, so give 0, "
                               "or leave it out",
                               from_s),
                   key);
}

/// A drive by laser has wheels of its own, and finds its way itself.
Status check_laser(const DriveScenario& scenario) {
  if (!scenario.planner.empty())
    return bad_input("a drive by laser finds its way itself; leave the planner out and give waypoints",
                     "planner");
  const bool by_tags = scenario.laser.navigator.localiser == "tags";
  if (by_tags && scenario.tags.empty() && scenario.map_tags.empty())
    return bad_input("'tags' needs tags; give their places, or take laser_mapping", "navigator.localiser");
  if (scenario.laser.start_unknown && scenario.map.empty() && !by_tags)
    return bad_input("a robot that is not told where it starts needs a map or tags; give them",
                     "navigator.start_unknown");
  if (scenario.laser.navigator.localiser == "laser_on_map" && scenario.map.empty())
    return bad_input("'laser_on_map' needs a map; give one, or laser_mapping", "navigator.localiser");
  if (auto ok = check(scenario.laser.laser); !ok) return ok;
  if (scenario.laser.footprint.empty()) return {};
  if (auto shape = parse_footprint(scenario.laser.footprint); !shape)
    return bad_input(shape.error().sentence, "navigator.footprint");
  return {};
}

Status check_arguments(const DriveScenario& scenario) {
  const bool by_laser = scenario.loop == "laser";
  if (auto ok = by_laser ? check_laser(scenario)
                         : check_argument(scenario.loop, "loop", {"closed", "open", "laser"});
      !ok)
    return ok;
  if (auto ok = check_argument(scenario.sight, "sight", {"rendered", "modelled"}); !ok) return ok;
  for (const auto& [value, key] : {std::pair(&scenario.map, "map"), {&scenario.things, "things"}}) {
    if (!by_laser && !value->empty())
      return bad_input("it goes with a drive by laser; give loop: laser, or leave it out", key);
  }
  if (!by_laser && scenario.goal.empty() != scenario.planner.empty()) {
    return bad_input("a goal and a planner go together; give both, or waypoints",
                     scenario.goal.empty() ? "goal" : "planner");
  }
  if (!scenario.goal.empty() && !scenario.waypoints.empty()) {
    return bad_input("there are waypoints as well; give a goal, or waypoints", "goal");
  }
  if (auto ok = check_outage(scenario); !ok) return ok;
  return check(scenario.task.follow);
}

/// Takes the size of the robot and the mount of its camera from its own file, if it has one.
Status take_robot(DriveScenario& scenario, std::vector<std::string>& warnings) {
  constexpr const char* key = "camera.link";
  auto sensor =
      take_robot_file(scenario.robot_file, key, scenario.sdf, scenario.radius_m, scenario.height_m, warnings);
  if (!sensor) return pass_on(sensor);
  if (!*sensor) return {};
  const Pose3& pose = **sensor;
  if (std::abs(pose.position.y) > 1e-3 || norm(pose.rotation.axes[0] - Vec3{1, 0, 0}) > 1e-3) {
    return bad_input(
        fmt::format("the x axis of '{}' does not point ahead on the middle line of the robot; name "
                    "another link, or give camera.ahead and camera.height",
                    scenario.robot_file.link),
        key);
  }
  scenario.task.eye.ahead_m = pose.position.x;
  scenario.task.eye.height_m = pose.position.z;
  return check_ranges(describe(scenario.task.eye), "camera");
}

/// Builds the task from the options, and from the texts and files that they name.
Outcome<DriveTask> robot_from(const DriveScenario& scenario) {
  DriveTask task = scenario.task;
  auto chassis = make_chassis(scenario.chassis, scenario.wheel_radius_m, scenario.wheel_reach_m);
  if (!chassis) return pass_on(chassis);
  task.chassis = std::move(*chassis);
  task.radius_m = scenario.radius_m;
  task.closed_loop = scenario.loop != "open";
  if (scenario.loop == "laser") task.follow.mode = "rotate_then_go";  // its two wheels do not go sideways
  if (scenario.loop == "closed" && task.follow.mode == "holonomic" && !task.chassis.moves_sideways()) {
    return bad_input(
        fmt::format("a {} chassis does not move sideways; take rotate_then_go", scenario.chassis),
        "follow.mode");
  }
  if (!scenario.calibration.empty()) {
    if (auto ok = load_scenario(scenario.calibration, describe(task.calibration)); !ok) return pass_on(ok);
  }
  auto start = parse_pose(scenario.start, "start");
  if (!start) return pass_on(start);
  task.start = *start;
  if (auto ok = check_camera(task.eye.camera); !ok) {
    if (ok.error().where.empty()) ok.error().where = "camera";
    return pass_on(ok);
  }
  const bool apart = !scenario.map_tags.empty();
  auto tags = tags_from(scenario, apart ? scenario.map_tags : scenario.tags, apart ? "map_tags" : "tags");
  if (!tags) return pass_on(tags);
  task.tags = std::move(*tags);
  return task;
}

/// Checks that neither the start nor a waypoint is in a keep-out zone.
Status check_outside(const DriveTask& task, const Footprint& footprint) {
  const Zones zones(task.zones, 0.0);
  for (std::size_t i = 0; i <= task.waypoints.size(); ++i) {
    const Pose2& pose = i == 0 ? task.start : task.waypoints[i - 1].pose;
    if (!zones.overlap(footprint, pose)) continue;
    const auto in = std::ranges::min_element(task.zones, {}, [&](const Zone& zone) {
      return std::pair(zone.kind != Zone::Kind::keep_out, zone.distance_to(pose.position));
    });
    return bad_input(
        fmt::format("{} at {:g},{:g} is in the keep-out zone {} ({}), with a part of the robot at least; "
                    "move one of them",
                    i == 0 ? "the start" : fmt::format("waypoint {}", i), pose.position.x, pose.position.y,
                    in - task.zones.begin() + 1, in->where),
        i == 0 ? "start" : "waypoints");
  }
  return {};
}

Status take_zones(const DriveScenario& scenario, DriveSetup& setup) {
  DriveTask& task = setup.task;
  auto loaded = load_zones(scenario.zones, task.follow.speed_mps, task.world.bounds);
  if (!loaded) return pass_on(loaded);
  if (loaded->zones.empty()) return {};
  if (scenario.loop != "laser")
    return bad_input("only a drive by laser keeps to zones; give loop: laser, or leave them out", "zones");
  task.zones = std::move(loaded->zones);
  std::ranges::move(loaded->warnings, std::back_inserter(setup.warnings));
  const bool forbids =
      std::ranges::any_of(task.zones, [](const Zone& zone) { return zone.kind == Zone::Kind::keep_out; });
  if (forbids && scenario.laser.start_unknown)
    return bad_input(
        "a robot that does not know where it is cannot keep out of zones; tell it where it starts",
        "navigator.start_unknown");
  const auto footprint = footprint_of(scenario.laser, task.radius_m);
  if (!footprint) return tl::unexpected(footprint.error());
  return check_outside(task, *footprint);
}

}  // namespace

std::vector<OptionGroup> describe(DriveScenario& scenario) {
  DriveTask& task = scenario.task;
  std::vector<Option> link = describe(scenario.sim.link);
  std::vector<Option> camera = describe(task.eye);
  camera.push_back(describe_link(scenario.robot_file));
  link.push_back({"patience", "s", 0.05, 1e9, "without a command after which the wheels stop",
                  &scenario.sim.patience_s});
  std::vector<OptionGroup> groups = {
      {"",
       "the drive",
       {file_option("world", "file of the world (SDF, or a map of walls); empty: the map, or open ground",
                    &scenario.world),
        file_option("map",
                    "map of cells that a robot with a laser has: YAML of map_server, PGM, PNG; empty: none",
                    &scenario.map),
        {"things", "", 0, 0,
         "x,y,length,width of each box and x,y,radius of each post that stands there and is on no map, m, "
         "with "
         "blanks between",
         &scenario.things},
        describe(scenario.sdf).front(),
        {"bounds", "", 0, 0, "low x,low y,high x,high y of the ground, m; empty: the box of its walls",
         &scenario.bounds},
        {"start", "", 0, 0, "x,y,heading in m and degrees", &scenario.start},
        {"waypoints", "", 0, 0, "x,y,heading of each, with blanks between; a ! behind one: pass by it",
         &scenario.waypoints},
        {"goal", "", 0, 0, "x,y,heading, in place of waypoints; by tags with a planner", &scenario.goal},
        choice_option("planner", "a path planner of 'outrider list', for the way to the goal",
                      &scenario.planner, names_of_planners_in_place()),
        {"tags", "", 0, 0, "id=x,y,facing[,height] of each tag, with blanks between", &scenario.tags},
        {"map_tags", "", 0, 0, "the same of the map that the robot has, if the world differs; empty: as tags",
         &scenario.map_tags},
        {"tag_size", "m", 1e-3, 10.0, "side of the square of every tag at whose edge black meets white",
         &scenario.tag_size_m},
        {"tag_family", "", 0, 0, "family of the tags, such as tag36h11 or tagStandard41h12",
         &scenario.tag_family},
        {"loop", "", 0, 0, "closed (by tags), open (by time) or laser (around what stands in the way)",
         &scenario.loop},
        {"sight", "", 0, 0, "rendered (images, tags detected in them) or modelled (corners with errors)",
         &scenario.sight},
        {"chassis", "", 0, 0, "mecanum, differential or holonomic", &scenario.chassis},
        {"wheel_radius", "m", 1e-3, 10.0, "of every wheel", &scenario.wheel_radius_m},
        {"wheel_reach", "m", 1e-3, 10.0,
         "half length plus half width (mecanum), half track (differential), or middle to wheel (holonomic)",
         &scenario.wheel_reach_m},
        {"radius", "m", 0.0, 100.0, "of the disk that the robot stays within", &scenario.radius_m},
        {"height", "m", 0.0, 100.0, "of the robot; obstacles above it are driven under", &scenario.height_m},
        describe_file(scenario.robot_file, "robot_file"),
        file_option("calibration", "file that 'outrider calibrate' wrote; empty: none",
                    &scenario.calibration),
        {"seed", "", 0, 1e15, "seed of every random number", &scenario.seed}}},
      {"follow", "how waypoints are followed", describe(task.follow)},
      {"pid", "gains of the follower", describe(task.pid)},
      {"reckoning", "how the belief is carried on between two looks", describe(task.reckoning)},
      {"localise", "how tags tell where the robot is", describe(task.localise)},
      {"camera", "the camera, which looks ahead", camera},
      {"rules", "when the robot looks, waits and gives up", describe(task.rules)},
      {"route", "how a planner's path becomes waypoints", describe(scenario.route)},
      {"faults", "what the wheels of the simulated robot do wrong, and what befalls it",
       describe(scenario.sim)},
      {"link", "how commands travel to the simulated robot", link},
  };
  std::ranges::move(describe(scenario.laser), std::back_inserter(groups));
  std::vector<Option> zones = describe(scenario.zones);
  std::ranges::move(describe(scenario.laser.keep), std::back_inserter(zones));
  groups.push_back(
      {"zones", "where a robot with a laser may not go, goes slowly, and keeps to a side", zones});
  return groups;
}

Outcome<DriveSetup> load_drive(const DriveScenario& given) {
  DriveScenario scenario = given;
  std::vector<std::string> warnings;
  if (auto ok = check_arguments(scenario); !ok) return pass_on(ok);
  if (auto ok = take_robot(scenario, warnings); !ok) return pass_on(ok);
  auto task = robot_from(scenario);
  if (!task) return pass_on(task);
  DriveSetup setup{std::move(*task), scenario.sim, scenario.sight == "rendered",
                   std::nullopt,     0.0,          std::move(warnings)};
  if (!scenario.map_tags.empty()) {
    auto tags = tags_from(scenario, scenario.tags, "tags");
    if (!tags) return pass_on(tags);
    setup.sim.tags = std::move(*tags);
  }
  std::optional<Pose2> goal;
  if (scenario.goal.empty()) {
    auto waypoints = waypoints_from(scenario.waypoints);
    if (!waypoints) return pass_on(waypoints);
    setup.task.waypoints = std::move(*waypoints);
  } else {
    auto pose = parse_pose(scenario.goal, "goal");
    if (!pose) return pass_on(pose);
    goal = *pose;
    if (scenario.planner.empty()) setup.task.waypoints = {{*pose}};
  }
  if (!scenario.map.empty()) {
    auto known = known_map(scenario);
    if (!known) return pass_on(known);
    setup.task.known = std::move(*known);
  }
  if (auto ok = load_ground(scenario, goal, setup); !ok) return pass_on(ok);
  if (auto ok = take_zones(scenario, setup); !ok) return pass_on(ok);
  const CollisionMap ground = CollisionMap::of(setup.task.world, scenario.height_m);
  if (goal && !scenario.planner.empty()) {
    auto route = plan_route(setup.task, ground, *goal, scenario.planner, scenario.route,
                            scenario.sim.planner.budget(0.0));
    if (!route) return pass_on(route);
    setup.task.waypoints = std::move(route->waypoints);
    setup.plan = std::move(route->plan);
    setup.path_clearance_m = way_clearance_m(setup.plan->waypoints, ground);
  }
  if (auto ok = check_waypoints(setup.task, ground, scenario.loop != "laser"); !ok) return pass_on(ok);
  if (scenario.loop != "laser")
    for (std::string& warning : tag_warnings(setup.task)) setup.warnings.push_back(std::move(warning));
  return setup;
}

Outcome<DriveSetup> load_wheel_drive(const DriveScenario& scenario) {
  if (scenario.loop == "laser")
    return bad_input("a drive by laser is simulated only, by 'outrider run'; here give closed or open",
                     "loop");
  return load_drive(scenario);
}

}  // namespace outrider
