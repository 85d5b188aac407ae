// The robot: the way it drove, and the disk with its heading and its gun.
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { lastNotAfter } from "../log/track";
import { disk, traceWay, type Layer, type Pen } from "./layer";

/** A disk of the robot's size with a wedge that shows its heading. In metres. */
export function drawBody({ ctx, camera }: Pen, x: number, y: number, heading: number, radius: number, colour: string): number {
  const r = Math.max(radius, camera.px(7));
  disk(ctx, x, y, r);
  ctx.fillStyle = theme.yard;
  ctx.fill();
  ctx.lineWidth = camera.px(2);
  ctx.strokeStyle = colour;
  ctx.stroke();
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(heading);
  ctx.beginPath();
  ctx.moveTo(0.84 * r, 0);
  ctx.lineTo(0.34 * r, 0.4 * r);
  ctx.lineTo(0.34 * r, -0.4 * r);
  ctx.closePath();
  ctx.fillStyle = colour;
  ctx.fill();
  ctx.restore();
  return r;
}

export function robot(run: Run): Layer | null {
  const { track, radius, log, info: { gun_length: gunLength } } = run;
  if (track.length === 0 || log.has(topic.costGrid)) return null;  // pursuers are drawn on their grid
  const covers = log.has(topic.coverageArea);
  return {
    still(pen) {
      const { ctx, camera } = pen;
      if (covers) return;  // its layer draws the way
      ctx.strokeStyle = theme.robot;
      ctx.globalAlpha = 0.3;
      ctx.lineWidth = camera.px(1.2);
      ctx.beginPath();
      traceWay(pen, track.x, track.y, track.length);
      ctx.stroke();
    },
    moving(pen) {
      const { ctx, camera, now } = pen;
      const index = lastNotAfter(track.time, now.t);
      const at = track.at(now.t);
      ctx.beginPath();
      if (!covers) traceWay(pen, track.x, track.y, index + 1);
      ctx.lineTo(at.x, at.y);
      ctx.strokeStyle = theme.robot;
      ctx.lineWidth = camera.px(2.2);
      ctx.lineJoin = ctx.lineCap = "round";
      ctx.stroke();
      const r = drawBody(pen, at.x, at.y, at.heading, radius, theme.robot);
      if (gunLength <= 0) return;
      ctx.translate(at.x, at.y);
      ctx.rotate(at.yaw);
      ctx.beginPath();
      ctx.moveTo(0, 0);
      ctx.lineTo(Math.max(gunLength, 1.3 * r), 0);
      ctx.lineWidth = Math.max(camera.px(3.5), 0.16 * r);
      ctx.strokeStyle = theme.water;
      ctx.stroke();
      disk(ctx, 0, 0, 0.28 * r);
      ctx.fillStyle = theme.water;
      ctx.fill();
    },
    find(at, { camera, now }) {
      const { x, y } = track.at(now.t);
      const place = camera.screen(x, y);
      if (Math.hypot(place.x - at.x, place.y - at.y) > Math.max(9, camera.scale * radius)) return null;
      return { told: { topic: topic.pose, name: "robot", at: (t) => log.latest(topic.pose, t) }, lines: [] };
    },
  };
}
