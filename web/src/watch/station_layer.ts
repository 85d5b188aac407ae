// Places that fill the tank or the battery.
import { theme } from "../base/theme";
import type { Supplies } from "../log/messages";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { label, type Layer } from "./layer";

export function stations(run: Run): Layer | null {
  const supplies = run.log.latest<Supplies>(topic.supplies);
  if (!supplies) return null;
  return {
    moving({ ctx, camera }) {
      camera.toScreen(ctx);
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      ctx.font = `450 11.5px ${theme.sans}`;
      for (const { name, position, gives_water, gives_charge } of supplies.stations) {
        const { x, y } = camera.screen(position.x, position.y);
        ctx.fillStyle = gives_water ? theme.water : theme.robot;
        ctx.fillRect(x - 6, y - 6, 12, 12);
        if (gives_water && gives_charge) {
          ctx.fillStyle = theme.robot;
          ctx.fillRect(x, y - 6, 6, 12);
        }
        ctx.strokeStyle = theme.ink;
        ctx.lineWidth = 1.2;
        ctx.strokeRect(x - 6, y - 6, 12, 12);
        label(ctx, name, x + 10, y, theme.ink, theme.yard);
      }
    },
  };
}
