// The place in the plane of a shot where the ball comes closest to what it does not touch at the end.
import { nearestOnPolygon } from "../base/outline";
import { ballOf, type Ball, type Flight } from "../log/flights";
import type { Run } from "../log/run";

export interface Near {
  clearance: number;
  name: string;
  ball: Ball;
  near: { distance: number; x: number; y: number };
  /** The clearance of the shot, which is of space, is the distance to a piece of this plane. */
  here: boolean;
}

export function leastClearance(run: Run, shot: Flight): Near | null {
  const nearest = new Map<string, Omit<Near, "here">>();
  const steps = 400;
  for (let i = 0; i <= steps; ++i) {
    const ball = ballOf(run, shot, ((shot.end - shot.start) * i) / steps);
    for (const { name, polygon } of shot.profile) {
      if (name === shot.contact || polygon.length < 3) continue;
      const near = nearestOnPolygon(ball.s, ball.z, polygon);
      const clearance = near.distance - run.info.ball_radius;
      const least = nearest.get(name)?.clearance ?? Infinity;
      if (clearance < least) nearest.set(name, { clearance, name, ball, near });
    }
  }
  const places = [...nearest.values()];
  if (places.length === 0) return null;
  const told = shot.clearance;
  const off = (place: Omit<Near, "here">): number => Math.abs(place.clearance - told);
  const match = places.reduce((a, b) => (off(b) < off(a) ? b : a));
  const here = off(match) < Math.max(0.005, 0.02 * told);
  return { ...(here ? match : places.reduce((a, b) => (b.clearance < a.clearance ? b : a))), here };
}
