#include "outrider/jobs/cover/mission/navigated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/io/scenario/things.hpp"
#include "outrider/job/map_log.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

constexpr double wall_m = 0.001, wall_height_m = 1.0;  // thin: at sharp corners it must not reach inside
constexpr double robot_height_m = 0.5;
constexpr double seen_off_m = 0.03;  // by which marks may be beside what they are of
constexpr double noted_m = 0.01, noted_rad = radians(2.0);
constexpr double map_every_s = 1.0;
constexpr double arc_m = 0.002, inside_arc_m = 1e-4;

/// The things as a world, and where they stand.
Outcome<World> world_of_things(const CoverProblem& problem, const std::string& things) {
  World world;
  if (auto ok = add_things(things, robot_height_m, world); !ok) return pass_on(ok);
  for (Solid& solid : world.solids) {
    const Vec2 at = problem.frame.to_local(xy(solid.world_T_solid.position));
    solid.world_T_solid.position.x = at.x;
    solid.world_T_solid.position.y = at.y;
  }
  return world;
}

/// Returns the areas of the problem, those that touch as one.
Region region_of_all(const CoverProblem& problem) {
  std::vector<Region> all{region_of(problem.boundary, problem.holes)};
  for (const AreaOutline& other : problem.others) all.push_back(region_of(other.boundary, other.holes));
  return united(all);
}

/// Puts a wall along each edge, outside of the area.
void add_walls(const Region& area, World& world) {
  const auto add = [&](const std::vector<Vec2>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 from = ring[i], to = ring[(i + 1) % ring.size()];
      const double length_m = distance(from, to);
      if (length_m == 0.0) continue;
      const Vec2 along = (1.0 / length_m) * (to - from);
      // The area is on the left of its rings.
      const Vec2 middle = 0.5 * (from + to) - 0.5 * wall_m * perpendicular(along);
      world.solids.push_back(
          {"edge",
           {{middle.x, middle.y, 0.5 * wall_height_m}, Rotation::from_rpy(0.0, 0.0, heading_of(along))},
           BoxShape{{0.5 * length_m, 0.5 * wall_m, 0.5 * wall_height_m}}});
    }
  };
  for (const RingedPolygon& part : area) {
    add(part.outer);
    std::ranges::for_each(part.holes, add);
  }
}

AllowedGround allowed_of(const Region& area) {
  std::vector<std::vector<Vec2>> rings;
  for (const RingedPolygon& part : area) {
    rings.push_back(part.outer);
    rings.insert(rings.end(), part.holes.begin(), part.holes.end());
  }
  return AllowedGround(std::move(rings));
}

RobotModel robot_of(const CoverProblem& problem) {
  RobotModel robot;
  robot.radius_m = problem.body_radius_m();
  robot.height_m = robot_height_m;
  robot.speed_mps = problem.pace.speed_mps;
  robot.acceleration_mps2 = problem.pace.acceleration_mps2;
  robot.turn_rate_radps = problem.pace.turn_rate_radps;
  robot.turn_acceleration_radps2 = problem.pace.turn_acceleration_radps2;
  return robot;
}

void add_pose(PieceDrive& drive, double time_s, const Pose2& pose) {
  drive.track.push_back({time_s, pose});
  drive.way.push_back(pose.position);
  drive.times_s.push_back(time_s);
}

/// Notes the true pose in the drive.
void note_pose(PieceDrive& drive, double time_s, const Pose2& pose) {
  drive.time_s = time_s;
  if (!drive.track.empty()) {
    const Pose2& before = drive.track.back().pose;
    const double moved_m = distance(before.position, pose.position);
    const double turned_rad = std::abs(pose.heading_rad - before.heading_rad);
    if (moved_m < noted_m && turned_rad < noted_rad) return;
    drive.length_m += moved_m;
    drive.turned_rad += turned_rad;
  }
  add_pose(drive, time_s, pose);
}

/// Returns what a robot can cover that keeps the rim from things; nothing if it has no room where it starts.
Region reach_among(const CoverProblem& problem, const CoverPlan& plan, const World& things, double rim_m) {
  std::vector<Region> all;
  for (const RoundedPolygon& thing : footprints_above_floor(things)) {
    const double grown_m = thing.radius_m + rim_m;
    std::vector<Vec2> corners;
    constexpr int around = 32;
    for (const Vec2 core : thing.core) {
      std::vector<Vec2> disk;
      for (int i = 0; i < around; ++i)
        disk.push_back(core + grown_m / std::cos(pi / around) * direction(2.0 * pi * i / around));
      corners.insert(corners.end(), disk.begin(), disk.end());
    }
    all.push_back(region_of(convex_hull(corners), {}));
  }
  const double radius_m = problem.body_radius_m();
  const Region standing = shrunk(without(plan.ground.area, united(all)), radius_m, arc_m);
  const auto from = std::ranges::find_if(standing, [&](const RingedPolygon& part) {
    return contains(part, plan.track.start.position) ||
           distance_to_border(part, plan.track.start.position) <= 2.0 * arc_m;
  });
  if (from == standing.end()) return {};
  return common(grown({*from}, radius_m, arc_m), plan.ground.reach);
}

/// A robot, its navigator and its orders, until these end.
class NavigatedDrive {
 public:
  NavigatedDrive(AllowedGround ground, double radius_m, Navigator navigator, SimulatedRobot robot,
                 CoverOrders orders, Log& log)
      : ground_(std::move(ground)),
        radius_m_(radius_m),
        navigator_(std::move(navigator)),
        robot_(std::move(robot)),
        orders_(std::move(orders)),
        log_(log) {}

  /// Drives; `look` receives the drive so far.
  void run(const RunWatch& watch, const std::function<void(const PieceDrive&)>& look) {
    for (;;) {
      const Observation seen = robot_.sense();
      const Situation now = navigator_.perceive(seen);
      note_truth();
      look(done_.drive);
      log(seen, now);
      if (watch.stopped()) return;
      const auto order = orders_.next(now, navigator_);
      done_.finished = !order && !watch.stopped();
      if (!order) return;
      robot_.act(navigator_.act(*order));
      done_.recoveries = std::max(done_.recoveries, navigator_.recoveries());
      watch.part(orders_.driven_part(navigator_));
    }
  }

  /// Returns what it came to, but for what was covered.
  NavigatedCover result() {
    const auto& body = robot_.body<TwistBody>();
    if (done_.drive.track.back().time_s < done_.drive.time_s)
      add_pose(done_.drive, done_.drive.time_s, robot_.pose());
    done_.believed_complete = orders_.believes_complete();
    done_.reason = orders_.reason();
    done_.contacts = body.contacts();
    done_.walked_into = body.walked_into();
    done_.rounds = orders_.rounds();
    done_.left_m2 = area_of(orders_.left());
    return std::move(done_);
  }

 private:
  void note_truth() {
    const Pose2& truth = robot_.pose();
    note_pose(done_.drive, robot_.time_s(), truth);
    const bool out = !ground_.contains(truth.position) || ground_.to_edge_m(truth.position) < radius_m_;
    if (out && !outside_) ++done_.left_ground;
    outside_ = out;
  }

  void log(const Observation& seen, const Situation& now) {
    if (seen.scan) log_scan(log_, now.time_s, *seen.scan);
    if (now.time_s < next_map_s_) return;
    next_map_s_ = now.time_s + map_every_s - 1e-9;
    log_map(log_, occupancy_of(navigator_.map()), 0.0, now.time_s);
  }

  AllowedGround ground_;
  double radius_m_;  // of the robot
  Navigator navigator_;
  SimulatedRobot robot_;
  CoverOrders orders_;
  Log& log_;
  NavigatedCover done_;
  bool outside_ = false;  // of the area, now
  double next_map_s_ = 0.0;
};

}  // namespace

Outcome<CoverProblem> kept_inside(const CoverProblem& problem) {
  const Region inside = shrunk(region_of_all(problem), problem.tracking_error_m, inside_arc_m);
  if (inside.empty())
    return bad_input(
        fmt::format("nowhere in the area is room for a robot that is up to {:g} m beside its track",
                    problem.tracking_error_m),
        "tracking_error");
  const auto part = std::ranges::max_element(inside, {}, [&](const RingedPolygon& one) {
    const bool has_start = problem.start && contains(one, problem.start->position);
    return std::pair(has_start, area_of(one));
  });
  CoverProblem rest = problem;
  rest.boundary = part->outer;
  rest.holes = part->holes;
  rest.others.clear();
  return rest;
}

double rim_of(const NavigationOptions& options) {
  return options.motion.margin_m + 0.5 * options.live_map.resolution_m;
}

Outcome<NavigatedCover> drive_with_navigator(const CoverProblem& problem, const CoverMethod& method,
                                             const CoverOptions& options, const CoverPlan& plan,
                                             const NavigationOptions& navigation, const std::string& things,
                                             std::uint64_t seed, Log& log, const RunWatch& watch,
                                             const std::function<void(const PieceDrive&)>& look) {
  auto world = world_of_things(problem, things);
  if (!world) return pass_on(world);
  const Pose2& start = plan.track.start;
  const double rim_m = rim_of(navigation);
  const Region reach = reach_among(problem, plan, *world, rim_m + seen_off_m);
  if (reach.empty()) {
    const Vec2 at = problem.frame.to_file(start.position);
    return bad_input(
        fmt::format("they leave the robot no room where it starts, at ({:.2f}, {:.2f}); move one, "
                    "or give another start",
                    at.x, at.y),
        "things");
  }
  const auto inside = kept_inside(problem);
  if (!inside) return pass_on(inside);
  const RobotModel model = robot_of(problem);
  const Footprint footprint = Footprint::disk(model.radius_m);
  const Region area = region_of_all(problem);
  NavigatorSetup setup = setup_of(navigation, model, footprint);
  setup.allowed = allowed_of(area);
  auto navigator = Navigator::make(setup, start);
  if (!navigator) return pass_on(navigator);

  log_solids(log, *world, robot_height_m);
  add_walls(area, *world);
  world->bounds = bounds_of(area).grown(1.0);
  NavigatedDrive drive(*setup.allowed, model.radius_m, std::move(*navigator),
                       simulated_explorer(*world, start, model, devices_of(navigation, footprint), seed),
                       CoverOrders(*inside, method, options, plan, rim_m, watch.budget()), log);
  drive.run(watch, look);
  NavigatedCover done = drive.result();
  done.driven = coverage_of(done.drive.way, model.radius_m, reach);
  done.reach = reach;
  return done;
}

}  // namespace outrider
