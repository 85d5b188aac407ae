// Mapping, in space: landmarks as posts, loops, and where odometry and a reference went.
import { CircleGeometry, CylinderGeometry, Group, type Line, Mesh, Points, PointsMaterial } from "three";
import { theme } from "../base/theme";
import type { Vec2, Vec3 } from "../log/geometry";
import { landmarksAt, loopsAt, odometryOf, referenceOf, robotWays, truePlaces, type TimedWay } from "../log/mapping";
import type { Run } from "../log/run";
import { hasSenses, laserMount, sensesOf } from "../log/sensed";
import { topic } from "../log/topics";
import { deviations, ellipseOf } from "./ellipse";
import { reachedOn } from "./mapping_layer";
import { geometryOf, glass, lambert, lineOf, linesOf, moveTo, type Actor } from "./space_parts";
import { radiusOf } from "./space_robot";

const above = 0.03;
const mostBeams = 512;

function post(run: Run): Group {
  const group = new Group();
  const radius = 0.35 * radiusOf(run);
  const column = new Mesh(new CylinderGeometry(radius, radius, 8 * radius, 16), lambert(theme.reached));
  column.rotation.x = Math.PI / 2;
  column.position.z = 4 * radius;
  const disk = new Mesh(new CircleGeometry(1, 40), glass(theme.reached, 0.3));
  disk.position.z = above;
  return group.add(column, disk);
}

/** A cross on the ground where a landmark truly is. */
function crossAt(run: Run, place: Vec2 | undefined): Line[] {
  if (!place) return [];
  const [x, y] = place;
  const r = 0.8 * radiusOf(run);
  return [[r, r], [r, -r]].map(([dx, dy]) => lineOf([[x - dx!, y - dy!, 2 * above], [x + dx!, y + dy!, 2 * above]], theme.ink));
}

/** A post for each landmark that the newest map has; each stands where it is known to be at the time. */
function landmarkActor(run: Run): Actor[] {
  const posts = new Map(landmarksAt(run, Infinity).map((one) => [one.id, { post: post(run), marks: crossAt(run, truePlaces(run).get(one.id)) }]));
  if (posts.size === 0) return [];
  return [{ things: [...posts.values()].flatMap((one) => [one.post, ...one.marks]), act: ({ t }) => {
    const known = new Map(landmarksAt(run, t).map((one) => [one.id, one]));
    for (const [id, { post: group, marks }] of posts) {
      const one = known.get(id);
      for (const thing of [group, ...marks]) thing.visible = one !== undefined;
      if (!one) continue;
      group.position.set(one.position.x, one.position.y, 0);
      const { major, minor, angle } = ellipseOf(one);
      const disk = group.children[1]!;
      disk.scale.set(Math.max(0.01, deviations * major), Math.max(0.01, deviations * minor), 1);
      disk.rotation.z = angle;
    }
  } }];
}

function wayActor(way: TimedWay, colour: string, opacity: number): Actor[] {
  if (way.places.length < 2) return [];
  const line = lineOf(way.places.map(([x, y]): Vec3 => [x, y, above]), colour, opacity);
  line.frustumCulled = false;
  return [{ things: [line], act: ({ t }) => line.geometry.setDrawRange(0, reachedOn(way, t) + 1) }];
}

function loopActor(run: Run): Actor[] {
  const most = loopsAt(run, Infinity).length;
  if (most === 0) return [];
  const lines = linesOf(Array.from({ length: 2 * most }, (): Vec3 => [0, 0, 0]), theme.open, 0.8);
  lines.frustumCulled = false;
  return [{ things: [lines], act: ({ t }) => {
    const loops = loopsAt(run, t).slice(0, most);
    moveTo(lines.geometry, loops.flatMap(({ from, to }): Vec3[] => [[from.x, from.y, 2 * above], [to.x, to.y, 2 * above]]));
    lines.geometry.setDrawRange(0, 2 * loops.length);
  } }];
}

/** Returns the newest observation: a point where something was met, and some of the lines to it. */
export function sensedActor(run: Run): Actor[] {
  if (!hasSenses(run)) return [];
  const height = laserMount(run).height || (run.log.has(topic.scan) ? 0.3 : 2 * radiusOf(run));
  const nowhere = Array.from({ length: mostBeams }, (): Vec3 => [0, 0, 0]);
  const hits = new Points(geometryOf(nowhere), new PointsMaterial({ color: theme.failed, size: 3, sizeAttenuation: false }));
  const beams = linesOf([...nowhere, ...nowhere], theme.failed, run.log.has(topic.scan) ? 0.3 : 0.7);
  hits.frustumCulled = beams.frustumCulled = false;
  return [{ things: [hits, beams], act: ({ t }) => {
    const sensed = sensesOf(run).at(t);
    hits.visible = beams.visible = sensed !== null;
    if (!sensed) return;
    const points = sensed.points.slice(0, mostBeams).map(([x, y]): Vec3 => [x, y, height]);
    const drawn = sensed.isLaser ? sensed.ends.filter((_, i) => i % 3 === 0).map(([x, y]): Vec3 => [x, y, height]) : points;
    moveTo(hits.geometry, points);
    hits.geometry.setDrawRange(0, points.length);
    moveTo(beams.geometry, drawn.flatMap((end): Vec3[] => [[...sensed.from, height], end]));
    beams.geometry.setDrawRange(0, 2 * drawn.length);
  } }];
}

export function mappingActor(run: Run): Actor[] {
  if (run.hasTruth || !run.log.has(topic.belief)) return [];
  const others = robotWays(run).flatMap((way) => wayActor(way, theme.unreachable, 1));
  return [...landmarkActor(run), ...wayActor(odometryOf(run), theme.soft, 0.6), ...wayActor(referenceOf(run), theme.reached, 0.9), ...loopActor(run), ...others];
}
