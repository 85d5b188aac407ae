// The commands of a SimulatedRobot with a body that drives to waypoints: drive, aim, shoot, wait, fill its
// stores. The body is a WaypointBody, a NavigatedBody or a RigidBody.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/overload.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

constexpr double sample_period_s = 0.1;
constexpr double no_ball_s = 1.0;  // a robot that waits for a ball to land and sees none goes on after that
constexpr double at_station_m = 1e-6;  // beside the error of a drive that ends there

void measure(const WaypointBody& body, SimRecord& record) {
  record.contacts = body.hindrance().contacts();
  record.post_contacts = body.hindrance().post_contacts();
}
void measure(RigidBody& body, SimRecord& record) { record.rigid = body.record(); }
void measure(const NavigatedBody& body, SimRecord& record) {
  const TwistBody& wheels = body.wheels();
  record.navigated = {wheels.contacts(), wheels.walked_into(), body.recoveries(),
                      wheels.walk_ins().blocked_s().value_or(-1.0), body.belief_error_m()};
}

/// Returns the heading that the robot believes to have.
double heading_of_body(const WaypointBody& body) { return body.pose().heading_rad; }
double heading_of_body(const RigidBody& body) { return body.pose().heading_rad; }
double heading_of_body(const NavigatedBody& body) { return body.believed_pose().heading_rad; }

}  // namespace

/// Commands for devices that it does not carry are ignored.
template <class Body>
void SimulatedRobot::act_on(Body& body, const Command& command) {
  std::visit(Overload{[&](const FollowWaypoints& c) { follow(body, c); },
                      [&](const AimGun& c) {
                        if (devices_.gun) aim(body, c);
                      },
                      [&](const Fire& c) {
                        if (devices_.gun) fire(body, c);
                      },
                      [&](const Wait& c) { wait(body, c); },
                      [&](const Fill& c) {
                        if (devices_.stores) fill(body, c);
                      },
                      [](const auto&) {}},
             command);
  note_put(body);
  note_landed();
  gauge(body);
  log_now();
}
template void SimulatedRobot::act_on(WaypointBody& body, const Command& command);
template void SimulatedRobot::act_on(NavigatedBody& body, const Command& command);
template void SimulatedRobot::act_on(RigidBody& body, const Command& command);

/// Logs what has happened until now. Returns the log, or null if there is none.
Log* SimulatedRobot::log_now() {
  if (log_ != nullptr) queue_.flush(*log_, time_s());
  return log_;
}

/// Tells that somebody has put the robot elsewhere, if so.
template <class Body>
void SimulatedRobot::note_put(Body& body) {
  if (!body.suffer()) return;
  tell(body.time_s(), "kidnapped",
       fmt::format("is put to ({:.2f}, {:.2f})", body.pose().position.x, body.pose().position.y));
  sample();
}

/// Notes an event. Of waits that follow one another only the first is told.
void SimulatedRobot::tell(double time_s, std::string kind, std::string sentence) {
  const bool waits = kind == "wait";
  if (!waits || !waited_) queue_.note_event(time_s, std::move(kind), std::move(sentence));
  waited_ = waits;
}

/// Brings the gun to where it is now if it turns, and logs the pose of the robot and of its gun.
void SimulatedRobot::sample() {
  if (gun_motion_)
    devices_.gun->be_between(gun_motion_->from, gun_motion_->to, time_s() - gun_motion_->begin_s);
  note_landed();
  Log* const log = log_now();
  if (log == nullptr) return;
  log_pose(*log, time_s(), pose());
  if (!devices_.gun) return;
  const Shot barrel = this->barrel();
  log_gun(*log, time_s(), wrap_angle(barrel.yaw_rad - pose().heading_rad), barrel.pitch_rad);
}

Stance SimulatedRobot::stance() const {
  const auto* body = std::get_if<WaypointBody>(&body_);
  return body != nullptr ? body->stance() : Stance{};
}

/// Returns the direction of the barrel in the world.
Shot SimulatedRobot::barrel() const { return devices_.gun->barrel(stance(), pose().heading_rad); }

/// Takes what has been used until now out of the stores.
template <class Body>
void SimulatedRobot::gauge(Body& body) {
  record.driven_m = body.driven_m();
  record.turned_rad = body.turned_rad();
  measure(body, record);
  if (!devices_.stores) return;
  devices_.stores->note(body.time_s(), record.driven_m, record.shots);
  if (Log* const log = log_now()) {
    log->append(topic::stores, body.time_s(),
                outrider_msgs::StoreLevels{devices_.stores->water(), devices_.stores->charge_j()});
  }
}

template <class Body>
void SimulatedRobot::begin(Body& body) {
  gauge(body);
  sample();
}
template void SimulatedRobot::begin(WaypointBody& body);
template void SimulatedRobot::begin(NavigatedBody& body);
template void SimulatedRobot::begin(RigidBody& body);

/// Lets the gun turn to where it has to point next: for the shot after those done, or on arrival.
template <class Body>
void SimulatedRobot::turn_gun(const Body& body, const std::vector<Vec2>& waypoints,
                              const FollowWaypoints& command, std::size_t shots_done) {
  gun_motion_.reset();
  if (!devices_.gun) return;
  const bool shoots = shots_done < command.shots.size();
  if (!shoots && !command.aim) return;
  const std::size_t leg = shoots ? command.shots[shots_done].leg : waypoints.size() - 1;
  const Vec2 from = waypoints[leg - 1], to = waypoints[leg];
  const Shot barrel =
      shoots ? command.shots[shots_done].shot : Shot{command.aim->yaw_rad, command.aim->pitch_rad, 0.0};
  const Stance stance =
      shoots ? body.stance_on(from, to, command.shots[shots_done].after_s) : body.stance_on(to, to, 0.0);
  gun_motion_ = GunMotion{devices_.gun->state(),
                          SimulatedGun::joints_towards(barrel, stance, heading_of(to - from)), body.time_s()};
}

/// Drives the straight that ends at waypoint `leg`, and shoots on the way.
template <class Body>
void SimulatedRobot::drive_straight(Body& body, const std::vector<Vec2>& waypoints, std::size_t leg,
                                    const FollowWaypoints& command) {
  const StraightDrive drive = body.begin_straight(waypoints[leg], [this] { sample(); });
  if (drive.length_m == 0.0) return;
  const auto stopped_s = body.stopped_after_s(drive);
  const double drives_s = stopped_s.value_or(drive.total_s);
  const auto [first, last] = std::ranges::equal_range(command.shots, leg, {}, &FireInPassing::leg);
  int samples = 1;
  double last_shot = 0.0;
  const auto sample_until = [&](double end_s) {
    for (; samples * sample_period_s < end_s; ++samples) {
      body.be_on(drive, samples * sample_period_s);
      sample();
    }
  };
  for (auto shot = first; devices_.gun && shot != last; ++shot) {
    SimulatedGun& gun = *devices_.gun;
    const double at = std::clamp(shot->after_s + gun.draw_delay_s(), last_shot, drive.total_s);
    if (stopped_s && at > drives_s) break;
    sample_until(at);
    body.be_on(drive, at);
    sample();
    Shot barrel = this->barrel();
    barrel.speed_mps = shot->shot.speed_mps;
    shoot(body, {shot->target, barrel}, body.platform_on(drive, at));
    turn_gun(body, waypoints, command, static_cast<std::size_t>(shot - command.shots.begin()) + 1);
    last_shot = at;
  }
  sample_until(drives_s);
  if (stopped_s)
    body.cut_short(drive, drives_s);
  else
    body.end_straight(drive);
  sample();
}

template <class Body>
void SimulatedRobot::follow(Body& body, const FollowWaypoints& command) {
  if (command.waypoints.size() < 2) return;
  sample();  // the way before may have ended with an error of the heading
  const std::vector<Vec2> waypoints = body.displaced_waypoints(command.waypoints);
  if (Log* const log = log_now()) log_plan(*log, body.time_s(), waypoints);
  tell(body.time_s(), "drive",
       fmt::format("drives to ({:.2f}, {:.2f})", waypoints.back().x, waypoints.back().y));
  turn_gun(body, waypoints, command, 0);
  body.begin_way();
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    drive_straight(body, waypoints, i, command);
    if (body.stopped()) {
      tell(body.time_s(), "stopped",
           fmt::format("stops at ({:.2f}, {:.2f}): the drive does not go on", body.pose().position.x,
                       body.pose().position.y));
      break;
    }
    if (command.until_arrival && devices_.targets && devices_.targets->somebody_entered(body.time_s())) break;
  }
  gun_motion_.reset();
  body.end_way();
  if (Log* const log = log_now()) log_plan(*log, body.time_s(), {});
}

/// The navigator finds the way, and nothing is shot in passing.
void SimulatedRobot::follow(NavigatedBody& body, const FollowWaypoints& command) {
  if (command.waypoints.size() < 2) return;
  const Vec2 place = command.waypoints.back();
  if (Log* const log = log_now()) log_plan(*log, body.time_s(), command.waypoints);
  tell(body.time_s(), "drive", fmt::format("drives to ({:.2f}, {:.2f})", place.x, place.y));
  turn_gun(body, command.waypoints, command, 0);
  body.begin_way();
  double sampled_s = body.time_s();
  body.drive_to(place, [&] {
    note_put(body);
    if (body.time_s() - sampled_s >= sample_period_s) {
      sampled_s = body.time_s();
      sample();
    }
    return !command.until_arrival || !devices_.targets || !devices_.targets->somebody_entered(body.time_s());
  });
  if (!body.why_stopped().empty()) {
    tell(body.time_s(), "stopped",
         fmt::format("stops at ({:.2f}, {:.2f}): {}", body.pose().position.x, body.pose().position.y,
                     body.why_stopped()));
  }
  gun_motion_.reset();
  sample();
  if (Log* const log = log_now()) log_plan(*log, body.time_s(), {});
}

template <class Body>
void SimulatedRobot::aim(Body& body, const AimGun& command) {
  SimulatedGun& gun = *devices_.gun;
  const SimulatedGun::Turn turn =
      gun.turn_towards(command.yaw_rad, command.pitch_rad, stance(), heading_of_body(body));
  sample();
  const double begin = body.time_s();
  // Each joint moves at its own rate, so the path bends once, where the faster one arrives.
  for (const double t : {std::min(turn.yaw_s, turn.pitch_s), turn.total_s}) {
    body.wait_until(begin + t);
    gun.be_on(turn, t);
    sample();
  }
}

/// Throws a ball from the robot, unless the gun fires nothing. Time does not go on.
template <class Body>
bool SimulatedRobot::shoot(Body& body, const Fire& command, const Platform& platform) {
  SimulatedGun& gun = *devices_.gun;
  if (gun.pull_trigger(body.time_s())) return throw_ball(body, command, platform);
  tell(body.time_s(), "no_shot",
       fmt::format("pulls the trigger at {}, and nothing leaves the barrel",
                   gun.scene().targets[command.target].name));
  return false;
}

/// Tells of a shot that has just left the barrel.
FiredShot SimulatedRobot::note_fired(const Fire& command, const Platform& platform, const Flight& flight,
                                     double muzzle_mps, const std::string& name) {
  const double speed = norm(platform.velocity());
  tell(time_s(), "shot",
       fmt::format("shoots at {} with {:.2f} m/s{}", name, muzzle_mps,
                   speed > 0.0 ? fmt::format(", driving at {:.2f} m/s", speed) : ""));
  ++record.shots;
  return {
      command.target,       devices_.gun->next_attempt(command.target), flight, time_s(), pose(), barrel(),
      platform.velocity_mps};
}

/// Tells what a ball has touched. `miss` says how it missed.
void SimulatedRobot::tell_impact(double time_s, bool hit, const std::string& name, const std::string& miss) {
  tell(time_s, hit ? "hit" : "miss",
       hit ? fmt::format("hits {}", name) : fmt::format("misses {}: {}", name, miss));
}

/// The flight is known as soon as the ball has left.
template <class Body>
bool SimulatedRobot::throw_ball(const Body& from, const Fire& command, const Platform& platform) {
  SimulatedGun& gun = *devices_.gun;
  auto& targets = devices_.targets;
  const std::size_t stand_in = targets ? targets->stand_in(command.target) : command.target;
  const Walk* const walk = targets ? targets->walk(command.target) : nullptr;
  const double time_s = from.time_s();
  const auto thrown = gun.throw_ball(command.shot, command.target, stand_in, platform, walk, time_s);
  const FlightSpace& space = gun.scene().space(stand_in);
  const auto& [flight, impact, muzzle_mps, target, stopped_by] = thrown;
  const std::string contact = stopped_by.empty() ? contact_of(impact, space, target) : stopped_by;
  const FiredShot shot = note_fired(command, platform, flight, muzzle_mps, target.name);
  tell_impact(time_s + impact.time_s, impact.hit, target.name, "touches " + contact);
  if (Log* const log = log_now()) {
    log->append(topic::shots, time_s,
                message_of(shot, impact, space, target, gun.scene().rules.gun.ball_radius_m, contact));
  }
  flights_.push_back({command.target, impact.hit, time_s + impact.time_s});
  if (impact.hit && targets) targets->hit(command.target, time_s + impact.time_s, queue_);
  return true;
}

template <class Body>
void SimulatedRobot::fire(Body& body, const Fire& command) {
  const bool flies = shoot(body, command, {body.pose().position, {}});
  if (!command.until_landed) return;
  if (!flies)
    body.wait_until(body.time_s() + no_ball_s);
  else if constexpr (std::is_same_v<Body, RigidBody>)
    body.wait_until_landed();
  else
    body.wait_until(flights_.back().landed_s);
  sample();
}

template <class Body>
void SimulatedRobot::wait(Body& body, const Wait& command) {
  double until_s = command.until_s;
  if (devices_.targets) until_s = std::min(until_s, devices_.targets->next_entry_s());
  if (!std::isfinite(until_s) || until_s <= body.time_s()) return;
  const bool walkers = devices_.targets && devices_.targets->walk(0) != nullptr;
  tell(body.time_s(), "wait",
       walkers ? std::string("waits for a shot") : fmt::format("waits until {:.1f} s", until_s));
  sample();
  body.wait_until(until_s);
  sample();
}

template <class Body>
void SimulatedRobot::fill(Body& body, const Fill& command) {
  gauge(body);
  const StationCall& call = command.call;
  const Station& station = devices_.stores->station(call.station);
  if (distance(body.pose().position, station.position) > body.position_error_m() + at_station_m) {
    tell(body.time_s(), "no_fill",
         fmt::format("is too far from {} to take in {}", station.name, to_string(call.store)));
    return;
  }
  tell(body.time_s(), "fill", fmt::format("takes in {} at {}", to_string(call.store), station.name));
  sample();
  body.wait_until(body.time_s() + devices_.stores->fill(call.store));
  if (call.store == Store::water && devices_.gun) devices_.gun->fill_tank();
  sample();
}

}  // namespace outrider
