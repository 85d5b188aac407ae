// Points and poses of messages as the tuples that the views draw.
import type { Rounded, Vec2 } from "../base/outline";
import type { Outline, Path, Point2, Point3, Pose3, Quaternion, RoundedPolygon } from "./messages";

export type { Vec2 };
export type Vec3 = [number, number, number];
/** x, y, heading. */
export type Pose = [number, number, number];
/** Closed outlines: counter-clockwise, and clockwise for holes. */
export type Outlines = Vec2[][];

export const vec2 = ({ x, y }: Point2): Vec2 => [x, y];
export const vec3 = ({ x, y, z }: Point3): Vec3 => [x, y, z];
export const headingOf = ({ x, y, z, w }: Quaternion): number => Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
export const poseOf = ({ position: { x, y }, orientation }: Pose3): Pose => [x, y, headingOf(orientation)];
export const placesOf = (path: Path | undefined): Vec2[] => (path?.poses ?? []).map(({ pose }) => vec2(pose.position));
export const rings = (outlines: Outline[]): Outlines => outlines.map(({ points }) => points.map(vec2));
export const shapes = (polygons: RoundedPolygon[]): Rounded[] => polygons.map(({ points, radius }) => ({ core: points.map(vec2), radius_m: radius }));

/** A place in a frame that stands at a pose. */
export function placedAt([x, y, heading]: Pose, [ahead, left]: Vec2): Vec2 {
  const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
  return [x + ahead * cos - left * sin, y + ahead * sin + left * cos];
}
