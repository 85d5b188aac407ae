// Beliefs of the robot: the path that it believed to drive, its pose, and the ellipse of its uncertainty.
import { degrees, fixed, wrapped } from "../base/numbers";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { beliefsOf, type Belief } from "../log/beliefs";
import { deviations, ellipseOf, enlargedOf } from "./ellipse";
import { traceRobot, type Layer, type Pen } from "./layer";

export function believed(run: Run): Layer | null {
  const beliefs = beliefsOf(run);
  if (beliefs.all.length === 0) return null;
  const { radius, hasTruth } = run;
  const enlarged = enlargedOf(run);
  const reference = hasTruth ? "" : " the way as settled";
  /** Distances of the believed path from the final estimate, if the truth is not known. */
  const away = Float64Array.from(hasTruth ? [] : beliefs.all, ({ t, pose: [x, y] }) => {
    const at = run.track.at(t);
    return Math.hypot(x - at.x, y - at.y);
  });

  function drawWay({ ctx, camera, now }: Pen, belief: Belief | null): void {
    ctx.lineWidth = camera.px(1.2);
    ctx.setLineDash([camera.px(5), camera.px(5)]);
    ctx.beginPath();
    const least = camera.px(2);
    let [lx, ly] = [Infinity, Infinity];
    let joined = true;
    for (let i = 0; i <= beliefs.index(now.t); ++i) {
      const [x, y] = beliefs.all[i]!.pose;
      if (away[i]! < least) {
        joined = false;
        continue;
      }
      if (!joined) ctx.moveTo(x, y);
      joined = true;
      if (Math.abs(x - lx) < least && Math.abs(y - ly) < least) continue;  // dashes of many short lines are slow
      ctx.lineTo(x, y);
      [lx, ly] = [x, y];
    }
    if (belief && joined) ctx.lineTo(belief.pose[0], belief.pose[1]);
    ctx.stroke();
    ctx.setLineDash([]);
  }

  return {
    moving(pen) {
      const { ctx, camera, now } = pen;
      const belief = beliefs.at(now.t);
      ctx.strokeStyle = ctx.fillStyle = theme.belief;
      drawWay(pen, belief);
      if (!belief) return;
      const { major, minor, angle } = ellipseOf(belief);
      const [x, y, heading] = belief.pose;
      const axis = (sigma: number): number => Math.max(deviations * enlarged * sigma, camera.px(1));
      ctx.beginPath();
      ctx.ellipse(x, y, axis(major), axis(minor), angle, 0, 2 * Math.PI);
      ctx.globalAlpha = 0.22;
      ctx.fill();
      ctx.globalAlpha = 1;
      ctx.lineWidth = camera.px(1.6);
      ctx.stroke();
      ctx.setLineDash([camera.px(3), camera.px(3)]);
      const r = traceRobot(pen, run, x, y, heading);
      ctx.moveTo(x, y);
      ctx.lineTo(x + r * Math.cos(heading), y + r * Math.sin(heading));
      ctx.stroke();
      ctx.setLineDash([]);
    },
    find(at, { camera, now }) {
      const belief = beliefs.at(now.t);
      if (!belief) return null;
      const place = camera.screen(belief.pose[0], belief.pose[1]);
      if (Math.hypot(place.x - at.x, place.y - at.y) > Math.max(9, camera.scale * radius)) return null;
      const truth = run.track.at(now.t);
      const { major, minor } = ellipseOf(belief);
      const mm = (metres: number): string => `${fixed(1000 * metres, 0)} mm`;
      return { told: { topic: topic.belief, name: "belief", at: (t) => run.log.latest(topic.belief, t) }, lines: [
        `believed ${mm(Math.hypot(belief.pose[0] - truth.x, belief.pose[1] - truth.y))} and ${degrees(wrapped(belief.pose[2] - truth.heading))} off${reference}`,
        `2\u03c3: ${mm(deviations * major)} by ${mm(deviations * minor)}, ${degrees(deviations * belief.sigma_heading)}`] };
    },
  };
}
