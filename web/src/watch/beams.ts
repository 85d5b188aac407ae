// Rays from a place in the plane to the nearest wall: the beams of a range finder, what a camera has in sight.
import type { Vec2 } from "../base/outline";

export class Walls {
  private edges: Float64Array;  // ax, ay, bx, by, ...

  /** Makes the beams from closed outlines. */
  constructor(outlines: Vec2[][]) {
    this.edges = Float64Array.from(outlines.flatMap((outline) =>
      outline.flatMap((a, i) => [...a, ...outline[(i + 1) % outline.length]!])));
  }

  /** Edges with a part in the square about a place. */
  private near(x: number, y: number, reach: number): Float64Array {
    const found: number[] = [];
    const { edges } = this;
    for (let k = 0; k < edges.length; k += 4) {
      const [ax, ay, bx, by] = [edges[k]! - x, edges[k + 1]! - y, edges[k + 2]! - x, edges[k + 3]! - y];
      if (Math.min(ax, bx) > reach || Math.max(ax, bx) < -reach || Math.min(ay, by) > reach || Math.max(ay, by) < -reach) continue;
      found.push(ax, ay, bx, by);
    }
    return Float64Array.from(found);
  }

  /** How far it is in each direction to the first edge; `range` where none is nearer. O(edges + directions x edges near). */
  cast(x: number, y: number, directions: ArrayLike<number>, range: number): Float64Array {
    const edges = this.near(x, y, range);
    return Float64Array.from(directions, (direction) => {
      const [dx, dy] = [Math.cos(direction), Math.sin(direction)];
      let least = range;
      for (let k = 0; k < edges.length; k += 4) {
        const [ax, ay] = [edges[k]!, edges[k + 1]!];
        const [ex, ey] = [edges[k + 2]! - ax, edges[k + 3]! - ay];
        const slant = dx * ey - dy * ex;
        if (slant === 0) continue;
        const share = (ax * dy - ay * dx) / slant;
        const away = (ax * ey - ay * ex) / slant;
        if (share >= -1e-9 && share <= 1 + 1e-9 && away >= 0 && away < least) least = away;
      }
      return least;
    });
  }

  /** Nothing stands between two places. */
  sees(from: Vec2, to: Vec2): boolean {
    const away = Math.hypot(to[0] - from[0], to[1] - from[1]);
    return this.cast(from[0], from[1], [Math.atan2(to[1] - from[1], to[0] - from[0])], away)[0]! >= away;
  }
}
