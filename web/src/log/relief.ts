// Ground that is not flat: heights on a lattice of posts, two triangles between four of them.
import { clamp } from "../base/numbers";
import type { Vec3 } from "./geometry";
import type { Terrain } from "./messages";

interface Place { column: number; row: number; u: number; v: number }

export class Relief {
  private constructor(readonly grid: Terrain) {}

  static of(grid: Terrain | undefined): Relief | null {
    const whole = grid && grid.columns > 1 && grid.rows > 1 && grid.heights.length === grid.columns * grid.rows;
    return whole ? new Relief(grid) : null;
  }

  post(column: number, row: number): Vec3 {
    const { origin, spacing, columns, heights } = this.grid;
    return [origin.x + column * spacing.x, origin.y + row * spacing.y, heights[row * columns + column]!];
  }

  /** The cell at a place and where in it, from 0 to 1; of the nearest edge beyond the lattice. */
  private place(x: number, y: number): Place {
    const { origin, spacing, columns, rows } = this.grid;
    const across = clamp((x - origin.x) / spacing.x, 0, columns - 1);
    const up = clamp((y - origin.y) / spacing.y, 0, rows - 1);
    const [column, row] = [Math.min(Math.floor(across), columns - 2), Math.min(Math.floor(up), rows - 2)];
    return { column, row, u: across - column, v: up - row };
  }

  /** Slopes of the triangle there along x and y, m a cell: the diagonal goes from the lowest x and y to the highest. */
  private rise({ column, row, u, v }: Place): { low: number; x: number; y: number } {
    const [low, right, left, high] = ([[0, 0], [1, 0], [0, 1], [1, 1]] as const).map(([i, j]) => this.post(column + i, row + j)[2]) as [number, number, number, number];
    return u >= v ? { low, x: right - low, y: high - right } : { low, x: high - left, y: left - low };
  }

  height(x: number, y: number): number {
    const place = this.place(x, y);
    const { low, x: along, y: up } = this.rise(place);
    return low + place.u * along + place.v * up;
  }

  /** Upwards, not of length 1. */
  normal(x: number, y: number): Vec3 {
    const { x: along, y: up } = this.rise(this.place(x, y));
    return [-along / this.grid.spacing.x, -up / this.grid.spacing.y, 1];
  }
}
