// The range finder while a robot explores: its beams from where it truly is to the walls that truly are. They are
// cast here, so they have no noise; the report keeps the walls that it meets, not each scan.
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import type { State } from "../report/track";
import { allAround, Walls } from "./beams";
import type { Layer } from "./layer";

/** Beams enough to be seen as such. */
const mostBeams = 360;

export interface Scan { x: number; y: number; directions: Float64Array; ranges: Float64Array; range: number }

/** The scan of an instant; null where the report tells of no range finder, and when there is nothing to explore any more. */
export class Scanner {
  private walls: Walls;

  constructor(private run: Run) {
    const { explore } = run.report;
    this.walls = new Walls(explore?.laser ? explore.walls : []);
  }

  at(t: number, { x, y, heading }: State = this.run.track.at(t)): Scan | null {
    const laser = this.run.report.explore?.laser;
    if (!laser || t > this.run.believedUntil) return null;
    const [ahead, left, turned] = laser.mount;
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    const from = { x: x + ahead * cos - left * sin, y: y + ahead * sin + left * cos };
    const directions = allAround(heading + turned, Math.min(mostBeams, laser.beams));
    return { ...from, directions, range: laser.range_m, ranges: this.walls.cast(from.x, from.y, directions, laser.range_m) };
  }
}

/** Ends of the beams. */
export const endsOf = ({ x, y, directions, ranges }: Scan): [number, number][] =>
  Array.from(directions, (direction, i) => [x + ranges[i]! * Math.cos(direction), y + ranges[i]! * Math.sin(direction)]);

export function laser(run: Run): Layer | null {
  if (!run.report.explore?.laser) return null;
  const scanner = new Scanner(run);
  return {
    moving({ ctx, camera, now }) {
      const scan = scanner.at(now.t);
      if (!scan) return;
      const ends = endsOf(scan);
      ctx.beginPath();
      for (const end of ends) ctx.lineTo(...end);
      ctx.closePath();
      ctx.fillStyle = ctx.strokeStyle = theme.failed;
      ctx.globalAlpha = 0.07;
      ctx.fill();
      ctx.beginPath();
      ends.forEach((end, i) => {
        if (i % 4 > 0) return;
        ctx.moveTo(scan.x, scan.y);
        ctx.lineTo(...end);
      });
      ctx.lineWidth = camera.px(0.7);
      ctx.globalAlpha = 0.28;
      ctx.stroke();
      ctx.globalAlpha = 0.9;
      const r = camera.px(1.3);
      ends.forEach(([x, y], i) => { if (scan.ranges[i]! < scan.range) ctx.fillRect(x - r, y - r, 2 * r, 2 * r); });
      ctx.globalAlpha = 1;
    },
  };
}
