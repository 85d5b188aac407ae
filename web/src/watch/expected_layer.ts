// The scenario of a run before its log tells more: the start of the robot, and the targets, while all is planned.
import type { SceneAnswer } from "../api";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { disk, type Layer } from "./layer";

/** Returns the layer, or nothing once the log has both. */
export function expected(run: Run, { start, targets }: SceneAnswer): Layer | null {
  const unseen = run.log.has(topic.targets) || run.log.has(topic.costGrid) ? [] : targets;
  const from = run.track.length > 0 || run.log.has(topic.costGrid) ? null : start;
  if (unseen.length === 0 && !from) return null;
  return {
    moving(pen) {
      const { ctx, camera } = pen;
      ctx.setLineDash([camera.px(3), camera.px(3)]);
      ctx.lineWidth = camera.px(1.6);
      ctx.strokeStyle = theme.waiting;
      ctx.fillStyle = theme.yard;
      for (const [x, y] of unseen) {
        disk(ctx, x, y, camera.px(5));
        ctx.fill();
        ctx.stroke();
      }
      ctx.setLineDash([]);
      if (!from) return;
      disk(ctx, from[0], from[1], Math.max(run.radius, camera.px(7)));
      ctx.lineWidth = camera.px(2);
      ctx.strokeStyle = theme.robot;
      ctx.fill();
      ctx.stroke();
    },
  };
}
