// Marks on the ground, in space: places to go to, the path that is driven, frontiers refused, stations.
import { BoxGeometry, EllipseCurve, type Line, type LineBasicMaterial, Mesh } from "three";
import { theme } from "../base/theme";
import type { Vec2, Vec3 } from "../log/geometry";
import type { Supplies, Waypoints } from "../log/messages";
import { planAt, plansOf, refusalsOf } from "../log/plans";
import type { Run } from "../log/run";
import { legsOfOthers } from "../log/team";
import { topic } from "../log/topics";
import { lambert, lineOf, type Actor } from "./space_parts";
import { radiusOf } from "./space_robot";

const above = 0.02;

function ring(run: Run, x: number, y: number, radius: number, colour: string): Line {
  const points = new EllipseCurve(x, y, radius, radius, 0, 2 * Math.PI).getPoints(40);
  return lineOf(points.map((at): Vec3 => [at.x, at.y, run.height(at.x, at.y) + above]), colour);
}

/** Green once they were reached; with a line where the robot was to look to. */
export function waypointActor(run: Run): Actor[] {
  const radius = radiusOf(run);
  return (run.log.latest<Waypoints>(topic.waypoints)?.waypoints ?? []).filter((one) => one.stop).map(({ position: { x, y }, heading, reached }) => {
    const marks = [ring(run, x, y, radius, theme.waiting),
      lineOf([[x, y, above], [x + 1.6 * radius * Math.cos(heading), y + 1.6 * radius * Math.sin(heading), above]], theme.waiting)];
    return { things: marks, act: ({ t }) => {
      for (const mark of marks) (mark.material as LineBasicMaterial).color.set(reached <= t ? theme.reached : theme.waiting);
    } };
  });
}

/** The path of the moment and its goal; at the end a square about each frontier that was refused. */
export function wayActor(run: Run): Actor[] {
  const plans = plansOf(run);
  const line = (points: Vec2[], colour: string): Line => lineOf(points.map(([x, y]): Vec3 => [x, y, run.height(x, y) + above]), colour);
  const shown = plans.map((plan) => ({ plan, things: [line(plan.waypoints, theme.open),
    ...(plan.goal ? [ring(run, plan.goal[0], plan.goal[1], 0.8 * radiusOf(run), theme.open)] : [])] }));
  const refused = refusalsOf(run).map(({ at: [x, y] }) => {
    const r = 0.7 * radiusOf(run);
    return line([[x - r, y - r], [x + r, y - r], [x + r, y + r], [x - r, y + r], [x - r, y - r]], theme.unreachable);
  });
  const others = legsOfOthers(run).flat().map((leg) => ({ leg, thing: line(leg.waypoints, theme.open) }));
  if (shown.length === 0 && refused.length === 0 && others.length === 0) return [];
  return [{ things: [...shown.flatMap((one) => one.things), ...refused, ...others.map(({ thing }) => thing)], act: ({ t }) => {
    const present = planAt(run, t);
    for (const { plan, things } of shown) for (const thing of things) thing.visible = plan === present;
    for (const { leg, thing } of others) thing.visible = leg.start <= t && t < leg.end;
    for (const one of refused) one.visible = t >= run.duration - 1e-6;
  } }];
}

export function stationActor(run: Run): Actor[] {
  return (run.log.latest<Supplies>(topic.supplies)?.stations ?? []).map(({ position: { x, y }, gives_water }) => {
    const post = new Mesh(new BoxGeometry(0.16, 0.16, 0.5), lambert(gives_water ? theme.water : theme.robot));
    post.position.set(x, y, run.height(x, y) + 0.25);
    return { things: [post] };
  });
}
