// A bar that covers, such as a mower deck or a boom: a rectangle across the heading of the robot, ahead of it or behind.
import { mix } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import type { State, Track } from "./track";

export interface Bar {
  width: number;
  /** Along the heading. */
  length: number;
  /** Distance of its middle ahead of the robot. */
  forward: number;
}

const smallTurn = 0.1;  // rad; between such headings the bar covers nearly the hull of both

function cornersAt({ width, length, forward }: Bar, { x, y, heading }: Pick<State, "x" | "y" | "heading">): Vec2[] {
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([along, across]): Vec2 => {
    const [u, v] = [forward + (along! * length) / 2, (across! * width) / 2];
    return [x + u * c - v * s, y + u * s + v * c];
  });
}

/** Twice the area of the triangle; positive where it turns left. */
const turn = (a: Vec2, b: Vec2, [x, y]: Vec2): number => (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);

/** The convex hull, counter-clockwise (Andrew 1979). */
export function hullOf(points: Vec2[]): Vec2[] {
  const half = (sorted: Vec2[]): Vec2[] => {
    const chain: Vec2[] = [];
    for (const p of sorted) {
      while (chain.length > 1 && turn(chain.at(-2)!, chain.at(-1)!, p) <= 0) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  return [...half(sorted), ...half(sorted.reverse())];
}

/** Returns what the bar comes over from one time to another, between two rows of the track: convex, counter-clockwise outlines. */
export function sweptBetween(bar: Bar, track: Track, from: number, to: number): Vec2[][] {
  const steps = Math.max(1, Math.ceil(Math.abs(track.at(to).heading - track.at(from).heading) / smallTurn));
  const at = (k: number): Vec2[] => cornersAt(bar, track.at(mix(from, to, k / steps)));
  return Array.from({ length: steps }, (_, k) => hullOf([...at(k), ...at(k + 1)]));
}

const contains = (ring: Vec2[], p: Vec2): boolean => ring.every((a, i) => turn(a, ring[(i + 1) % ring.length]!, p) >= 0);

/** When the bar comes over a place, at the row of the track before: each time that it comes, stays or passes, and leaves counts once. O(rows). */
export function barComesOver(bar: Bar, track: Track, x: number, y: number): number[] {
  const times: number[] = [];
  const reach = Math.hypot(Math.abs(bar.forward) + bar.length / 2, bar.width / 2);
  /** The robot is too far on one side in both rows. Its way between them is straight, or stands. */
  const isFar = (row: Float64Array, i: number, at: number): boolean =>
    Math.min(row[i]!, row[i + 1]!) - reach > at || Math.max(row[i]!, row[i + 1]!) + reach < at;
  let over = false;
  for (let i = 0; i + 1 < track.length; ++i) {
    const now = !isFar(track.x, i, x) && !isFar(track.y, i, y) && sweptBetween(bar, track, track.time[i]!, track.time[i + 1]!).some((ring) => contains(ring, [x, y]));
    if (now && !over) times.push(track.time[i]!);
    over = now;
  }
  return times;
}
