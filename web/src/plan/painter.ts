// Pictures of one pixel a cell: the ground, and a search upon it.
import { theme } from "../base/theme";
import type { GridGround } from "./ground";
import { free, occupied } from "./ground";
import type { Trace } from "./trace";

type Rgb = [number, number, number];

/** A colour of the theme as numbers, through a canvas: it may be written in any way. */
export function rgb(colour: string): Rgb {
  const ctx = document.createElement("canvas").getContext("2d", { willReadFrequently: true })!;
  ctx.fillStyle = colour;
  ctx.fillRect(0, 0, 1, 1);
  const [r = 0, g = 0, b = 0] = ctx.getImageData(0, 0, 1, 1).data;
  return [r, g, b];
}

/** Row 0 of the map is the lowest, that of a picture the highest. */
const pixel = (x: number, y: number, width: number, height: number): number => 4 * ((height - 1 - y) * width + x);

export class Picture {
  readonly canvas = document.createElement("canvas");
  private key = "";

  /** Paints anew when the key has changed. */
  paint(width: number, height: number, key: string, fill: (image: ImageData) => void): void {
    const whole = `${key} ${theme.ground}`;
    if (whole === this.key) return;
    this.key = whole;
    this.canvas.width = width;
    this.canvas.height = height;
    const image = new ImageData(width, height);
    fill(image);
    this.canvas.getContext("2d")!.putImageData(image, 0, 0);
  }
}

export function paintCells(picture: Picture, ground: GridGround): void {
  const { width, height } = ground.grid;
  picture.paint(width, height, String(ground.version), (image) => {
    const colours = { free: rgb(theme.yard), solid: rgb(theme["solid-high"]), unknown: rgb(theme["solid-low"]) };
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const value = ground.cells[y * width + x]!;
        const colour = value === free ? colours.free : value === occupied ? colours.solid : colours.unknown;
        image.data.set([...colour, 255], pixel(x, y, width, height));
      }
    }
  });
}

/** Cells that the robot's centre must not be in, but which are free. */
export function paintBlocked(picture: Picture, blocked: Uint8Array, ground: GridGround, key: string): void {
  const { width, height } = ground.grid;
  picture.paint(width, height, `${key} ${ground.version}`, (image) => {
    const colour = rgb(theme.failed);
    for (let i = 0; i < blocked.length; ++i) {
      if (blocked[i] === 0 || ground.cells[i] !== free) continue;
      image.data.set([...colour, 46], pixel(i % width, Math.floor(i / width), width, height));
    }
  });
}

/** Closed vertices and the queue, the newest expansion strongest. */
export function paintTrace(picture: Picture, trace: Trace, step: number, key: string): void {
  picture.paint(trace.width, trace.height, `${key} ${step}`, (image) => {
    const [closed, open] = [rgb(theme.closed), rgb(theme.open)];
    for (let i = trace.length - 1; i >= 0; --i) {
      const state = trace.state(i, step);
      if (state === "unseen") continue;
      const { x, y } = trace.at(i);
      if (x < 0 || y < 0 || x >= trace.width || y >= trace.height) continue;
      const newest = state === "closed" && step - i <= 1 && step < trace.length;
      const colour = state === "open" || newest ? open : closed;
      image.data.set([...colour, newest ? 255 : state === "open" ? 150 : 190], pixel(x, y, trace.width, trace.height));
    }
  });
}
