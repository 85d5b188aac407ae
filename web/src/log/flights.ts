// Shots and the flight of their balls.
import { clamp, finite, mix } from "../base/numbers";
import { vec2, vec3, type Vec2, type Vec3 } from "./geometry";
import type { Shot } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import { topic } from "./topics";

export interface Flight {
  /** Among the shots; -1 for a flight that was not tried. */
  index: number;
  target: string;
  attempt: number;
  hit: boolean;
  contact: string;
  clearance: number;
  pitch: number;   // of the gun
  /** The robot drove when it shot. */
  driving: boolean;
  start: number;
  end: number;
  from: Vec3;
  to: Vec3;
  across: number;  // m/s along the ground
  up: number;      // m/s
  along: number;   // m from the muzzle to the contact, along the ground
  speed: number;
  /** Places of a shot in air at equal times. */
  path: Vec3[];
  profile: { name: string; polygon: Vec2[] }[];
}
export interface Ball { x: number; y: number; z: number; s: number }

function flightOf(start: number, shot: Shot, index: number): Flight {
  const [vx, vy, up] = vec3(shot.velocity);
  const [from, to] = [vec3(shot.muzzle), vec3(shot.contact_point)];
  const across = Math.hypot(vx, vy);
  const { x, y } = shot.platform_velocity ?? { x: 0, y: 0 };
  return { index, target: shot.target, attempt: shot.attempt, hit: shot.hit, contact: shot.contact, clearance: shot.clearance, pitch: shot.gun_pitch,
    driving: x !== 0 || y !== 0, start, end: start + finite(shot.flight), from, to, across, up, speed: Math.hypot(across, up), along: Math.hypot(to[0] - from[0], to[1] - from[1]),
    path: shot.path.map(vec3), profile: shot.profile.map(({ name, polygon }) => ({ name, polygon: polygon.map(vec2) })) };
}

export const flightsOf = once(({ log }: Run): Flight[] =>
  log.messages<Shot>(topic.shots).map(({ t, message }, i) => flightOf(t, message, i)));

/** The flights that come nearest to those targets that cannot be hit, by the name of the target. Their contact is what is in the way. */
export const blockedOf = once(({ log }: Run): Map<string, Flight> =>
  new Map(log.messages<Shot>(topic.blockedFlights).map(({ t, message }) => [message.target, flightOf(t, message, -1)])));

/** Centre of the ball `tau` seconds after the muzzle: on the path of a shot in air, else on the line to the contact, at
 *  the parabola's height. */
export function ballOf(run: Run, { start, end, from, to, along, path, across, up }: Flight, tau: number): Ball {
  const share = end > start ? tau / (end - start) : 1;
  if (path.length > 1) {
    const steps = path.length - 1;
    const step = clamp(Math.floor(share * steps), 0, steps - 1);
    const [x, y, z] = [0, 1, 2].map((k) => mix(path[step]![k]!, path[step + 1]![k]!, share * steps - step)) as Vec3;
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    return { x, y, z, s: ((x - from[0]) * dx + (y - from[1]) * dy) / (along || 1) };
  }
  return { x: mix(from[0], to[0], share), y: mix(from[1], to[1], share),
    z: from[2] + up * tau - 0.5 * run.info.gravity * tau * tau, s: across * tau };
}
