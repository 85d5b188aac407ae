#include "outrider/report/report_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/log/conversions.hpp"
#include "outrider/log/gun_messages.hpp"
#include "outrider/log/mapping_messages.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "report_map_log.hpp"

namespace outrider {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

void add_scene(Log& log, const Report& report) {
  outrider_msgs::RunInfo info;
  info.job = report.job;
  info.sim = report.sim.value_or("");
  info.seed = report.seed;
  info.world = report.world_name;
  info.low = point_of(report.bounds.low);
  info.high = point_of(report.bounds.high);
  info.gravity = report.gravity_mps2;
  info.robot_radius = report.robot_radius_m;
  info.gun_length = report.gun_length_m;
  info.ball_radius = report.ball_radius_m;
  info.margin = report.margin_m;
  if (report.cover) info.coverage_width = report.cover->width_m;
  for (const auto& [name, value] : report.settings) info.settings.push_back({name, value});
  info.warnings = report.warnings;
  log.append(topic::run, 0.0, std::move(info));
  outrider_msgs::Solids solids;
  for (const ReportSolid& solid : report.solids) {
    solids.solids.push_back({solid.name, solid.kind, rounded_of(solid.footprint), solid.low_z_m,
                             solid.high_z_m, solid.blocks_driving});
  }
  if (!solids.solids.empty()) log.append(topic::solids, 0.0, std::move(solids));
  if (!report.terrain) return;
  outrider_msgs::Terrain terrain;
  for (const ReportContour& contour : report.terrain->contours) {
    terrain.contours.push_back({contour.height_m, points_of(contour.points)});
  }
  terrain.steep = rounded_of(report.terrain->steep);
  if (const auto& relief = report.terrain->relief) {
    terrain.origin = point_of(relief->origin);
    terrain.spacing = point_of(relief->spacing_m);
    terrain.columns = static_cast<std::uint32_t>(relief->columns);
    terrain.rows = static_cast<std::uint32_t>(relief->rows);
    terrain.heights = relief->heights_m;
  }
  log.append(topic::terrain, 0.0, std::move(terrain));
}

void add_track(Log& log, const Report& report) {
  if (report.track.empty() && !report.pursuit) log.append(topic::pose, 0.0, stamped(0.0, report.start));
  for (const TrackSample& sample : report.track) {
    log.append(topic::pose, sample.time_s, stamped(sample.time_s, sample.pose));
    tf2_msgs::TFMessage transforms;
    transforms.transforms.push_back(transform_of(sample.time_s, sample.pose, "map", "base_link"));
    log.append(topic::transforms, sample.time_s, std::move(transforms));
  }
  for (const ReportPath& path : report.paths) {
    log.append(topic::plan, path.start_s, path_of(path.start_s, path.waypoints));
    log.append(topic::plan, path.end_s, path_of(path.end_s, {}));
  }
  for (const ReportEvent& event : report.events) {
    rcl_interfaces::Log line;
    line.stamp = stamp_of(event.time_s);
    line.name = event.kind;
    line.msg = event.text;
    log.append(topic::events, event.time_s, std::move(line));
  }
}

outrider_msgs::Shot shot_of(const ReportShot& shot, const Report& report) {
  outrider_msgs::Shot message;
  message.target = shot.target;
  message.attempt = static_cast<std::uint32_t>(shot.attempt);
  message.flight = shot.flight_s;
  const auto sample = std::ranges::upper_bound(report.track, shot.time_s + 1e-9, {}, &TrackSample::time_s);
  if (sample != report.track.begin()) {
    const TrackSample& at = *std::prev(sample);
    message.robot = point_of(at.pose.position);
    message.robot_heading = at.pose.heading_rad;
    message.gun_yaw = at.gun_yaw_rad;
    message.gun_pitch = at.gun_pitch_rad;
  }
  message.muzzle = point_of(shot.muzzle);
  message.velocity = vector_of(shot.velocity_mps);
  if (shot.platform_velocity_mps) message.platform_velocity = point_of(*shot.platform_velocity_mps);
  message.contact = shot.contact;
  message.contact_point = point_of(shot.contact_point);
  message.hit = shot.hit;
  message.hit_by_reference_rule = shot.hit_by_reference_rule;
  message.clearance = shot.clearance_m;
  if (shot.path) {
    for (const Vec3& at : *shot.path) message.path.push_back(point_of(at));
  }
  for (const ProfilePiece& piece : shot.profile) {
    message.profile.push_back({piece.name, points_of(piece.polygon)});
  }
  return message;
}

/// The messages of all targets, which are appended in the order of time.
struct TargetRows {
  std::vector<Stamped<outrider_msgs::Target>> states;
  std::vector<Stamped<outrider_msgs::TargetPosition>> positions;

  void add(const Report& report, const ReportTarget& target) {
    outrider_msgs::Target state{target.name,
                                "waiting",
                                "",
                                vector_of(target.size),
                                target.yaw_rad,
                                0,
                                target.visit ? target.visit->entrance : ""};
    const auto place = [&](double time_s, Vec2 at, Vec2 believed) {
      positions.push_back(
          {nanoseconds(time_s), {target.name, {at.x, at.y, target.centre.z}, point_of(believed)}});
    };
    const auto set = [&](double time_s) { states.push_back({nanoseconds(time_s), state}); };
    const Vec2 end{target.centre.x, target.centre.y};
    const Vec2 settled = target.moves && !target.moves->empty() ? target.moves->front().position : end;
    if (target.visit) {
      state.status = "outside";
      set(0.0);
      state.status = "waiting";
      set(target.visit->enters_s);
      place(target.visit->enters_s, target.visit->from, target.visit->from);
      place(target.visit->settles_s, settled, settled);
    } else {
      set(0.0);
      place(0.0, settled, settled);
    }
    if (target.moves) {
      for (const ReportMove& move : *target.moves) place(move.time_s, move.position, move.believed);
    }
    for (const ReportShot& shot : report.shots) {
      if (shot.target != target.name) continue;
      ++state.shots;
      set(shot.time_s);
    }
    if (target.status.empty() || !std::isfinite(target.done_s)) return;
    state.status = target.status;
    state.reason = target.reason;
    set(target.done_s);
  }
};

template <class Message>
void append_sorted(Log& log, std::string_view topic, std::vector<Stamped<Message>> rows) {
  std::ranges::stable_sort(rows, {}, &Stamped<Message>::time_ns);
  for (auto& row : rows) log.append_at(topic, row.time_ns, std::move(row.message));
}

void add_targets(Log& log, const Report& report) {
  TargetRows rows;
  for (const ReportTarget& target : report.targets) rows.add(report, target);
  append_sorted(log, topic::targets, std::move(rows.states));
  append_sorted(log, topic::target_positions, std::move(rows.positions));
  for (const ReportShot& shot : report.shots) log.append(topic::shots, shot.time_s, shot_of(shot, report));
  if (!report.supplies) return;
  outrider_msgs::Supplies supplies{report.supplies->tank, report.supplies->battery_j, {}};
  for (const ReportStation& one : report.supplies->stations) {
    supplies.stations.push_back({one.name, point_of(one.position), one.gives_water, one.gives_charge});
  }
  log.append(topic::supplies, 0.0, std::move(supplies));
  for (const ReportLevel& level : report.supplies->levels) {
    log.append(topic::stores, level.time_s, outrider_msgs::StoreLevels{level.water, level.charge_j});
  }
}

void add_beliefs(Log& log, const std::vector<ReportBelief>& beliefs) {
  for (const ReportBelief& belief : beliefs) {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header = header_of(belief.time_s, "map");
    message.pose.pose = pose_of(belief.pose);
    auto& covariance = message.pose.covariance;
    covariance[0] = belief.sigma_x_m * belief.sigma_x_m;
    covariance[7] = belief.sigma_y_m * belief.sigma_y_m;
    covariance[1] = covariance[6] = belief.correlation * belief.sigma_x_m * belief.sigma_y_m;
    covariance[35] = belief.sigma_rad * belief.sigma_rad;
    log.append(topic::belief, belief.time_s, std::move(message));
    if (!belief.corrected) continue;
    log.append(topic::corrections, belief.time_s, stamped(belief.time_s, belief.pose));
  }
}

void add_drive(Log& log, const ReportDrive& drive) {
  outrider_msgs::Tags tags;
  for (const ReportTag& tag : drive.tags) {
    tags.tags.push_back({tag.id,
                         {tag.position.x, tag.position.y, tag.height_m.value_or(not_a_number)},
                         tag.facing_rad,
                         tag.size_m});
  }
  if (!tags.tags.empty()) log.append(topic::tags, 0.0, std::move(tags));
  outrider_msgs::Waypoints waypoints{drive.loop != "open", {}};
  std::vector<double> times_s;
  for (const ReportStop& stop : drive.stops) {
    waypoints.waypoints.push_back(
        {point_of(stop.pose.position), stop.pose.heading_rad, stop.stop, not_a_number, {}, 0.0});
  }
  log.append(topic::waypoints, 0.0, waypoints);
  for (std::size_t i = 0; i < drive.stops.size(); ++i) {
    const ReportStop& stop = drive.stops[i];
    if (!std::isfinite(stop.time_s)) continue;
    waypoints.waypoints[i].reached = stop.time_s;
    waypoints.waypoints[i].error = point_of(stop.error);
    waypoints.waypoints[i].heading_error = stop.heading_error_rad;
    log.append(topic::waypoints, stop.time_s, waypoints);
  }
  add_beliefs(log, drive.beliefs);
}

void add_explore(Log& log, const ReportExplore& explore) {
  log.append(topic::walls, 0.0, outrider_msgs::Outlines{outlines_of(explore.walls)});
  add_map(log, explore.map);
  add_beliefs(log, explore.beliefs);
  for (const ReportDecision& one : explore.decisions) {
    log.append(topic::decisions, one.time_s,
               outrider_msgs::Decision{one.kind, static_cast<std::uint32_t>(one.frontiers)});
    log.append(topic::goal, one.time_s, stamped(one.time_s, one.goal));
    log.append(topic::plan, one.time_s, path_of(one.time_s, one.waypoints));
  }
  for (const ReportRefusal& one : explore.refused) {
    log.append(topic::refusals, log.end_s(), outrider_msgs::Refusal{point_of(one.position), one.reason});
  }
}

void add_cover(Log& log, const ReportCover& cover) {
  outrider_msgs::CoverageArea area{
      outlines_of(cover.area), outlines_of(cover.reach), {}, {}, points_of(cover.planned)};
  log.append(topic::coverage_area, 0.0, area);
  for (const ReportPass& pass : cover.passes)
    log.append(topic::coverage_passes, pass.start_s, outrider_msgs::CoveragePass{pass.role, pass.end_s});
  for (const ReportCovered& one : cover.covered)
    log.append(topic::coverage, one.time_s, outrider_msgs::Coverage{one.covered_m2, one.overlap_m2});
  area.missed = outlines_of(cover.missed);
  area.overlap = outlines_of(cover.overlap);
  log.append(topic::coverage_area, log.end_s(), std::move(area));
}

void add_pursuit(Log& log, const Report& report) {
  const ReportPursuit& pursuit = *report.pursuit;
  outrider_msgs::CostGrid grid{point_of(report.bounds.low),
                               pursuit.cell_m,
                               static_cast<std::uint32_t>(pursuit.columns),
                               static_cast<std::uint32_t>(pursuit.rows),
                               {}};
  for (std::size_t i = 0; i + 1 < pursuit.cost_runs.size(); i += 2) {
    grid.costs.insert(grid.costs.end(), static_cast<std::size_t>(pursuit.cost_runs[i + 1]),
                      pursuit.cost_runs[i]);
  }
  log.append(topic::cost_grid, 0.0, std::move(grid));
  const auto add_way = [&](const std::string& topic, const std::vector<Vec2>& way) {
    for (std::size_t i = 0; i < way.size(); ++i)
      log.append(topic, static_cast<double>(i), stamped(static_cast<double>(i), {way[i], 0.0}));
  };
  add_way(std::string(topic::target_pose), pursuit.target);
  for (std::size_t i = 0; i < pursuit.robots.size(); ++i) {
    add_way(i == 0 ? std::string(topic::pose) : "/robot_" + std::to_string(i + 1) + "/pose",
            pursuit.robots[i]);
  }
  for (std::size_t i = 0; i < pursuit.paid.size(); ++i)
    log.append(topic::paid, static_cast<double>(i), outrider_msgs::PaidCost{pursuit.paid[i]});
  for (const ReportBound& one : pursuit.bounds) {
    log.append(topic::bounds, one.time_s,
               outrider_msgs::CostBound{one.expansions, one.cost, one.lower_bound});
  }
}

void add_slam(Log& log, const Report& report) {
  const ReportSlam& slam = *report.slam;
  add_beliefs(log, slam.beliefs);
  for (std::size_t i = 0; i < slam.odometry.size() && i < slam.beliefs.size(); ++i) {
    nav_msgs::Odometry odometry;
    odometry.header = header_of(slam.beliefs[i].time_s, "odom");
    odometry.child_frame_id = "base_link";
    odometry.pose.pose = pose_of(Pose2{slam.odometry[i], 0.0});
    log.append(topic::odometry, slam.beliefs[i].time_s, std::move(odometry));
  }
  const double end_s = log.end_s();
  if (!slam.reference.empty()) log.append(topic::reference, 0.0, path_of(0.0, slam.reference));
  outrider_msgs::Loops loops;
  for (const ReportLoop& one : slam.loops)
    loops.loops.push_back({one.time_s, point_of(one.from), point_of(one.to)});
  if (!loops.loops.empty()) log.append(topic::loops, end_s, std::move(loops));
  outrider_msgs::Landmarks landmarks;
  for (const ReportLandmark& one : slam.landmarks) {
    landmarks.landmarks.push_back({one.id, one.first_s, point_of(one.position), one.sigma_x_m, one.sigma_y_m,
                                   one.correlation, static_cast<std::uint32_t>(one.sightings),
                                   point_of(one.truth.value_or(Vec2{not_a_number, not_a_number}))});
  }
  if (!landmarks.landmarks.empty()) log.append(topic::landmarks, end_s, std::move(landmarks));
  if (slam.map) add_map(log, *slam.map);
}

}  // namespace

Log to_log(const Report& report) {
  Log log;
  add_scene(log, report);
  add_track(log, report);
  add_targets(log, report);
  if (report.drive) add_drive(log, *report.drive);
  if (report.explore) add_explore(log, *report.explore);
  if (report.cover) add_cover(log, *report.cover);
  if (report.pursuit) add_pursuit(log, report);
  if (report.slam) add_slam(log, report);
  return log;
}

}  // namespace outrider
