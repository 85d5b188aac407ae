// Pictures with one pixel per cell: the ground, and a search on it.
import { theme } from "../base/theme";
import type { GridGround } from "./ground";
import { free, occupied } from "./ground";
import type { Trace } from "./trace";

const known = new Map<string, Uint8ClampedArray>();

/** Returns any CSS colour as red, green, blue and alpha, by drawing it on a canvas. */
function bytesOf(colour: string): Uint8ClampedArray {
  let bytes = known.get(colour);
  if (!bytes) {
    const ctx = document.createElement("canvas").getContext("2d", { willReadFrequently: true })!;
    ctx.fillStyle = colour;
    ctx.fillRect(0, 0, 1, 1);
    bytes = ctx.getImageData(0, 0, 1, 1).data;
    known.set(colour, bytes);
  }
  return bytes;
}

/** Returns the colour as one number, in the memory layout of image pixels. */
function pixelOf(colour: string, alpha = 255): number {
  const [r = 0, g = 0, b = 0] = bytesOf(colour);
  return new Uint32Array(new Uint8ClampedArray([r, g, b, alpha]).buffer)[0]!;
}

/** How opaque cells of a search are, of 255. */
export const tint = { closed: 190, open: 150 } as const;

/** Returns the pixel index of a cell: row 0 is the lowest of the map but the highest of a picture. */
const place = (x: number, y: number, width: number, height: number): number => (height - 1 - y) * width + x;

export class Picture {
  readonly canvas = document.createElement("canvas");
  private key = "";
  private image: ImageData | null = null;

  /** Repaints from an empty picture if the key has changed. */
  paint(width: number, height: number, key: string, fill: (pixels: Uint32Array) => void): void {
    const whole = `${key} ${theme.ground}`;
    if (whole === this.key) return;
    this.key = whole;
    if (this.image?.width !== width || this.image.height !== height) {
      [this.canvas.width, this.canvas.height] = [width, height];
      this.image = new ImageData(width, height);
    }
    const pixels = new Uint32Array(this.image.data.buffer);
    pixels.fill(0);
    fill(pixels);
    this.canvas.getContext("2d")!.putImageData(this.image, 0, 0);
  }
}

export function paintCells(picture: Picture, ground: GridGround): void {
  const { width, height } = ground.grid;
  picture.paint(width, height, String(ground.version), (pixels) => {
    const [open, solid, unknown] = [pixelOf(theme.yard), pixelOf(theme["solid-high"]), pixelOf(theme["solid-low"])];
    for (let y = 0, i = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x, ++i) {
        const value = ground.cells[i]!;
        pixels[place(x, y, width, height)] = value === free ? open : value === occupied ? solid : unknown;
      }
    }
  });
}

/** Paints free cells that the robot's centre must not enter. */
export function paintBlocked(picture: Picture, blocked: Uint8Array, ground: GridGround, key: string): void {
  const { width, height } = ground.grid;
  picture.paint(width, height, `${key} ${ground.version}`, (pixels) => {
    const rim = pixelOf(theme.failed, 46);
    for (let i = 0; i < blocked.length; ++i) {
      if (blocked[i] !== 0 && ground.cells[i] === free) pixels[place(i % width, Math.floor(i / width), width, height)] = rim;
    }
  });
}

/** Paints the closed vertices of a grid and the queue; the newest expansion is the most intense. */
export function paintTrace(picture: Picture, trace: Trace, step: number, key: string): void {
  const grid = trace.grid!;
  const { width, height } = grid;
  picture.paint(width, height, `${key} ${step}`, (pixels) => {
    const [closed, open, newest] = [pixelOf(theme.closed, tint.closed), pixelOf(theme.open, tint.open), pixelOf(theme.open)];
    const set = (vertex: number, pixel: number): void => {
      const [x, y] = grid.cell(vertex);
      if (x >= 0 && y >= 0 && x < width && y < height) pixels[place(x, y, width, height)] = pixel;
    };
    for (const one of step > 0 ? trace.waiting : []) if (one.opened <= step) set(one.key, open);
    for (let i = trace.length - 1; i >= 0; --i) {
      const state = trace.state(i, step);
      if (state === "unseen") continue;
      set(trace.at(i).key, state === "open" ? open : step - i <= 1 && step < trace.length ? newest : closed);
    }
  });
}
