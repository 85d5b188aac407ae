#include "outrider/jobs/cover/mission/navigated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ground/tool_coverage.hpp"
#include "outrider/core/units.hpp"
#include "outrider/io/scenario/things.hpp"
#include "outrider/job/navigation_log.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

constexpr double most_wall_m = 1.0, least_wall_m = 0.001, wall_height_m = 1.0;
constexpr double robot_height_m = 0.5;
constexpr double seen_off_m = 0.03;  // by which marks may be beside what they are of
constexpr double noted_m = 0.01, noted_rad = radians(2.0);
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

/// Returns how thick a wall outside of an edge can be that reaches no edge. The area is on the left of its
/// edges.
double wall_behind(const Segment& edge, const std::vector<Segment>& edges) {
  const double length_m = distance(edge.a, edge.b);
  const Vec2 along = (1.0 / length_m) * (edge.b - edge.a);
  double wall_m = most_wall_m;
  for (const Segment& other : edges) {
    if (distance(other.a, edge) > wall_m + distance(other.a, other.b)) continue;
    while (wall_m > least_wall_m) {
      const double rim_m = std::min(0.1 * least_wall_m, 0.1 * length_m);
      const Vec2 in = rim_m * along, out = -(wall_m - rim_m) * perpendicular(along);
      const Vec2 beside = -rim_m * perpendicular(along);
      const RoundedPolygon wall{
          {edge.a + in + beside, edge.a + in + out, edge.b - in + out, edge.b - in + beside}, 0.0};
      if (signed_distance(other, wall) > 0.0) break;
      wall_m = std::max(least_wall_m, 0.5 * wall_m);
    }
  }
  return wall_m;
}

/// Puts a wall along each edge, outside of the area: as thick as it can be without reaching into it.
void add_walls(const Region& area, World& world) {
  std::vector<Segment> edges = edges_of(area);
  std::erase_if(edges, [](const Segment& edge) { return edge.a == edge.b; });
  for (const Segment& edge : edges) {
    const double wall_m = wall_behind(edge, edges), length_m = distance(edge.a, edge.b);
    const Vec2 along = (1.0 / length_m) * (edge.b - edge.a);
    const Vec2 middle = 0.5 * (edge.a + edge.b) - 0.5 * wall_m * perpendicular(along);
    world.solids.push_back(
        {"edge",
         {{middle.x, middle.y, 0.5 * wall_height_m}, Rotation::from_rpy(0.0, 0.0, heading_of(along))},
         BoxShape{{0.5 * length_m, 0.5 * wall_m, 0.5 * wall_height_m}}});
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

/// Adds the last pose of the drive, if it has moved on a little since the last that was noted.
void add_last(PieceDrive& drive, const Pose2& pose) {
  if (drive.track.back().time_s < drive.time_s) add_pose(drive, drive.time_s, pose);
}

/// Notes that the robot was carried to a pose, from another.
void note_carried(PieceDrive& drive, double time_s, const Pose2& from, const Pose2& to) {
  add_last(drive, from);
  drive.carried.push_back({drive.time_s, time_s});
  drive.time_s = time_s;
  add_pose(drive, time_s, to);
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

/// Returns what a robot can cover that keeps the rim from things; nothing if it has no room in these places.
Region reach_among(const CoverProblem& problem, const CoverPlan& plan,
                   const std::vector<RoundedPolygon>& things, double rim_m, const std::vector<Vec2>& places) {
  std::vector<Region> all;
  for (const RoundedPolygon& thing : things) {
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
  Region standing = shrunk(without(plan.ground.area, united(all)), radius_m, arc_m);
  std::erase_if(standing, [&](const RingedPolygon& part) {
    return std::ranges::none_of(places, [&](Vec2 place) {
      return contains(part, place) || distance_to_border(part, place) <= 2.0 * arc_m;
    });
  });
  return common(grown(standing, radius_m, arc_m), plan.ground.reach);
}

/// A robot, its navigator and its orders, until these end.
class NavigatedDrive {
 public:
  NavigatedDrive(AllowedGround ground, const CoverProblem& problem, Navigator navigator, SimulatedRobot robot,
                 CoverOrders orders, Log& log)
      : ground_(std::move(ground)),
        problem_(problem),
        truth_(robot.pose()),
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
      log_.note(seen, now.time_s, navigator_.map());
      if (watch.stopped()) return;
      const auto order = orders_.next(now, navigator_);
      done_.finished = !order && !watch.stopped();
      if (!order) return;
      robot_.act(navigator_.act(*order));
      done_.recoveries = std::max(done_.recoveries, navigator_.recoveries());
      watch.part(orders_.driven_part(navigator_));
    }
  }

  /// Returns what was put in its way and still stands there.
  [[nodiscard]] std::optional<RoundedPolygon> post() const {
    return robot_.body<TwistBody>().walk_ins().post();
  }

  /// Returns what it came to, but for what was covered.
  NavigatedCover result() {
    const auto& body = robot_.body<TwistBody>();
    add_last(done_.drive, truth_);
    done_.believed_complete = orders_.believes_complete();
    done_.reason = orders_.reason();
    done_.contacts = body.contacts();
    done_.walked_into = body.walked_into();
    done_.rounds = orders_.rounds();
    done_.left_m2 = area_of(orders_.left());
    done_.blocked_s = body.walk_ins().blocked_s().value_or(-1.0);
    return std::move(done_);
  }

 private:
  void note_truth() {
    const Pose2 before = std::exchange(truth_, robot_.pose());
    const Vec2 here = truth_.position;
    const bool was_carried =
        is_leap(before.position, here, robot_.time_s() - done_.drive.time_s, problem_.pace);
    if (was_carried) note_carried(done_.drive, robot_.time_s(), before, truth_);
    note_pose(done_.drive, robot_.time_s(), truth_);
    const bool out = !ground_.contains(here) || ground_.to_edge_m(here) < problem_.body_radius_m();
    if (out && !outside_ && !was_carried) ++done_.left_ground;
    outside_ = out;
  }

  AllowedGround ground_;
  const CoverProblem& problem_;
  Pose2 truth_;
  Navigator navigator_;
  SimulatedRobot robot_;
  CoverOrders orders_;
  NavigationLog log_;
  NavigatedCover done_;
  bool outside_ = false;  // of the area, now
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
  std::vector<RoundedPolygon> standing = footprints_above_floor(*world);
  Region reach = reach_among(problem, plan, standing, rim_m + seen_off_m, {start.position});
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
  NavigatedDrive drive(*setup.allowed, problem, std::move(*navigator),
                       simulated_explorer(*world, start, model, devices_of(navigation, footprint), seed),
                       CoverOrders(*inside, method, options, plan, rim_m, watch.budget()), log);
  drive.run(watch, look);
  NavigatedCover done = drive.result();
  if (const auto post = drive.post()) {
    standing.push_back(*post);
    reach = reach_among(problem, plan, standing, rim_m + seen_off_m, {start.position, done.drive.way.back()});
  }
  // A stopped drive is measured, too.
  const std::stop_token stop = done.finished ? watch.stop : std::stop_token{};
  done.driven = cover::coverage_of_drive(done.drive, problem, reach, stop);
  if (stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while it measured what the drive covers");
  done.missed_m2 = area_of(without_specks(done.driven.missed));
  done.reach = std::move(reach);
  return done;
}

}  // namespace outrider
