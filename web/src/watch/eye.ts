// The camera of a robot, which looks straight ahead: its view as a pyramid, and the tags in its picture.
import { finite, mix } from "../base/numbers";
import { roundedPoints, type Vec2 } from "../base/outline";
import { beliefsOf, type Beliefs } from "../log/beliefs";
import type { Vec3 } from "../log/geometry";
import type { CameraInfo, Tag, Tags } from "../log/messages";
import type { Run } from "../log/run";
import { mountOf } from "../log/sensed";
import { topic } from "../log/topics";
import type { State } from "../log/track";
import { bodiesOf } from "../log/world";
import { Walls } from "./beams";

/** A camera: its picture in pixels, its lens ahead of the robot's middle and above the floor. */
export interface Eye { width: number; height: number; fx: number; fy: number; cx: number; cy: number; ahead: number; above: number }

type Pose = Pick<State, "x" | "y" | "heading">;

/** Ray through a point of the picture, with x = 1 ahead, y to the left, z up. Pixel (i, j) has its centre at (i + 0.5, j + 0.5). */
export const rayThrough = (eye: Eye, u: number, v: number): Vec3 =>
  [1, -(u - 0.5 - eye.cx) / eye.fx, -(v - 0.5 - eye.cy) / eye.fy];

/** Rays through the corners of the picture: upper left, upper right, lower right, lower left. */
export const cornerRays = (eye: Eye): Vec3[] =>
  [[0, 0], [eye.width, 0], [eye.width, eye.height], [0, eye.height]].map(([u = 0, v = 0]) => rayThrough(eye, u, v));

export const lensAt = (eye: Eye, at: Pose): Vec2 =>
  [at.x + eye.ahead * Math.cos(at.heading), at.y + eye.ahead * Math.sin(at.heading)];

/** Returns the pixel of a point in the picture; null behind the lens. */
export function pixelOf(eye: Eye, at: Pose, [x, y, z]: Vec3): Vec2 | null {
  const [cos, sin] = [Math.cos(at.heading), Math.sin(at.heading)];
  const [lx, ly] = lensAt(eye, at);
  const depth = (x - lx) * cos + (y - ly) * sin;
  const left = (y - ly) * cos - (x - lx) * sin;
  if (depth <= 1e-6) return null;
  return [0.5 + eye.cx - (eye.fx * left) / depth, 0.5 + eye.cy - (eye.fy * (z - eye.above)) / depth];
}

/** Middle of a tag; where its height is not known, as high as the lens. */
export const middleOf = (tag: Tag, eye?: Eye): Vec3 => [tag.position.x, tag.position.y, finite(tag.position.z, eye?.above ?? 0.2)];

export const tagsOf = ({ log }: Run): Tag[] => log.latest<Tags>(topic.tags)?.tags ?? [];

export function eyeOf(run: Run): Eye | null {
  const camera = run.log.latest<CameraInfo>(topic.camera);
  if (!camera) return null;
  const { width, height, k } = camera;
  const mount = mountOf(run, "camera");
  return { width, height, fx: k[0]!, fy: k[4]!, cx: k[2]!, cy: k[5]!, ahead: mount.pose[0], above: mount.height };
}

/** The true view of the camera of a run. */
export class Sight {
  /** How far the view is drawn. */
  readonly reach: number;
  private walls: Walls;
  private beliefs: Beliefs;

  private constructor(run: Run, readonly eye: Eye, private tags: Tag[]) {
    const solids = bodiesOf(run).filter(({ low, high }) => low <= eye.above && high >= eye.above);
    this.walls = new Walls(solids.flatMap((one) => one.footprint.map(({ core, radius_m }) => roundedPoints(core, radius_m))));
    this.beliefs = beliefsOf(run);
    this.reach = Math.max(1, ...tags.map((tag) => Math.hypot(tag.position.x - run.track.x[0]!, tag.position.y - run.track.y[0]!)));
  }

  static of(run: Run): Sight | null {
    const eye = eyeOf(run);
    const tags = tagsOf(run);
    return eye && tags.length > 0 ? new Sight(run, eye, tags) : null;
  }

  /** The ends of rays across the picture at the height of the lens: at walls, or as far as is drawn. */
  edge(at: Pose): Vec2[] {
    const [x, y] = lensAt(this.eye, at);
    const [left, right] = [0, this.eye.width].map((u) => Math.atan(rayThrough(this.eye, u, 0)[1])) as [number, number];
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
      if (!pixel || pixel[0] < 0 || pixel[0] > eye.width || pixel[1] < 0 || pixel[1] > eye.height) return false;
      const [cos, sin] = [Math.cos(tag.facing), Math.sin(tag.facing)];
      const { x, y } = tag.position;
      const before: Vec2 = [x + 0.01 * cos, y + 0.01 * sin];
      return (lens[0] - x) * cos + (lens[1] - y) * sin > 0 && this.walls.sees(lens, before);
    });
  }

  /** Returns the tags in view while the robot took its pose from tags. */
  tagsSeen(t: number, at: Pose): Tag[] {
    const belief = this.beliefs.all[this.beliefs.index(t)];
    return belief?.corrected ? this.tagsInView(at) : [];
  }
}
