// A run: what its log says as a whole. What is particular to a kind of message is worked out beside it (flights.ts,
// targets.ts, beliefs.ts, map.ts).
import { finite } from "../base/numbers";
import { typeset } from "../base/typeset";
import { beliefsOf } from "./beliefs";
import { flightsOf } from "./flights";
import type { Vec2, Vec3 } from "./geometry";
import type { LogLine, PolygonStamped, RunInfo, Terrain } from "./messages";
import { Relief } from "./relief";
import { indexAt, type RunLog, type Stamped } from "./run_log";
import { topic } from "./topics";
import { gunOf, posesOf, Track } from "./track";

const nothingKnown: RunInfo = { job: "", seeded: false, seed: 0n, world: "", low: { x: NaN, y: NaN }, high: { x: NaN, y: NaN }, gravity: 9.8, robot_radius: NaN,
  gun_length: 0, ball_radius: 0, margin: 0, coverage_width: 0 };

export class Run {
  readonly info: RunInfo;
  readonly track: Track;
  readonly duration: number;
  /** Corners of the robot, in its own frame; none: it is a disk. */
  readonly outline: readonly Vec2[];
  readonly terrain: Terrain | undefined;
  readonly events: readonly Stamped<LogLine>[];
  private relief: Relief | null;

  /** `goesOn`: it is not over, and lasts so long as it is known where the robot was. */
  constructor(readonly log: RunLog, readonly goesOn = false) {
    this.info = log.latest<RunInfo>(topic.run) ?? nothingKnown;
    this.track = new Track(posesOf(log), gunOf(log));
    this.outline = (log.latest<PolygonStamped>(topic.footprint)?.polygon.points ?? []).map(({ x, y }) => [x, y]);
    this.terrain = log.latest<Terrain>(topic.terrain);
    this.relief = Relief.of(this.terrain);
    this.events = log.messages<LogLine>(topic.events);
    const told = flightsOf(this).reduce((latest, { end }) => Math.max(latest, end), log.end);
    this.duration = Math.max(1e-3, goesOn && this.track.end > 0 ? this.track.end : told);
  }

  get name(): string { return this.info.world || this.log.summary?.world || ""; }
  get job(): string { return this.info.job || this.log.summary?.job || ""; }
  /** True if the log has true poses. Else the track is what was settled or believed. */
  get hasTruth(): boolean { return this.log.has(topic.pose); }

  /** Two corners of the box that shows everything; null where the run names none. */
  get bounds(): [Vec2, Vec2] | null {
    const { low, high } = this.info;
    return Number.isFinite(low.x) && Number.isFinite(high.x) ? [[low.x, low.y], [high.x, high.y]] : null;
  }

  /** Radius of the robot; 0 where it is not known. */
  get radius(): number { return finite(this.info.robot_radius); }

  /** Until then the robot goes by what it believes. */
  get believedUntil(): number { return beliefsOf(this).until; }

  /** Height of the ground, m. */
  height(x: number, y: number): number { return this.relief?.height(x, y) ?? 0; }
  /** Upward normal of the ground, not normalised. */
  normal(x: number, y: number): Vec3 { return this.relief?.normal(x, y) ?? [0, 0, 1]; }
  get ground(): Relief | null { return this.relief; }

  /** Index of the last event that has happened at t; -1 before the first. */
  eventIndex(t: number): number { return indexAt(this.events, t + 1e-9); }
  eventText(t: number): string { return typeset(this.events[this.eventIndex(t)]?.message.msg ?? ""); }
}
