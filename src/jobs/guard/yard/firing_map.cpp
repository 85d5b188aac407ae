#include "outrider/jobs/guard/yard/firing_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "outrider/ballistics/stance.hpp"
#include "outrider/core/parallel.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr double too_many_bytes = std::numeric_limits<double>::infinity();
constexpr double too_far = std::numeric_limits<double>::infinity();

ShotRules rules_of(const GuardProblem& problem, const GuardOptions& options) {
  return {problem.gun,
          problem.errors.aim,
          problem.world.gravity_mps2,
          problem.world.floor_z_m,
          problem.robot.radius_m,
          options.margin_m,
          options.pitch_step_rad,
          options.aim_step_m,
          problem.air,
          problem.world.terrain};
}

/// The room of the robot is that of its barrel, too, which may point anywhere.
Status check_barrel(const GuardProblem& problem) {
  const double reach = barrel_reach(problem.gun);
  if (reach <= problem.robot.radius_m) return {};
  return bad_input(
      fmt::format("a disk of {:g} m does not contain the barrel, whose tip is {:.4g} m from the yaw "
                  "axis; give robot.radius at least that, or a smaller gun.tip_forward",
                  problem.robot.radius_m, reach),
      "robot.radius");
}

Status check_air(const GuardProblem& problem) {
  const double wind = problem.air.wind_mps;
  if (wind >= problem.gun.muzzle_speed_mps) {
    return bad_input(fmt::format("a wind of {:g} m/s carries off every ball, as none leaves the gun faster "
                                 "than {:g} m/s; give less wind or a larger gun.muzzle_speed",
                                 wind, problem.gun.muzzle_speed_mps),
                     "air.wind");
  }
  if (wind > 0.0 && problem.air.none()) {
    return bad_input(fmt::format("a wind of {:g} m/s acts by drag alone; give air.drag, such as 0.02 for a "
                                 "ball of water of 1 cm",
                                 wind),
                     "air.wind");
  }
  return {};
}

Status check_terrain(const GuardProblem& problem) {
  if (!problem.world.terrain) return {};
  const Box2 has = problem.world.terrain->bounds();
  const Box2& yard = problem.world.bounds;
  if (!yard.empty() && !(has.grown(1e-9).contains(yard.low) && has.grown(1e-9).contains(yard.high))) {
    return bad_input(
        fmt::format("it spans {} to {}, and the yard {} to {}; make it larger, or give bounds within it",
                    place_text(has.low.x, has.low.y), place_text(has.high.x, has.high.y),
                    place_text(yard.low.x, yard.low.y), place_text(yard.high.x, yard.high.y)),
        "terrain");
  }
  return {};
}

Status check_numbers(GuardProblem problem, GuardOptions options) {
  if (auto ok = check_ranges(describe(problem.robot), "robot"); !ok) return ok;
  if (auto ok = check_ranges(describe(problem.gun), "gun"); !ok) return ok;
  if (auto ok = check_ranges(describe(problem.air), "air"); !ok) return ok;
  if (auto ok = check_barrel(problem); !ok) return ok;
  if (auto ok = check_air(problem); !ok) return ok;
  if (auto ok = check_terrain(problem); !ok) return ok;
  if (auto ok = check_ranges(describe(problem.errors), "errors"); !ok) return ok;
  if (auto ok = check_ranges(describe(options), "plan"); !ok) return ok;
  const Pose2& start = problem.start;
  if (!std::isfinite(start.position.x + start.position.y + start.heading_rad)) {
    return bad_input("not a finite number; give x, y in m and a heading", "start");
  }
  if (!(problem.world.gravity_mps2 > 0.0) ||
      !std::isfinite(problem.world.gravity_mps2 + problem.world.floor_z_m)) {
    return bad_input(
        fmt::format("a gravity of {:g} m/s2 and a floor at {:g} m are not valid; gravity is above 0",
                    problem.world.gravity_mps2, problem.world.floor_z_m),
        "world");
  }
  for (const Target& target : problem.targets) {
    const double sum = squared_norm(target.base) + squared_norm(target.size) + target.yaw_rad;
    if (std::isfinite(sum) && target.size.x > 0.0 && target.size.y > 0.0 && target.size.z > 0.0) continue;
    return bad_input(
        fmt::format("target {} has a number that is not finite or a size that is not above 0", target.name),
        "targets");
  }
  return {};
}

Status check_targets(const GuardProblem& problem) {
  for (const Target& target : problem.targets) {
    for (const Solid& solid : problem.world.solids) {
      const bool is_surface = std::holds_alternative<MeshShape>(solid.shape);
      if (is_surface || distance(target.centre(), solid) > 0.0) continue;
      return bad_input(fmt::format("target {} at ({:g}, {:g}, {:g}) is inside {}; move it out", target.name,
                                   target.base.x, target.base.y, target.base.z, solid.name),
                       "targets");
    }
  }
  return {};
}

/// Cells of a square about the target that holds every place from which a flight may reach it.
double cells_in_reach(const GridFrame& frame, const ShotRules& rules, const Target& target) {
  const double cells = static_cast<double>(frame.width) * static_cast<double>(frame.height);
  const double range = rules.air.none() ? longest_range(rules, target) : too_far;
  const double side = 2.0 * range / frame.resolution_m + 4.0;
  return std::min(cells, side * side);
}

/// Bytes that planning holds at most but for the fields of its bound, which take what is left: the vectors of
/// FiringMap and the sure hits, by cell; pitch, error_ratio and least flight of each target, by cell in its
/// reach (in air, of the whole grid: the reach takes long to find).
double bytes_needed(const GridFrame& frame, const GuardProblem& problem, const GuardOptions& options) {
  const double cells = static_cast<double>(frame.width) * static_cast<double>(frame.height);
  const double words = std::ceil(static_cast<double>(problem.targets.size()) / 64.0);
  double bytes = cells * (3.0 + 4.0 + 4.0 + 8.0 * words);
  const ShotRules rules = rules_of(problem, options);
  for (const Target& target : problem.targets) bytes += 7.0 * cells_in_reach(frame, rules, target);
  return bytes;
}

Outcome<GridFrame> frame_for(const GuardProblem& problem, const GuardOptions& options) {
  const Vec2 size = problem.world.bounds.size();
  const double cap = static_cast<double>(options.memory_mib) * 1024.0 * 1024.0;
  const double cells = std::ceil(size.x / options.resolution_m) * std::ceil(size.y / options.resolution_m);
  if (problem.world.bounds.empty() || !std::isfinite(cells) || cells < 1.0) {
    return bad_input("the yard has no bounds; give them as low x, low y, high x, high y", "bounds");
  }
  const bool few = cells <= 1e9 && size.x / options.resolution_m < 1e6 && size.y / options.resolution_m < 1e6;
  const GridFrame frame = few ? covering(problem.world.bounds, options.resolution_m) : GridFrame{};
  const double bytes = few ? bytes_needed(frame, problem, options) : too_many_bytes;
  if (bytes > cap) {
    return bad_input(fmt::format("a resolution of {:g} m makes {:.3g} places and needs more than {} MiB; "
                                 "take a coarser one or raise plan.memory_cap",
                                 options.resolution_m, cells, options.memory_mib),
                     "plan.resolution");
  }
  return frame;
}

/// Tangent of the steepest slope in the cells that a disk may touch.
double steepest_under(const HeightField& field, Vec2 p, double radius_m) {
  const Vec2 reach{radius_m, radius_m};
  const Cell low = field.cell_at(p - reach);
  const Cell high = field.cell_at(p + reach);
  double slope = 0.0;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) slope = std::max(slope, field.steepest_in({x, y}));
  }
  return slope;
}

Status check_start(const GuardProblem& problem, const CollisionMap& ground) {
  const Vec2 p = problem.start.position;
  const double radius = problem.robot.radius_m;
  if (!problem.world.bounds.contains(p)) {
    return fault(
        FaultCode::outside_map,
        fmt::format(
            "{} is outside the yard, which spans {} to {}; start inside, or give bounds that contain it",
            place_text(p.x, p.y), place_text(problem.world.bounds.low.x, problem.world.bounds.low.y),
            place_text(problem.world.bounds.high.x, problem.world.bounds.high.y)),
        "start");
  }
  const double clearance = ground.clearance(p, radius);
  if (clearance < radius) {
    const double slope = problem.world.terrain ? steepest_under(*problem.world.terrain, p, radius) : 0.0;
    if (slope > std::tan(problem.robot.max_slope_rad)) {
      return fault(
          FaultCode::start_blocked,
          fmt::format("the ground under the robot at ({:g}, {:g}) is as steep as {:.1f} degrees, and "
                      "it holds on {:g}; start elsewhere or raise robot.max_slope",
                      p.x, p.y, degrees(std::atan(slope)), degrees(problem.robot.max_slope_rad)),
          "start");
    }
    return fault(FaultCode::start_blocked,
                 fmt::format("({:g}, {:g}) is {:.3g} m from an obstacle or the edge of the yard, and the "
                             "robot's radius is {:g} m; start elsewhere",
                             p.x, p.y, std::max(0.0, clearance), radius),
                 "start");
  }
  return {};
}

constexpr std::size_t cells_an_ask = 256;  // of the stop token

void find_standable(FiringMap& firing_map, double radius_m, double spare_m, const std::stop_token& stop) {
  for (std::size_t i = 0; i < firing_map.frame.size(); ++i) {
    if (i % cells_an_ask == 0 && stop.stop_requested()) return;
    const double clearance = firing_map.ground.clearance(firing_map.place(i), radius_m + spare_m);
    firing_map.clearance_m[i] = static_cast<float>(clearance);
    firing_map.standable[i] = clearance >= radius_m ? 1 : 0;
  }
}

/// Breadth-first from the cells that the start sees within two steps; every step is swept exactly.
void find_reachable(FiringMap& firing_map, Vec2 start, double radius_m, const std::stop_token& stop) {
  const GridFrame& frame = firing_map.frame;
  const double step = frame.resolution_m;
  std::queue<std::size_t> open;
  const auto reach = [&](Vec2 from, std::optional<std::size_t> parent, Cell c, bool surely_free) {
    if (!frame.contains(c)) return;
    const std::size_t i = frame.index(c);
    if (firing_map.standable[i] == 0 || firing_map.reachable[i] != 0) return;
    if (!surely_free && !firing_map.ground.segment_free({from, frame.centre(c)}, radius_m)) return;
    firing_map.reachable[i] = 1;
    firing_map.homeward[i] = static_cast<std::uint32_t>(parent.value_or(i));
    open.push(i);
  };
  const Cell home = frame.cell_at(start);
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) reach(start, {}, {home.x + dx, home.y + dy}, false);
  }
  for (std::size_t popped = 0; !open.empty(); ++popped) {
    if (popped % cells_an_ask == 0 && stop.stop_requested()) return;
    const std::size_t i = open.front();
    open.pop();
    const Cell c = frame.cell(i);
    // Within half a diagonal step of a cell with that much to spare nothing can be touched.
    const bool roomy = firing_map.clearance_m[i] >= radius_m + 1.5 * step;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) reach(frame.centre(c), i, {c.x + dx, c.y + dy}, roomy);
    }
  }
}

/// Refuses to try everything where that would take days.
Status check_flights(const FiringMap& firing_map, const Target& target, double aim_step_m) {
  constexpr double most_flights = 1e13;
  const double places = cells_in_reach(firing_map.frame, firing_map.rules, target);
  const double points =
      (1.0 + std::hypot(target.size.x, target.size.y) / aim_step_m) * (1.0 + target.size.z / aim_step_m);
  const double pitches = static_cast<double>(pitch_lattice(firing_map.rules).size());
  if (places * points * pitches <= most_flights) return {};
  return bad_input(
      fmt::format(
          "no shot at the centre of target {} was found, and to try all takes up to {:.2g} flights: "
          "from {:.3g} places at {:.3g} points with {:.0f} pitches, and at most {:.2g} are tried; take a "
          "larger plan.aim_step, plan.resolution or plan.pitch_step",
          target.name, places * points * pitches, places, points, pitches, most_flights),
      "plan.aim_step");
}

/// Tries everything the resolution allows before no shot at a target counts as found.
void try_all(FiringMap& firing_map, const Target& target, std::size_t t, const std::stop_token& stop) {
  const FlightSpace& space = firing_map.space(t);
  Exhausted tried = exhaust(firing_map.rules, space, target, firing_map.frame, firing_map.reachable, stop);
  if (tried.found) {
    FiringRegion& region = firing_map.regions[t];
    const auto pitches = pitch_lattice(firing_map.rules);
    const Vec2 place = firing_map.place(*tried.found);
    const double pitch = angles_of(stance_at(firing_map.rules, place), tried.shot).pitch_rad;
    const auto index =
        std::ranges::min_element(pitches, {}, [pitch](double p) { return std::abs(p - pitch); }) -
        pitches.begin();
    region.pitch.set(*tried.found, static_cast<std::uint8_t>(index));
    region.error_ratio.set(*tried.found,
                           static_cast<float>(error_ratio(firing_map.rules, target, place, tried.shot)));
    region.hits = 1;
    return;
  }
  std::vector<std::uint8_t> elsewhere(firing_map.frame.size());
  for (std::size_t i = 0; i < elsewhere.size(); ++i) {
    elsewhere[i] = firing_map.standable[i] != 0 && firing_map.reachable[i] == 0 ? 1 : 0;
  }
  firing_map.no_shots[t].from_elsewhere =
      firing_region(firing_map.rules, space, target, firing_map.frame, elsewhere, stop).hits > 0;
  firing_map.no_shots[t].blocked =
      best_blocked_flight(firing_map.rules, space, target, firing_map.frame, firing_map.reachable, stop);
  firing_map.no_shots[t].exhausted = std::move(tried);
}

}  // namespace

std::vector<FlightSpace> flight_spaces(const GuardProblem& problem) {
  if (!problem.targets_block) return {FlightSpace(problem.world.solids)};
  std::vector<FlightSpace> spaces;
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    std::vector<Solid> solids = problem.world.solids;
    for (std::size_t j = 0; j < problem.targets.size(); ++j) {
      if (j != i) solids.push_back(solid_of(problem.targets[j]));
    }
    spaces.emplace_back(std::move(solids));
  }
  return spaces;
}

World driving_world(const GuardProblem& problem) {
  World world = problem.world;
  if (problem.targets_block) {
    for (const Target& target : problem.targets) world.solids.push_back(solid_of(target));
  }
  return world;
}

Outcome<FiringMap> build_firing_map(const GuardProblem& problem, const GuardOptions& options,
                                    const Budget& budget, RegionSearch search) {
  if (auto ok = check_numbers(problem, options); !ok) return pass_on(ok);
  if (auto ok = check_targets(problem); !ok) return pass_on(ok);
  auto frame = frame_for(problem, options);
  if (!frame) return pass_on(frame);

  FiringMap firing_map{
      rules_of(problem, options),
      flight_spaces(problem),
      CollisionMap::of(driving_world(problem), room_height(problem), 1e-3, problem.robot.max_slope_rad),
      *frame,
      std::vector<std::uint8_t>(frame->size(), 0),
      std::vector<std::uint8_t>(frame->size(), 0),
      std::vector<float>(frame->size(), 0.0F),
      std::vector<std::uint32_t>(frame->size(), 0),
      std::vector<FiringRegion>(problem.targets.size()),
      std::vector<NoShot>(problem.targets.size()),
      {}};
  if (auto ok = check_start(problem, firing_map.ground); !ok) return pass_on(ok);

  const double spare = std::max(problem.errors.position_m, 1.5 * options.resolution_m);
  const auto cancelled = [] {
    return fault(FaultCode::cancelled, "it was cancelled while it looked for places to shoot from");
  };
  find_standable(firing_map, problem.robot.radius_m, spare, budget.stop);
  find_reachable(firing_map, problem.start.position, problem.robot.radius_m, budget.stop);
  if (budget.stop.stop_requested()) return cancelled();
  if (search == RegionSearch::none) return firing_map;
  auto corners = find_corners(firing_map.ground, problem.robot, {}, {}, budget);
  if (!corners) return pass_on(corners);
  firing_map.corners = std::move(*corners);
  parallel_for(problem.targets.size(), [&](std::size_t i) {
    const Target& target = problem.targets[i];
    firing_map.regions[i] = firing_region(firing_map.rules, firing_map.space(i), target, firing_map.frame,
                                          firing_map.reachable, budget.stop);
  });
  if (budget.stop.stop_requested()) return cancelled();
  if (search == RegionSearch::centres_only) return firing_map;
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    if (firing_map.regions[i].hits > 0) continue;
    if (auto ok = check_flights(firing_map, problem.targets[i], options.aim_step_m); !ok) return pass_on(ok);
  }
  parallel_for(problem.targets.size(), [&](std::size_t i) {
    if (firing_map.regions[i].hits == 0) try_all(firing_map, problem.targets[i], i, budget.stop);
  });
  if (budget.stop.stop_requested()) return cancelled();
  return firing_map;
}

}  // namespace outrider
