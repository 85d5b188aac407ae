// Report: everything that happened in one run. The one thing that the summary, the JSON file, the
// replay page and the pictures are made from; docs/report.md describes the JSON.
//
// Times are seconds on the run's own clock. Angles of yaw and heading are in the world, counter-
// clockwise from +x; pitch is up from the horizon. A number that is not known is NaN.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

struct ReportSolid {
  std::string name;
  std::string kind;                       ///< box, cylinder, sphere, half_space, mesh
  std::vector<RoundedPolygon> footprint;  ///< of the whole solid
  double low_z_m = 0.0;
  double high_z_m = 0.0;
  bool blocks_driving = false;  ///< some part of it stands in the robot's way
};

/// One instant of the motion; between two samples every value is interpolated linearly.
struct TrackSample {
  double time_s = 0.0;
  Pose2 pose;
  double gun_yaw_rad = 0.0;
  double gun_pitch_rad = 0.0;
};

/// A solid cut by the vertical plane of a shot: polygons in (distance along from the muzzle, height).
struct ProfilePiece {
  std::string name;
  std::vector<Vec2> polygon;
};

struct ReportShot {
  std::string target;
  int attempt = 1;        ///< 1, 2, ... for this target
  double time_s = 0.0;    ///< when the ball leaves the muzzle
  double flight_s = 0.0;  ///< until its first contact
  Vec3 muzzle;            ///< centre of the ball as it leaves
  Vec3 velocity_mps;      ///< of the ball as it leaves
  std::string contact;    ///< name of what was touched first; the target's name on a hit
  Vec3 contact_point;     ///< centre of the ball then
  bool hit = false;
  bool hit_by_reference_rule = false;  ///< ball centre came within 0.5 m of the target's base
  double clearance_m = 0.0;            ///< least distance from the ball to any solid before the contact
  std::vector<ProfilePiece> profile;   ///< the side view, the target's box included under its name
  std::optional<std::vector<Vec3>> path =
      {};  ///< of the ball's centre at equal times from the muzzle to the contact, where it is no parabola
  std::optional<Vec2> platform_velocity_mps = {};  ///< of the robot, where it drove; in the velocity above
};

/// The stay of an intruder.
struct ReportVisit {
  std::string entrance;
  Vec2 from;               ///< where that is
  double enters_s = 0.0;   ///< from then on it is known
  double settles_s = 0.0;  ///< when it is in its place, after a straight way there
};

/// Where a target that moves was at an instant; between two of them it went straight.
struct ReportMove {
  double time_s = 0.0;
  Vec2 position;  ///< in truth
  Vec2 believed;  ///< as the robot had it
};

struct ReportTarget {
  std::string name;
  std::string status;  ///< reached, failed or unreachable
  std::string reason;  ///< one sentence
  Vec3 centre;
  Vec3 size;  ///< length, width, height, m
  double yaw_rad = 0.0;
  Pose2 pose;  ///< from which it was shot last
  double pitch_rad = 0.0;
  double shot_yaw_rad = 0.0;
  double speed_mps = 0.0;
  double clearance_m = 0.0;
  double done_s = 0.0;  ///< when its status became final
  int shots = 0;
  std::optional<ReportVisit> visit =
      {};  ///< of one that was not there from the start; it leaves when reached
  std::optional<std::vector<ReportMove>> moves =
      {};  ///< of one that moved after it was in its place; `centre` and `size` are of the last place
};

struct ReportEvent {
  double time_s = 0.0;
  std::string kind;  ///< drive, aim, shot, hit, miss, status, ...
  std::string text;  ///< one sentence
};

struct ReportPath {
  double start_s = 0.0;
  double end_s = 0.0;
  std::vector<Vec2> waypoints;
};

/// What was known of a pursuit at one moment; costs are of the whole mission.
struct ReportBound {
  double time_s = 0.0;       ///< of the mission
  double expansions = 0.0;   ///< of planning until then
  double cost = 0.0;         ///< by the best catch known; NaN: none
  double lower_bound = 0.0;  ///< proven; 0: nothing
};

/// A map that is drawn in a report has at most so many cells; what was larger is drawn coarser.
inline constexpr std::int64_t most_drawn_cells = 4'000'000;

/// A pursuit over a map of costs: who was where in each second, what it cost, what was known.
struct ReportChase {
  int columns = 0;  ///< of the map as it is drawn; coarser than the true one where that is large
  int rows = 0;
  double cell_m = 1.0;            ///< side of a drawn cell; the lowest corner is bounds.low
  std::vector<double> cost_runs;  ///< cost, count, cost, count, ... row by row from the lowest; -1: wall
  std::vector<Vec2> target;       ///< where it is at second 0, 1, ...
  std::vector<std::vector<Vec2>> robots;  ///< the same of each robot, until the end of the mission
  std::vector<double> paid;               ///< by all robots until second 0, 1, ...
  std::vector<ReportBound> bounds;
};

/// A place that fills the tank or the battery.
struct ReportStation {
  std::string name;
  Vec2 position;
  bool gives_water = false;
  bool gives_charge = false;
};

/// What was in the stores at one instant; between two of them the levels are interpolated linearly.
struct ReportLevel {
  double time_s = 0.0;
  double water = 0.0;
  double charge_j = 0.0;
};

/// A tank and a battery that end. What has no end is infinite, and NaN once read back.
struct ReportSupplies {
  double tank = 0.0;
  double battery_j = 0.0;
  std::vector<ReportStation> stations;
  std::vector<ReportLevel> levels;
};

/// A tag on a wall, and where the heading out of the wall goes.
struct ReportTag {
  int id = 0;
  Vec2 position;
  double facing_rad = 0.0;
  double size_m = 0.0;
  std::optional<double> height_m = {};  ///< of its middle above the floor
};

/// A pinhole camera that looks straight ahead; the numbers of its image as those of Camera.
struct ReportCamera {
  int width_px = 0;
  int height_px = 0;
  double fx = 1.0;
  double fy = 1.0;
  double cx = 0.0;
  double cy = 0.0;
  double ahead_m = 0.0;   ///< of the robot's middle
  double height_m = 0.0;  ///< above the floor
};

/// A place that a robot on wheels was to go to, and how it came there.
struct ReportStop {
  Pose2 pose;
  bool stop = true;     ///< it was to come to rest there
  double time_s = 0.0;  ///< when it was reached; NaN: never, or passed by
  Vec2 error;           ///< of the true position then, in the world
  double heading_error_rad = 0.0;
};

/// What the robot believed of its pose at one moment.
struct ReportBelief {
  double time_s = 0.0;
  Pose2 pose;
  double sigma_x_m = 0.0;
  double sigma_y_m = 0.0;
  double correlation = 0.0;  ///< of x and y
  double sigma_rad = 0.0;
  bool saw_tag = false;  ///< since the belief before, a tag told where the robot is; exploring: a place was
                         ///< recognised
};

/// A drive on wheels; the truth is the track of the report.
struct ReportDrive {
  std::string loop;  ///< closed or open
  std::vector<ReportTag> tags;
  std::vector<ReportStop> stops;
  std::vector<ReportBelief> beliefs;
  std::optional<ReportCamera> camera = {};  ///< of a drive by tags
};

/// What a robot has found out of a map, and when. The lists go row by row from the lowest.
struct ReportMap {
  Vec2 origin;           ///< lowest corner
  double cell_m = 0.05;  ///< side of a drawn cell; a large map is drawn coarser than it is
  int columns = 0;
  int rows = 0;
  std::vector<int> state_runs;  ///< Occupancy in the end, count, Occupancy, count, ...
  double step_s = 1.0;
  std::vector<int> known_runs;  ///< in which step the cell was first known, count, ...; as the cell before
                                ///< where it never was
};

/// Where exploring went next.
struct ReportDecision {
  double time_s = 0.0;
  std::string kind;  ///< frontier, home, ...
  Pose2 goal;
  std::vector<Vec2> waypoints;
  int frontiers = 0;  ///< open then
};

/// A frontier that was left as it was.
struct ReportRefusal {
  Vec2 position;
  std::string reason;  ///< one sentence
};

/// A range finder that looks all around.
struct ReportLaser {
  int beams = 0;  ///< equally far apart
  double range_m = 0.0;
  double height_m = 0.0;  ///< of its plane above the floor
  Pose2 mount;            ///< robot_T_laser
};

/// The exploring of what was not known; the truth of the way is the track of the report.
struct ReportExplore {
  ReportMap map;
  std::vector<std::vector<Vec2>> walls;  ///< in truth: closed outlines of what the range finder meets
  std::vector<ReportBelief> beliefs;
  std::vector<ReportDecision> decisions;
  std::vector<ReportRefusal> refused;
  std::optional<ReportLaser> laser = {};
};

/// A stretch of the way over an area.
struct ReportPass {
  double start_s = 0.0;
  double end_s = 0.0;
  std::string role;  ///< lap, lane or move
};

/// How much was covered by then; between two of them about linearly.
struct ReportCovered {
  double time_s = 0.0;
  double covered_m2 = 0.0;
  double twice_m2 = 0.0;
};

/// The way over every spot of an area; it is the track of the report. Areas are closed outlines: those of
/// polygons run counter-clockwise, those of their holes clockwise.
struct ReportCover {
  double width_m = 0.0;                   ///< of the strip that is covered
  std::vector<std::vector<Vec2>> area;    ///< all that was asked for
  std::vector<std::vector<Vec2>> reach;   ///< of it, what the robot can cover
  std::vector<std::vector<Vec2>> missed;  ///< of the reach, in the end
  std::vector<std::vector<Vec2>> twice;   ///< of the reach, in the end
  std::vector<Vec2> planned;              ///< the track that was to be driven
  std::vector<ReportPass> passes;
  std::vector<ReportCovered> covered;
};

/// A place that was recognised: two poses of the way that were joined, where they lie in the end.
struct ReportLoop {
  double time_s = 0.0;  ///< when
  Vec2 from;
  Vec2 to;
};

struct ReportLandmark {
  std::int64_t id = 0;
  double first_s = 0.0;  ///< when it was first in the map
  Vec2 position;         ///< in the end, as the sigmas
  double sigma_x_m = 0.0;
  double sigma_y_m = 0.0;
  double correlation = 0.0;  ///< of x and y
  int sightings = 0;
  std::optional<Vec2> truth = {};  ///< in the frame of the map
};

/// What a range finder met.
struct ReportScan {
  double time_s = 0.0;
  std::vector<Vec2> points;  ///< in the frame of the robot
};

/// Mapping from what a robot has recorded. The track of the report is the way as it was settled in the end.
struct ReportSlam {
  std::string engine;                 ///< laser, ekf, graph, ...
  std::vector<ReportBelief> beliefs;  ///< as it was believed then
  std::vector<Vec2> odometry;         ///< where odometry alone puts the robot at the times of the beliefs
  std::vector<Vec2> reference;        ///< the same of a reference in the frame of the map; empty: none
  std::vector<ReportLoop> loops;
  std::vector<ReportLandmark> landmarks;
  std::vector<ReportScan> scans;  ///< some of them
  std::optional<ReportMap> map = {};
};

/// Heights on a lattice of posts, row by row from the lowest; between four posts lie two triangles, joined
/// along the diagonal from the lowest x and y. A large field is drawn coarser than it is.
struct ReportRelief {
  Vec2 origin;  ///< of the first post
  Vec2 spacing_m{1.0, 1.0};
  int columns = 0;
  int rows = 0;
  std::vector<double> heights_m;
};

struct ReportContour {
  double height_m = 0.0;
  std::vector<Vec2> points;  ///< the first again at the end of a closed one
};

/// Ground that is not flat.
struct ReportTerrain {
  std::vector<ReportContour> contours;
  std::vector<RoundedPolygon> steep;  ///< too steep for the robot
  std::optional<ReportRelief> relief = {};
};

struct Report {
  std::string status;                   ///< "done" or "not_done"
  std::string job;                      ///< "guard", ...
  std::string reason;                   ///< why it was not done; empty when it was
  std::optional<std::string> sim = {};  ///< "physics" when rigid bodies carried it out
  std::uint64_t seed = 0;
  std::vector<std::pair<std::string, std::string>> settings;  ///< option name -> value with unit
  std::vector<std::string> warnings;                          ///< what was repaired in the input

  std::string world_name;
  Box2 bounds;
  double gravity_mps2 = 9.8;
  double robot_radius_m = 0.0;
  double gun_length_m = 0.0;  ///< from the yaw axis to the tip, for drawing
  double ball_radius_m = 0.0;
  double margin_m = 0.0;  ///< clearance that planned flights keep
  Pose2 start;
  std::vector<ReportSolid> solids;
  std::optional<ReportTerrain> terrain;

  std::vector<std::pair<std::string, double>> metrics;  ///< in the order of showing
  /// How long the machine took for what. Shown, and never stored: it differs from run to run.
  std::vector<std::pair<std::string, double>> machine_times = {};
  std::vector<ReportTarget> targets;
  std::vector<ReportPath> paths;
  std::vector<ReportShot> shots;
  std::vector<ReportEvent> events;
  std::vector<TrackSample> track;
  std::optional<ReportSupplies> supplies;     ///< where they end
  std::optional<ReportChase> chase;           ///< of the job pursue
  std::optional<ReportDrive> drive = {};      ///< of the job drive
  std::optional<ReportExplore> explore = {};  ///< of the job explore, and of a yard that was explored first
  std::optional<ReportCover> cover = {};      ///< of the job cover
  std::optional<ReportSlam> slam = {};        ///< of the job slam
};

/// The metric or the time of the machine of that name; `otherwise` where the report has none. O(metrics).
inline double metric(const Report& report, std::string_view name,
                     double otherwise = std::numeric_limits<double>::quiet_NaN()) {
  for (const auto* list : {&report.metrics, &report.machine_times}) {
    for (const auto& [key, value] : *list) {
      if (key == name) return value;
    }
  }
  return otherwise;
}

}  // namespace outrider
