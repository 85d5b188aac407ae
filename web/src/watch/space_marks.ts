// Marks on the ground, in space: places to go to, the way that was chosen, frontiers refused, stations.
import { BoxGeometry, EllipseCurve, type Line, type LineBasicMaterial, Mesh } from "three";
import { finite } from "../base/numbers";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import type { Vec3 } from "../report/types";
import { decisionAt } from "./explore_layer";
import { lambert, lineOf, type Actor } from "./space_parts";
import { radiusOf } from "./space_robot";

const above = 0.02;

function ring(run: Run, x: number, y: number, radius: number, colour: string): Line {
  const points = new EllipseCurve(x, y, radius, radius, 0, 2 * Math.PI).getPoints(40);
  return lineOf(points.map((at): Vec3 => [at.x, at.y, run.height(at.x, at.y) + above]), colour);
}

/** Green once they were reached; with a line where the robot was to look to. */
export function stopActor(run: Run): Actor[] {
  const radius = radiusOf(run);
  return (run.report.drive?.stops ?? []).filter((one) => one.stop).map((stop) => {
    const [x, y, heading] = stop.pose;
    const marks = [ring(run, x, y, radius, theme.waiting),
      lineOf([[x, y, above], [x + 1.6 * radius * Math.cos(heading), y + 1.6 * radius * Math.sin(heading), above]], theme.waiting)];
    return { things: marks, act: ({ t }) => {
      const colour = Number.isFinite(stop.time_s) && finite(stop.time_s) <= t ? theme.reached : theme.waiting;
      for (const mark of marks) (mark.material as LineBasicMaterial).color.set(colour);
    } };
  });
}

/** The way to the goal of the moment; at the end a square about each frontier that was refused. */
export function decisionActor(run: Run): Actor[] {
  const { explore } = run.report;
  if (!explore) return [];
  const way = (points: [number, number][], colour: string): Line => lineOf(points.map(([x, y]): Vec3 => [x, y, above]), colour);
  const ways = explore.decisions.map(({ waypoints }) => way(waypoints, theme.open));
  const goals = explore.decisions.map(({ goal }) => ring(run, goal[0], goal[1], 0.8 * radiusOf(run), theme.open));
  const refused = explore.refused.map(({ position: [x, y] }) => {
    const r = 0.7 * radiusOf(run);
    return way([[x - r, y - r], [x + r, y - r], [x + r, y + r], [x - r, y + r], [x - r, y - r]], theme.unreachable);
  });
  return [{ things: [...ways, ...goals, ...refused], act: ({ t }) => {
    const present = decisionAt(run, t);
    explore.decisions.forEach((one, i) => { ways[i]!.visible = goals[i]!.visible = one === present; });
    for (const one of refused) one.visible = t >= run.duration - 1e-6;
  } }];
}

export function stationActor(run: Run): Actor[] {
  return (run.report.supplies?.stations ?? []).map(({ position: [x, y], gives_water }) => {
    const post = new Mesh(new BoxGeometry(0.16, 0.16, 0.5), lambert(gives_water ? theme.water : theme.robot));
    post.position.set(x, y, run.height(x, y) + 0.25);
    return { things: [post] };
  });
}
