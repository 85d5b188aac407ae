// Shapes: convex cores inflated by a radius, and distances to polygons.
import { clamp } from "./numbers";

export type Vec2 = [number, number];
export interface Rounded { core: Vec2[]; radius_m: number }

/** Adds the outline of a convex core inflated by a radius to the path, counter-clockwise. */
export function traceRounded(path: Path2D, core: Vec2[], radius: number): void {
  const count = core.length;
  const [first] = core;
  if (!first) return;
  if (count === 1) {
    path.moveTo(first[0] + radius, first[1]);
    path.arc(first[0], first[1], Math.max(0, radius), 0, 2 * Math.PI);
    path.closePath();
    return;
  }
  const outward = (a: Vec2, b: Vec2): number => Math.atan2(a[0] - b[0], b[1] - a[1]);
  core.forEach((corner, i) => {
    const from = outward(core[(i + count - 1) % count]!, corner);
    const to = outward(corner, core[(i + 1) % count]!);
    const start: Vec2 = [corner[0] + radius * Math.cos(from), corner[1] + radius * Math.sin(from)];
    if (i === 0) path.moveTo(...start);
    else path.lineTo(...start);
    if (radius > 0) path.arc(corner[0], corner[1], radius, from, to);
  });
  path.closePath();
}

/** Returns the same outline as points, for 3D shapes. */
export function roundedPoints(core: Vec2[], radius: number, steps = 8): Vec2[] {
  if (radius <= 0) return core;
  const count = core.length;
  const round = (centre: Vec2, from: number, to: number): Vec2[] => {
    const n = Math.max(1, Math.ceil(Math.abs(to - from) / (2 * Math.PI) * 4 * steps));
    return Array.from({ length: n + 1 }, (_, i) => {
      const angle = from + (to - from) * i / n;
      return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
    });
  };
  if (count === 1) return round(core[0]!, 0, 2 * Math.PI * (1 - 1 / (4 * steps)));
  return core.flatMap((corner, i) => {
    const a = core[(i + count - 1) % count]!;
    const b = core[(i + 1) % count]!;
    const from = Math.atan2(a[0] - corner[0], corner[1] - a[1]);
    let to = Math.atan2(corner[0] - b[0], b[1] - corner[1]);
    while (to < from) to += 2 * Math.PI;
    return round(corner, from, to);
  });
}

/** Returns the distance from a point to a simple polygon, 0 inside, and the nearest point. */
export function nearestOnPolygon(x: number, y: number, polygon: Vec2[]): { distance: number; x: number; y: number } {
  let best = { distance: Infinity, x, y };
  let inside = false;
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length]!;
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const square = dx * dx + dy * dy;
    const share = square > 0 ? clamp(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0, 1) : 0;
    const [px, py] = [a[0] + share * dx, a[1] + share * dy];
    const distance = Math.hypot(x - px, y - py);
    if (distance < best.distance) best = { distance, x: px, y: py };
    if (a[1] > y !== b[1] > y && x < a[0] + (dx * (y - a[1])) / dy) inside = !inside;
  });
  return inside ? { distance: 0, x, y } : best;
}
