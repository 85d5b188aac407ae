// Mapping from a log, in space: landmarks as posts, what was sensed, loops, and where odometry and a reference went.
import { CircleGeometry, CylinderGeometry, Group, type Line, Mesh, Points, PointsMaterial } from "three";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import { lastNotAfter } from "../report/track";
import type { Landmark, Vec2, Vec3 } from "../report/types";
import { deviations, ellipseOf } from "./ellipse";
import { Scans } from "./slam_layer";
import { geometryOf, glass, lambert, lineOf, linesOf, moveTo, type Actor } from "./space_parts";
import { radiusOf } from "./space_robot";

const above = 0.03;

function post(run: Run, one: Landmark): Group {
  const group = new Group();
  const radius = 0.35 * radiusOf(run);
  const column = new Mesh(new CylinderGeometry(radius, radius, 8 * radius, 16), lambert(theme.reached));
  column.rotation.x = Math.PI / 2;
  column.position.z = 4 * radius;
  const { major, minor, angle } = ellipseOf(one);
  const disk = new Mesh(new CircleGeometry(1, 40), glass(theme.reached, 0.3));
  disk.scale.set(Math.max(0.01, deviations * major), Math.max(0.01, deviations * minor), 1);
  disk.rotation.z = angle;
  disk.position.z = above;
  group.add(column, disk);
  group.position.set(one.position[0], one.position[1], 0);
  return group;
}

/** A cross on the ground where a landmark truly is. */
function cross(run: Run, [x, y]: Vec2): Line[] {
  const r = 0.8 * radiusOf(run);
  return [[r, r], [r, -r]].map(([dx, dy]) => lineOf([[x - dx!, y - dy!, 2 * above], [x + dx!, y + dy!, 2 * above]], theme.ink));
}

function landmarkActor(run: Run, landmarks: Landmark[]): Actor {
  const shown = landmarks.map((one) => ({ since: one.first_s, things: [post(run, one), ...(one.truth ? cross(run, one.truth) : [])] }));
  return { things: shown.flatMap((one) => one.things), act: ({ t }) => {
    for (const { since, things } of shown) for (const thing of things) thing.visible = since <= t;
  } };
}

/** A line along places at the times of the beliefs. */
function wayActor(times: Float64Array, places: Vec2[], colour: string, opacity: number): Actor[] {
  if (places.length < 2) return [];
  const line = lineOf(places.map(([x, y]): Vec3 => [x, y, above]), colour, opacity);
  line.frustumCulled = false;
  return [{ things: [line], act: ({ t }) => line.geometry.setDrawRange(0, t < times[0]! ? 0 : lastNotAfter(times, t) + 1) }];
}

function sensedActor(run: Run): Actor[] {
  const slam = run.report.slam!;
  const most = Math.max(0, ...slam.scans.map((one) => one.points.length));
  if (most === 0) return [];
  const scans = new Scans(run, slam);
  const height = slam.map ? 0.3 : 2 * radiusOf(run);
  const nowhere = Array.from({ length: most }, (): Vec3 => [0, 0, 0]);
  const hits = new Points(geometryOf(nowhere), new PointsMaterial({ color: theme.failed, size: 3, sizeAttenuation: false }));
  const beams = linesOf([...nowhere, ...nowhere], theme.failed, slam.map ? 0.25 : 0.7);
  hits.frustumCulled = beams.frustumCulled = false;
  return [{ things: [hits, beams], act: ({ t }) => {
    const sensed = scans.at(t);
    hits.visible = beams.visible = sensed !== null;
    if (!sensed) return;
    const ends = sensed.points.map(([x, y]): Vec3 => [x, y, height]);
    const drawn = ends.filter((_, i) => !sensed.isLaser || i % 3 === 0);
    moveTo(hits.geometry, ends);
    hits.geometry.setDrawRange(0, ends.length);
    moveTo(beams.geometry, drawn.flatMap((end): Vec3[] => [[...sensed.from, height], end]));
    beams.geometry.setDrawRange(0, 2 * drawn.length);
  } }];
}

export function slamActor(run: Run): Actor[] {
  const { slam, paths } = run.report;
  if (!slam) return [];
  const times = Float64Array.from(slam.beliefs, (one) => one.time_s);
  const sorted = [...slam.loops].sort((a, b) => a.time_s - b.time_s);
  const since = Float64Array.from(sorted, (one) => one.time_s);
  const loops = linesOf(sorted.flatMap(({ from, to }): Vec3[] => [[...from, 2 * above], [...to, 2 * above]]), theme.open, 0.8);
  loops.frustumCulled = false;
  const others = paths.length > 1 ? paths.map(({ waypoints }) => lineOf(waypoints.map(([x, y]): Vec3 => [x, y, above]), theme.unreachable)) : [];
  const landmarks = slam.landmarks.length > 0 ? [landmarkActor(run, slam.landmarks)] : [];
  return [...landmarks, ...wayActor(times, slam.odometry, theme.soft, 0.6), ...wayActor(times, slam.reference, theme.reached, 0.9),
    ...sensedActor(run), { things: [loops, ...others], act: ({ t }) => loops.geometry.setDrawRange(0, since.length === 0 || since[0]! > t ? 0 : 2 * (lastNotAfter(since, t) + 1)) }];
}
