#include "outrider/jobs/guard/guard_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "errors.hpp"
#include "outrider/core/overload.hpp"
#include "outrider/jobs/guard/passing.hpp"
#include "outrider/sim/profile.hpp"

namespace outrider {
namespace {

constexpr double sample_period_s = 0.1;
constexpr double at_station_m = 1e-6;  // beside the error of a drive that ends there

std::string name_of_contact(const Impact& impact, const FlightSpace& space, const Target& target) {
  if (impact.hit) return target.name;
  return impact.solid ? space.solids()[*impact.solid].name : "nothing";
}

/// The gun on its way to an aim, both axes at once, each at its own rate.
GunState turned(const GunModel& gun, GunState from, GunState to, double after_s) {
  const double yaw = gun.yaw_rate_radps * after_s;
  const double pitch = gun.pitch_rate_radps * after_s;
  return {wrap_angle(from.yaw_rad + std::clamp(wrap_angle(to.yaw_rad - from.yaw_rad), -yaw, yaw)),
          from.pitch_rad + std::clamp(to.pitch_rad - from.pitch_rad, -pitch, pitch)};
}

}  // namespace

SimulatedGuard::SimulatedGuard(const GuardProblem& problem, const Site& site, std::uint64_t seed,
                               GuardSimParams params)
    : problem_(problem),
      site_(site),
      arrival_rng_(Rng(seed).child("arrival")),
      gun_rng_(Rng(seed).child("gun")),
      pose_(problem.start),
      timing_rng_(Rng(seed).child("timing")),
      gauge_(problem.supplies, params.levels),
      attempts_(problem.targets.size(), 0),
      params_(std::move(params)),
      survival_rng_(Rng(seed).child("survival")),
      gone_(params_.walks.size(), 0),
      sight_rng_(Rng(seed).child("sight")) {
  record.moves.resize(params_.intruders.size());
  for (std::size_t i = 0; i < problem.targets.size(); ++i) at_.push_back(i);
  gauge();
  sample();
}

bool SimulatedGuard::news() const {
  return seen_ < params_.intruders.size() &&
         (params_.foreseen || params_.intruders[seen_].enters_s <= time_s_);
}

Observation SimulatedGuard::sense() {
  Observation seen{time_s_, pose_};
  seen.gun = {gun_yaw_rad_, gun_pitch_rad_};
  seen.shots = std::exchange(landed_, {});
  seen.stores = {gauge_.water(), gauge_.charge_j()};
  seen.targets.emplace();
  for (; news(); ++seen_) {
    seen.targets->arrivals.push_back(
        {seen_, params_.intruders[seen_].settles_s, params_.intruders[seen_].place});
  }
  seen.targets->arrivals.insert(seen.targets->arrivals.end(), survived_.begin(), survived_.end());
  survived_.clear();
  seen.targets->more_to_come = seen_ < params_.intruders.size();
  if (!params_.walks.empty()) look(*seen.targets);
  return seen;
}

void SimulatedGuard::look(TargetReport& told) {
  for (; static_cast<double>(looks_) * params_.look_s <= time_s_; ++looks_) {
    const double when_s = static_cast<double>(looks_) * params_.look_s;
    for (std::size_t who = 0; who < params_.walks.size(); ++who) {
      const Vec2 off = in_disk(sight_rng_, params_.sight_m);
      if (gone_[who] == 0) told.seen.push_back({who, when_s, params_.walks[who].at(when_s) + off});
    }
  }
}

void SimulatedGuard::act(const Command& command) {
  std::visit(Overload{[this](const FollowWaypoints& c) { follow(c); }, [this](const AimGun& c) { aim(c); },
                      [this](const Fire& c) { fire(c); }, [this](const Wait& c) { wait(c); },
                      [this](const Fill& c) { fill(c); }, [](const auto&) {}},
             command);
  gauge();
}

/// Takes what has been used until now out of the stores.
void SimulatedGuard::gauge() {
  gauge_.note(time_s_, record.driven_m, record.shots.size());
  if (problem_.supplies.any()) record.levels.push_back({time_s_, gauge_.water(), gauge_.charge_j()});
}

void SimulatedGuard::fill(const Fill& command) {
  gauge();
  const StationCall& call = command.call;
  const Station& station = problem_.supplies.stations[call.station];
  if (distance(pose_.position, station.position) > problem_.errors.position_m + at_station_m) {
    log("no_fill", fmt::format("is too far from {} to take in {}", station.name, to_string(call.store)));
    return;
  }
  log("fill", fmt::format("takes in {} at {}", to_string(call.store), station.name));
  sample();
  time_s_ += gauge_.fill(call.store);
  sample();
}

Stance SimulatedGuard::stance() const { return stance_at(site_.rules, pose_.position); }

void SimulatedGuard::sample() {
  const Stance here = stance();
  const double yaw = wrap_angle(heading_on(here, pose_.heading_rad) + gun_yaw_rad_);
  const Shot barrel = shot_of(here, {yaw, gun_pitch_rad_}, 0.0);
  record.track.push_back({time_s_, pose_, barrel.yaw_rad, barrel.pitch_rad});
}

void SimulatedGuard::log(std::string kind, std::string text) {
  record.events.push_back({time_s_, std::move(kind), std::move(text)});
}

void SimulatedGuard::turn_to(double heading_rad) {
  const double from = pose_.heading_rad;
  const double turn = wrap_angle(heading_rad - from);
  const double total = duration(std::abs(turn), problem_.robot.turning());
  const double begin = time_s_;
  for (int i = 1; i * sample_period_s < total; ++i) {
    const double t = i * sample_period_s;
    const double done = covered(std::abs(turn), problem_.robot.turning(), t);
    time_s_ = begin + t;
    pose_.heading_rad = wrap_angle(from + std::copysign(done, turn));
    sample();
  }
  time_s_ = begin + total;
  pose_.heading_rad = heading_rad;
  record.turned_rad += std::abs(turn);
  if (total > 0.0) sample();
}

void SimulatedGuard::drive_to(Vec2 goal, std::span<const FireInPassing> shots) {
  const Vec2 from = pose_.position;
  const double length = site_.ground.length({from, goal});
  if (length == 0.0) return;
  turn_to(heading_of(goal - from));
  const HeightField* const terrain = site_.ground.terrain();
  const double total = duration(length, problem_.robot.straight());
  const double begin = time_s_;
  const auto be_at = [&](double t) {
    time_s_ = begin + t;
    const double way = covered(length, problem_.robot.straight(), t);
    pose_.position =
        terrain != nullptr ? terrain->walked({from, goal}, way) : from + way / length * (goal - from);
  };
  int samples = 1;
  double last_shot = 0.0;
  for (const FireInPassing& shot : shots) {
    const GunState rest{gun_yaw_rad_, gun_pitch_rad_};
    const GunState aim{shot.shot.yaw_rad - pose_.heading_rad, shot.shot.pitch_rad};
    const auto point = [&](double t) {
      be_at(t);
      const GunState now = turned(problem_.gun, rest, aim, t - last_shot);
      gun_yaw_rad_ = now.yaw_rad;
      gun_pitch_rad_ = now.pitch_rad;
      sample();
    };
    const double late = problem_.errors.timing_s * timing_rng_.uniform(-1.0, 1.0);
    const double at = std::clamp(shot.after_s + late, last_shot, total);
    for (; samples * sample_period_s < at; ++samples) point(samples * sample_period_s);
    point(at);
    fire_in_passing(shot, platform_on(problem_.robot, from, goal, at).velocity_mps);
    last_shot = at;
  }
  for (; samples * sample_period_s < total; ++samples) {
    be_at(samples * sample_period_s);
    sample();
  }
  time_s_ = begin + total;
  pose_.position = goal;
  record.driven_m += length;
  sample();
}

void SimulatedGuard::wait(const Wait& command) {
  double until_s = command.until_s;
  if (seen_ < params_.intruders.size()) until_s = std::min(until_s, params_.intruders[seen_].enters_s);
  if (!std::isfinite(until_s) || until_s <= time_s_) return;
  log("wait", fmt::format("waits until {:.1f} s", until_s));
  sample();
  time_s_ = until_s;
  sample();
}

void SimulatedGuard::follow(const FollowWaypoints& command) {
  std::vector<Vec2> waypoints = command.waypoints;
  if (waypoints.size() < 2) return;
  const Vec2 error = in_disk(arrival_rng_, problem_.errors.position_m);
  const double heading_error = problem_.errors.heading_rad * arrival_rng_.uniform(-1.0, 1.0);
  waypoints.back() = strayed_goal(waypoints, problem_, site_, error);

  ReportPath path{time_s_, 0.0, waypoints};
  const Vec2 goal = waypoints.back();
  log("drive", fmt::format("drives to ({:.2f}, {:.2f})", goal.x, goal.y));
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const auto on_leg = std::ranges::equal_range(command.shots, i, {}, &FireInPassing::leg);
    drive_to(waypoints[i], on_leg);
    if (command.until_arrival && news()) {
      path.waypoints.resize(i + 1);
      break;
    }
  }
  pose_.heading_rad = wrap_angle(pose_.heading_rad + heading_error);
  path.end_s = time_s_;
  record.paths.push_back(std::move(path));
  if (!landed_.empty()) await_balls();
}

void SimulatedGuard::aim(const AimGun& command) {
  const double yaw_from = gun_yaw_rad_;
  const double pitch_from = gun_pitch_rad_;
  const Stance here = stance();
  const GunAngles to = angles_of(here, {command.yaw_rad, command.pitch_rad, 0.0});
  const double yaw_turn = wrap_angle(to.yaw_rad - heading_on(here, pose_.heading_rad) - yaw_from);
  const double pitch_turn = to.pitch_rad - pitch_from;
  const double total = aim_time(problem_.gun, yaw_turn, pitch_turn);
  sample();
  // Each axis record.moves at its own rate, so the path bends once, where the faster one arrives.
  const double yaw_s = std::abs(yaw_turn) / problem_.gun.yaw_rate_radps;
  const double pitch_s = std::abs(pitch_turn) / problem_.gun.pitch_rate_radps;
  const double begin = time_s_;
  for (const double t : {std::min(yaw_s, pitch_s), total}) {
    time_s_ = begin + t;
    gun_yaw_rad_ = wrap_angle(yaw_from + yaw_turn * (yaw_s > 0.0 ? std::min(1.0, t / yaw_s) : 1.0));
    gun_pitch_rad_ = pitch_from + pitch_turn * (pitch_s > 0.0 ? std::min(1.0, t / pitch_s) : 1.0);
    sample();
  }
}

/// Reports a shot from where the robot is, at that velocity. Time does not go on.
Impact SimulatedGuard::shoot(const Fire& command, Vec2 velocity_mps) {
  Target target = problem_.targets[at_[command.target]];
  target.name = problem_.targets[command.target].name;
  const Shot actual = strayed(command.shot, problem_.errors.aim, gun_rng_, stance());
  const double floor = problem_.world.floor_z_m;
  const Flight flight = launch(site_.rules, {pose_.position, velocity_mps}, target, actual);
  const FlightSpace& space = site_.space(at_[command.target]);
  const double radius = problem_.gun.ball_radius_m;
  const bool walks = !params_.walks.empty();
  const Impact impact =
      walks ? fly_at(flight, radius, space, target, params_.walks[command.target], time_s_, floor)
            : fly(flight, radius, space, target, floor);
  if (walks) target = moved_to(target, params_.walks[command.target].at(time_s_ + impact.time_s));

  ReportShot shot;
  shot.target = target.name;
  shot.attempt = ++attempts_[command.target];
  shot.time_s = time_s_;
  shot.flight_s = impact.time_s;
  shot.muzzle = flight.muzzle;
  shot.velocity_mps = flight.velocity_mps;
  shot.contact = name_of_contact(impact, space, target);
  shot.contact_point = impact.position;
  shot.hit = impact.hit;
  shot.hit_by_reference_rule = hits_by_reference_rule(flight, target, impact.time_s);
  shot.clearance_m = impact.hit ? space.clearance(flight, radius, impact.time_s, 1.0).distance_m : 0.0;
  shot.profile = profile_of(flight, impact, space, target);
  shot.path = path_of(flight, impact);
  const double speed = norm(velocity_mps);
  if (speed > 0.0) shot.platform_velocity_mps = velocity_mps;
  log("shot", fmt::format("shoots at {} with {:.2f} m/s{}", target.name, actual.speed_mps,
                          speed > 0.0 ? fmt::format(", driving at {:.2f} m/s", speed) : ""));
  record.events.push_back({time_s_ + impact.time_s, impact.hit ? "hit" : "miss",
                           impact.hit ? fmt::format("hits {}", target.name)
                                      : fmt::format("misses {}: touches {}", target.name, shot.contact)});
  record.shots.push_back(std::move(shot));
  if (walks && impact.hit) gone_[command.target] = 1;
  return impact;
}

void SimulatedGuard::fire(const Fire& command) {
  const Impact impact = shoot(command, {});
  time_s_ += impact.time_s;
  landed_.push_back({command.target, impact.hit, time_s_});
  sample();
  if (impact.hit && command.target < params_.intruders.size()) leave_or_go_on(command.target);
}

/// The barrel shoots where it is by now.
void SimulatedGuard::fire_in_passing(const FireInPassing& command, Vec2 velocity_mps) {
  const Shot shot{wrap_angle(pose_.heading_rad + gun_yaw_rad_), gun_pitch_rad_, command.shot.speed_mps};
  const Impact impact = shoot({command.target, shot}, velocity_mps);
  landed_.push_back({command.target, impact.hit, time_s_ + impact.time_s});
}

/// Stands until the balls of the shots in passing have landed, and puts the events in their order.
void SimulatedGuard::await_balls() {
  for (const ShotResult& shot : landed_) time_s_ = std::max(time_s_, shot.landed_s);
  sample();
  std::stable_sort(record.events.begin(), record.events.end(),
                   [](const ReportEvent& a, const ReportEvent& b) { return a.time_s < b.time_s; });
}

void SimulatedGuard::leave_or_go_on(std::size_t who) {
  if (params_.survival.leave >= 1.0 || survival_rng_.uniform() < params_.survival.leave) return;
  const std::size_t first = params_.intruders.size();
  const std::size_t place = at_[who] < first ? params_.intruders[who].place : at_[who] - first;
  const std::size_t next = elsewhere(place, problem_.targets.size() - first, survival_rng_);
  at_[who] = first + next;
  const Vec2 from = xy(problem_.targets[first + place].base);
  const Vec2 to = xy(problem_.targets[first + next].base);
  const double walk_s =
      params_.survival.walk_mps > 0.0 ? distance(from, to) / params_.survival.walk_mps : 0.0;
  survived_.push_back({who, time_s_ + walk_s, next});
  log("survive", fmt::format("{} does not leave: it goes to the place of {}", params_.intruders[who].name,
                             problem_.targets[first + next].name));
  if (record.moves[who].empty()) record.moves[who].push_back({params_.intruders[who].settles_s, from, from});
  record.moves[who].push_back({time_s_, from, from});
  record.moves[who].push_back({time_s_ + walk_s, to, to});
}

}  // namespace outrider
