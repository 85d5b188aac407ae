// The shots of a SimulatedRobot with a RigidBody, whose balls fly as long as time goes on.
#include <fmt/format.h>

#include <algorithm>

#include "outrider/log/topics.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

bool SimulatedRobot::throw_ball(RigidBody& body, const Fire& command, const Platform& platform) {
  note_landed(body);
  SimulatedGun& gun = *devices_.gun;
  const GunScene& scene = gun.scene();
  const Target& target = scene.targets[command.target];
  if (body.full()) {
    tell(body.time_s(), "no_shot",
         fmt::format("does not shoot at {}: {} balls are in the air", target.name, most_balls));
    return false;
  }
  const Shot actual = gun.draw_shot(command.shot, {});
  Flight flight = body.launched(scene.rules.gun, actual);
  Vec3 platform_mps;
  if (platform.velocity_mps != Vec2{}) platform_mps = body.velocity_at(flight.muzzle);
  flight.velocity_mps = flight.velocity_mps + platform_mps;
  const Platform from{platform.position, xy(platform_mps), platform_mps.z};
  body.throw_ball(note_fired(command, from, flight, actual.speed_mps, target.name));
  return true;
}

void SimulatedRobot::note_landed() {
  if (auto* body = std::get_if<RigidBody>(&body_)) note_landed(*body);
}

/// Notes the contacts of the robot and of its balls since the call before.
void SimulatedRobot::note_landed(RigidBody& body) {
  for (const Bump& bump : body.take_bumps()) {
    tell(bump.time_s, "bump",
         fmt::format("touches {} at ({:.2f}, {:.2f})", body.name_of(bump.body), bump.position.x,
                     bump.position.y));
  }
  for (const LandedBall& ball : body.take_landed()) note_landed(body, ball);
  if (log_ != nullptr) landed_shots_.flush(*log_, body.all_landed_before_s());
}

void SimulatedRobot::note_landed(RigidBody& body, const LandedBall& ball) {
  const auto& [shot, impact, landed_s] = ball;
  const GunScene& scene = devices_.gun->scene();
  const Target& target = scene.targets[shot.target];
  const FlightSpace& space = scene.space(shot.target);
  const double radius = scene.rules.gun.ball_radius_m;
  const Impact foreseen = fly(shot.flight, radius, space, target, scene.rules.floor_z_m);
  const std::string contact = impact.hit     ? target.name
                              : impact.solid ? body.name_of(*impact.solid)
                                             : "nothing";
  const std::string expected = contact_of(foreseen, space, target);
  RigidRecord& rigid = body.record();
  if (impact.hit == foreseen.hit && contact == expected) ++rigid.as_foreseen;
  const Vec3 at = impact.position;
  rigid.flight_error_m = std::max(rigid.flight_error_m, norm(at - shot.flight.position(impact.time_s)));
  if (!impact.hit) {
    rigid.misses[shot.target] =
        fmt::format("touches {} at ({:.2f}, {:.2f}, {:.2f}), {:.3f} m from it", contact, at.x, at.y, at.z,
                    std::max(0.0, distance(at, solid_of(target)) - radius));
  }
  tell_impact(landed_s, impact.hit, target.name, rigid.misses[shot.target]);
  landed_shots_.note(shot.fired_s, topic::shots, message_of(shot, impact, space, target, radius, contact));
  flights_.push_back({shot.target, impact.hit, landed_s});
}

}  // namespace outrider
