// The part of the plane that a run takes place in.
import type { Box } from "../base/camera";
import { finite } from "../base/numbers";
import type { Run } from "../report/run";

/** What the view shows when nobody moved it: the bounds, or all that the report tells of. */
export function areaOf(run: Run): Box {
  const { world, pursuit, explore: found, drive: driven, slam } = run.report;
  if (world.bounds) return [...world.bounds[0], ...world.bounds[1]];
  const box: Box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (x: number, y: number, r = 0): void => {
    box[0] = Math.min(box[0], x - r);
    box[1] = Math.min(box[1], y - r);
    box[2] = Math.max(box[2], x + r);
    box[3] = Math.max(box[3], y + r);
  };
  const reach = Math.max(0.3, finite(run.report.robot.radius_m));
  for (let i = 0; i < run.track.length; ++i) add(run.track.x[i]!, run.track.y[i]!, reach);
  for (const solid of world.solids) {
    for (const { core, radius_m } of solid.footprint) for (const [x, y] of core) add(x, y, radius_m);
  }
  for (const tag of driven?.tags ?? []) add(...tag.position);
  for (const stop of driven?.stops ?? []) add(stop.pose[0], stop.pose[1], reach);
  for (const way of pursuit ? [pursuit.target, ...pursuit.robots] : []) for (const [x, y] of way) add(x, y);
  for (const { position } of slam?.landmarks ?? []) add(...position, reach);
  const map = found?.map ?? slam?.map;
  if (map && map.columns > 0) {
    const { origin, columns, rows, cell_m } = map;
    add(...origin);
    add(origin[0] + columns * cell_m, origin[1] + rows * cell_m);
  }
  return [box[0] - 0.25, box[1] - 0.25, box[2] + 0.25, box[3] + 0.25];
}
