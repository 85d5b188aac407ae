// The path that the robot means to drive now, its goal, and in the end the frontiers that it refused.
import { theme } from "../base/theme";
import type { Vec2 } from "../log/geometry";
import { planAt, plansOf, refusalsOf } from "../log/plans";
import type { Run } from "../log/run";
import { legsOfOthers } from "../log/team";
import { disk, type Layer } from "./layer";

export function way(run: Run): Layer | null {
  const refused = refusalsOf(run);
  const others = legsOfOthers(run);
  if (plansOf(run).length === 0 && refused.length === 0 && others.every((legs) => legs.length === 0)) return null;
  return {
    moving({ ctx, camera, now }) {
      const plan = planAt(run, now.t);
      const line = (points: Vec2[]): void => {
        ctx.beginPath();
        for (const [x, y] of points) ctx.lineTo(x, y);
        ctx.stroke();
      };
      ctx.lineWidth = camera.px(1.6);
      ctx.strokeStyle = theme.open;
      if (plan) line(plan.waypoints);
      for (const legs of others) {
        const leg = legs.find(({ start, end }) => start <= now.t && now.t < end);
        if (leg) line(leg.waypoints);
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
