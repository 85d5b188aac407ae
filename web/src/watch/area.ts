// The part of the plane that a run takes place in.
import type { Box } from "../base/camera";
import { landmarksAt } from "../log/mapping";
import { mapOf } from "../log/map";
import type { Tags, Waypoints } from "../log/messages";
import { pursuitOf } from "../log/pursuit";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { bodiesOf } from "../log/world";

/** Returns the part that the view shows when nobody moved it: the bounds, or all that the log tells of. */
export function areaOf(run: Run): Box {
  const { bounds, log } = run;
  if (bounds) return [...bounds[0], ...bounds[1]];
  const box: Box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (x: number, y: number, r = 0): void => {
    box[0] = Math.min(box[0], x - r);
    box[1] = Math.min(box[1], y - r);
    box[2] = Math.max(box[2], x + r);
    box[3] = Math.max(box[3], y + r);
  };
  const reach = Math.max(0.3, run.radius);
  for (let i = 0; i < run.track.length; ++i) add(run.track.x[i]!, run.track.y[i]!, reach);
  for (const { footprint } of bodiesOf(run)) for (const { core, radius_m } of footprint) for (const [x, y] of core) add(x, y, radius_m);
  for (const { position } of log.latest<Tags>(topic.tags)?.tags ?? []) add(position.x, position.y);
  for (const { position } of log.latest<Waypoints>(topic.waypoints)?.waypoints ?? []) add(position.x, position.y, reach);
  const pursuit = pursuitOf(run);
  for (const way of pursuit ? [pursuit.target, ...pursuit.robots] : []) for (const [x, y] of way) add(x, y);
  for (const { position } of landmarksAt(run, Infinity)) add(position.x, position.y, reach);
  const map = mapOf(log).at(run.duration);
  if (map && map.known > 0) {
    const { origin: [x, y], cell_m, extent: { low, high } } = map;
    add(x + low[0] * cell_m, y + low[1] * cell_m);
    add(x + (high[0] + 1) * cell_m, y + (high[1] + 1) * cell_m);
  }
  if (box[0] > box[2]) return [-2, -2, 2, 2];
  return [box[0] - 0.25, box[1] - 0.25, box[2] + 0.25, box[3] + 0.25];
}
