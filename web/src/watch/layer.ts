// The plan view is made of layers, one for each kind of message that can be drawn.
import type { Camera, Point } from "../base/camera";
import type { Ink } from "../base/ink";
import type { Flight } from "../log/flights";
import type { Run } from "../log/run";
import type { TargetStory } from "../log/targets";

export interface Now {
  t: number;
  shot: Flight | null;
  target: TargetStory | null;
  /** Speed of playing; 0 while paused. */
  speed: number;
}

/** The message that tells of a thing: the name of the thing, and its fields at a time. */
export interface Told { topic: string; name: string; at: (t: number) => unknown }

export interface Found { target?: TargetStory; shot?: Flight; told?: Told; lines: string[] }

export interface Pen {
  ctx: Ink;
  camera: Camera;
  now: Now;
}

export interface Layer {
  /** Draws what does not move: drawn again only when the view moved. The context draws in metres. */
  still?(pen: Pen): void;
  moving?(pen: Pen): void;
  /** Returns what is under the pointer. */
  find?(at: Point, pen: Pen): Found | null;
}

/** Makes the layer, or nothing where the log has no such message. */
export type LayerOf = (run: Run) => Layer | null;

export function disk(ctx: Ink, x: number, y: number, radius: number): void {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
}

/** Begins the path of the robot's outline there, or of a disk of its size where that is too small to see. Returns the radius, m. */
export function traceRobot({ ctx, camera }: Pen, run: Run, x: number, y: number, heading: number): number {
  const r = Math.max(run.radius, camera.px(7));
  if (run.outline.length === 0 || run.radius < r) {
    disk(ctx, x, y, r);
    return r;
  }
  const [ahead, left] = [Math.cos(heading), Math.sin(heading)];
  ctx.beginPath();
  for (const [a, l] of run.outline) ctx.lineTo(x + ahead * a - left * l, y + left * a + ahead * l);
  ctx.closePath();
  return r;
}

/** A line through the first places, without those that stand too close to the one before to be told from it. */
export function traceWay({ ctx, camera }: Pen, x: ArrayLike<number>, y: ArrayLike<number>, count: number): void {
  const least = camera.px(1.5);
  let [lx, ly] = [Infinity, Infinity];
  for (let i = 0; i < count; ++i) {
    if (Math.abs(x[i]! - lx) < least && Math.abs(y[i]! - ly) < least) continue;
    [lx, ly] = [x[i]!, y[i]!];
    ctx.lineTo(lx, ly);
  }
}

/** A name with a rim, so that it can be read over anything. In pixels. */
export function label(ctx: Ink, text: string, x: number, y: number, ink: string, rim: string): void {
  ctx.lineJoin = "round";
  ctx.strokeStyle = rim;
  ctx.lineWidth = 3.5;
  ctx.globalAlpha = 0.85;
  ctx.strokeText(text, x, y);
  ctx.globalAlpha = 1;
  ctx.fillStyle = ink;
  ctx.fillText(text, x, y);
}
