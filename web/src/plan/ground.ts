// The ground for planning: a grid of cells or polygons, with the changes made by hand.
import type { Edit, Grid, MapAnswer, Polygons } from "../api";
import type { Box } from "../base/camera";
import { nearestOnPolygon, type Vec2 } from "../base/outline";
import { endsIn, eroded, type OpenCells } from "./ends";
import type { Restore } from "./history";
import { maze, mazeEnds } from "./maze";

export const free = 0;
export const occupied = 1;

/** Decodes cells from runs of value and count, row by row from the lowest. */
export function cellsOf({ width, height, runs }: Pick<Grid, "width" | "height" | "runs">): Uint8Array {
  const cells = new Uint8Array(width * height);
  let at = 0;
  for (let i = 0; i + 1 < runs.length; i += 2) {
    cells.fill(runs[i]!, at, at + runs[i + 1]!);
    at += runs[i + 1]!;
  }
  return cells;
}

export class GridGround {
  readonly kind = "grid";
  readonly cells: Uint8Array;
  private before: Uint8Array;
  /** Counts changes, so that pictures can tell when they are stale. */
  version = 0;

  constructor(readonly grid: Grid) {
    this.cells = cellsOf(grid);
    this.before = this.cells.slice();
  }

  get box(): Box {
    const { origin: [x, y], width, height, resolution_m: r } = this.grid;
    return [x, y, x + width * r, y + height * r];
  }

  cellAt([x, y]: Vec2): [number, number] {
    const { origin, resolution_m: r } = this.grid;
    return [Math.floor((x - origin[0]) / r), Math.floor((y - origin[1]) / r)];
  }

  centre(x: number, y: number): Vec2 {
    const { origin, resolution_m: r } = this.grid;
    return [origin[0] + (x + 0.5) * r, origin[1] + (y + 0.5) * r];
  }

  /** Sets the cells within `reach` cells of the straight line between two cells. */
  paint(from: [number, number], to: [number, number], value: number, reach: number): void {
    const { width, height } = this.grid;
    const steps = Math.max(1, Math.abs(to[0] - from[0]), Math.abs(to[1] - from[1]));
    for (let i = 0; i <= steps; ++i) {
      const x = Math.round(from[0] + (to[0] - from[0]) * i / steps);
      const y = Math.round(from[1] + (to[1] - from[1]) * i / steps);
      for (let v = Math.max(0, y - reach); v <= Math.min(height - 1, y + reach); ++v) {
        const low = Math.max(0, x - reach);
        const high = Math.min(width, x + reach + 1);
        if (low < high) this.cells.fill(value, v * width + low, v * width + high);
      }
    }
    this.version += 1;
  }

  /** Draws a maze in whose ways a disk fits; returns the places in two of its corners. */
  drawMaze(radius_m: number, seed: number): [Vec2, Vec2] {
    const { width, height, resolution_m: r } = this.grid;
    const wide = radius_m > 0 ? Math.ceil((2 * radius_m) / r) + 2 : 1;
    this.cells.set(maze(width, height, wide, seed));
    this.version += 1;
    const [first, last] = mazeEnds(width, height, wide);
    return [this.centre(...first), this.centre(...last)];
  }

  /** Erases all walls; returns places in two corners. */
  clear(radius_m: number): [Vec2, Vec2] {
    this.cells.fill(free);
    this.version += 1;
    return this.ends(radius_m);
  }

  /** Returns the changes as runs along rows. */
  edits(): Edit[] {
    const { width, height } = this.grid;
    const edits: Edit[] = [];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const at = y * width + x;
        const value = this.cells[at]!;
        if (value === this.before[at]) continue;
        let end = x + 1;
        while (end < width && this.cells[y * width + end] === value && this.before[y * width + end] !== value) ++end;
        edits.push(value === free ? { free: [x, y, end - x, 1] } : { block: [x, y, end - x, 1] });
        x = end - 1;
      }
    }
    return edits;
  }

  /** Returns what takes the cells back to what they are now. */
  snapshot(): Restore {
    const edits = this.edits();
    return () => {
      this.cells.set(this.before);
      for (const edit of edits) {
        const [[x, y, across], value] = "free" in edit ? [edit.free, free] : "block" in edit ? [edit.block, occupied] : [[0, 0, 0], free];
        const at = y! * this.grid.width + x!;
        this.cells.fill(value, at, at + across!);
      }
      this.version += 1;
    };
  }

  /** Returns places near two opposite corners between which a disk can drive, anywhere in their cells; a point where it fits nowhere. */
  ends(radius_m: number): [Vec2, Vec2] {
    const { width, height, resolution_m: r } = this.grid;
    const open = { width, height, open: Uint8Array.from(this.cells, (value) => Number(value === free)) };
    const ends = endsIn(eroded(open, radius_m > 0 ? radius_m / r + Math.SQRT2 : 0)) ?? endsIn(open) ?? [[0, 0], [0, 0]];
    return [this.centre(...ends[0]), this.centre(...ends[1])];
  }
}

/** Returns the box of the points and of another box. */
export function boxAround(points: readonly Vec2[], box: Box = [Infinity, Infinity, -Infinity, -Infinity]): Box {
  return points.reduce<Box>(([x0, y0, x1, y1], [x, y]) => [Math.min(x0, x), Math.min(y0, y), Math.max(x1, x), Math.max(y1, y)], box);
}

export class PolygonGround {
  readonly kind = "polygons";
  /** The obstacles by index: those of the map, then the added ones; null for removed ones. */
  readonly obstacles: (Vec2[] | null)[];
  private count: number;
  private moved = new Set<number>();
  version = 0;

  constructor(readonly polygons: Polygons) {
    this.obstacles = polygons.obstacles.map((polygon) => polygon.map(([x, y]): Vec2 => [x, y]));
    this.count = this.obstacles.length;
  }

  get box(): Box {
    const points = [...this.polygons.boundary, ...this.obstacles.flatMap((one) => one ?? [])];
    return boxAround(points);
  }

  /** Returns the index of the obstacle at a place; -1 if there is none. */
  at([x, y]: Vec2): number {
    return this.obstacles.findLastIndex((one) => one !== null && nearestOnPolygon(x, y, one).distance <= 0);
  }

  shift(index: number, [dx, dy]: Vec2): void {
    const polygon = this.obstacles[index];
    if (!polygon) return;
    this.obstacles[index] = polygon.map(([x, y]) => [x + dx, y + dy]);
    this.moved.add(index);
    this.version += 1;
  }

  remove(index: number): void {
    if (!this.obstacles[index]) return;
    this.obstacles[index] = null;
    this.version += 1;
  }

  /** Adds a square centred at a place; returns its index. */
  add([x, y]: Vec2, half: number): number {
    this.obstacles.push([[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]]);
    this.version += 1;
    return this.obstacles.length - 1;
  }

  /** Returns what takes the obstacles back to what they are now. */
  snapshot(): Restore {
    const [obstacles, moved] = [[...this.obstacles], new Set(this.moved)];
    return () => {
      this.obstacles.splice(0, this.obstacles.length, ...obstacles);
      this.moved = moved;
      this.version += 1;
    };
  }

  edits(): Edit[] {
    const edits: Edit[] = [];
    this.obstacles.forEach((polygon, i) => {
      if (i >= this.count) edits.push({ add: polygon ?? [] });
      else if (polygon && this.moved.has(i)) edits.push({ set: i, polygon });
    });
    // Removes last, because an added obstacle must first exist under its index.
    this.obstacles.forEach((polygon, i) => { if (!polygon) edits.push({ remove: i }); });
    return edits;
  }

  /** Returns the ends of the first query, or else as a grid has them, of cells so small that the disk keeps clear between two. */
  ends(radius_m: number): [Vec2, Vec2] {
    const query = this.polygons.queries[0];
    if (query) return [query.start, query.goal];
    const [x0, y0, x1, y1] = this.box;
    const cell_m = Math.max(x1 - x0, y1 - y0) / 160;
    const [width, height] = [Math.ceil((x1 - x0) / cell_m), Math.ceil((y1 - y0) / cell_m)];
    const place = (x: number, y: number): Vec2 => [x0 + (x + 0.5) * cell_m, y0 + (y + 0.5) * cell_m];
    const cells = (clear_m: number): OpenCells => ({ width, height, open: Uint8Array.from({ length: width * height }, (_, at) =>
      Number(this.isClear(place(at % width, Math.floor(at / width)), clear_m))) });
    const ends = endsIn(cells(radius_m + cell_m)) ?? endsIn(cells(0)) ?? [[0, 0], [0, 0]];
    return [place(...ends[0]), place(...ends[1])];
  }

  /** Returns true if a disk at a place is within the boundary, if there is one, and beside all obstacles. */
  private isClear([x, y]: Vec2, radius_m: number): boolean {
    const { boundary } = this.polygons;
    if (this.obstacles.some((one) => one !== null && nearestOnPolygon(x, y, one).distance <= radius_m)) return false;
    if (boundary.length < 3) return true;
    return nearestOnPolygon(x, y, boundary).distance === 0
      && boundary.every((a, i) => nearestOnPolygon(x, y, [a, boundary[(i + 1) % boundary.length]!]).distance > radius_m);
  }
}

export type Ground = GridGround | PolygonGround;

/** Returns the map as ground, or a sentence that says why the page cannot draw it. */
export function groundOf(map: MapAnswer): Ground | string {
  if (map.grid?.yaw_rad) return `${map.name}: this map is turned by ${map.grid.yaw_rad} rad, and the page draws only maps whose yaw is 0`;
  if (map.grid) return new GridGround(map.grid);
  if (map.polygons) return new PolygonGround(map.polygons);
  return `${map.name}: this map has neither cells nor polygons`;
}
