// The picture of a card: the ground of its scenario from above, the start and the targets.
import type { SceneAnswer } from "../api";
import { Path } from "../base/ink";
import type { Vec2 } from "../base/outline";
import { theme } from "../base/theme";
import { boxAround, cellsOf, groundOf, PolygonGround, type GridGround } from "../plan/ground";

type Place = (at: Vec2) => Vec2;
const margin = 14;

function outline(points: readonly Vec2[], place: Place): Path {
  const path = new Path();
  points.forEach((point, i) => (i ? path.lineTo(...place(point)) : path.moveTo(...place(point))));
  path.closePath();
  return path;
}

function drawPolygons(ctx: CanvasRenderingContext2D, { polygons, box: [x0, y0, x1, y1] }: PolygonGround, others: readonly Vec2[][], place: Place): void {
  const boundary: Vec2[] = polygons.boundary.length > 2 ? polygons.boundary : [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
  const edges = [boundary, ...others].map((points) => outline(points, place));
  ctx.fillStyle = theme.yard;
  for (const edge of edges) ctx.fill(edge);
  ctx.fillStyle = ctx.strokeStyle = theme["solid-high"];
  ctx.lineWidth = 1.2;  // of a wall that has no thickness
  for (const obstacle of polygons.obstacles) {
    const shape = outline(obstacle, place);
    ctx.fill(shape);
    ctx.stroke(shape);
  }
  ctx.strokeStyle = theme.soft;
  ctx.lineWidth = 1;
  for (const edge of edges) ctx.stroke(edge);
}

/** One pixel a cell, scaled down smoothly. */
function drawGrid(ctx: CanvasRenderingContext2D, { grid, box: [x0, y0, x1, y1] }: GridGround, place: Place): void {
  const { width, height } = grid;
  const cells = cellsOf(grid);
  const picture = Object.assign(document.createElement("canvas"), { width, height });
  const pen = picture.getContext("2d")!;
  const colours = [theme.yard, theme["solid-high"], theme.line];
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width;) {
      const value = cells[y * width + x]!;
      let end = x + 1;
      while (end < width && cells[y * width + end] === value) ++end;
      pen.fillStyle = colours[value] ?? theme["solid-high"];
      pen.fillRect(x, height - 1 - y, end - x, 1);
      x = end;
    }
  }
  const [left, top] = place([x0, y1]);
  const [right, bottom] = place([x1, y0]);
  ctx.drawImage(picture, left, top, right - left, bottom - top);
}

function dot(ctx: CanvasRenderingContext2D, [x, y]: Vec2, radius: number, colour: string): void {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  ctx.fillStyle = colour;
  ctx.fill();
  ctx.strokeStyle = theme.yard;
  ctx.lineWidth = 1.5;
  ctx.stroke();
}

/** Draws a scene as large as it fits into a canvas; returns false where the page cannot draw it. */
export function drawScene(canvas: HTMLCanvasElement, scene: SceneAnswer): boolean {
  if (!scene.map) return false;
  const ground = groundOf({ ...scene.map, id: "", radius_m: 0, warnings: [] });
  if (typeof ground === "string") return false;
  const dpr = Math.min(2, window.devicePixelRatio || 1);
  const [width, height] = [canvas.clientWidth || 320, canvas.clientHeight || 180];
  canvas.width = Math.round(width * dpr);
  canvas.height = Math.round(height * dpr);
  const ctx = canvas.getContext("2d")!;
  ctx.setTransform(dpr, 0, 0, dpr, 0, 0);
  const others = scene.map.others ?? [];
  const [x0, y0, x1, y1] = boxAround(others.flat(), ground.box);
  const scale = Math.min((width - 2 * margin) / Math.max(1e-6, x1 - x0), (height - 2 * margin) / Math.max(1e-6, y1 - y0));
  const place: Place = ([x, y]) => [width / 2 + scale * (x - (x0 + x1) / 2), height / 2 - scale * (y - (y0 + y1) / 2)];
  if (ground.kind === "polygons") drawPolygons(ctx, ground, others, place);
  else drawGrid(ctx, ground, place);
  for (const target of scene.targets) dot(ctx, place(target), 3, theme.water);
  if (scene.start) dot(ctx, place(scene.start), 5, theme.robot);
  return true;
}
