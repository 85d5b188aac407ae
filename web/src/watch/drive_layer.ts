// A drive: tags on walls, the places to go to, what the robot believed of its pose and which tags it saw.
import { finite, fixed } from "../base/numbers";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import type { Drive } from "../report/types";
import { beliefDrawer } from "./belief";
import { beliefFinder } from "./ellipse";
import { disk, label, type Layer, type Pen } from "./layer";

/** The wall side of a tag is a bar, its face a short line outwards. */
function drawTag({ ctx, camera }: Pen, tag: Drive["tags"][number]): void {
  const half = Math.max(tag.size_m / 2, camera.px(7));
  const [cos, sin] = [Math.cos(tag.facing_rad), Math.sin(tag.facing_rad)];
  const [x, y] = tag.position;
  ctx.strokeStyle = theme.ink;
  ctx.lineWidth = camera.px(4);
  ctx.beginPath();
  ctx.moveTo(x - sin * half, y + cos * half);
  ctx.lineTo(x + sin * half, y - cos * half);
  ctx.stroke();
  ctx.lineWidth = camera.px(1.2);
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x + cos * camera.px(9), y + sin * camera.px(9));
  ctx.stroke();
}

function drawStop({ ctx, camera, now }: Pen, stop: Drive["stops"][number]): void {
  const [x, y, heading] = stop.pose;
  const reached = Number.isFinite(stop.time_s) && finite(stop.time_s) <= now.t;
  ctx.strokeStyle = reached ? theme.reached : theme.waiting;
  ctx.lineWidth = camera.px(1.6);
  if (!stop.stop) {
    disk(ctx, x, y, camera.px(2.5));
    ctx.stroke();
    return;
  }
  disk(ctx, x, y, camera.px(9));
  ctx.moveTo(x, y);
  ctx.lineTo(x + camera.px(15) * Math.cos(heading), y + camera.px(15) * Math.sin(heading));
  ctx.stroke();
}

export function drive(run: Run): Layer | null {
  const driven = run.report.drive;
  if (!driven) return null;
  const drawBelief = beliefDrawer(run, driven.beliefs);
  const find = beliefFinder(driven.beliefs);
  return {
    moving(pen) {
      const { ctx, camera, now } = pen;
      const belief = driven.beliefs[find(now.t)];
      const robot = run.track.at(now.t);
      for (const tag of driven.tags) {
        if (belief?.saw_tag) {
          ctx.strokeStyle = theme.water;
          ctx.globalAlpha = 0.45;
          ctx.lineWidth = camera.px(1);
          ctx.beginPath();
          ctx.moveTo(robot.x, robot.y);
          ctx.lineTo(...tag.position);
          if (facing(robot, tag)) ctx.stroke();
          ctx.globalAlpha = 1;
        }
        drawTag(pen, tag);
      }
      for (const stop of driven.stops) drawStop(pen, stop);
      drawBelief(pen);
      camera.toScreen(ctx);
      ctx.font = `11.5px ${theme.sans}`;
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      for (const tag of driven.tags) {
        const { x, y } = camera.screen(...tag.position);
        label(ctx, `tag ${tag.id}`, x + 12, y - 10, theme.ink, theme.yard);
      }
    },
    find(at, { camera }) {
      const stop = driven.stops.find((one) => {
        const place = camera.screen(one.pose[0], one.pose[1]);
        return one.stop && Math.hypot(place.x - at.x, place.y - at.y) < 12;
      });
      if (!stop) return null;
      const off = Math.hypot(finite(stop.error[0]), finite(stop.error[1]));
      return { lines: Number.isFinite(stop.time_s) ? [`reached after ${fixed(stop.time_s, 1)} s, ${fixed(1000 * off, 1)} mm off`] : ["not reached"] };
    },
  };
}

/** The robot stands before the face of the tag. */
function facing(robot: { x: number; y: number }, tag: Drive["tags"][number]): boolean {
  return (robot.x - tag.position[0]) * Math.cos(tag.facing_rad) + (robot.y - tag.position[1]) * Math.sin(tag.facing_rad) > 0;
}
