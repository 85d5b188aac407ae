// Draws a search without a grid: edges from parents, expanded states and queued states.
import type { Camera } from "../base/camera";
import { theme } from "../base/theme";
import type { Trace } from "./trace";

export function drawPlaces(ctx: CanvasRenderingContext2D, camera: Camera, trace: Trace, step: number): void {
  const shown = Math.min(step, trace.length);
  ctx.beginPath();
  for (let i = 0; i < shown; ++i) {
    const { key, parent } = trace.at(i);
    if (parent === null) continue;
    ctx.moveTo(...trace.place(parent));
    ctx.lineTo(...trace.place(key));
  }
  for (const [colour, pixels] of [[theme.soft, 3], [theme.closed, 1.8]] as const) {
    ctx.strokeStyle = colour;
    ctx.lineWidth = camera.px(pixels);
    ctx.stroke();
  }
  const dots = (colour: string, pixels: number, keys: Iterable<number>): void => {
    for (const [fill, width] of [[theme.soft, pixels + 2], [colour, pixels]] as const) {
      ctx.fillStyle = fill;
      const side = camera.px(width);
      for (const key of keys) {
        const [x, y] = trace.place(key);
        ctx.fillRect(x - side / 2, y - side / 2, side, side);
      }
    }
  };
  const open: number[] = [];
  if (step > 0) for (const one of trace.waiting) if (one.opened <= step) open.push(one.key);
  for (let i = shown; i < trace.length; ++i) if (trace.state(i, step) === "open") open.push(trace.at(i).key);
  dots(theme.open, 5, open);
  dots(theme.closed, 6, Array.from({ length: shown }, (_, i) => trace.at(i).key));
}
