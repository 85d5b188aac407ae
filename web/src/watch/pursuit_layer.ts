// A pursuit: the map of costs, the target and the robots on it.
import { clamp, mix } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import { pursuerColours, theme, isDark } from "../base/theme";
import type { CostGrid } from "../log/messages";
import { pursuitOf } from "../log/pursuit";
import type { Run } from "../log/run";
import { disk, type Layer, type Pen } from "./layer";

const wall = -1;

/** The map of costs as a picture of one pixel a cell, on a scale of logarithms. */
export function costPicture({ width: columns, height: rows, costs: all }: CostGrid): HTMLCanvasElement {
  const costs = Float64Array.from(all);
  const passable = costs.filter((value) => value !== wall);
  const low = Math.log1p(passable.reduce((least, cost) => Math.min(least, cost), Infinity));
  const span = Math.log1p(passable.reduce((most, cost) => Math.max(most, cost), -Infinity)) - low || 1;
  const [cheap, dear, solid] = isDark()
    ? [[24, 36, 46], [178, 132, 74], [92, 108, 120]] as const
    : [[251, 250, 245], [125, 92, 40], [63, 69, 75]] as const;
  const image = new ImageData(columns, rows);
  costs.forEach((cost, i) => {
    const share = clamp((Math.log1p(cost) - low) / span, 0, 1);
    const at = 4 * ((rows - 1 - Math.floor(i / columns)) * columns + (i % columns));
    for (let k = 0; k < 3; ++k) image.data[at + k] = cost === wall ? solid[k]! : mix(cheap[k]!, dear[k]!, share);
    image.data[at + 3] = 255;
  });
  const canvas = document.createElement("canvas");
  canvas.width = columns;
  canvas.height = rows;
  canvas.getContext("2d")!.putImageData(image, 0, 0);
  return canvas;
}

/** Returns the place of someone between two seconds. */
export function placeOnWay(way: Vec2[], t: number): Vec2 {
  const s = clamp(Math.floor(t), 0, way.length - 1);
  const [a, b] = [way[s]!, way[Math.min(s + 1, way.length - 1)]!];
  const share = clamp(t - s, 0, 1);
  return [mix(a[0], b[0], share), mix(a[1], b[1], share)];
}

function drawWay({ ctx, camera, now }: Pen, way: Vec2[], colour: string): void {
  const line = (points: Vec2[], alpha: number): void => {
    ctx.globalAlpha = alpha;
    ctx.beginPath();
    for (const [x, y] of points) ctx.lineTo(x, y);
    ctx.stroke();
    ctx.globalAlpha = 1;
  };
  const at = placeOnWay(way, now.t);
  ctx.strokeStyle = colour;
  ctx.lineJoin = "round";
  ctx.lineWidth = camera.px(2.2);
  line(way, 0.3);
  line([...way.slice(0, Math.floor(now.t) + 1), at], 1);
  disk(ctx, ...at, camera.px(6.5));
  ctx.fillStyle = colour;
  ctx.fill();
  ctx.strokeStyle = theme.yard;
  ctx.lineWidth = camera.px(2);
  ctx.stroke();
}

export function pursuit(run: Run): Layer | null {
  const found = pursuitOf(run);
  if (!found) return null;
  const { grid } = found;
  return {
    still({ ctx }) {
      ctx.imageSmoothingEnabled = false;
      ctx.translate(grid.origin.x, grid.origin.y + grid.height * grid.resolution);
      ctx.scale(grid.resolution, -grid.resolution);
      ctx.drawImage(costPicture(grid), 0, 0);
    },
    moving(pen) {
      if (found.target.length > 0) drawWay(pen, found.target, theme.failed);
      found.robots.forEach((way, i) => drawWay(pen, way, pursuerColours()[i % pursuerColours().length]!));
    },
  };
}
