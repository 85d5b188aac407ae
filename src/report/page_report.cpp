#include "outrider/report/page_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "outrider/log/append.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/gun_messages.hpp"
#include "outrider/log/mapping_messages.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "page_map.hpp"
#include "page_slam.hpp"

namespace outrider {
namespace {

std::vector<Vec2> vec2s(const std::vector<outrider_msgs::Point2>& points) {
  std::vector<Vec2> result;
  for (const auto& point : points) result.push_back(vec2_of(point));
  return result;
}

std::vector<std::vector<Vec2>> rings(const std::vector<outrider_msgs::Outline>& outlines) {
  std::vector<std::vector<Vec2>> result;
  for (const auto& outline : outlines) result.push_back(vec2s(outline.points));
  return result;
}

std::vector<RoundedPolygon> shapes(const std::vector<outrider_msgs::RoundedPolygon>& polygons) {
  std::vector<RoundedPolygon> result;
  for (const auto& one : polygons) result.push_back({vec2s(one.points), one.radius});
  return result;
}

Vec3 vec3(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }
Vec3 vec3(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

void add_scene(PageReport& page, const Log& log) {
  if (const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run)) {
    page.job = info->job;
    if (!info->sim.empty()) page.sim = info->sim;
    page.seed = info->seed;
    page.world_name = info->world;
    if (std::isfinite(info->low.x)) page.bounds = {vec2_of(info->low), vec2_of(info->high)};
    page.gravity_mps2 = info->gravity;
    page.robot_radius_m = info->robot_radius;
    page.gun_length_m = info->gun_length;
    page.ball_radius_m = info->ball_radius;
    page.margin_m = info->margin;
  }
  if (const auto* all = log.latest<outrider_msgs::Solids>(topic::solids)) {
    for (const auto& solid : all->solids) {
      page.solids.push_back(
          {solid.name, solid.kind, shapes(solid.footprint), solid.low_z, solid.high_z, solid.blocks_driving});
    }
  }
  if (const auto* ground = log.latest<outrider_msgs::Terrain>(topic::terrain)) {
    ReportTerrain terrain{{}, shapes(ground->steep), {}};
    for (const auto& line : ground->contours) terrain.contours.push_back({line.height, vec2s(line.points)});
    terrain.relief =
        ReportRelief{vec2_of(ground->origin), vec2_of(ground->spacing), static_cast<int>(ground->columns),
                     static_cast<int>(ground->rows), ground->heights};
    page.terrain = std::move(terrain);
  }
}

/// Angles are unwrapped, so that they can be interpolated.
void add_track(PageReport& page, const Log& log) {
  const auto& joints = log.messages<sensor_msgs::JointState>(topic::joints);
  std::size_t joint = 0;
  for (const auto& pose : log.messages<geometry_msgs::PoseStamped>(topic::pose)) {
    TrackSample sample{pose.time_s(), pose_of(pose.message.pose), 0.0, 0.0};
    if (joint < joints.size() && joints[joint].time_ns == pose.time_ns &&
        joints[joint].message.position.size() == 2) {
      sample.gun_yaw_rad = wrap_angle(sample.pose.heading_rad + joints[joint].message.position[0]);
      sample.gun_pitch_rad = joints[joint].message.position[1];
      ++joint;
    } else if (!joints.empty()) {
      sample.gun_yaw_rad = sample.pose.heading_rad;
    }
    page.track.push_back(sample);
  }
  if (!page.track.empty()) page.start = page.track.front().pose;
  for (const auto& path : log.messages<nav_msgs::Path>(topic::plan)) {
    if (!page.paths.empty() && page.paths.back().end_s < 0.0) page.paths.back().end_s = path.time_s();
    if (path.message.poses.empty()) continue;
    ReportPath& added = page.paths.emplace_back(ReportPath{path.time_s(), -1.0, {}});
    for (const auto& pose : path.message.poses) {
      added.waypoints.push_back({pose.pose.position.x, pose.pose.position.y});
    }
  }
  if (!page.paths.empty() && page.paths.back().end_s < 0.0) page.paths.back().end_s = log.end_s();
  for (const auto& event : log.messages<rcl_interfaces::Log>(topic::events)) {
    page.events.push_back({event.time_s(), event.message.name, event.message.msg});
  }
}

void add_shots(PageReport& page, const Log& log) {
  for (const auto& stamped : log.messages<outrider_msgs::Shot>(topic::shots)) {
    const outrider_msgs::Shot& shot = stamped.message;
    ReportShot& entry = page.shots.emplace_back();
    entry.target = shot.target;
    entry.attempt = static_cast<int>(shot.attempt);
    entry.time_s = stamped.time_s();
    entry.flight_s = shot.flight;
    entry.muzzle = vec3(shot.muzzle);
    entry.velocity_mps = vec3(shot.velocity);
    entry.contact = shot.contact;
    entry.contact_point = vec3(shot.contact_point);
    entry.hit = shot.hit;
    entry.hit_by_reference_rule = shot.hit_by_reference_rule;
    entry.clearance_m = shot.clearance;
    for (const auto& piece : shot.profile) entry.profile.push_back({piece.name, vec2s(piece.polygon)});
    if (!shot.path.empty()) {
      entry.path.emplace();
      for (const auto& at : shot.path) entry.path->push_back(vec3(at));
    }
    const Vec2 platform = vec2_of(shot.platform_velocity);
    if (platform != Vec2{}) entry.platform_velocity_mps = platform;
  }
}

/// Sets the places of a target: its visit, its motion, and its last place.
void add_places(ReportTarget& target, const std::vector<Stamped<outrider_msgs::TargetPosition>>& places) {
  const auto at = [&](std::size_t i) { return Vec2{places[i].message.centre.x, places[i].message.centre.y}; };
  if (places.empty()) return;
  target.centre = vec3(places.back().message.centre);
  std::size_t first = 0;
  if (target.visit) {
    target.visit->enters_s = places.front().time_s();
    target.visit->from = at(0);
    target.visit->settles_s = places[std::min<std::size_t>(1, places.size() - 1)].time_s();
    first = 1;
  }
  if (places.size() <= first + 1) return;
  target.moves.emplace();
  for (std::size_t i = first; i < places.size(); ++i) {
    target.moves->push_back({places[i].time_s(), at(i), vec2_of(places[i].message.believed)});
  }
}

void add_targets(PageReport& page, const Log& log) {
  std::map<std::string, std::size_t> numbers;
  const double never_s = log.end_s() + 1.0;  // of an intruder that has not come
  for (const auto& stamped : log.messages<outrider_msgs::Target>(topic::targets)) {
    const outrider_msgs::Target& now = stamped.message;
    const auto [found, added] = numbers.try_emplace(now.name, page.targets.size());
    if (added) page.targets.emplace_back().name = now.name;
    ReportTarget& target = page.targets[found->second];
    if (target.status != now.status) target.done_s = stamped.time_s();
    target.status = now.status == "outside" ? "waiting" : now.status;
    target.reason = now.reason;
    target.size = vec3(now.size);
    target.yaw_rad = now.yaw;
    target.shots = static_cast<int>(now.shots);
    if (!now.entrance.empty() && !target.visit)
      target.visit = ReportVisit{now.entrance, {}, never_s, never_s};
  }
  std::vector<std::vector<Stamped<outrider_msgs::TargetPosition>>> places(page.targets.size());
  for (const auto& place : log.messages<outrider_msgs::TargetPosition>(topic::target_positions)) {
    const auto found = numbers.find(place.message.name);
    if (found != numbers.end()) places[found->second].push_back(place);
  }
  for (std::size_t i = 0; i < places.size(); ++i) add_places(page.targets[i], places[i]);
  for (const auto& stamped : log.messages<outrider_msgs::Shot>(topic::shots)) {
    const outrider_msgs::Shot& shot = stamped.message;
    const auto found = numbers.find(shot.target);
    if (found == numbers.end()) continue;
    ReportTarget& target = page.targets[found->second];
    target.pose = {vec2_of(shot.robot), shot.robot_heading};
    target.pitch_rad = shot.gun_pitch;
    target.shot_yaw_rad = shot.gun_yaw;
    target.speed_mps = norm(vec3(shot.velocity));
    if (shot.hit) target.clearance_m = shot.clearance;
  }
  if (const auto* supplies = log.latest<outrider_msgs::Supplies>(topic::supplies)) {
    page.supplies = ReportSupplies{supplies->tank, supplies->battery, {}, {}};
    for (const auto& one : supplies->stations) {
      page.supplies->stations.push_back({one.name, vec2_of(one.position), one.gives_water, one.gives_charge});
    }
    for (const auto& level : log.messages<outrider_msgs::StoreLevels>(topic::stores)) {
      page.supplies->levels.push_back({level.time_s(), level.message.water, level.message.charge});
    }
  }
}

void add_drive(PageReport& page, const Log& log) {
  const auto* waypoints = log.latest<outrider_msgs::Waypoints>(topic::waypoints);
  if (waypoints == nullptr) return;
  ReportDrive& drive = page.drive.emplace();
  drive.loop = waypoints->closed_loop ? "closed" : "open";
  for (const auto& one : waypoints->waypoints) {
    const bool reached = std::isfinite(one.reached);
    drive.stops.push_back({{vec2_of(one.position), one.heading},
                           one.stop,
                           one.reached,
                           reached ? vec2_of(one.error) : Vec2{},
                           reached ? one.heading_error : 0.0});
  }
  if (const auto* tags = log.latest<outrider_msgs::Tags>(topic::tags)) {
    for (const auto& tag : tags->tags) {
      drive.tags.push_back({tag.id, {tag.position.x, tag.position.y}, tag.facing, tag.size, tag.position.z});
    }
  }
  drive.beliefs = beliefs_of(log);
  const auto* camera = log.latest<sensor_msgs::CameraInfo>(topic::camera);
  if (camera == nullptr) return;
  drive.camera = {static_cast<int>(camera->width),
                  static_cast<int>(camera->height),
                  camera->k[0],
                  camera->k[4],
                  camera->k[2],
                  camera->k[5],
                  0.0,
                  0.0};
  for (const auto& stamped : log.messages<tf2_msgs::TFMessage>(topic::static_transforms)) {
    for (const auto& one : stamped.message.transforms) {
      if (one.child_frame_id != "camera") continue;
      drive.camera->ahead_m = one.transform.translation.x;
      drive.camera->height_m = one.transform.translation.z;
    }
  }
}

void add_explore(PageReport& page, const Log& log) {
  const auto* walls = log.latest<outrider_msgs::Outlines>(topic::walls);
  if (walls == nullptr && !log.latest<outrider_msgs::Solids>(topic::solids)) return;
  ReportExplore& explore = page.explore.emplace();
  if (walls != nullptr) explore.walls = rings(walls->outlines);
  explore.map = page_map(log);
  explore.beliefs = beliefs_of(log);
  explore.laser = laser_of(log);
  const auto& goals = log.messages<geometry_msgs::PoseStamped>(topic::goal);
  const auto& plans = log.messages<nav_msgs::Path>(topic::plan);
  std::size_t goal = 0, plan = 0;
  for (const auto& stamped : log.messages<outrider_msgs::Decision>(topic::decisions)) {
    ReportDecision entry{
        stamped.time_s(), stamped.message.kind, {}, {}, static_cast<int>(stamped.message.frontiers)};
    if (goal < goals.size()) entry.goal = pose_of(goals[goal++].message.pose);
    while (plan < plans.size() && plans[plan].time_ns < stamped.time_ns) ++plan;
    if (plan < plans.size()) {
      for (const auto& pose : plans[plan].message.poses) {
        entry.waypoints.push_back({pose.pose.position.x, pose.pose.position.y});
      }
    }
    explore.decisions.push_back(std::move(entry));
  }
  for (const auto& one : log.messages<outrider_msgs::Refusal>(topic::refusals)) {
    explore.refused.push_back({vec2_of(one.message.position), one.message.reason});
  }
  const double end_s = explore.beliefs.empty() ? 0.0 : explore.beliefs.back().time_s;
  std::erase_if(page.paths,
                [&](const ReportPath& path) { return path.start_s < end_s; });  // they are decisions
}

void add_cover(PageReport& page, const Log& log) {
  const auto* area = log.latest<outrider_msgs::CoverageArea>(topic::coverage_area);
  if (area == nullptr) return;
  ReportCover& cover = page.cover.emplace();
  if (const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run)) cover.width_m = info->coverage_width;
  cover.area = rings(area->area);
  cover.reach = rings(area->reach);
  cover.missed = rings(area->missed);
  cover.overlap = rings(area->overlap);
  cover.planned = vec2s(area->planned);
  for (const auto& pass : log.messages<outrider_msgs::CoveragePass>(topic::coverage_passes)) {
    if (!cover.passes.empty()) cover.passes.back().end_s = pass.time_s();
    cover.passes.push_back({pass.time_s(), log.end_s(), pass.message.role});
  }
  for (const auto& one : log.messages<outrider_msgs::Coverage>(topic::coverage)) {
    cover.covered.push_back({one.time_s(), one.message.covered, one.message.overlap});
  }
}

std::vector<Vec2> way_of(const Log& log, std::string_view topic) {
  std::vector<Vec2> way;
  for (const auto& pose : log.messages<geometry_msgs::PoseStamped>(topic)) {
    way.push_back({pose.message.pose.position.x, pose.message.pose.position.y});
  }
  return way;
}

void add_pursuit(PageReport& page, const Log& log) {
  const auto* grid = log.latest<outrider_msgs::CostGrid>(topic::cost_grid);
  if (grid == nullptr) return;
  ReportPursuit& pursuit = page.pursuit.emplace();
  pursuit.columns = static_cast<int>(grid->width);
  pursuit.rows = static_cast<int>(grid->height);
  pursuit.cell_m = grid->resolution;
  for (const double cost : grid->costs) {
    auto& runs = pursuit.cost_runs;
    if (runs.empty() || runs[runs.size() - 2] != cost) runs.insert(runs.end(), {cost, 0.0});
    runs.back() += 1.0;
  }
  pursuit.target = way_of(log, topic::target_pose);
  pursuit.robots.push_back(way_of(log, topic::pose));
  for (std::size_t robot = 2;; ++robot) {
    auto way = way_of(log, "/robot_" + std::to_string(robot) + "/pose");
    if (way.empty()) break;
    pursuit.robots.push_back(std::move(way));
  }
  for (const auto& one : log.messages<outrider_msgs::PaidCost>(topic::paid))
    pursuit.paid.push_back(one.message.paid);
  for (const auto& one : log.messages<outrider_msgs::CostBound>(topic::bounds)) {
    pursuit.bounds.push_back(
        {one.time_s(), one.message.expansions, one.message.cost, one.message.lower_bound});
  }
  page.track.clear();
}

}  // namespace

PageReport page_report(const Report& report, const Log& log) {
  PageReport page;
  add_scene(page, log);
  add_track(page, log);
  add_shots(page, log);
  add_targets(page, log);
  add_drive(page, log);
  add_explore(page, log);
  add_cover(page, log);
  add_pursuit(page, log);
  add_slam(page, log);
  page.status = report.status;
  if (!report.job.empty()) page.job = report.job;
  page.reason = report.reason;
  page.settings = report.settings;
  page.warnings = report.warnings;
  page.metrics = report.metrics;
  if (page.world_name.empty()) page.world_name = report.world_name;
  return page;
}

}  // namespace outrider
