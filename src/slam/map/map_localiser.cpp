#include "outrider/slam/map/map_localiser.hpp"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "algebra/small_cholesky.hpp"
#include "laser/recent_scans.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/slam/map/map_fit.hpp"
#include "outrider/world/known_extent.hpp"
#include "outrider/world/occupancy.hpp"
#include "scan/grid_surface.hpp"
#include "scan/scan_match.hpp"

namespace outrider {
namespace {

constexpr double most_side_m = 500.0;    // of a map: its surfaces take a byte for each 5 cm by 5 cm
constexpr int levels = 7;                // of the pyramid: the widest blocks are 3.2 m
constexpr double search_reach_m = 15.0;  // farther readings are not used to search the whole map
constexpr std::size_t fewest_points = 10;
constexpr std::int64_t most_blocks = 40'000'000;
constexpr double turn_m = 0.5;  // a radian turned shows as much as this way
constexpr double first_search_m = 0.5;
constexpr double growth = 1.5, most_between_m = 8.0;     // of the way between two searches
constexpr double clear_score = 0.8, least_score = 0.65;  // of places: a high one is found sooner

constexpr double most_contradiction = 0.25;  // share of the beams
constexpr double recognised_share = 0.6;     // of the beams that agree with the map
constexpr double fitting_share = 0.5;        // of one scan
constexpr double lost_share = 0.4;           // mean of the last scans
constexpr double averaged_scans = 8.0;
constexpr Driven told_start{3.0, 4.0};  // a start that was told is as uncertain as odometry is after that

MatchWindow window_of(const KnownMap& map, const Pose2& world_T_grid) {
  const GridFrame& frame = map.occupancy.frame;
  const CellExtent known = known_extent(map.occupancy);
  const Vec2 low = frame.corner(known.low), high = frame.corner({known.high.x + 1, known.high.y + 1});
  return {{world_T_grid * (0.5 * (low + high)), 0.0},
          0.5 * norm(high - low),
          std::numbers::pi,
          1e9,
          1e9,
          most_blocks};
}

/// Returns the pose of the frame in which a turned map has its cells.
Pose2 world_T_grid_of(const KnownMap& map) {
  const Vec2 origin = map.occupancy.frame.origin;
  return {origin - rotated(map.yaw_rad, origin), map.yaw_rad};
}

}  // namespace

struct MapLocaliser::State {
  State(KnownMap known, Surface surface, const LaserSlamOptions& given)
      : options(given),
        map(std::move(known)),
        world_T_grid(world_T_grid_of(map)),
        surfaces(std::vector<SurfaceMap::Part>{{&surface, world_T_grid, 0}}, levels),
        everywhere(window_of(map, world_T_grid)),
        recent(options) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  [[nodiscard]] MapFit fit_of(const LaserScan& scan, const Pose2& world_T_robot) const {
    const Pose2 grid_T_robot = relative_pose(world_T_grid, world_T_robot);
    return map_fit(map.occupancy, compose(grid_T_robot, options.robot_T_laser), scan, options.reach_m);
  }
  /// Returns true if the map has a wall where the laser is, as in a doorway that is newer: then its beams
  /// tell nothing about the map.
  [[nodiscard]] bool is_in_wall() const {
    const Vec2 laser = relative_pose(world_T_grid, pose) * options.robot_T_laser.position;
    const Cell cell = map.occupancy.frame.cell_at(laser);
    return map.occupancy.frame.contains(cell) && map.occupancy[cell] == occupied_cell;
  }
  void track(const LaserScan& scan, const Surface& surface, MapLocaliserStep& step);
  void search(const LaserScan& scan, const Surface& surface, MapLocaliserStep& step);
  [[nodiscard]] bool agree(const Pose2& world_T_robot) const;

  LaserSlamOptions options;
  KnownMap map;
  Pose2 world_T_grid;
  SurfaceMap surfaces;     ///< of the map, in the world
  MatchWindow everywhere;  ///< all poses on the map
  RecentScans recent;      ///< while the robot is not located
  Pose2 pose;
  bool is_located = false;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of the last match
  Driven unmatched;                                       ///< since the last match
  Driven unsearched;                                      ///< since the last search
  double search_m = first_search_m;                       ///< way until the next one
  double mean_share = 1.0;                                ///< of the beams that agree, over the last scans
};

Outcome<MapLocaliser> MapLocaliser::begin(KnownMap map, const LaserSlamOptions& options,
                                          const std::optional<Pose2>& start) {
  if (auto begun = LaserSlam::begin(options, {}); !begun) return pass_on(begun);  // checks the options
  Surface surface = surface_of(map.occupancy);
  if (surface.empty()) return bad_input("the map has no occupied cell beside a free one", "map");
  Box2 box;
  for (const SurfacePoint& point : surface) box.include(point.position);
  if (box.size().x > most_side_m || box.size().y > most_side_m) {
    return bad_input(
        fmt::format("the map is {:.0f} m by {:.0f} m; a robot is localised on at most {:.0f} m by {:.0f} m",
                    box.size().x, box.size().y, most_side_m, most_side_m),
        "map");
  }
  if (start && !finite(*start)) return bad_input("the start must be finite", "start");
  auto state = std::make_unique<State>(std::move(map), std::move(surface), options);
  if (start) {
    state->pose = wrap_heading(*start);
    state->is_located = true;
    state->unmatched = told_start;
  }
  return MapLocaliser(std::move(state));
}

MapLocaliser::MapLocaliser(std::unique_ptr<State> state) : state_(std::move(state)) {}
MapLocaliser::MapLocaliser(MapLocaliser&&) noexcept = default;
MapLocaliser& MapLocaliser::operator=(MapLocaliser&&) noexcept = default;
MapLocaliser::~MapLocaliser() = default;

/// Matches a scan of a located robot.
void MapLocaliser::State::track(const LaserScan& scan, const Surface& surface, MapLocaliserStep& step) {
  const auto contradiction = [&](const Pose2& at) { return fit_of(scan, at).contradiction(); };
  const MatchWindow about = odometry_window(pose, unmatched, options);
  if (about.reach_m <= most_correction_m) {
    if (const auto fit = match_nearby(surfaces, surface, about, contradiction)) {
      step.matched = true;
      pose = wrap_heading(fit->pose);
      information = fit->information;
      unmatched = {};
    }
  }
  const double share = step.matched ? fit_of(scan, pose).share() : 0.0;
  step.fits = step.matched && share >= fitting_share;
  if (is_in_wall()) return;
  mean_share += (share - mean_share) / averaged_scans;
  if (mean_share >= lost_share) return;
  is_located = false;
  step.lost = true;
  recent.clear();
  unsearched = {};
  search_m = first_search_m;
}

/// Returns true if the last scans fit the map with the robot at that pose.
bool MapLocaliser::State::agree(const Pose2& world_T_robot) const {
  MapFit sum;
  for (const RecentScans::Placed& placed : recent.scans()) {
    const MapFit fit = fit_of(placed.scan, compose(world_T_robot, relative_pose(recent.pose(), placed.pose)));
    sum.agreeing += fit.agreeing;
    sum.through += fit.through;
    sum.unexpected += fit.unexpected;
    sum.unknown += fit.unknown;
  }
  return sum.beams() > sum.unknown && sum.contradiction() <= most_contradiction &&
         sum.share() >= recognised_share;
}

/// Searches a robot that is not located.
void MapLocaliser::State::search(const LaserScan& scan, const Surface& surface, MapLocaliserStep& step) {
  if (!recent.add(scan, surface) || !recent.are_enough()) return;
  if (unsearched.way_m + turn_m * unsearched.turn_rad < search_m) return;
  unsearched = {};
  search_m = std::min(growth * search_m, most_between_m);
  const Surface together = recent.together();
  auto fit = recognise_place(surfaces, together, everywhere, clear_score);
  if (!fit) fit = recognise_place(surfaces, together, everywhere, least_score);
  if (!fit || !agree(fit->pose)) return;
  pose = wrap_heading(fit->pose);
  information = fit->information;
  unmatched = {};
  mean_share = 1.0;
  is_located = step.found = step.matched = step.fits = true;
  recent.clear();
}

Outcome<MapLocaliserStep> MapLocaliser::advance(const Pose2& motion, const LaserScan& scan) {
  State& s = *state_;
  const Pose2 moved = wrap_heading(compose(s.pose, motion));
  if (!finite(motion) || !finite(moved)) return bad_input("the motion is not finite; leave it out");
  s.pose = moved;
  s.unmatched += motion;
  s.unsearched += motion;
  s.recent.move(motion);
  MapLocaliserStep step;
  if (check(scan)) {
    const double reach_m = s.is_located ? s.options.reach_m : std::min(s.options.reach_m, search_reach_m);
    const Surface surface = surface_of(scan, s.options.robot_T_laser, reach_m);
    if (surface.size() >= fewest_points) {
      s.is_located ? s.track(scan, surface, step) : s.search(scan, surface, step);
    }
  }
  step.pose = s.pose;
  step.located = s.is_located;
  return step;
}

const Pose2& MapLocaliser::pose() const { return state_->pose; }
bool MapLocaliser::is_located() const { return state_->is_located; }
const KnownMap& MapLocaliser::map() const { return state_->map; }
const Pose2& MapLocaliser::world_T_grid() const { return state_->world_T_grid; }

Eigen::Matrix3d MapLocaliser::pose_covariance() const {
  const State& s = *state_;
  const MotionNoise noise = odometry_noise(s.unmatched, s.options);
  Eigen::Matrix3d result = SmallCholesky<3>(s.information + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
  if (!s.unmatched.is_zero()) result += noise.information().inverse();
  return result;
}

}  // namespace outrider
