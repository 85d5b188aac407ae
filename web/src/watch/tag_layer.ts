// Tags on walls and which of them the camera has in sight, the places to go to.
import { fixed } from "../base/numbers";
import { theme } from "../base/theme";
import type { Tag, Waypoint, Waypoints } from "../log/messages";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import type { State } from "../log/track";
import { lensAt, Sight, tagsOf } from "./eye";
import { disk, label, type Layer, type Pen } from "./layer";

/** The wall side of a tag is a bar, its face a short line outwards. */
function drawTag({ ctx, camera }: Pen, tag: Tag): void {
  const half = Math.max(tag.size / 2, camera.px(7));
  const [cos, sin] = [Math.cos(tag.facing), Math.sin(tag.facing)];
  const { x, y } = tag.position;
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

function drawStop({ ctx, camera, now }: Pen, { position: { x, y }, heading, stop, reached: when }: Waypoint): void {
  const reached = when <= now.t;
  ctx.strokeStyle = reached ? theme.reached : theme.waiting;
  ctx.lineWidth = camera.px(1.6);
  if (!stop) {
    disk(ctx, x, y, camera.px(2.5));
    ctx.stroke();
    return;
  }
  disk(ctx, x, y, camera.px(9));
  ctx.moveTo(x, y);
  ctx.lineTo(x + camera.px(15) * Math.cos(heading), y + camera.px(15) * Math.sin(heading));
  ctx.stroke();
}

/** Draws what the camera sees of the plane, and lines to the tags that a pose was taken from. */
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
    ctx.lineTo(tag.position.x, tag.position.y);
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
}

export function tags(run: Run): Layer | null {
  const all = tagsOf(run);
  const waypoints = run.log.latest<Waypoints>(topic.waypoints)?.waypoints ?? [];
  if (all.length === 0 && waypoints.length === 0) return null;
  const sight = Sight.of(run);
  return {
    moving(pen) {
      const { ctx, camera, now } = pen;
      if (sight) drawSight(pen, sight, run.track.at(now.t));
      for (const tag of all) drawTag(pen, tag);
      for (const stop of waypoints) drawStop(pen, stop);
      camera.toScreen(ctx);
      ctx.font = `11.5px ${theme.sans}`;
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      for (const tag of all) {
        const { x, y } = camera.screen(tag.position.x, tag.position.y);
        label(ctx, `tag ${tag.id}`, x + 12, y - 10, theme.ink, theme.yard);
      }
    },
    find(at, { camera }) {
      const stop = waypoints.find((one) => {
        const place = camera.screen(one.position.x, one.position.y);
        return one.stop && Math.hypot(place.x - at.x, place.y - at.y) < 12;
      });
      if (!stop) return null;
      const off = Math.hypot(stop.error.x, stop.error.y);
      return { told: { topic: topic.waypoints, name: `stop ${waypoints.indexOf(stop) + 1}`, at: () => stop }, lines: Number.isFinite(stop.reached) ? [`reached after ${fixed(stop.reached, 1)} s, ${fixed(1000 * off, 1)} mm off`] : ["not reached"] };
    },
  };
}
