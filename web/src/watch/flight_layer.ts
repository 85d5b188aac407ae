// Shots: lines to where they touched, the ball in flight with its shadow, the splash.
import { clamp } from "../base/numbers";
import { nearestOnPolygon } from "../base/outline";
import { theme } from "../base/theme";
import { ballOf, flightsOf, type Ball, type Flight } from "../log/flights";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { disk, type Layer, type Pen } from "./layer";

/** As if the sun stood in the upper left: the higher, the farther off. */
const shadowOf = (ball: Ball): { x: number; y: number } => ({ x: ball.x + 0.3 * ball.z, y: ball.y - 0.3 * ball.z });

export function cross({ ctx, camera }: Pen, x: number, y: number, pixels: number): void {
  const r = camera.px(pixels);
  ctx.beginPath();
  ctx.moveTo(x - r, y - r);
  ctx.lineTo(x + r, y + r);
  ctx.moveTo(x - r, y + r);
  ctx.lineTo(x + r, y - r);
  ctx.stroke();
}

function drawShadow({ ctx, camera }: Pen, run: Run, shot: Flight, until: number, alpha: number): void {
  ctx.save();
  ctx.globalAlpha = alpha;
  ctx.strokeStyle = theme.soft;
  ctx.lineWidth = camera.px(1.3);
  ctx.setLineDash([camera.px(2), camera.px(3)]);
  ctx.beginPath();
  for (let i = 0; i <= 32; ++i) {
    const at = shadowOf(ballOf(run, shot, (until * i) / 32));
    ctx.lineTo(at.x, at.y);
  }
  ctx.stroke();
  ctx.restore();
}

function drawLine(pen: Pen, run: Run, shot: Flight): void {
  const { ctx, camera, now } = pen;
  const selected = shot === now.shot;
  if (shot.end > now.t && !selected) return;
  ctx.strokeStyle = shot.hit ? theme.water : theme.failed;
  ctx.globalAlpha = selected ? 0.95 : 0.33;
  ctx.lineWidth = camera.px(selected ? 1.6 : 1.1);
  ctx.setLineDash(shot.hit ? [] : [camera.px(5), camera.px(4)]);
  ctx.beginPath();
  ctx.moveTo(shot.from[0], shot.from[1]);
  ctx.lineTo(shot.to[0], shot.to[1]);
  ctx.stroke();
  ctx.setLineDash([]);
  if (!shot.hit) cross(pen, shot.to[0], shot.to[1], 3.5);
  if (selected) drawShadow(pen, run, shot, shot.end - shot.start, 0.5);
  ctx.globalAlpha = 1;
}

function drawBall(pen: Pen, run: Run, shot: Flight): void {
  const { ctx, camera, now } = pen;
  const age = now.t - shot.start;
  if (age < 0 || age >= shot.end - shot.start) return;
  const ball = ballOf(run, shot, age);
  drawShadow(pen, run, shot, age, 0.8);
  ctx.strokeStyle = theme.water;
  ctx.lineWidth = camera.px(2.4);
  ctx.beginPath();
  ctx.moveTo(shot.from[0], shot.from[1]);
  ctx.lineTo(ball.x, ball.y);
  ctx.stroke();
  const below = shadowOf(ball);
  const rise = 1.5 * clamp(ball.z, 0, 4);
  const spot = (x: number, y: number, pixels: number, colour: string): void => {
    ctx.fillStyle = colour;
    disk(ctx, x, y, camera.px(pixels));
    ctx.fill();
  };
  spot(below.x, below.y, 3, "#0006");
  spot(ball.x, ball.y, 4 + rise, theme.water);
  spot(ball.x, ball.y, 1.8 + rise, theme.yard);
}

function drawSplash({ ctx, camera, now }: Pen, shot: Flight): void {
  const spread = (now.t - shot.end) / (0.55 * Math.max(1, now.speed));
  if (now.speed === 0 || spread < 0 || spread >= 1) return;
  ctx.strokeStyle = shot.hit ? theme.water : theme.failed;
  ctx.globalAlpha = 1 - spread;
  ctx.lineWidth = camera.px(2);
  disk(ctx, shot.to[0], shot.to[1], camera.px(6 + 22 * spread));
  ctx.stroke();
  ctx.globalAlpha = 1;
}

export function flights(run: Run): Layer | null {
  const all = flightsOf(run);
  if (all.length === 0) return null;
  return {
    moving(pen) {
      for (const shot of all) drawLine(pen, run, shot);
      for (const shot of all) {
        drawBall(pen, run, shot);
        drawSplash(pen, shot);
      }
    },
    find(at, { camera, now }) {
      const { x, y } = camera.plane(at);
      let found: Flight | null = null;
      let least = camera.px(7);
      for (const shot of all) {
        if (shot.start > now.t && shot !== now.shot) continue;
        const { distance } = nearestOnPolygon(x, y, [[shot.from[0], shot.from[1]], [shot.to[0], shot.to[1]]]);
        if (distance < least) [least, found] = [distance, shot];
      }
      if (!found) return null;
      const { index } = found;
      return { shot: found, told: { topic: topic.shots, name: `shot ${index + 1}`, at: () => run.log.messages(topic.shots)[index]?.message }, lines: [`Shot ${found.index + 1} at ${found.target}: ${found.hit ? "hit" : `touched ${found.contact}`}`] };
    },
  };
}
