// Another run over the plan of one: where its robot drove until now, dashed, and where it is.
import { lastNotAfter } from "../log/track";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { disk, traceWay, type Layer } from "../watch/layer";

export function ghostOf(run: Run): Layer {
  const { track, radius } = run;
  return {
    moving(pen) {
      const { ctx, camera, now } = pen;
      if (track.length === 0) return;
      const t = Math.min(now.t, run.duration);
      const at = track.at(t);
      ctx.strokeStyle = theme.belief;
      ctx.lineWidth = camera.px(2.2);
      ctx.setLineDash([camera.px(7), camera.px(4)]);
      ctx.beginPath();
      traceWay(pen, track.x, track.y, lastNotAfter(track.time, t) + 1);
      ctx.lineTo(at.x, at.y);
      ctx.stroke();
      ctx.setLineDash([]);
      const r = Math.max(Number.isFinite(radius) ? radius : 0, camera.px(6));
      disk(ctx, at.x, at.y, r);
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
