// A run: a report, and what it says about any instant.
import { clamp, finite, mix } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import type { Event, Report, Shot, Target, Vec3 } from "./types";
import { Relief } from "./relief";
import { Track } from "./track";

export interface Flight extends Shot {
  index: number;
  start: number;
  end: number;
  from: Vec3;
  to: Vec3;
  across: number;  // m/s along the ground
  up: number;      // m/s
  along: number;   // m from the muzzle to the contact, along the ground
}
export interface Ball { x: number; y: number; z: number; s: number }
interface Knot { t: number; at: Vec2 }

const vec3 = (values: (number | null)[], otherwise: Vec3 = [0, 0, 0]): Vec3 =>
  [0, 1, 2].map((k) => finite(values[k], otherwise[k])) as Vec3;

function flightOf(shot: Shot, index: number): Flight {
  const [vx, vy, vz] = vec3(shot.velocity_mps);
  const from = vec3(shot.muzzle);
  const to = vec3(shot.contact_point, from);
  const start = finite(shot.time_s);
  return { ...shot, index, start, end: start + finite(shot.flight_s), from, to, up: vz,
    across: Math.hypot(vx, vy), along: Math.hypot(to[0] - from[0], to[1] - from[1]) };
}

/** The place at t between knots in the order of time; null when there are none. */
export function alongKnots(knots: Knot[], t: number): Vec2 | null {
  const last = knots.at(-1);
  if (!last) return null;
  const next = knots.findIndex((knot) => knot.t > t);
  if (next < 0) return last.at;
  const b = knots[next]!;
  const a = knots[next - 1] ?? b;
  const share = b.t > a.t ? (t - a.t) / (b.t - a.t) : 1;
  return [mix(a.at[0], b.at[0], share), mix(a.at[1], b.at[1], share)];
}

export class Run {
  readonly track: Track;
  readonly flights: Flight[];
  readonly duration: number;
  /** After that the robot goes on by other means than what it believed: a yard that is explored is then guarded. */
  readonly believedUntil: number;
  /** The terrain; null on flat ground. */
  readonly relief: Relief | null;

  /** `goesOn`: it is not over, and lasts so long as it is known where the robot was. */
  constructor(readonly report: Report, goesOn = false) {
    this.track = new Track(report.track, report.robot.start);
    const last = (report.drive ?? report.explore ?? report.slam)?.beliefs.at(-1);
    this.believedUntil = last ? last.time_s + 1.5 : -Infinity;
    this.relief = Relief.of(report.world.terrain?.relief);
    this.flights = report.shots.map(flightOf);
    const { pursuit, explore, drive, slam } = report;
    const latest = (times: (number | null | undefined)[]): number =>
      times.reduce<number>((most, t) => Math.max(most, finite(t)), 0);
    const told = Math.max(1e-3, this.track.end, latest(this.flights.map((one) => one.end)),
      latest(report.events.map((one) => one.time_s)), latest((pursuit?.robots ?? []).map((way) => way.length - 1)),
      latest([explore, drive, slam].map((part) => part?.beliefs.at(-1)?.time_s)));
    this.duration = goesOn && this.track.end > 0 ? this.track.end : told;
  }

  /** Height of the ground, m. */
  height(x: number, y: number): number { return this.relief?.height(x, y) ?? 0; }
  /** Upward normal of the ground, not normalised. */
  normal(x: number, y: number): Vec3 { return this.relief?.normal(x, y) ?? [0, 0, 1]; }

  /** Centre of the ball `tau` seconds after the muzzle: on the path of a shot in air, else on the line to the
   *  contact, at the parabola's height. */
  ball(shot: Flight, tau: number): Ball {
    const share = shot.end > shot.start ? tau / (shot.end - shot.start) : 1;
    if (shot.path && shot.path.length > 1) {
      const steps = shot.path.length - 1;
      const step = clamp(Math.floor(share * steps), 0, steps - 1);
      const [a, b] = [shot.path[step]!, shot.path[step + 1]!];
      const [x, y, z] = vec3([0, 1, 2].map((k) => mix(finite(a[k]), finite(b[k]), share * steps - step)));
      const [dx, dy] = [shot.to[0] - shot.from[0], shot.to[1] - shot.from[1]];
      return { x, y, z, s: ((x - shot.from[0]) * dx + (y - shot.from[1]) * dy) / (shot.along || 1) };
    }
    return {
      x: mix(shot.from[0], shot.to[0], share),
      y: mix(shot.from[1], shot.to[1], share),
      z: shot.from[2] + shot.up * tau - 0.5 * this.report.world.gravity_mps2 * tau * tau,
      s: shot.across * tau,
    };
  }

  targetOf(shot: Shot | null): Target | null { return this.targetNamed(shot?.target); }

  targetNamed(name: string | undefined): Target | null {
    return this.report.targets.find((one) => one.name === name) ?? null;
  }

  doneAt(target: Target): number {
    return finite(target.done_s, this.duration);
  }

  status(target: Target, t: number): string {
    if (t >= this.doneAt(target) - 1e-9) return target.status;
    return t < finite(target.visit?.enters_s) ? "outside" : "waiting";
  }

  /** Where a target is at t; null when it is not in the yard: intruders come and go. */
  place(target: Target, t: number): Vec2 | null {
    const { visit, moves, centre } = target;
    const gone = target.status === "reached" && t > this.doneAt(target) + 4;
    if (visit && (t < finite(visit.enters_s) || gone)) return null;
    const knots: Knot[] = (moves ?? []).map((move) => ({ t: finite(move.time_s), at: move.position }));
    const first: Vec2 = knots[0]?.at ?? [finite(centre[0]), finite(centre[1])];
    if (visit) knots.unshift({ t: finite(visit.enters_s), at: visit.from }, { t: finite(visit.settles_s), at: first });
    return alongKnots(knots, t) ?? first;
  }

  /** Where the robot takes a target that walks about to be; null when it is right. */
  belief(target: Target, t: number): Vec2 | null {
    const moves = target.moves ?? [];
    const wrong = moves.some((m) => m.believed[0] !== m.position[0] || m.believed[1] !== m.position[1]);
    if (t > this.doneAt(target) || !wrong) return null;
    return alongKnots(moves.map((move) => ({ t: finite(move.time_s), at: move.believed })), t);
  }

  /** Index of the last event that has happened at t; -1 before the first. */
  eventIndex(t: number): number {
    return this.report.events.findLastIndex((event: Event) => finite(event.time_s) <= t + 1e-9);
  }
}
