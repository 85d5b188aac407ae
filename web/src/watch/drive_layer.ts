// A drive: tags on walls, the places to go to, what the robot believed of its pose and which tags it saw.
import { finite, fixed } from "../base/numbers";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import type { State } from "../report/track";
import type { Drive } from "../report/types";
import { lensAt, Sight } from "./eye";
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

/** What the camera sees of the plane, and lines to the tags that a pose was taken from. */
function drawSight({ ctx, camera, now }: Pen, sight: Sight, at: State): void {
  const lens = lensAt(sight.eye, at);
  ctx.beginPath();
  ctx.moveTo(...lens);
  for (const end of sight.edge(at)) ctx.lineTo(...end);
  ctx.closePath();
  ctx.fillStyle = ctx.strokeStyle = theme.water;
  ctx.globalAlpha = 0.07;
  ctx.fill();
  ctx.globalAlpha = 0.4;
  ctx.lineWidth = camera.px(1);
  ctx.stroke();
  ctx.globalAlpha = 0.8;
  ctx.lineWidth = camera.px(1.4);
  for (const tag of sight.tagsSeen(now.t, at)) {
    ctx.beginPath();
    ctx.moveTo(...lens);
    ctx.lineTo(...tag.position);
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
}

export function drive(run: Run): Layer | null {
  const driven = run.report.drive;
  if (!driven) return null;
  const sight = Sight.of(run);
  return {
    moving(pen) {
      const { ctx, camera, now } = pen;
      if (sight) drawSight(pen, sight, run.track.at(now.t));
      for (const tag of driven.tags) drawTag(pen, tag);
      for (const stop of driven.stops) drawStop(pen, stop);
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
