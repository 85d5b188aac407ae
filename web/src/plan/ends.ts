// The ends of the first question about a map: two places far apart, between which a disk of some radius can drive.
import type { Vec2 } from "../base/outline";

/** Cells where the middle of a disk may be (1) or not (0), row by row from the lowest. */
export interface OpenCells { width: number; height: number; open: Uint8Array }

/** Leaves open what is farther than `reach` cells from all that is not, and from the border. O(cells * reach). */
export function eroded({ width, height, open }: OpenCells, reach: number): OpenCells {
  const far = Math.ceil(reach) + 1;
  const up = new Int32Array(open.length);  // cells to the next one in the column that is not open, counted up to `far`
  for (let x = 0; x < width; ++x) {
    for (let y = 0, gap = 0; y < height; ++y) up[y * width + x] = gap = open[y * width + x] ? Math.min(far, gap + 1) : 0;
    for (let y = height - 1, gap = 0; y >= 0; --y) {
      gap = open[y * width + x] ? Math.min(far, gap + 1) : 0;
      up[y * width + x] = Math.min(up[y * width + x]!, gap);
    }
  }
  const left = Uint8Array.from(up, (gap, at) => {
    const x = at % width;
    for (let dx = -far + 1; dx < far; ++dx) {
      const there = x + dx < 0 || x + dx >= width ? 0 : up[at + dx]!;
      if (there * there + dx * dx <= reach * reach) return 0;
    }
    return gap > 0 ? 1 : 0;
  });
  return { width, height, open: left };
}

/** Returns the largest set of open cells that are joined by their sides. O(cells). */
export function largestPart({ width, height, open }: OpenCells): number[] {
  const seen = new Uint8Array(open.length);
  let largest: number[] = [];
  for (let first = 0; first < open.length; ++first) {
    if (!open[first] || seen[first]) continue;
    seen[first] = 1;
    const part = [first];
    for (let i = 0; i < part.length; ++i) {
      const at = part[i]!;
      const x = at % width;
      for (const next of [x > 0 ? at - 1 : -1, x + 1 < width ? at + 1 : -1, at - width, at + width < width * height ? at + width : -1]) {
        if (next < 0 || !open[next] || seen[next]) continue;
        seen[next] = 1;
        part.push(next);
      }
    }
    if (part.length > largest.length) largest = part;
  }
  return largest;
}

/** Returns two joined cells near two opposite corners of the map, as columns and rows; null if no cell is open. */
export function endsIn(cells: OpenCells): [Vec2, Vec2] | null {
  const { width, height } = cells;
  const part = largestPart(cells);
  if (part.length === 0) return null;
  const nearest = (right: number, up: number): Vec2 => {
    const distance = (at: number): number => ((at % width) + 0.5 - right * width) ** 2 + (Math.floor(at / width) + 0.5 - up * height) ** 2;
    const best = part.reduce((a, b) => (distance(b) < distance(a) ? b : a));
    return [best % width, Math.floor(best / width)];
  };
  return [nearest(0.06, 0.08), nearest(0.94, 0.92)];
}
