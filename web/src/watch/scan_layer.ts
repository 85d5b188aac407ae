// The newest observation: the beams of a range finder, or lines to the landmarks that were sighted.
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { hasSenses, sensesOf, type Sensed } from "../log/sensed";
import type { Layer, Pen } from "./layer";

const beamsShown = 4;  // one in so many

function drawBeams({ ctx, camera }: Pen, { from, ends, points }: Sensed): void {
  ctx.beginPath();
  ctx.moveTo(...from);
  for (const end of ends) ctx.lineTo(...end);
  ctx.closePath();
  ctx.fillStyle = ctx.strokeStyle = theme.failed;
  ctx.globalAlpha = 0.07;
  ctx.fill();
  ctx.beginPath();
  ends.forEach((end, i) => {
    if (i % beamsShown > 0) return;
    ctx.moveTo(...from);
    ctx.lineTo(...end);
  });
  ctx.lineWidth = camera.px(0.7);
  ctx.globalAlpha = 0.28;
  ctx.stroke();
  ctx.globalAlpha = 0.9;
  const r = camera.px(1.3);
  for (const [x, y] of points) ctx.fillRect(x - r, y - r, 2 * r, 2 * r);
  ctx.globalAlpha = 1;
}

function drawSightings({ ctx, camera }: Pen, { from, points }: Sensed): void {
  ctx.strokeStyle = ctx.fillStyle = theme.failed;
  ctx.lineWidth = camera.px(1.1);
  ctx.globalAlpha = 0.6;
  ctx.beginPath();
  for (const point of points) {
    ctx.moveTo(...from);
    ctx.lineTo(...point);
  }
  ctx.stroke();
  ctx.globalAlpha = 0.95;
  const r = camera.px(1.8);
  for (const [x, y] of points) ctx.fillRect(x - r, y - r, 2 * r, 2 * r);
  ctx.globalAlpha = 1;
}

export function scan(run: Run): Layer | null {
  if (!hasSenses(run)) return null;
  return {
    moving(pen) {
      const sensed = sensesOf(run).at(pen.now.t);
      if (sensed?.isLaser) drawBeams(pen, sensed);
      else if (sensed) drawSightings(pen, sensed);
    },
  };
}
