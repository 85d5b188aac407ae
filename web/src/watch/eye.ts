// The camera of a robot, which looks straight ahead: its view as a pyramid, and the tags in its picture.
import { finite, mix } from "../base/numbers";
import { roundedPoints, type Vec2 } from "../base/outline";
import type { Run } from "../report/run";
import type { State } from "../report/track";
import type { Eye, Tag, Vec3 } from "../report/types";
import { Walls } from "./beams";
import { Beliefs } from "./ellipse";

type Pose = Pick<State, "x" | "y" | "heading">;

/** Ray through a point of the picture, with x = 1 ahead, y to the left, z up. Pixel (i, j) has its centre at (i + 0.5, j + 0.5). */
export const rayThrough = (eye: Eye, u: number, v: number): Vec3 =>
  [1, -(u - 0.5 - eye.cx) / eye.fx, -(v - 0.5 - eye.cy) / eye.fy];

/** Rays through the corners of the picture: upper left, upper right, lower right, lower left. */
export const cornerRays = (eye: Eye): Vec3[] =>
  [[0, 0], [eye.width_px, 0], [eye.width_px, eye.height_px], [0, eye.height_px]].map(([u = 0, v = 0]) => rayThrough(eye, u, v));

export const lensAt = (eye: Eye, at: Pose): Vec2 =>
  [at.x + eye.ahead_m * Math.cos(at.heading), at.y + eye.ahead_m * Math.sin(at.heading)];

/** Where a point appears in the picture; null behind the lens. */
export function pixelOf(eye: Eye, at: Pose, [x, y, z]: Vec3): Vec2 | null {
  const [cos, sin] = [Math.cos(at.heading), Math.sin(at.heading)];
  const [lx, ly] = lensAt(eye, at);
  const depth = (x - lx) * cos + (y - ly) * sin;
  const left = (y - ly) * cos - (x - lx) * sin;
  if (depth <= 1e-6) return null;
  return [0.5 + eye.cx - (eye.fx * left) / depth, 0.5 + eye.cy - (eye.fy * (z - eye.height_m)) / depth];
}

/** Middle of a tag; tags of old reports are as high as the lens. */
export const middleOf = (tag: Tag, eye?: Eye): Vec3 => [...tag.position, finite(tag.height_m, eye?.height_m ?? 0.2)];

/** What the camera of a run sees, in truth. */
export class Sight {
  /** How far the view is drawn. */
  readonly reach: number;
  private walls: Walls;
  private beliefs: Beliefs;

  private constructor(run: Run, readonly eye: Eye, private tags: Tag[]) {
    const solids = run.report.world.solids.filter((one) => finite(one.low_z_m) <= eye.height_m && finite(one.high_z_m) >= eye.height_m);
    this.walls = new Walls(solids.flatMap((one) => one.footprint.map(({ core, radius_m }) => roundedPoints(core, radius_m))));
    this.beliefs = Beliefs.of(run);
    this.reach = Math.max(1, ...tags.map((tag) => Math.hypot(tag.position[0] - run.track.x[0]!, tag.position[1] - run.track.y[0]!)));
  }

  static of(run: Run): Sight | null {
    const { drive } = run.report;
    return drive?.camera && drive.tags.length > 0 ? new Sight(run, drive.camera, drive.tags) : null;
  }

  /** The ends of rays across the picture at the height of the lens: at walls, or as far as is drawn. */
  edge(at: Pose): Vec2[] {
    const [x, y] = lensAt(this.eye, at);
    const [left, right] = [0, this.eye.width_px].map((u) => Math.atan(rayThrough(this.eye, u, 0)[1])) as [number, number];
    const directions = Float64Array.from({ length: 121 }, (_, i) => at.heading + mix(left, right, i / 120));
    const ranges = this.walls.cast(x, y, directions, this.reach);
    return Array.from(directions, (direction, i) => [x + ranges[i]! * Math.cos(direction), y + ranges[i]! * Math.sin(direction)]);
  }

  /** Tags whose middle is in the picture, that turn their face to the lens and have nothing before them. */
  tagsInView(at: Pose): Tag[] {
    const { eye } = this;
    const lens = lensAt(eye, at);
    return this.tags.filter((tag) => {
      const pixel = pixelOf(eye, at, middleOf(tag, eye));
      if (!pixel || pixel[0] < 0 || pixel[0] > eye.width_px || pixel[1] < 0 || pixel[1] > eye.height_px) return false;
      const [cos, sin] = [Math.cos(tag.facing_rad), Math.sin(tag.facing_rad)];
      const before: Vec2 = [tag.position[0] + 0.01 * cos, tag.position[1] + 0.01 * sin];
      return (lens[0] - tag.position[0]) * cos + (lens[1] - tag.position[1]) * sin > 0 && this.walls.sees(lens, before);
    });
  }

  /** Those in view while the robot took its pose from tags. */
  tagsSeen(t: number, at: Pose): Tag[] {
    const belief = this.beliefs.all[this.beliefs.index(t)];
    return belief?.corrected ? this.tagsInView(at) : [];
  }
}
