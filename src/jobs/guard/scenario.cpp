#include "outrider/jobs/guard/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "outrider/core/text.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/map/terrain.hpp"
#include "outrider/io/scenario/targets.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/io/scenario/world_changes.hpp"
#include "outrider/io/sdf/sdf.hpp"
#include "outrider/jobs/guard/capabilities.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/team/team_plan.hpp"
#include "outrider/jobs/guard/yard/inputs.hpp"
#include "outrider/sim/faults/post_place.hpp"

namespace outrider {
namespace {

Outcome<World> with_terrain(World world, const Box2& bounds, const GuardScenario& scenario) {
  world.bounds = bounds;
  if (scenario.terrain.empty() && (!scenario.terrain_size.empty() || !scenario.terrain_position.empty())) {
    return bad_input("it says where a PNG lies, and there is none; give terrain, or leave this out",
                     scenario.terrain_size.empty() ? "terrain_position" : "terrain_size");
  }
  if (scenario.terrain.empty()) return world;
  auto field = load_terrain(scenario.terrain, scenario.terrain_size, scenario.terrain_position);
  if (!field) return pass_on(field);
  return world.on(std::make_shared<const HeightField>(std::move(*field)));
}

/// Returns the bounds grown so that there is ground around the starts and around each target that lies
/// outside them: they are the box of what stands in the yard, which may be little. What lies far outside is
/// left there.
Box2 with_room(Box2 bounds, const std::vector<Pose2>& starts, double robot_radius_m,
               const std::vector<Target>& targets) {
  constexpr double room_m = 2.0;
  const Box2 standing = bounds;
  const double farthest_m = std::max({10.0, standing.size().x, standing.size().y});
  const auto include = [&](Vec2 p) {
    if (standing.distance_to(p) > farthest_m) return;
    bounds.include(p - Vec2{room_m, room_m});
    bounds.include(p + Vec2{room_m, room_m});
  };
  for (const Pose2& start : starts) {
    if (!standing.grown(-robot_radius_m).contains(start.position)) include(start.position);
  }
  for (const Target& target : targets) {
    if (!standing.contains(xy(target.base))) include(xy(target.base));
  }
  return bounds;
}

/// Returns the part of large bounds, as of an ocean or a city, that lies near the starts and the targets.
Box2 near_part(Box2 bounds, const std::vector<Pose2>& starts, const std::vector<Target>& targets) {
  constexpr double large_m = 300.0, near_m = 100.0;
  if (std::max(bounds.size().x, bounds.size().y) <= large_m) return bounds;
  Box2 used;
  const auto include = [&](Vec2 p) {
    if (bounds.contains(p)) used.include(p);
  };
  for (const Pose2& start : starts) include(start.position);
  for (const Target& target : targets) include(xy(target.base));
  if (used.empty()) return bounds;
  const Box2 near = used.grown(near_m);
  return {{std::max(bounds.low.x, near.low.x), std::max(bounds.low.y, near.low.y)},
          {std::min(bounds.high.x, near.high.x), std::min(bounds.high.y, near.high.y)}};
}

/// Sets the bounds where none are given: those of what stands, with room around starts and targets, and
/// without what is far from them.
void set_bounds(const GuardScenario& scenario, const Pose2& start, const std::vector<Target>& targets,
                World& world, std::vector<std::string>& warnings) {
  std::vector<Pose2> starts = scenario.other_starts;
  starts.insert(starts.begin(), start);
  const Box2 all = world.terrain ? world.bounds
                                 : with_room(world.bounds, starts, scenario.problem.robot.radius_m, targets);
  world.bounds = near_part(all, starts, targets);
  if (world.bounds.size() == all.size()) return;
  warnings.push_back(
      fmt::format("the yard is {:.0f} m by {:.0f} m; {:.0f} m by {:.0f} m of it, within 100 m of the starts "
                  "and the targets, are used; give bounds for more",
                  all.size().x, all.size().y, world.bounds.size().x, world.bounds.size().y));
}

Status load_walkers(GuardScenario& scenario) {
  auto weights = preferences_from_text(scenario.wander.prefers, scenario.problem.targets);
  if (!weights) return pass_on(weights);
  scenario.preferences = std::move(*weights);
  if (!scenario.wander.any()) return {};
  if (scenario.wander.history.empty()) return {};
  auto text = read_file(scenario.wander.history);
  if (!text) return pass_on(text);
  auto history = sightings_from_text(*text, scenario.wander.history);
  if (!history) return pass_on(history);
  scenario.history = std::move(*history);
  return {};
}

std::vector<Option> describe_faults(GuardScenario& scenario) {
  std::vector<Option> options = describe(scenario.faults);
  options.push_back(
      {"blocked_place", "", 0, 0,
       "x,y in m where the post is put, such as the middle of a gate, once the robot is off it; "
       "empty: on its way",
       &scenario.blocked_place});
  return options;
}

Status set_post_place(GuardScenario& scenario) {
  if (scenario.blocked_place.empty()) return {};
  auto place = parse_place(scenario.blocked_place, "faults.blocked_place");
  if (!place) return pass_on(place);
  WayFaults& way = scenario.faults.way;
  way.blocked_place = *place;
  return check_post_place(scenario.problem.world, *place, way.blocked_at_s);
}

/// Checks the simulator, and that what stands or walks in the way is asked for with a navigator only.
Status check_sim(const GuardScenario& scenario) {
  if (scenario.sim == "navigator") return check(scenario.navigation.laser);
  if (scenario.sim != "kinematic" && scenario.sim != "physics") {
    return bad_input(
        fmt::format("'{}' is not valid; expected kinematic, navigator or physics", excerpt(scenario.sim)),
        "sim");
  }
  const bool walk_ins = scenario.navigation.faults.any();
  if (scenario.things.empty() && !walk_ins) return {};
  return bad_input(
      "drives that are carried out as planned go around nothing; give sim: navigator, or leave it out",
      walk_ins ? "walk_ins" : "things");
}

/// Checks the names, and that what is asked for combines.
Status check_combination(const GuardScenario& scenario) {
  if (auto ok = check_sim(scenario); !ok) return ok;
  if (scenario.wander.any() && scenario.problem.targets.empty()) {
    return bad_input("intruders that walk about need at least one target; list one", "targets");
  }
  if (auto planner = find_guard_planner(scenario.options.planner); !planner) return pass_on(planner);
  return check_capabilities(requested_capabilities(scenario));
}

Status need(const std::string& value, const std::string& key, const std::string& what) {
  if (!value.empty()) return {};
  return bad_input(fmt::format("missing; give {}", what), key);
}

}  // namespace

NavigationOptions GuardScenario::default_navigation() {
  NavigationOptions options;
  options.navigator.localiser = "exact";
  options.navigator.most_recoveries = 4;  // there are other places to shoot from
  return options;
}

std::vector<OptionGroup> describe(GuardScenario& scenario) {
  GuardProblem& problem = scenario.problem;
  std::vector<Option> robot = describe(problem.robot);
  robot.push_back(describe_file(scenario.robot_file, "file"));
  std::vector<OptionGroup> groups = {
      {"",
       "the mission",
       {file_option("world", "SDF file of the yard", &scenario.world),
        describe(scenario.sdf).front(),
        file_option("terrain",
                    "heights of the ground, an ESRI ASCII grid or a grey PNG; empty: the world's floor",
                    &scenario.terrain),
        {"terrain_size", "", 0, 0, "length,width,height of a PNG's terrain from black to white, m",
         &scenario.terrain_size},
        {"terrain_position", "", 0, 0, "x,y,z of the middle of a PNG's terrain at black, m; empty: 0,0,0",
         &scenario.terrain_position},
        {"moved", "", 0, 0,
         "what stands elsewhere: name=x,y,turn; ... where the middle of it stands, m, and its turn from how "
         "the world has it, degrees",
         &scenario.moved},
        {"removed", "", 0, 0, "what of the world is taken away: name; ...", &scenario.removed},
        file_option("targets", "file of targets, one a line: type=T x= y= [z=] [rz=]", &scenario.targets),
        {"start", "", 0, 0, "x,y,heading of the robot at first, m, m and degrees", &scenario.start},
        {"robots", "", 1, static_cast<double>(most_robots), "robots that share the targets",
         &scenario.robots},
        {"robot_starts", "", 0, 0,
         "x,y,heading; ... of the robots after the first, m, m and degrees; empty: side by side with the "
         "first",
         &scenario.robot_starts},
        {"bounds", "", 0, 0,
         "low x,low y,high x,high y of the yard, m; empty: the box of its walls, or the part near starts and "
         "targets",
         &scenario.bounds},
        {"seed", "", 0, 1e15, "seed of every random number", &scenario.seed},
        {"sim", "", 0, 0,
         "what carries the plan out: kinematic (as planned), navigator (around what stands there) or physics",
         &scenario.sim},
        {"things", "", 0, 0,
         "with sim: navigator: x,y,length,width of boxes and x,y,radius of posts that are on no map, m",
         &scenario.things},
        {"targets_block", "", 0, 0, "targets stop the robot and the shots at other targets",
         &problem.targets_block},
        {"tries", "", 1, 100, "shots at a target before it has failed", &problem.tries},
        {"give_up", "s", 0, 1e6,
         "a target that was missed is not tried again if a hit takes longer on average; 0: never",
         &problem.give_up_s},
        {"regions", "", 0, 0, "log and draw from where each target can be hit", &scenario.regions}}},
      {"robot", "the robot", robot},
      {"gun", "the water gun", describe(problem.gun)},
      {"air", "the air that the ball flies through", describe(problem.air)},
      {"errors", "the largest errors of the execution", describe(problem.errors)},
      {"faults", "what goes wrong without the mission being told, once it has begun to guard",
       describe_faults(scenario)},
      {"supplies", "water and charge that end, and the stations that fill them up",
       describe(problem.supplies)},
      {"plan", "the planner", describe(scenario.options)},
      {"arrivals", "intruders that keep coming", describe(scenario.arrivals)},
      {"wander", "intruders that walk about", describe(scenario.wander)},
      {"scout", "a yard that is not known", describe(scenario.scout)},
  };
  std::ranges::move(describe(scenario.navigation), std::back_inserter(groups));
  return groups;
}

Outcome<std::vector<std::string>> load_problem(GuardScenario& scenario) {
  if (auto ok = need(scenario.world, "world", "the SDF file of the yard"); !ok) return pass_on(ok);
  if (auto ok = need(scenario.targets, "targets", "the file of the targets"); !ok) return pass_on(ok);
  if (scenario.problem.gun.pitch_low_rad > scenario.problem.gun.pitch_high_rad) {
    return bad_input("the lowest pitch is above the highest; swap them", "gun.pitch_low");
  }
  auto start = parse_pose(scenario.start, "start");
  if (!start) return pass_on(start);
  auto others = parse_starts(scenario.robot_starts, scenario.robots);
  if (!others) return pass_on(others);
  scenario.other_starts = std::move(*others);
  auto loaded = load_sdf(scenario.world, scenario.sdf);
  if (!loaded) return pass_on(loaded);
  RobotModel& robot = scenario.problem.robot;
  if (auto ok = take_robot_file(scenario.robot_file, "", scenario.sdf, robot.radius_m, robot.height_m,
                                loaded->warnings);
      !ok)
    return pass_on(ok);
  auto bounds = scenario.bounds.empty() ? loaded->world.bounds : parse_box(scenario.bounds, "bounds");
  if (!bounds) return pass_on(bounds);
  auto world = with_terrain(std::move(loaded->world), *bounds, scenario);
  if (!world) return pass_on(world);
  auto changes = changes_from_text(scenario.moved, scenario.removed);
  if (!changes) return pass_on(changes);
  world = changed(*world, *changes);
  if (!world) return pass_on(world);
  auto targets = load_targets(scenario.targets, *world);
  if (!targets) return pass_on(targets);
  if (scenario.bounds.empty()) set_bounds(scenario, *start, *targets, *world, loaded->warnings);

  scenario.problem.start = {start->position, wrap_angle(start->heading_rad)};
  scenario.problem.world = std::move(*world);
  scenario.problem.targets = std::move(*targets);
  if (auto ok = set_post_place(scenario); !ok) return pass_on(ok);
  Supplies& supplies = scenario.problem.supplies;
  auto stations = stations_from_text(supplies.stations_text, scenario.problem.world.bounds);
  if (!stations) return pass_on(stations);
  supplies.stations = std::move(*stations);
  if (auto ok = check_combination(scenario); !ok) return pass_on(ok);
  auto intruders =
      load_arrivals(scenario.problem, scenario.arrivals, static_cast<std::uint64_t>(scenario.seed));
  if (!intruders) return pass_on(intruders);
  scenario.intruders = std::move(*intruders);
  if (auto ok = load_walkers(scenario); !ok) return pass_on(ok);
  return std::move(loaded->warnings);
}

}  // namespace outrider
