// Targets: what became of each, and where it was at any time.
import { mix } from "../base/numbers";
import { flightsOf, type Flight } from "./flights";
import { vec2, type Vec2 } from "./geometry";
import type { Target, TargetPosition } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import { indexAt, type Stamped } from "./run_log";
import { topic } from "./topics";

export interface Knot { t: number; at: Vec2 }

/** The place at t between knots in the order of time; null when there are none. */
export function alongKnots(knots: Knot[], t: number): Vec2 | null {
  const last = knots.at(-1);
  if (!last) return null;
  const index = indexAt(knots, t);
  if (index === knots.length - 1) return last.at;
  const b = knots[index + 1]!;
  const a = knots[index] ?? b;
  const share = b.t > a.t ? (t - a.t) / (b.t - a.t) : 1;
  return [mix(a.at[0], b.at[0], share), mix(a.at[1], b.at[1], share)];
}

const gone_s = 4;  // an intruder that was reached leaves

/** The story of one target, as the log tells it. */
export class TargetStory {
  private knots: Knot[];
  private believed: Knot[];

  constructor(readonly name: string, private states: Stamped<Target>[], private places: Stamped<TargetPosition>[], private shotsAt: Flight[]) {
    this.knots = places.map(({ t, message }) => ({ t, at: vec2(message.centre) }));
    this.believed = places.map(({ t, message }) => ({ t, at: vec2(message.believed) }));
  }

  /** As it is in the newest message. */
  get last(): Target { return this.states.at(-1)!.message; }
  get status(): string { return this.last.status; }

  /** When a message told of it. */
  get changes(): number[] { return this.states.map(({ t }) => t); }

  /** As it was known to be at t. */
  at(t: number): Target { return (this.states[indexAt(this.states, t + 1e-9)] ?? this.states[0]!).message; }

  /** When its status became what it is in the end; NaN while it waits. */
  get doneAt(): number { return this.doneBy(Infinity); }

  statusAt(t: number): string { return this.at(t).status; }

  /** When its status became what it is at t; NaN if it waits then. */
  doneBy(t: number): number {
    const { status } = this.at(t);
    return status === "waiting" || status === "outside" ? NaN : this.states.find(({ message }) => message.status === status)!.t;
  }

  /** Its last place, and the height of its middle. */
  get centre(): [number, number, number] {
    const { x, y, z } = this.places.at(-1)?.message.centre ?? { x: 0, y: 0, z: 0 };
    return [x, y, z];
  }

  /** Returns its place at t; null when it is not in the yard: intruders come and go. */
  placeAt(t: number): Vec2 | null {
    const comes = this.last.entrance !== "";
    if (comes && (t < (this.knots[0]?.t ?? 0) || (this.status === "reached" && t > this.doneAt + gone_s))) return null;
    return alongKnots(this.knots, t);
  }

  /** Returns the place that the robot believes, if that is wrong. */
  believedAt(t: number): Vec2 | null {
    const wrong = this.knots.some(({ at }, i) => at[0] !== this.believed[i]!.at[0] || at[1] !== this.believed[i]!.at[1]);
    return !wrong || t > this.doneAt ? null : alongKnots(this.believed, t);
  }

  /** The shots that had been fired at it at t. */
  firedBy(t: number): Flight[] { return this.shotsAt.filter(({ start }) => start <= t + 1e-9); }
  /** Returns the pitch of the newest shot at it; NaN before one. */
  pitchBy(t: number): number { return this.firedBy(t).at(-1)?.pitch ?? NaN; }
  /** Returns the clearance of the shot that hit it, once that is over; else NaN. */
  clearanceBy(t: number): number { return this.firedBy(t).findLast(({ hit, end }) => hit && end <= t + 1e-9)?.clearance ?? NaN; }
}

function grouped<T extends { name: string }>(messages: readonly Stamped<T>[]): Map<string, Stamped<T>[]> {
  const groups = new Map<string, Stamped<T>[]>();
  for (const one of messages) {
    const group = groups.get(one.message.name);
    if (group) group.push(one);
    else groups.set(one.message.name, [one]);
  }
  return groups;
}

export const targetsOf = once((run: Run): TargetStory[] => {
  const places = grouped(run.log.messages<TargetPosition>(topic.targetPositions));
  return [...grouped(run.log.messages<Target>(topic.targets))].map(([name, states]) =>
    new TargetStory(name, states, places.get(name) ?? [], flightsOf(run).filter((shot) => shot.target === name)));
});
