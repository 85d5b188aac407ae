// The robot, or each of a team: the way it drove, and its outline or disk with its heading and its gun.
import { teamColours, theme } from "../base/theme";
import type { Run } from "../log/run";
import { teamOf, type TeamRobot } from "../log/team";
import { topic } from "../log/topics";
import { lastNotAfter } from "../log/track";
import { disk, traceRobot, traceWay, type Found, type Layer, type Pen } from "./layer";

/** The robot's outline, or a disk of its size, with a wedge that shows its heading. In metres. */
function drawBody(pen: Pen, run: Run, x: number, y: number, heading: number, colour: string): number {
  const { ctx, camera } = pen;
  const r = traceRobot(pen, run, x, y, heading);
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
  if (run.track.length === 0 || run.log.has(topic.costGrid)) return null;  // pursuers are drawn on their grid
  const layers = teamOf(run).map((one, i) => oneRobot(run, one, i));
  return {
    still(pen) { for (const layer of layers) layer.still!(pen); },
    moving(pen) {
      for (const layer of layers) {
        pen.ctx.save();
        layer.moving!(pen);
        pen.ctx.restore();
      }
    },
    find: (at, pen) => layers.reduce<Found | null>((found, layer) => found ?? layer.find!(at, pen), null),
  };
}

function oneRobot(run: Run, { name, poseTopic, track }: TeamRobot, index: number): Layer {
  const { radius, log, info: { gun_length: gunLength } } = run;
  const covers = log.has(topic.coverageArea);
  const colour = (): string => teamColours()[index % teamColours().length]!;
  return {
    still(pen) {
      const { ctx, camera } = pen;
      if (covers) return;  // its layer draws the way
      ctx.strokeStyle = colour();
      ctx.globalAlpha = 0.3;
      ctx.lineWidth = camera.px(1.2);
      ctx.beginPath();
      traceWay(pen, track.x, track.y, track.length);
      ctx.stroke();
    },
    moving(pen) {
      const { ctx, camera, now } = pen;
      const row = lastNotAfter(track.time, now.t);
      const at = track.at(now.t);
      ctx.beginPath();
      if (!covers) traceWay(pen, track.x, track.y, row + 1);
      ctx.lineTo(at.x, at.y);
      ctx.strokeStyle = colour();
      ctx.lineWidth = camera.px(2.2);
      ctx.lineJoin = ctx.lineCap = "round";
      ctx.stroke();
      const r = drawBody(pen, run, at.x, at.y, at.heading, colour());
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
      return { told: { topic: poseTopic, name, at: (t) => log.latest(poseTopic, t) }, lines: [] };
    },
  };
}
