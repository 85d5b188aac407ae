// The things that stand still: the solids of the world, terrain, and the walls that a range finder meets.
import type { Rounded } from "../base/outline";
import { rings, shapes, vec2, type Outlines, type Vec2 } from "./geometry";
import type { Outlines as OutlinesMessage, Solids, Terrain } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import { topic } from "./topics";

export interface Body { name: string; kind: string; low: number; high: number; blocks_driving: boolean; footprint: Rounded[] }
export interface Slopes { contours: { height: number; points: Vec2[] }[]; steep: Rounded[] }

const none: Body[] = [];
const bodies = once(({ solids }: Solids): Body[] => solids.map(({ name, kind, low_z, high_z, blocks_driving, footprint }) =>
  ({ name, kind, low: low_z, high: high_z, blocks_driving, footprint: shapes(footprint) })));
const slopes = once(({ contours, steep }: Terrain): Slopes =>
  ({ contours: contours.map(({ height, points }) => ({ height, points: points.map(vec2) })), steep: shapes(steep) }));
const outlined = once(({ outlines }: OutlinesMessage): Outlines => rings(outlines));

/** The same list as long as no newer message comes. */
export function bodiesOf({ log }: Run): Body[] {
  const message = log.latest<Solids>(topic.solids);
  return message ? bodies(message) : none;
}

export function slopesOf({ terrain }: Run): Slopes | null { return terrain ? slopes(terrain) : null; }

/** The outlines on a topic; null where the log has none. */
export function outlinesOf({ log }: Run, name: string): Outlines | null {
  const message = log.latest<OutlinesMessage>(name);
  return message ? outlined(message) : null;
}

export const wallsOf = (run: Run): Outlines | null => outlinesOf(run, topic.walls);
