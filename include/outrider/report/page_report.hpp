// PageReport: a run as the page and the pictures read it, made from its log. docs/report.md describes its
// JSON.
//
// Times are seconds on the run's own clock. Yaw and heading angles are in the world frame, counter-clockwise
// from +x. Pitch counts up from the horizon. An unknown number is NaN.
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
#include "outrider/log/log.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// A solid of the world.
struct ReportSolid {
  std::string name;
  std::string kind;                       ///< box, cylinder, sphere, half_space, mesh
  std::vector<RoundedPolygon> footprint;  ///< of the whole solid
  double low_z_m = 0.0;
  double high_z_m = 0.0;
  bool blocks_driving = false;  ///< some part of it is an obstacle for the robot
};

/// One instant of the motion. Every value is interpolated linearly between two samples.
struct TrackSample {
  double time_s = 0.0;
  Pose2 pose;
  double gun_yaw_rad = 0.0;
  double gun_pitch_rad = 0.0;
};

/// The section of a solid with the vertical plane of a shot, in (distance along from the muzzle, height).
struct ProfilePiece {
  std::string name;
  std::vector<Vec2> polygon;
};

/// One shot and its flight.
struct ReportShot {
  std::string target;
  int attempt = 1;        ///< 1, 2, ... for this target
  double time_s = 0.0;    ///< when the ball leaves the muzzle
  double flight_s = 0.0;  ///< until its first contact
  Vec3 muzzle;            ///< centre of the ball as it leaves
  Vec3 velocity_mps;      ///< of the ball as it leaves
  std::string contact;    ///< name of the solid that the ball touched first; the target's name on a hit
  Vec3 contact_point;     ///< centre of the ball at the contact
  bool hit = false;
  bool hit_by_reference_rule = false;  ///< ball centre came within 0.5 m of the target's base
  double clearance_m = 0.0;            ///< smallest distance from the ball to any solid before the contact
  std::vector<ProfilePiece> profile;   ///< the side view, the target's box included under its name
  std::optional<std::vector<Vec3>> path =
      {};  ///< centres of the ball at equal times from the muzzle to the contact; absent for a parabola
  std::optional<Vec2> platform_velocity_mps = {};  ///< of a robot that drives; included in velocity_mps
};

/// The visit of an intruder.
struct ReportVisit {
  std::string entrance;
  Vec2 from;               ///< position of the entrance
  double enters_s = 0.0;   ///< when it enters and becomes known
  double settles_s = 0.0;  ///< when it reaches its place along a straight line
};

/// The position of a moving target at an instant. It moves along a straight line between two instants.
struct ReportMove {
  double time_s = 0.0;
  Vec2 position;  ///< true position
  Vec2 believed;  ///< position in the robot's belief
};

/// A target and what became of it.
struct ReportTarget {
  std::string name;
  std::string status;  ///< reached, failed or unreachable
  std::string reason;  ///< one sentence
  Vec3 centre;
  Vec3 size;  ///< length, width, height, m
  double yaw_rad = 0.0;
  Pose2 pose;  ///< pose of the robot at the last shot
  double pitch_rad = 0.0;
  double shot_yaw_rad = 0.0;
  double speed_mps = 0.0;
  double clearance_m = 0.0;
  double done_s = 0.0;  ///< when its status became final
  int shots = 0;
  std::optional<ReportVisit> visit = {};  ///< of a target that arrived later; it leaves when it is reached
  std::optional<std::vector<ReportMove>> moves =
      {};  ///< of a target that moved after it settled; `centre` and `size` are those of the last place
};

/// Something that happened at one time.
struct ReportEvent {
  double time_s = 0.0;
  std::string kind;  ///< drive, aim, shot, hit, miss, status, ...
  std::string text;  ///< one sentence
};

/// A path that was driven.
struct ReportPath {
  double start_s = 0.0;
  double end_s = 0.0;
  std::vector<Vec2> waypoints;
};

/// What was known about a pursuit at one moment. Costs are those of the whole mission.
struct ReportBound {
  double time_s = 0.0;       ///< of the mission
  double expansions = 0.0;   ///< of all planning until this time
  double cost = 0.0;         ///< of the best known catch; NaN: none
  double lower_bound = 0.0;  ///< proven lower bound of the cost; 0: none
};

/// Largest number of cells of a map in a report. Larger maps are drawn coarser.
inline constexpr std::int64_t most_drawn_cells = 4'000'000;

/// A pursuit on a cost grid: the positions in each second, the costs, and what was known.
struct ReportPursuit {
  int columns = 0;  ///< of the drawn map; a large map is drawn coarser
  int rows = 0;
  double cell_m = 1.0;            ///< side of a drawn cell; the lowest corner is bounds.low
  std::vector<double> cost_runs;  ///< cost, count, cost, count, ... row by row from the lowest; -1: wall
  std::vector<Vec2> target;       ///< its position at second 0, 1, ...
  std::vector<std::vector<Vec2>> robots;  ///< the positions of each robot until the end of the mission
  std::vector<double> paid;               ///< cost paid by all robots until second 0, 1, ...
  std::vector<ReportBound> bounds;
};

/// A station that refills the tank or charges the battery.
struct ReportStation {
  std::string name;
  Vec2 position;
  bool gives_water = false;
  bool gives_charge = false;
};

/// The contents of tank and battery at one instant. The levels are interpolated linearly between two
/// instants.
struct ReportLevel {
  double time_s = 0.0;
  double water = 0.0;
  double charge_j = 0.0;
};

/// A limited tank and battery. An unlimited one is infinite; it is NaN after reading a file.
struct ReportSupplies {
  double tank = 0.0;
  double battery_j = 0.0;
  std::vector<ReportStation> stations;
  std::vector<ReportLevel> levels;
};

/// A tag on a wall.
struct ReportTag {
  int id = 0;
  Vec2 position;
  double facing_rad = 0.0;  ///< heading of the normal that points out of the wall
  double size_m = 0.0;
  std::optional<double> height_m = {};  ///< of its centre above the floor
};

/// A pinhole camera that looks straight ahead. The intrinsic parameters are those of Camera.
struct ReportCamera {
  int width_px = 0;
  int height_px = 0;
  double fx = 1.0;
  double fy = 1.0;
  double cx = 0.0;
  double cy = 0.0;
  double ahead_m = 0.0;   ///< in front of the robot's centre
  double height_m = 0.0;  ///< above the floor
};

/// A waypoint of a drive, and how accurately the robot reached it.
struct ReportStop {
  Pose2 pose;
  bool stop = true;     ///< the robot stops there; false: it passes by
  double time_s = 0.0;  ///< when the robot reached it; NaN: never, or passed by
  Vec2 error;           ///< of the true position at that time, in the world
  double heading_error_rad = 0.0;
};

/// The robot's belief about its pose at one moment.
struct ReportBelief {
  double time_s = 0.0;
  Pose2 pose;
  double sigma_x_m = 0.0;
  double sigma_y_m = 0.0;
  double correlation = 0.0;  ///< of x and y
  double sigma_rad = 0.0;
  bool corrected = false;  ///< an observation corrected the belief since the one before: a tag, a landmark,
                           ///< or, in exploration and laser mapping, a recognised place
};

/// A drive on wheels. The true poses are the track of the report.
struct ReportDrive {
  std::string loop;  ///< closed or open
  std::vector<ReportTag> tags;
  std::vector<ReportStop> stops;
  std::vector<ReportBelief> beliefs;
  std::optional<ReportCamera> camera = {};  ///< of a drive by tags
};

/// A map, and when each of its cells became known. The lists go row by row from the lowest.
struct ReportMap {
  Vec2 origin;           ///< lowest corner
  double cell_m = 0.05;  ///< side of a drawn cell; a large map is drawn coarser than it is
  int columns = 0;
  int rows = 0;
  std::vector<int> state_runs;  ///< final Occupancy, count, Occupancy, count, ...
  double step_s = 1.0;
  std::vector<int> known_runs;  ///< step in which the cell first became known, count, ...; an unknown cell
                                ///< repeats the value of the cell before
};

/// A decision of exploration: the next goal.
struct ReportDecision {
  double time_s = 0.0;
  std::string kind;  ///< frontier, home, ...
  Pose2 goal;
  std::vector<Vec2> waypoints;
  int frontiers = 0;  ///< open at this time
};

/// A frontier that was not explored.
struct ReportRefusal {
  Vec2 position;
  std::string reason;  ///< one sentence
};

/// A range finder that measures in all directions.
struct ReportLaser {
  int beams = 0;  ///< at equal angles
  double range_m = 0.0;
  double height_m = 0.0;  ///< of its plane above the floor
  Pose2 mount;            ///< robot_T_laser
};

/// An exploration. The true poses are the track of the report.
struct ReportExplore {
  ReportMap map;
  std::vector<std::vector<Vec2>> walls;  ///< true closed outlines of what the range finder can hit
  std::vector<ReportBelief> beliefs;
  std::vector<ReportDecision> decisions;
  std::vector<ReportRefusal> refused;
  std::optional<ReportLaser> laser = {};
};

/// A section of the path over an area.
struct ReportPass {
  double start_s = 0.0;
  double end_s = 0.0;
  std::string role;  ///< lap, lane or move
};

/// How much was covered until a time. Between two rows the areas grow about linearly.
struct ReportCovered {
  double time_s = 0.0;
  double covered_m2 = 0.0;  ///< covered at least once
  double overlap_m2 = 0.0;  ///< covered more than once
};

/// The coverage of an area. The driven path is the track of the report. Areas are closed outlines: polygons
/// run counter-clockwise and their holes clockwise.
struct ReportCover {
  double width_m = 0.0;                    ///< width of the strip that the robot covers
  std::vector<std::vector<Vec2>> area;     ///< the area to cover
  std::vector<std::vector<Vec2>> reach;    ///< the part of it that the robot can cover
  std::vector<std::vector<Vec2>> missed;   ///< part of the reach that was not covered
  std::vector<std::vector<Vec2>> overlap;  ///< part of the reach that was covered more than once
  std::vector<Vec2> planned;               ///< the planned track
  std::vector<ReportPass> passes;
  std::vector<ReportCovered> covered;
};

/// A loop closure: two poses that were joined, at their final positions.
struct ReportLoop {
  double time_s = 0.0;  ///< when the loop was closed
  Vec2 from;
  Vec2 to;
};

/// A landmark of the map.
struct ReportLandmark {
  std::int64_t id = 0;
  double first_s = 0.0;  ///< when it was added to the map
  Vec2 position;         ///< final estimate; the sigmas are final, too
  double sigma_x_m = 0.0;
  double sigma_y_m = 0.0;
  double correlation = 0.0;  ///< of x and y
  int sightings = 0;
  std::optional<Vec2> truth = {};  ///< true position in the frame of the map
};

/// The points that a range finder hit.
struct ReportScan {
  double time_s = 0.0;
  std::vector<Vec2> points;  ///< in the frame of the robot
};

/// Mapping from a recorded log. The track of the report is the final estimate of the path.
struct ReportSlam {
  std::string engine;                 ///< laser, ekf, graph, ...
  std::vector<ReportBelief> beliefs;  ///< as they were at the time, before later corrections
  std::vector<Vec2> odometry;         ///< positions by odometry alone, at the times of the beliefs
  std::vector<Vec2> reference;        ///< positions of a reference in the frame of the map; empty: none
  std::vector<ReportLoop> loops;
  std::vector<ReportLandmark> landmarks;
  std::vector<ReportScan> scans;  ///< a selection of all scans
  std::optional<ReportMap> map = {};
};

/// A height field, row by row from the lowest. Each cell of the lattice is two triangles that share the
/// diagonal from the lowest x and y. A large field is drawn coarser.
struct ReportRelief {
  Vec2 origin;  ///< position of the first height
  Vec2 spacing_m{1.0, 1.0};
  int columns = 0;
  int rows = 0;
  std::vector<double> heights_m;
};

/// A contour line of the terrain.
struct ReportContour {
  double height_m = 0.0;
  std::vector<Vec2> points;  ///< a closed line repeats its first point at the end
};

/// Terrain: height field and slopes.
struct ReportTerrain {
  std::vector<ReportContour> contours;
  std::vector<RoundedPolygon> steep;  ///< too steep for the robot
  std::optional<ReportRelief> relief = {};
};

/// A whole run as the page and the pictures read it.
struct PageReport {
  std::string status;                   ///< "done" or "not_done"
  std::string job;                      ///< "guard", ...
  std::string reason;                   ///< why it is not done; empty when it is
  std::optional<std::string> sim = {};  ///< "physics" when a rigid-body simulation carried it out
  std::uint64_t seed = 0;
  std::vector<std::pair<std::string, std::string>> settings;  ///< option name -> value with unit
  std::vector<std::string> warnings;  ///< what was repaired or is uncertain in the input

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

  std::vector<std::pair<std::string, double>> metrics;  ///< in display order
  std::vector<ReportTarget> targets;
  std::vector<ReportPath> paths;
  std::vector<ReportShot> shots;
  std::vector<ReportEvent> events;
  std::vector<TrackSample> track;
  std::optional<ReportSupplies> supplies;  ///< where they are limited
  std::optional<ReportPursuit> pursuit;    ///< of the job pursue
  std::optional<ReportDrive> drive = {};   ///< of the job drive
  std::optional<ReportExplore> explore =
      {};                                 ///< of the job explore, and of a guard mission that explores first
  std::optional<ReportCover> cover = {};  ///< of the job cover
  std::optional<ReportSlam> slam = {};    ///< of the job slam
};

/// Returns the run of a log as the page reads it. Of a long path at most 5000 rows are kept, of a map at most
/// 150,000 cells, and of the scans at most 400.
PageReport page_report(const Report& report, const Log& log);

}  // namespace outrider
