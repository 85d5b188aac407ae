// The world from above: solids in tones of their height, where the robot's centre cannot be, slopes.
import { type Ink, Path } from "../base/ink";
import { clamp, fixed } from "../base/numbers";
import { nearestOnPolygon, traceRounded, type Vec2 } from "../base/outline";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import type { Solids } from "../log/messages";
import { topic } from "../log/topics";
import { bodiesOf, slopesOf, type Body } from "../log/world";
import type { Layer, Pen } from "./layer";

interface Shape extends Body { path: Path; top: number }

export function highestOf(run: Run): number {
  return bodiesOf(run).reduce((most, { footprint, high }) => (footprint.length > 0 && Number.isFinite(high) ? Math.max(most, high) : most), 0);
}

export function tone(top: number, highest: number): string {
  const share = Math.sqrt(clamp(top / Math.max(1e-3, highest), 0, 1));
  return `color-mix(in srgb, ${theme["solid-high"]} ${(100 * share).toFixed(1)}%, ${theme["solid-low"]})`;
}

/** Returns the places where the robot's centre cannot be: solids in its way grown by its radius, and a rim inside the bounds. */
function inflationOf(run: Run, shapes: Shape[]): Path {
  const { bounds, radius: r } = run;
  const path = new Path();
  for (const solid of shapes.filter((one) => one.blocks_driving)) {
    for (const piece of solid.footprint) traceRounded(path, piece.core, piece.radius_m + r);
  }
  if (!bounds) return path;
  const [[x0, y0], [x1, y1]] = bounds;
  const rim = (points: Vec2[]): void => {
    points.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
    path.closePath();
  };
  rim([[x0 - 1, y0 - 1], [x1 + 1, y0 - 1], [x1 + 1, y1 + 1], [x0 - 1, y1 + 1]]);
  rim([[x0 + r, y0 + r], [x0 + r, y1 - r], [x1 - r, y1 - r], [x1 - r, y0 + r]]);
  return path;
}

function hatch(ctx: CanvasRenderingContext2D, dpr: number): CanvasPattern {
  const tile = document.createElement("canvas");
  const size = Math.max(4, Math.round(5 * dpr));
  tile.width = tile.height = size;
  const line = tile.getContext("2d")!;
  line.strokeStyle = theme.inflated;
  line.lineWidth = 0.8 * dpr;
  line.beginPath();
  for (const shift of [-size, 0, size]) {
    line.moveTo(shift - 1, size + 1);
    line.lineTo(shift + size + 1, -1);
  }
  line.stroke();
  return ctx.createPattern(tile, "repeat")!;
}

function sheet({ canvas }: Ink): CanvasRenderingContext2D {
  const { width, height } = canvas;
  return Object.assign(document.createElement("canvas"), { width, height }).getContext("2d")!;
}

function put(ctx: Ink, picture: HTMLCanvasElement): void {
  ctx.save();
  ctx.setTransform(1, 0, 0, 1, 0, 0);
  ctx.drawImage(picture, 0, 0);
  ctx.restore();
}

/** The union of overlapping outlines: hatched, with one contour around it. */
function unionOf({ ctx, camera }: Pen, union: Path): HTMLCanvasElement {
  const [whole, pen] = [sheet(ctx), sheet(ctx)];
  const layer = pen.canvas;
  camera.toPlane(pen);
  pen.fill(union);
  pen.globalCompositeOperation = "source-in";
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.fillStyle = hatch(pen, camera.dpr);
  pen.fillRect(0, 0, layer.width, layer.height);
  put(whole, layer);
  pen.globalCompositeOperation = "source-over";
  pen.clearRect(0, 0, layer.width, layer.height);
  camera.toPlane(pen);
  pen.strokeStyle = theme.inflated;
  pen.lineWidth = camera.px(2.2);
  pen.stroke(union);
  pen.globalCompositeOperation = "destination-out";
  pen.fillStyle = "#000";
  pen.fill(union);
  put(whole, layer);
  return whole.canvas;
}

export const drawUnion = (pen: Pen, union: Path): void => put(pen.ctx, unionOf(pen, union));

function drawSolid({ ctx, camera }: Pen, solid: Shape, highest: number): void {
  ctx.fillStyle = tone(solid.top, highest);
  if (solid.blocks_driving) {
    ctx.fill(solid.path);
    return;
  }
  ctx.globalAlpha = 0.28;
  ctx.fill(solid.path);
  ctx.globalAlpha = 1;
  if (solid.footprint.length !== 1) return;
  ctx.strokeStyle = theme.soft;
  ctx.lineWidth = camera.px(1);
  ctx.setLineDash([camera.px(4), camera.px(3)]);
  ctx.stroke(solid.path);
  ctx.setLineDash([]);
}

/** Ground too steep to drive on, and lines of equal height, the higher the stronger. */
function drawTerrain({ ctx, camera }: Pen, run: Run): void {
  const slopes = slopesOf(run);
  if (!slopes) return;
  const steep = new Path();
  for (const piece of slopes.steep) traceRounded(steep, piece.core, piece.radius_m);
  ctx.fillStyle = theme.failed;
  ctx.globalAlpha = 0.12;
  ctx.fill(steep);
  const heights = slopes.contours.map((line) => line.height);
  const low = Math.min(...heights);
  const span = Math.max(...heights) - low || 1;
  ctx.strokeStyle = theme.soft;
  ctx.lineWidth = camera.px(1);
  for (const { height, points } of slopes.contours) {
    ctx.globalAlpha = 0.35 + (0.5 * (height - low)) / span;
    ctx.beginPath();
    for (const [x, y] of points) ctx.lineTo(x, y);
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
}

const made = new WeakMap<Body[], { layer: Layer; bounds: string }>();

/** Made once for a world, however often its run grows. */
export function ground(run: Run): Layer {
  const [bodies, bounds] = [bodiesOf(run), String(run.bounds)];
  let held = made.get(bodies);
  if (held?.bounds !== bounds) made.set(bodies, held = { layer: groundOf(run), bounds });
  return held.layer;
}

function groundOf(run: Run): Layer {
  const { bounds } = run;
  const shapes: Shape[] = bodiesOf(run).filter((solid) => solid.footprint.length > 0).map((solid) => {
    const path = new Path();
    for (const piece of solid.footprint) traceRounded(path, piece.core, piece.radius_m);
    return { ...solid, path, top: Number.isFinite(solid.high) ? solid.high : Infinity };
  }).sort((a, b) => a.top - b.top);
  const highest = highestOf(run);
  const inflated = run.log.has(topic.costGrid) ? null : inflationOf(run, shapes);
  let hatched: HTMLCanvasElement | null = null;
  let view = "";

  /** Painted once for a view: a run that grows shows the same ground again and again. */
  function drawInflated(pen: Pen, union: Path): void {
    const { ctx, camera } = pen;
    const asked = [camera.x, camera.y, camera.scale, ctx.canvas.width, ctx.canvas.height, theme.inflated].join();
    if (asked !== view) hatched = unionOf(pen, union);
    view = asked;
    put(ctx, hatched!);
  }

  return {
    still(pen) {
      const { ctx } = pen;
      drawTerrain(pen, run);
      if (inflated && shapes.length > 0) {
        ctx.save();
        ctx.beginPath();
        if (bounds) ctx.rect(bounds[0][0], bounds[0][1], bounds[1][0] - bounds[0][0], bounds[1][1] - bounds[0][1]);
        else ctx.rect(-1e6, -1e6, 2e6, 2e6);
        ctx.clip();
        drawInflated(pen, inflated);
        ctx.restore();
      }
      for (const solid of shapes) drawSolid(pen, solid, highest);
    },
    find(at, { camera }) {
      const { x, y } = camera.plane(at);
      const under = shapes.filter((solid) => solid.footprint.some(({ core, radius_m }) =>
        nearestOnPolygon(x, y, core).distance <= radius_m + 1e-9)).reverse().slice(0, 3);
      if (under.length === 0) return null;
      const [{ name }] = under as [Shape];
      return { told: { topic: topic.solids, name, at: () => run.log.latest<Solids>(topic.solids)?.solids.find((one) => one.name === name) }, lines: under.map((solid) => `${solid.name}: ${fixed(solid.low, 2)} to ${fixed(solid.high, 2)} m${solid.blocks_driving ? "" : ", does not block driving"}`) };
    },
  };
}
