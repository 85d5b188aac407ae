// The tour that is planned, and from where targets can be hit.
import { vec2, type Vec2 } from "./geometry";
import type { OccupancyGrid, Tour } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import type { Stamped } from "./run_log";
import { topic } from "./topics";

export interface PlannedTour { stops: { at: Vec2; targets: string[] }[]; way: Vec2[]; cost: number; bound: number }

const tour = once(({ stops, way, cost, lower_bound }: Tour): PlannedTour =>
  ({ stops: stops.map(({ position, targets }) => ({ at: vec2(position), targets })), way: way.map(vec2), cost, bound: lower_bound }));

/** The newest tour. */
export function tourOf({ log }: Run): PlannedTour | null {
  const message = log.latest<Tour>(topic.tours);
  return message ? tour(message) : null;
}

/** The share of the targets that can be hit from each cell, in percent; -1 where the robot cannot stand. */
export const firingMapOf = ({ log }: Run): Stamped<OccupancyGrid> | null => log.at<OccupancyGrid>(topic.firingMap, Infinity) ?? null;

/** The robot plans its tour: it stands where it stood when it was last told of. */
export function isPlanning(run: Run): boolean {
  if (!run.goesOn) return false;
  const told = Math.max(run.log.channels.get(topic.tours)?.end ?? -1, run.log.channels.get(topic.firingMap)?.end ?? -1);
  return told >= 0 && (run.track.length === 0 || told >= run.track.end - 1e-6);
}
