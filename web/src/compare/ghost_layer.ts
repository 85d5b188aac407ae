// Other runs over the plan of one: where their robots drove until now, each with dashes of its own, and where they are.
import { lastNotAfter } from "../log/track";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { traceRobot, traceWay, type Layer } from "../watch/layer";

/** Dashes of the second run, the third and so on; compare.css has the same. */
const dashes = [[7, 4], [2, 3], [10, 3, 2, 3]];
const colours = ["belief", "open", "reached"] as const;

export function ghostsOf(runs: Run[]): Layer {
  const ghosts = runs.map(ghostOf);
  return { moving: (pen) => ghosts.forEach((one) => one.moving!(pen)) };
}

function ghostOf(run: Run, index: number): Layer {
  const { track } = run;
  return {
    moving(pen) {
      const { ctx, camera, now } = pen;
      if (track.length === 0) return;
      const t = Math.min(now.t, run.duration);
      const at = track.at(t);
      ctx.strokeStyle = theme[colours[index % colours.length]!];
      ctx.lineWidth = camera.px(2.2);
      ctx.setLineDash(dashes[index % dashes.length]!.map((length) => camera.px(length)));
      ctx.beginPath();
      traceWay(pen, track.x, track.y, lastNotAfter(track.time, t) + 1);
      ctx.lineTo(at.x, at.y);
      ctx.stroke();
      ctx.setLineDash([]);
      const r = traceRobot(pen, run, at.x, at.y, at.heading);
      ctx.fillStyle = theme.yard;
      ctx.fill();
      ctx.stroke();
      ctx.beginPath();
      ctx.moveTo(at.x, at.y);
      ctx.lineTo(at.x + r * Math.cos(at.heading), at.y + r * Math.sin(at.heading));
      ctx.stroke();
    },
  };
}
