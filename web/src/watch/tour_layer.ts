// The tour as it is planned: its way, its stops in their order, and whom each serves.
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { tourOf } from "../log/tours";
import { disk, label, type Layer } from "./layer";

const near_px = 11;

export function tour(run: Run): Layer | null {
  const planned = tourOf(run);
  if (!planned || planned.stops.length === 0) return null;
  const { stops, way } = planned;
  return {
    moving({ ctx, camera }) {
      ctx.lineWidth = camera.px(2);
      ctx.lineJoin = "round";
      ctx.strokeStyle = theme.open;
      ctx.beginPath();
      for (const [x, y] of way) ctx.lineTo(x, y);
      ctx.stroke();
      ctx.fillStyle = theme.yard;
      for (const { at: [x, y] } of stops) {
        disk(ctx, x, y, camera.px(8));
        ctx.fill();
        ctx.stroke();
      }
      camera.toScreen(ctx);
      ctx.textAlign = "center";
      ctx.textBaseline = "middle";
      ctx.font = `650 11px ${theme.sans}`;
      stops.forEach(({ at }, i) => {
        const { x, y } = camera.screen(...at);
        label(ctx, String(i + 1), x, y + 0.5, theme.ink, theme.yard);
      });
    },
    find(at, { camera }) {
      const index = stops.findIndex((stop) => {
        const { x, y } = camera.screen(...stop.at);
        return Math.hypot(x - at.x, y - at.y) < near_px;
      });
      return index < 0 ? null : { told: { topic: topic.tours, name: "the planned tour", at: (t) => run.log.latest(topic.tours, t) },
        lines: [`stop ${index + 1} serves ${stops[index]!.targets.join(", ")}`] };
    },
  };
}
