// What the robot believed: the way it took itself to have driven, its pose, and the ellipse of its doubt.
import { finite } from "../base/numbers";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import type { Belief } from "../report/types";
import { beliefFinder, ellipseOf } from "./ellipse";
import { disk, type Pen } from "./layer";

/** Two standard deviations: 86 % of a plane's normal distribution. Never smaller than can be seen. */
const deviations = 2;

export function beliefDrawer(run: Run, beliefs: Belief[]): (pen: Pen) => void {
  const find = beliefFinder(beliefs);
  const radius = finite(run.report.robot.radius_m);
  return ({ ctx, camera, now }) => {
    const index = find(now.t);
    const belief = beliefs[index];
    if (!belief) return;
    ctx.strokeStyle = theme.belief;
    ctx.lineWidth = camera.px(1.8);
    ctx.setLineDash([camera.px(5), camera.px(3)]);
    ctx.beginPath();
    for (let i = 0; i <= index; ++i) ctx.lineTo(beliefs[i]!.pose[0], beliefs[i]!.pose[1]);
    ctx.stroke();
    ctx.setLineDash([]);
    const { major, minor, angle } = ellipseOf(belief);
    const [x, y, heading] = belief.pose;
    ctx.beginPath();
    ctx.ellipse(x, y, Math.max(deviations * major, camera.px(1)), Math.max(deviations * minor, camera.px(1)), angle, 0, 2 * Math.PI);
    ctx.fillStyle = theme.belief;
    ctx.globalAlpha = 0.22;
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.stroke();
    const r = Math.max(radius, camera.px(7));
    ctx.setLineDash([camera.px(3), camera.px(3)]);
    disk(ctx, x, y, r);
    ctx.moveTo(x, y);
    ctx.lineTo(x + r * Math.cos(heading), y + r * Math.sin(heading));
    ctx.stroke();
    ctx.setLineDash([]);
  };
}
