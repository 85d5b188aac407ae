// The way of a robot as a line: its corners, and when a disk on it comes over a place.
import { mix } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import type { Track } from "./track";

const straight = 2e-6;  // m; poses may be rounded to half of it

/** The rows of the track where the way bends, and those of times to keep, each at the time when it is reached. */
export class Way {
  readonly time: number[] = [];
  readonly corners: Vec2[] = [];
  private kept: Set<number>;

  constructor(private track: Track, keep: Iterable<number> = []) {
    this.kept = new Set(keep);
    for (let i = 0; i < track.length; ++i) this.add(track.time[i]!, [track.x[i]!, track.y[i]!]);
  }

  private add(t: number, p: Vec2): void {
    const { time, corners } = this;
    const last = corners.at(-1);
    if (last && last[0] === p[0] && last[1] === p[1]) return;  // it stands or turns
    const before = corners.at(-2);
    if (last && before && !this.kept.has(time.at(-1)!) && goesOn(before, last, p)) {
      corners.pop();
      time.pop();
    }
    corners.push(p);
    time.push(t);
  }

  at(t: number): Vec2 {
    const { x, y } = this.track.at(t);
    return [x, y];
  }

  /** How many corners are reached at t. O(log n). */
  reached(t: number): number {
    let [low, high] = [0, this.time.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time[middle]! <= t) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** The line from one time to another, with both ends. */
  between(from: number, to: number): Vec2[] {
    return [this.at(from), ...this.corners.slice(this.reached(from), this.reached(to)), this.at(to)];
  }

  /** When the places of that line are reached. */
  times(from: number, to: number): number[] {
    return [from, ...this.time.slice(this.reached(from), this.reached(to)), to];
  }
}

/** Returns true if b lies on the leg from a to c. */
function goesOn(a: Vec2, b: Vec2, c: Vec2): boolean {
  const [ux, uy, vx, vy] = [b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]];
  return Math.abs(ux * vy - uy * vx) <= straight * Math.hypot(ux, uy) && ux * vx + uy * vy > 0;
}

/** When a disk on the way comes over a place: each time that it comes, stays or passes, and leaves counts once. O(rows). */
export function comesOver({ time, x, y, length }: Track, px: number, py: number, radius: number): number[] {
  const times: number[] = [];
  let over = false;
  for (let i = 0; i < length; ++i) {
    const before = Math.max(0, i - 1);
    const [ax, ay, dx, dy] = [x[before]! - px, y[before]! - py, x[i]! - x[before]!, y[i]! - y[before]!];
    // |a + s d| = radius
    const [square, half, rest] = [dx * dx + dy * dy, ax * dx + ay * dy, ax * ax + ay * ay - radius * radius];
    const root = half * half - square * rest;
    const share = rest <= 0 ? 0 : square > 0 && root >= 0 ? (-half - Math.sqrt(root)) / square : 2;
    const during = share >= 0 && share <= 1;
    if (during && !over) times.push(mix(time[before]!, time[i]!, share));
    over = during && Math.hypot(x[i]! - px, y[i]! - py) <= radius;
  }
  return times;
}
