// From where targets can be hit: the more of them, the stronger the tint.
import { theme } from "../base/theme";
import type { OccupancyGrid } from "../log/messages";
import { once } from "../log/once";
import type { Run } from "../log/run";
import { firingMapOf } from "../log/tours";
import type { Layer } from "./layer";

/** A pixel a cell, black, as opaque as its share of the targets. */
const shares = once(({ info: { width, height }, data }: OccupancyGrid): { sheet: HTMLCanvasElement } => {
  const sheet = Object.assign(document.createElement("canvas"), { width: Math.max(1, width), height: Math.max(1, height) });
  const image = new ImageData(sheet.width, sheet.height);
  let most = 1;
  for (const value of data) most = Math.max(most, value);
  for (let row = 0, i = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column, ++i) image.data[4 * ((height - 1 - row) * width + column) + 3] = (255 * Math.max(0, data[i]!)) / most;
  }
  sheet.getContext("2d")!.putImageData(image, 0, 0);
  return { sheet };
});

/** A pixel a cell in a colour of the theme, the upper row first. */
export function firingPicture(grid: OccupancyGrid, colour: string): HTMLCanvasElement {
  const { sheet } = shares(grid);
  const made = Object.assign(document.createElement("canvas"), { width: sheet.width, height: sheet.height });
  const ctx = made.getContext("2d")!;
  ctx.drawImage(sheet, 0, 0);
  ctx.globalCompositeOperation = "source-in";
  ctx.fillStyle = colour;
  ctx.fillRect(0, 0, made.width, made.height);
  return made;
}

export function firingMap(run: Run): Layer | null {
  const grid = firingMapOf(run)?.message;
  if (!grid) return null;
  const { info, data } = grid;
  const [x0, y0] = [info.origin.position.x, info.origin.position.y];
  let [picture, colour] = [null as HTMLCanvasElement | null, ""];
  return {
    still({ ctx }) {
      if (colour !== theme.water) [picture, colour] = [firingPicture(grid, theme.water), theme.water];
      ctx.save();
      ctx.globalAlpha = 0.4;
      ctx.imageSmoothingEnabled = false;
      ctx.translate(x0, y0 + info.height * info.resolution);
      ctx.scale(info.resolution, -info.resolution);
      ctx.drawImage(picture!, 0, 0);
      ctx.restore();
    },
    find(at, { camera }) {
      const { x, y } = camera.plane(at);
      const [column, row] = [Math.floor((x - x0) / info.resolution), Math.floor((y - y0) / info.resolution)];
      const share = column < 0 || row < 0 || column >= info.width || row >= info.height ? -1 : data[row * info.width + column]!;
      return share > 0 ? { lines: [`${share} % of the targets can be hit from here`] } : null;
    },
  };
}
