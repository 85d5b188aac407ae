// Covering an area: what is asked for, the passes of the robot, how much is covered when.
import type { Bar } from "./bar";
import { rings, vec2, type Outlines, type Vec2 } from "./geometry";
import type { Coverage, CoverageArea, CoveragePass } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import { topic } from "./topics";

export interface Pass { start: number; end: number; role: CoveragePass["role"] }

export interface Cover {
  /** Width of the covered strip, m. */
  width: number;
  /** The bar that covers, unless it is a disk. */
  bar: Bar | null;
  area: Outlines;
  /** The part of it that the robot can cover. */
  reach: Outlines;
  missed: Outlines;
  overlap: Outlines;
  planned: Vec2[];
  passes: Pass[];
  covered: { t: number; covered: number; overlap: number }[];
}

/** Returns the coverage by the newest messages; null if nothing is covered. */
export const coverOf = once(({ log, info, track }: Run): Cover | null => {
  const found = log.latest<CoverageArea>(topic.coverageArea);
  if (!found) return null;
  const passes = log.messages<CoveragePass>(topic.coveragePasses);
  const length = info.coverage_length ?? 0;
  const bar = length > 0 ? { width: info.coverage_width, length, forward: info.coverage_forward ?? 0 } : null;
  return { width: info.coverage_width, bar, area: rings(found.area), reach: rings(found.reach), missed: rings(found.missed), overlap: rings(found.overlap),
    planned: found.planned.map(vec2),
    passes: passes.map(({ t, message: { role } }, i) => ({ start: t, end: passes[i + 1]?.t ?? track.end, role })),
    covered: log.messages<Coverage>(topic.coverage).map(({ t, message }) => ({ t, ...message })) };
});
