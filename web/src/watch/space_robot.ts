// The robot in space, on the ground as it is: its body, its gun, the way it drove; and where it believed to be.
import { BoxGeometry, type BufferGeometry, CircleGeometry, CylinderGeometry, EdgesGeometry, EllipseCurve, ExtrudeGeometry, Group, LineBasicMaterial, LineSegments, Mesh, Shape, Vector2, Vector3 } from "three";
import { mix } from "../base/numbers";
import { teamColours, theme } from "../base/theme";
import { beliefsOf } from "../log/beliefs";
import { flightsOf } from "../log/flights";
import type { Vec2, Vec3 } from "../log/geometry";
import type { Run } from "../log/run";
import { teamOf } from "../log/team";
import { topic } from "../log/topics";
import { lastNotAfter, type Track } from "../log/track";
import { areaOf } from "./area";
import { deviations, ellipseOf, enlargedOf } from "./ellipse";
import { glass, lambert, lineOf, ribbon, type Actor } from "./space_parts";

const mostSteps = 20_000;
const up = new Vector3(0, 0, 1);

/** Returns the radius of the robot; if it is unknown, one that is large enough to see from afar. */
export function radiusOf(run: Run): number {
  if (run.radius > 0) return Math.max(0.05, run.radius);
  const [x0, y0, x1, y1] = areaOf(run);
  return Math.max(0.1, 0.006 * Math.max(x1 - x0, y1 - y0));
}

/** Puts a thing onto the ground there, upright to it, and turns it. */
export function stand(run: Run, thing: Group, x: number, y: number, heading: number): void {
  thing.position.set(x, y, run.height(x, y));
  thing.quaternion.setFromUnitVectors(up, new Vector3(...run.normal(x, y)).normalize());
  thing.rotateOnAxis(up, heading);
}

/** A way in steps that are short beside the robot, on the ground (x, y, z, x, y, z, ...); with the time of each of them. */
export function wayOnGround(run: Run, time: ArrayLike<number>, places: Vec2[], above: number): { time: Float64Array; way: Float64Array } {
  const legs = new Float64Array(places.length);
  for (let i = 1; i < places.length; ++i) legs[i] = Math.hypot(places[i]![0] - places[i - 1]![0], places[i]![1] - places[i - 1]![1]);
  const step = Math.max(0.7 * radiusOf(run), legs.reduce((sum, leg) => sum + leg, 0) / mostSteps);
  const counts = legs.map((leg) => Math.max(1, Math.ceil(leg / step)));
  const total = counts.reduce((sum, count) => sum + count, 0);
  const all = { time: new Float64Array(total), way: new Float64Array(3 * total) };
  let at = 0;
  for (let i = 0; i < places.length; ++i) {
    const from = Math.max(0, i - 1);
    const [[ax, ay], [bx, by]] = [places[from]!, places[i]!];
    for (let k = 1; k <= counts[i]!; ++k, ++at) {
      const share = k / counts[i]!;
      const px = mix(ax, bx, share);
      const py = mix(ay, by, share);
      all.time[at] = mix(time[from]!, time[i]!, share);
      all.way[3 * at] = px;
      all.way[3 * at + 1] = py;
      all.way[3 * at + 2] = run.height(px, py) + above;
    }
  }
  return all;
}

function wayActor(run: Run, time: ArrayLike<number>, places: Vec2[], colour: string, above: number): Actor {
  const { time: times, way } = wayOnGround(run, time, places, above);
  const [x0, y0, x1, y1] = areaOf(run);
  const band = ribbon(way, Math.max(0.22 * radiusOf(run), 0.0045 * Math.max(x1 - x0, y1 - y0)), colour);  // seen from afar as well
  return { things: [band], act: ({ t }) => band.geometry.setDrawRange(0, t < times[0]! ? 0 : 6 * lastNotAfter(times, t)) };
}

export function robotActor(run: Run): Actor[] {
  if (run.track.length === 0 || run.log.has(topic.costGrid)) return [];  // pursuers stand on their grid
  return teamOf(run).flatMap(({ track }, i) => oneRobot(run, track, teamColours()[i % teamColours().length]!));
}

/** The robot's body on the ground, enlarged by a factor. */
function hullOf(run: Run, height: number, factor: number): BufferGeometry {
  if (run.outline.length > 0)
    return new ExtrudeGeometry(new Shape(run.outline.map(([x, y]) => new Vector2(factor * x, factor * y))), { depth: height, bevelEnabled: false });
  const radius = factor * radiusOf(run);
  return new CylinderGeometry(radius, radius, height, 36).rotateX(Math.PI / 2).translate(0, 0, height / 2);
}

function oneRobot(run: Run, track: Track, colour: string): Actor[] {
  const radius = radiusOf(run);
  const height = Math.max(0.08, 0.8 * radius);
  const body = new Group();
  const hull = new Mesh(hullOf(run, height, 1), lambert(colour));
  const nose = new Mesh(new BoxGeometry(0.5 * radius, 0.24 * radius, 0.02), lambert(theme.yard));
  nose.position.set(0.6 * radius, 0, height + 0.01);
  body.add(hull, nose);
  const gun = new Group();
  const length = run.info.gun_length;
  const [muzzle] = flightsOf(run);
  const mounted = muzzle ? muzzle.from[2] - run.height(muzzle.from[0], muzzle.from[1]) : height;
  if (length > 0) {
    const barrel = new Mesh(new CylinderGeometry(0.025, 0.025, length, 12), lambert(theme.water));
    barrel.rotation.z = -Math.PI / 2;
    barrel.position.x = length / 2;
    gun.add(barrel);
    gun.rotation.order = "ZYX";
  }
  const act: Actor["act"] = ({ t }) => {
    const at = track.at(t);
    stand(run, body, at.x, at.y, at.heading);
    gun.position.set(at.x, at.y, run.height(at.x, at.y) + mounted);
    gun.rotation.set(0, -at.pitch, at.yaw);
  };
  if (run.log.has(topic.coverageArea)) return [{ things: [body, gun], act }];  // its way is drawn by what it does
  const { time, x, y } = track;
  return [{ things: [body, gun], act }, wayActor(run, time, Array.from(x, (one, i): Vec2 => [one, y[i]!]), colour, 0.012)];
}

/** A ghost at the believed pose on the ellipse of its uncertainty. */
export function beliefActor(run: Run): Actor[] {
  const beliefs = beliefsOf(run);
  if (beliefs.all.length === 0) return [];
  const enlarged = enlargedOf(run);
  const radius = radiusOf(run);
  const height = Math.max(0.08, 0.8 * radius);
  const ghost = new Group();
  const hull = hullOf(run, height, 1.02);
  const nose = lineOf([[0, 0, height + 0.02], [1.5 * radius, 0, height + 0.02]], theme.belief);
  ghost.add(new Mesh(hull, glass(theme.belief, 0.25)), new LineSegments(new EdgesGeometry(hull, 30), new LineBasicMaterial({ color: theme.belief })), nose);
  const ellipse = new Group();
  ellipse.add(new Mesh(new CircleGeometry(1, 48), glass(theme.belief, 0.3)),
    lineOf(new EllipseCurve(0, 0, 1, 1, 0, 2 * Math.PI).getPoints(48).map(({ x, y }): Vec3 => [x, y, 0]), theme.belief));
  const act: Actor["act"] = ({ t }) => {
    const belief = beliefs.at(t);
    ghost.visible = ellipse.visible = belief !== null;
    if (!belief) return;
    const [x, y, heading] = belief.pose;
    stand(run, ghost, x, y, heading);
    const { major, minor, angle } = ellipseOf(belief);
    stand(run, ellipse, x, y, angle);
    ellipse.position.z += 0.02;
    const axis = (sigma: number): number => Math.max(0.01, deviations * enlarged * sigma);
    ellipse.scale.set(axis(major), axis(minor), 1);
  };
  const way = wayActor(run, beliefs.times, beliefs.all.map(({ pose }): Vec2 => [pose[0], pose[1]]), theme.belief, 0.008);
  return [{ things: [ghost, ellipse], act }, way];
}
