// Coordinates along two edges, a bar of round length, and the tones of heights.
import type { Box, Camera } from "../base/camera";
import type { Ink } from "../base/ink";
import { minus, roundStep } from "../base/numbers";
import { theme } from "../base/theme";
import { inMetres, inUnit, lengthText, lengthUnit } from "../base/units";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { highestOf, tone } from "./ground_layer";
import type { Layer } from "./layer";

export function drawScales(ctx: Ink, camera: Camera, [x0, y0, x1, y1]: Box): void {
  camera.toScreen(ctx);
  ctx.font = `10.5px ${theme.sans}`;
  ctx.fillStyle = theme.soft;
  const step = inMetres(roundStep(inUnit(70 / camera.scale)));
  const corner = camera.screen(x0, y0);
  ctx.textAlign = "center";
  ctx.textBaseline = "top";
  for (let x = Math.ceil(x0 / step) * step; x <= x1 + 1e-9; x += step) {
    ctx.fillText(minus(String(+inUnit(x).toFixed(6))), camera.screen(x, y0).x, corner.y + 5);
  }
  ctx.textAlign = "right";
  ctx.textBaseline = "middle";
  for (let y = Math.ceil(y0 / step) * step; y <= y1 + 1e-9; y += step) {
    ctx.fillText(minus(String(+inUnit(y).toFixed(6))), corner.x - 6, camera.screen(x0, y).y);
  }
  const length = inMetres(roundStep(inUnit(50 / camera.scale)));
  const [left, base] = [14, camera.height - 12];
  const right = left + length * camera.scale;
  ctx.globalAlpha = 0.8;
  ctx.fillStyle = theme.panel;
  ctx.fillRect(0, camera.height - 24, camera.width, 24);
  ctx.globalAlpha = 1;
  ctx.strokeStyle = theme.ink;
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(left, base - 4);
  ctx.lineTo(left, base);
  ctx.lineTo(right, base);
  ctx.lineTo(right, base - 4);
  ctx.stroke();
  ctx.fillStyle = theme.soft;
  ctx.textAlign = "left";
  ctx.textBaseline = "alphabetic";
  ctx.fillText(`${+inUnit(length).toPrecision(3)} ${lengthUnit()}`, right + 6, base + 1);
}

export function scales(area: Box, run: Run): Layer {
  const highest = run.log.has(topic.map) ? 0 : highestOf(run);  // true solids are not shown then
  return {
    still({ ctx, camera }) {
      ctx.strokeStyle = theme.soft;
      ctx.lineWidth = camera.px(1);
      ctx.strokeRect(area[0], area[1], area[2] - area[0], area[3] - area[1]);
    },
    moving({ ctx, camera }) {
      drawScales(ctx, camera, area);
      if (highest <= 0) return;
      const text = `${lengthText(highest, 1)} high`;
      const base = camera.height - 12;
      const end = camera.width - 14 - ctx.measureText(text).width;
      for (let i = 0; i < 40; ++i) {
        ctx.fillStyle = tone((highest * i) / 39, highest);
        ctx.fillRect(end - 66 + 1.5 * i, base - 7, 1.6, 8);
      }
      ctx.fillStyle = theme.soft;
      ctx.fillText(text, end, base + 1);
      ctx.textAlign = "right";
      ctx.fillText("0", end - 71, base + 1);
    },
  };
}
