// The map as it was at a time: what was free and what was occupied then, over the walls as they truly are.
import { Path } from "../base/ink";
import { traceRounded } from "../base/outline";
import { theme } from "../base/theme";
import { mapOf, occupied, type MapNow } from "../log/map";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { bodiesOf, wallsOf } from "../log/world";
import { areaOf } from "./area";
import type { Layer } from "./layer";

const known = new Map<string, number>();

/** A colour of the theme as a pixel. A look at a pixel may wait for the graphics card, so it is taken once. */
function pixelOf(colour: string): number {
  if (!known.has(colour)) {
    const ctx = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d", { willReadFrequently: true })!;
    ctx.fillStyle = colour;
    ctx.fillRect(0, 0, 1, 1);
    known.set(colour, new Uint32Array(ctx.getImageData(0, 0, 1, 1).data.buffer)[0]!);
  }
  return known.get(colour)!;
}

/** Pixels of the values 0 to 127, and from 128 of -128 to -1. */
function palette(): Uint32Array {
  const [free, wall] = [pixelOf(theme.yard), pixelOf(theme["solid-high"])];
  return Uint32Array.from({ length: 256 }, (_, value) => (value > 127 ? 0 : value >= occupied ? wall : free));
}

/** A picture of a map, of one pixel a cell, painted anew where something is known when the map or the colours have changed. */
export class MapPicture {
  readonly canvas = document.createElement("canvas");
  private painted = "";
  private place = "";  // which cells it shows
  private image: ImageData | null = null;

  /** Returns true if it was painted. */
  paint(map: MapNow): boolean {
    const asked = `${map.version} ${theme.yard} ${theme["solid-high"]}`;
    if (asked === this.painted) return false;
    this.painted = asked;
    const { columns, rows, cells, extent: { low, high } } = map;
    const [wide, tall] = [high[0] - low[0] + 1, high[1] - low[1] + 1];
    const { canvas } = this;
    const place = `${low} ${high} ${columns} ${rows}`;
    if (place !== this.place) [this.place, canvas.width, canvas.height] = [place, Math.max(1, columns), Math.max(1, rows)];  // this clears it, too
    if (!(wide > 0 && tall > 0)) return true;
    if (this.image?.width !== wide || this.image.height !== tall) this.image = new ImageData(wide, tall);
    const pixels = new Uint32Array(this.image.data.buffer);
    const colours = palette();
    for (let row = high[1], at = 0; row >= low[1]; --row) {
      let i = row * columns + low[0];
      for (const end = at + wide; at < end; ++i, ++at) pixels[at] = colours[cells[i]! & 255]!;
    }
    canvas.getContext("2d")!.putImageData(this.image, low[0], rows - 1 - high[1]);
    return true;
  }
}

export function map(run: Run): Layer | null {
  if (!run.log.has(topic.map)) return null;
  const picture = new MapPicture();
  const walls = new Path();
  const met = wallsOf(run);  // walls that are the outlines of the solids are logged once
  for (const outline of met ?? []) traceRounded(walls, outline, 0);
  if (!met) for (const { footprint } of bodiesOf(run)) for (const { core, radius_m } of footprint) traceRounded(walls, core, radius_m);
  const [x0, y0, x1, y1] = areaOf(run);
  return {
    still({ ctx, camera }) {
      ctx.fillStyle = theme.grid;
      ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
      ctx.fillStyle = ctx.strokeStyle = theme["solid-low"];
      ctx.lineWidth = camera.px(0.7);
      ctx.fill(walls);
      ctx.stroke(walls);  // no seams between pieces of one wall
    },
    moving({ ctx, now }) {
      const shown = mapOf(run.log).at(now.t);
      if (!shown) return;
      picture.paint(shown);
      ctx.save();
      ctx.imageSmoothingEnabled = false;
      ctx.globalAlpha = 0.85;
      ctx.translate(shown.origin[0], shown.origin[1] + shown.rows * shown.cell_m);
      ctx.scale(shown.cell_m, -shown.cell_m);
      ctx.drawImage(picture.canvas, 0, 0);
      ctx.restore();
    },
  };
}
