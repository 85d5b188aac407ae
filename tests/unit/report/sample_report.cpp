#include "sample_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider::test {
namespace {

constexpr double gravity = 9.8;
constexpr double ball_radius = 0.01;
constexpr double muzzle_height = 0.2;

RoundedPolygon rectangle(Vec2 centre, Vec2 size, double yaw_rad = 0.0) {
  RoundedPolygon shape;
  const Vec2 u = 0.5 * size.x * direction(yaw_rad);
  const Vec2 v = 0.5 * size.y * perpendicular(direction(yaw_rad));
  shape.core = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
  return shape;
}

ReportSolid solid(std::string name, std::string kind, RoundedPolygon footprint, double low, double high,
                  bool blocks = true) {
  return {std::move(name), std::move(kind), {std::move(footprint)}, low, high, blocks};
}

std::vector<ReportSolid> yard() {
  std::vector<ReportSolid> solids = {
      {"ground", "half_space", {}, -1e3, 0.0, false},
      solid("wall_west", "box", rectangle({-10.1, 0}, {0.2, 20.4}), 0, 2.5),
      solid("wall_east", "box", rectangle({10.1, 0}, {0.2, 20.4}), 0, 2.5),
      solid("wall_north", "box", rectangle({0, 10.1}, {20.4, 0.2}), 0, 2.5),
      solid("wall_south_left", "box", rectangle({-5.7, -10.1}, {9.0, 0.2}), 0, 2.5),
      solid("wall_south_right", "box", rectangle({5.7, -10.1}, {9.0, 0.2}), 0, 2.5),
      solid("shed", "box", rectangle({6.6, 5.6}, {3.4, 2.6}, 0.2), 0, 2.2),
      solid("low_wall", "box", rectangle({-4.0, -3.2}, {5.0, 0.3}), 0, 0.6),
      solid("fence", "box", rectangle({-6.4, -0.8}, {0.15, 4.5}), 0, 0.8),
      solid("crate", "box", rectangle({2.6, -5.4}, {1.0, 0.8}, 0.5), 0, 0.8),
      solid("barrel_1", "cylinder", {{{-1.5, 2.0}}, 0.45}, 0, 1.0),
      solid("barrel_2", "cylinder", {{{-0.4, 2.4}}, 0.45}, 0, 1.0),
      solid("tree", "cylinder", {{{3.2, 1.4}}, 0.3}, 0, 3.0),
      solid("hedge", "box", {{{-8.0, 6.0}, {-4.5, 7.2}}, 0.35}, 0, 1.4),
      solid("pipe", "mesh", {{{1.5, 7.4}, {4.0, 8.0}}, 0.08}, 1.6, 1.8, false),
      solid("table_top", "box", rectangle({5.0, -1.8}, {2.0, 1.2}), 0.7, 0.76, false),
  };
  for (const Vec2 corner : {Vec2{-0.9, -0.5}, Vec2{0.9, -0.5}, Vec2{-0.9, 0.5}, Vec2{0.9, 0.5}}) {
    solids.push_back(solid("table_leg", "cylinder", {{Vec2{5.0, -1.8} + corner}, 0.05}, 0, 0.7));
  }
  return solids;
}

struct Intruder {
  std::string name;
  Vec3 base;
  double yaw_rad;
  std::string status;
  Vec2 stand;  // from which it is shot
  double pitch_rad;
  int misses;
};

const std::vector<Intruder> intruders = {
    {"cat_gate", {4.2, -8.2, 0.0}, 0.3, "reached", {0.6, -8.0}, 0.12, 0},
    {"cat_crate", {2.6, -5.4, 0.8}, 1.1, "reached", {0.4, -7.0}, 0.75, 0},
    {"cat_table", {5.2, -1.7, 0.76}, -0.4, "reached", {1.8, -3.4}, 0.7, 1},
    {"cat_under_table", {4.8, -1.9, 0.0}, 2.0, "reached", {1.6, -1.2}, 0.06, 0},
    {"cat_shed", {7.0, 3.2, 0.0}, 0.0, "reached", {4.6, 1.6}, 0.3, 0},
    {"cat_barrels", {-0.9, 4.2, 0.0}, 0.9, "reached", {1.4, 4.2}, 0.2, 0},
    {"cat_hedge", {-6.6, 8.2, 0.0}, -0.7, "failed", {-2.0, 6.4}, 0.7, 3},
    {"cat_fence", {-8.2, -0.6, 0.0}, 1.6, "reached", {-4.6, 0.8}, 0.76, 0},
    {"cat_low_wall", {-4.4, -4.4, 0.0}, 0.0, "reached", {-3.2, -1.4}, 0.72, 0},
    {"cat_roof", {6.6, 5.6, 2.2}, 0.5, "unreachable", {}, 0, 0},
};

double height_over(const ReportSolid& thing, Vec3 p) {
  return std::max({thing.low_z_m - p.z, p.z - thing.high_z_m});
}

double gap(const ReportSolid& thing, Vec3 p) {
  double least = 1e9;
  for (const RoundedPolygon& piece : thing.footprint) {
    const double across = std::max(0.0, signed_distance(xy(p), piece));
    least = std::min(least, std::hypot(across, std::max(0.0, height_over(thing, p))));
  }
  return least;
}

ReportSolid as_solid(const Intruder& cat) {
  return solid(cat.name, "box", rectangle(xy(cat.base), {0.5, 0.205}, cat.yaw_rad), cat.base.z,
               cat.base.z + 0.372);
}

class Run {
 public:
  Run() {
    report_.solids = yard();
    report_.start = {{0.0, -9.5}, pi / 2};
    now_ = {0.0, report_.start, pi / 2, 0.0};
    report_.track.push_back(now_);
  }

  PageReport finished() {
    for (const Intruder& cat : intruders) guard(cat);
    report_.status = "not_done";
    report_.job = "guard";
    report_.reason = "cat_hedge failed after 3 shots; cat_roof cannot be hit from any reachable pose";
    report_.seed = 18446744073709551557ULL;
    report_.settings = {{"grid_resolution", "0.1 m"}, {"gun_muzzle_speed", "10 m/s"}, {"tries", "3"}};
    report_.warnings = {"yard.sdf: <state><sim_time>0 was read as '0 0'",
                        "yard.sdf: <pose> of 'shed' had three numbers; the rest was taken as 0"};
    report_.world_name = "small_yard";
    report_.bounds = {{-10, -10}, {10, 10}};
    report_.gravity_mps2 = gravity;
    report_.robot_radius_m = 0.26;
    report_.gun_length_m = 0.255;
    report_.ball_radius_m = ball_radius;
    report_.margin_m = 0.02;
    report_.metrics = {{"targets", 10},
                       {"reached", 8},
                       {"failed", 1},
                       {"unreachable", 1},
                       {"reached_by_reference_rule", 8},
                       {"planning_s", 0.8421},
                       {"mission_s", now_.time_s},
                       {"driven_m", driven_},
                       {"turned_rad", turned_},
                       {"shots", static_cast<double>(report_.shots.size())},
                       {"lower_bound_s", 0.81 * now_.time_s}};
    return report_;
  }

 private:
  void add_event(std::string kind, std::string text) {
    report_.events.push_back({now_.time_s, std::move(kind), std::move(text)});
  }

  // Samples five times a second while values change linearly over `duration_s`.
  void change(const TrackSample& to, double duration_s) {
    const TrackSample from = now_;
    const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / 0.2)));
    for (int i = 1; i <= steps; ++i) {
      const double s = static_cast<double>(i) / steps;
      now_.time_s = from.time_s + s * duration_s;
      now_.pose.position = from.pose.position + s * (to.pose.position - from.pose.position);
      now_.pose.heading_rad =
          wrap_angle(from.pose.heading_rad + s * wrap_angle(to.pose.heading_rad - from.pose.heading_rad));
      now_.gun_yaw_rad = wrap_angle(from.gun_yaw_rad + s * wrap_angle(to.gun_yaw_rad - from.gun_yaw_rad));
      now_.gun_pitch_rad = from.gun_pitch_rad + s * (to.gun_pitch_rad - from.gun_pitch_rad);
      report_.track.push_back(now_);
    }
  }

  void drive(Vec2 goal) {
    const Vec2 way = goal - now_.pose.position;
    if (norm(way) < 1e-6) return;
    const double start_s = now_.time_s;
    const Vec2 from = now_.pose.position;
    TrackSample turned = now_;
    turned.pose.heading_rad = heading_of(way);
    turned.gun_yaw_rad = heading_of(way);
    const double angle = std::abs(wrap_angle(turned.pose.heading_rad - now_.pose.heading_rad));
    turned_ += angle;
    change(turned, angle / 0.8 + 0.1);
    TrackSample there = now_;
    there.pose.position = goal;
    driven_ += norm(way);
    change(there, norm(way) / 0.8 + 1.0);
    report_.paths.push_back({start_s, now_.time_s, {from, goal}});
  }

  void guard(const Intruder& cat) {
    ReportTarget target;
    target.name = cat.name;
    target.status = cat.status;
    target.size = {0.5, 0.205, 0.372};
    target.centre = cat.base + Vec3{0, 0, 0.186};
    target.yaw_rad = cat.yaw_rad;
    if (cat.status == "unreachable") {
      target.reason = "none of 6310 reachable poses has a flight that stays clear of 'shed'";
      add_event("status", cat.name + " is unreachable: " + target.reason);
    } else {
      add_event("drive", "Driving to the firing pose for " + cat.name);
      drive(cat.stand);
      add_event("aim", "Aiming at " + cat.name);
      for (int i = 1; i <= cat.misses + (cat.status == "reached" ? 1 : 0); ++i) fire(cat, i, target);
      target.reason = cat.status == "reached" ? fmt::format("hit at shot {}", target.shots)
                                              : "missed 3 times: the ball touched 'hedge' first";
      add_event("status", cat.name + " is " + cat.status);
      change(now_, 0.3);
    }
    target.done_s = now_.time_s;
    report_.targets.push_back(target);
  }

  void fire(const Intruder& cat, int attempt, ReportTarget& target) {
    const bool misses_target = attempt <= cat.misses;
    const Vec2 to_target = xy(target.centre) - now_.pose.position;
    const double yaw = heading_of(to_target);
    TrackSample aimed = now_;
    aimed.gun_yaw_rad = yaw;
    aimed.gun_pitch_rad = cat.pitch_rad;
    change(aimed, std::abs(wrap_angle(yaw - now_.gun_yaw_rad)) / pi +
                      std::abs(cat.pitch_rad - now_.gun_pitch_rad) * 6 / pi + 0.2);

    ReportShot shot;
    shot.target = cat.name;
    shot.attempt = attempt;
    shot.time_s = now_.time_s;
    const Vec2 along = direction(yaw);
    shot.muzzle = {now_.pose.position.x + 0.25 * along.x, now_.pose.position.y + 0.25 * along.y,
                   muzzle_height};
    const double reach = norm(to_target) - 0.25;
    const double drop = reach * std::tan(cat.pitch_rad) - (target.centre.z - muzzle_height);
    double speed = reach / std::cos(cat.pitch_rad) * std::sqrt(0.5 * gravity / drop);
    if (misses_target) speed *= cat.status == "failed" ? 0.84 : 0.9;
    shot.velocity_mps = {speed * std::cos(cat.pitch_rad) * along.x, speed * std::cos(cat.pitch_rad) * along.y,
                         speed * std::sin(cat.pitch_rad)};
    fly(cat, shot);
    add_event("shot", fmt::format("Shot {} at {}: {:.2f} m/s, pitch {:.1f} degrees", attempt, cat.name, speed,
                                  degrees(cat.pitch_rad)));
    change(now_, shot.flight_s);
    add_event(shot.hit ? "hit" : "miss", fmt::format("The ball touched {}", shot.contact));
    change(now_, 0.4);

    target.pose = now_.pose;
    target.pitch_rad = cat.pitch_rad;
    target.shot_yaw_rad = yaw;
    target.speed_mps = speed;
    target.clearance_m = shot.clearance_m;
    target.shots = attempt;
    report_.shots.push_back(std::move(shot));
  }

  // Steps the parabola until the ball touches the target, a solid or the ground.
  void fly(const Intruder& cat, ReportShot& shot) {
    std::vector<ReportSolid> things = report_.solids;
    things.push_back(as_solid(cat));
    shot.clearance_m = 1e9;
    for (double t = 0.0; shot.contact.empty(); t += 5e-4) {
      const Vec3 p = shot.muzzle + t * shot.velocity_mps - 0.5 * gravity * t * t * Vec3{0, 0, 1};
      shot.flight_s = t;
      shot.contact_point = p;
      if (p.z <= ball_radius) shot.contact = "ground";
      for (const ReportSolid& thing : things) {
        if (gap(thing, p) <= ball_radius) shot.contact = thing.name;
      }
    }
    for (double t = 0.0; t <= shot.flight_s; t += 5e-4) {
      const Vec3 p = shot.muzzle + t * shot.velocity_mps - 0.5 * gravity * t * t * Vec3{0, 0, 1};
      for (const ReportSolid& thing : report_.solids) {
        if (thing.name != shot.contact)
          shot.clearance_m = std::min(shot.clearance_m, gap(thing, p) - ball_radius);
      }
    }
    shot.hit = shot.contact == cat.name;
    shot.hit_by_reference_rule = norm(shot.contact_point - cat.base) <= 0.5;
    const Vec2 along = (1.0 / norm(xy(shot.velocity_mps))) * xy(shot.velocity_mps);
    for (const ReportSolid& thing : things) {
      for (const RoundedPolygon& piece : thing.footprint) {
        const auto inside = cut(circumscribed(piece, 0.1), xy(shot.muzzle), along, -25.0, 25.0);
        if (!inside) continue;
        shot.profile.push_back({thing.name,
                                {{inside->low, thing.low_z_m},
                                 {inside->high, thing.low_z_m},
                                 {inside->high, thing.high_z_m},
                                 {inside->low, thing.high_z_m}}});
      }
    }
    shot.profile.push_back({"ground", {{-1e3, -1e3}, {1e3, -1e3}, {1e3, 0}, {-1e3, 0}}});
  }

  PageReport report_;
  TrackSample now_;
  double driven_ = 0.0;
  double turned_ = 0.0;
};

}  // namespace

PageReport sample_report() { return Run().finished(); }

}  // namespace outrider::test
