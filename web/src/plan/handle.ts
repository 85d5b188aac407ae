// A handle for turning an item: an arm from its middle in the direction of its heading, with a knob.
import type { Camera } from "../base/camera";
import type { Vec2 } from "../base/outline";
import { theme } from "../base/theme";
import { disk } from "../watch/layer";

const arm_px = 34;
const knob_px = 7;
const reach_px = 15;

/** Returns the position of the knob; the arm begins `beyond` m from the middle. */
export function knob(camera: Camera, [x, y]: Vec2, heading: number, beyond = 0): Vec2 {
  const arm = beyond + camera.px(arm_px);
  return [x + arm * Math.cos(heading), y + arm * Math.sin(heading)];
}

export function onKnob(camera: Camera, at: Vec2, middle: Vec2, heading: number, beyond = 0): boolean {
  const [x, y] = knob(camera, middle, heading, beyond);
  return Math.hypot(at[0] - x, at[1] - y) <= camera.px(reach_px);
}

export function drawHandle(ctx: CanvasRenderingContext2D, camera: Camera, middle: Vec2, heading: number, colour: string, idle = false, beyond = 0): void {
  const [from, to] = [middle, knob(camera, middle, heading, beyond)].map(([x, y]) => camera.screen(x!, y!)) as [{ x: number; y: number }, { x: number; y: number }];
  ctx.save();
  camera.toScreen(ctx);
  ctx.globalAlpha = idle ? 0.5 : 1;
  for (const [width, stroke] of [[5, theme.yard], [2.5, colour]] as const) {
    ctx.beginPath();
    ctx.moveTo(from.x, from.y);
    ctx.lineTo(to.x, to.y);
    ctx.strokeStyle = stroke;
    ctx.lineWidth = width;
    ctx.stroke();
  }
  disk(ctx, to.x, to.y, knob_px);
  ctx.fillStyle = idle ? theme.panel : colour;
  ctx.fill();
  ctx.strokeStyle = idle ? colour : theme.yard;
  ctx.lineWidth = 2;
  ctx.stroke();
  ctx.restore();
  camera.toPlane(ctx);
}
