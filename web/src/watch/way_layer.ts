// The path that the robot means to drive now, its goal, and in the end the frontiers that it refused.
import { theme } from "../base/theme";
import { planAt, plansOf, refusalsOf } from "../log/plans";
import type { Run } from "../log/run";
import { disk, type Layer } from "./layer";

export function way(run: Run): Layer | null {
  const refused = refusalsOf(run);
  if (plansOf(run).length === 0 && refused.length === 0) return null;
  return {
    moving({ ctx, camera, now }) {
      const plan = planAt(run, now.t);
      ctx.lineWidth = camera.px(1.6);
      ctx.strokeStyle = theme.open;
      if (plan) {
        ctx.beginPath();
        for (const [x, y] of plan.waypoints) ctx.lineTo(x, y);
        ctx.stroke();
      }
      if (plan?.goal) {
        disk(ctx, plan.goal[0], plan.goal[1], camera.px(6));
        ctx.stroke();
      }
      if (now.t < run.duration - 1e-6) return;
      ctx.strokeStyle = theme.unreachable;
      for (const { at: [x, y] } of refused) {
        const r = camera.px(5);
        ctx.strokeRect(x - r, y - r, 2 * r, 2 * r);
      }
    },
    find(at, { camera }) {
      const under = refused.find((one) => {
        const place = camera.screen(...one.at);
        return Math.hypot(place.x - at.x, place.y - at.y) < 9;
      });
      return under ? { lines: [under.reason] } : null;
    },
  };
}
