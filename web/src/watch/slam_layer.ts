// Mapping from a log: the map as it was discovered, landmarks and loops from when they were known, what was sensed, and
// where odometry alone and a reference put the robot. The way as settled in the end is the track of the run.
import { finite, fixed } from "../base/numbers";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import { lastNotAfter } from "../report/track";
import type { Landmark, Slam, Vec2 } from "../report/types";
import { areaOf } from "./area";
import { deviations, ellipseOf } from "./ellipse";
import { Discovery, drawDiscovery } from "./explore_layer";
import { disk, label, type Layer, type Pen } from "./layer";

const mostNamed = 60;

/** What was sensed last, where it lies on the map. */
export interface Sensed { from: Vec2; points: Vec2[]; isLaser: boolean }

export const isLaser = (slam: Slam): boolean => slam.engine === "laser";

/** Scans at instants; each lies where the robot was, on the way as settled. */
export class Scans {
  private times: Float64Array;
  private placed: (Sensed | undefined)[] = [];

  constructor(private run: Run, private slam: Slam) {
    this.times = Float64Array.from(slam.scans, (one) => one.time_s);
  }

  /** The newest that is not after t. O(log n). */
  at(t: number): Sensed | null {
    if (this.times.length === 0 || this.times[0]! > t) return null;
    const index = lastNotAfter(this.times, t);
    return (this.placed[index] ??= this.place(index));
  }

  private place(index: number): Sensed {
    const { time_s, points } = this.slam.scans[index]!;
    const { x, y, heading } = this.run.track.at(time_s);
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    return { from: [x, y], isLaser: isLaser(this.slam), points: points.map(([ahead, left]): Vec2 => [x + ahead * cos - left * sin, y + ahead * sin + left * cos]) };
  }
}

/** Where a robot is at t on a way of places at equal times. */
export function onPath({ start_s, end_s, waypoints }: Run["report"]["paths"][number], t: number): { until: number; at: Vec2 } {
  const last = waypoints.length - 1;
  const span = finite(end_s) - finite(start_s);
  const along = span > 0 ? Math.min(Math.max(0, ((t - finite(start_s)) / span) * last), last) : last;
  const until = Math.floor(along);
  const [a, b] = [waypoints[until]!, waypoints[Math.min(until + 1, last)]!];
  return { until, at: [a[0] + (along - until) * (b[0] - a[0]), a[1] + (along - until) * (b[1] - a[1])] };
}

/** The name and the style of each line that is drawn of a mapping. */
export function slamLegend({ report }: Run): [string, string][] {
  const { slam } = report;
  if (!slam) return [];
  const settled = report.status !== "running";
  const way = settled ? "way settled in the end" : "way believed so far";
  const belief = settled && slam.engine !== "pose_graph" ? "believed then, 2\u03c3" : "pose, 2\u03c3";
  const lines: [string, string, boolean][] = [
    [way, "border-color:var(--robot)", true],
    [belief, "border-color:var(--belief);border-top-style:dashed", true],
    ["odometry alone", "border-color:var(--soft);border-top-width:1px", slam.odometry.length > 0],
    ["reference", "border-color:var(--reached);border-top-style:dotted", slam.reference.length > 0],
    ["loop closed", "border-color:var(--open);border-top-width:1.5px", slam.loops.length > 0],
    ["landmark, 2\u03c3", "border-color:var(--reached)", slam.landmarks.length > 0],
    ["true place \u00d7", "border-color:var(--ink)", slam.landmarks.some((one) => one.truth)],
    [isLaser(slam) ? "range finder" : "sightings", "border-color:var(--failed);border-top-width:1.5px", slam.scans.length > 0],
    ["other robots", "border-color:var(--unreachable)", report.paths.length > 1]];
  return lines.filter(([, , shown]) => shown).map(([name, style]) => [name, style]);
}

function drawLine({ ctx, camera }: Pen, places: Vec2[], until: number): void {
  const least = camera.px(1.5);
  let [lx, ly] = [Infinity, Infinity];
  ctx.beginPath();
  for (let i = 0; i <= until; ++i) {
    const [x, y] = places[i]!;
    if (i < until && Math.abs(x - lx) < least && Math.abs(y - ly) < least) continue;
    ctx.lineTo(x, y);
    [lx, ly] = [x, y];
  }
  ctx.stroke();
}

function drawLandmark({ ctx, camera }: Pen, one: Landmark): void {
  const [x, y] = one.position;
  const { major, minor, angle } = ellipseOf(one);
  ctx.beginPath();
  ctx.ellipse(x, y, Math.max(deviations * major, camera.px(1)), Math.max(deviations * minor, camera.px(1)), angle, 0, 2 * Math.PI);
  ctx.globalAlpha = 0.2;
  ctx.fill();
  ctx.globalAlpha = 1;
  ctx.lineWidth = camera.px(1.3);
  ctx.stroke();
  disk(ctx, x, y, camera.px(2.6));
  ctx.fill();
}

function drawTruth({ ctx, camera }: Pen, [x, y]: Vec2): void {
  const r = camera.px(5);
  ctx.beginPath();
  ctx.moveTo(x - r, y - r);
  ctx.lineTo(x + r, y + r);
  ctx.moveTo(x - r, y + r);
  ctx.lineTo(x + r, y - r);
  ctx.stroke();
}

function drawSensed({ ctx, camera }: Pen, { from, points, isLaser: laser }: Sensed): void {
  ctx.strokeStyle = ctx.fillStyle = theme.failed;
  ctx.lineWidth = camera.px(laser ? 0.6 : 1.1);
  ctx.globalAlpha = laser ? 0.2 : 0.6;
  ctx.beginPath();
  points.forEach((point, i) => {
    if (laser && i % 3 > 0) return;
    ctx.moveTo(...from);
    ctx.lineTo(...point);
  });
  ctx.stroke();
  ctx.globalAlpha = 0.95;
  const r = camera.px(laser ? 1.3 : 1.8);
  for (const [x, y] of points) ctx.fillRect(x - r, y - r, 2 * r, 2 * r);
  ctx.globalAlpha = 1;
}

/** Those closed a moment ago stand out. */
function drawLoops(pen: Pen, run: Run, loops: Slam["loops"]): void {
  const { ctx, camera, now } = pen;
  const moment = 0.02 * run.duration;
  ctx.strokeStyle = theme.open;
  for (const fresh of [false, true]) {
    ctx.beginPath();
    for (const { time_s, from, to } of loops) {
      if (time_s > now.t || (now.t - time_s < moment && now.t < run.duration) !== fresh) continue;
      ctx.moveTo(...from);
      ctx.lineTo(...to);
    }
    ctx.lineWidth = camera.px(fresh ? 2.6 : 1.2);
    ctx.globalAlpha = fresh || loops.length < 200 ? 0.9 : 0.45;
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
  if (loops.length > 100) return;
  ctx.lineWidth = camera.px(1.4);
  for (const { time_s, to } of loops) {
    if (time_s > now.t) continue;
    disk(ctx, ...to, camera.px(5));
    ctx.stroke();
  }
}

function drawOthers(pen: Pen, run: Run): void {
  const { ctx, camera, now } = pen;
  ctx.strokeStyle = ctx.fillStyle = theme.unreachable;
  ctx.lineWidth = camera.px(1.4);
  for (const path of run.report.paths) {
    const { until, at } = onPath(path, now.t);
    ctx.globalAlpha = 0.75;
    drawLine(pen, path.waypoints, until);
    ctx.globalAlpha = 1;
    disk(ctx, ...at, camera.px(4));
    ctx.fill();
  }
}

export function slam(run: Run): Layer | null {
  const mapped = run.report.slam;
  if (!mapped) return null;
  const discovery = mapped.map && mapped.map.columns > 0 ? new Discovery(mapped.map) : null;
  const scans = new Scans(run, mapped);
  const times = Float64Array.from(mapped.beliefs, (one) => one.time_s);
  const landmarks = [...mapped.landmarks].sort((a, b) => a.first_s - b.first_s);
  const [x0, y0, x1, y1] = areaOf(run);
  return {
    still({ ctx }) {
      if (!discovery) return;
      ctx.fillStyle = theme.grid;
      ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    },
    moving(pen) {
      const { ctx, camera, now } = pen;
      if (discovery) drawDiscovery(pen, discovery, mapped.map!);
      const until = times.length === 0 || times[0]! > now.t ? -1 : lastNotAfter(times, now.t);
      ctx.lineJoin = "round";
      ctx.strokeStyle = theme.soft;
      ctx.lineWidth = camera.px(0.9);
      ctx.globalAlpha = 0.75;
      drawLine(pen, mapped.odometry, Math.min(until, mapped.odometry.length - 1));
      ctx.globalAlpha = 1;
      ctx.strokeStyle = theme.reached;
      ctx.lineWidth = camera.px(1.8);
      ctx.setLineDash([camera.px(1.5), camera.px(3.5)]);
      drawLine(pen, mapped.reference, Math.min(until, mapped.reference.length - 1));
      ctx.setLineDash([]);
      if (run.report.paths.length > 1) drawOthers(pen, run);
      drawLoops(pen, run, mapped.loops);
      const known = landmarks.filter((one) => one.first_s <= now.t);
      ctx.strokeStyle = theme.ink;
      ctx.lineWidth = camera.px(1.6);
      for (const { truth } of known) if (truth) drawTruth(pen, truth);
      ctx.strokeStyle = ctx.fillStyle = theme.reached;
      for (const one of known) drawLandmark(pen, one);
      const sensed = scans.at(now.t);
      if (sensed) drawSensed(pen, sensed);
      if (landmarks.length > mostNamed) return;
      camera.toScreen(ctx);
      ctx.font = `11px ${theme.sans}`;
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      for (const { id, position } of known) {
        const { x, y } = camera.screen(...position);
        label(ctx, String(id), x + 7, y - 8, theme.ink, theme.yard);
      }
    },
    find(at, { camera, now }) {
      const away = ([x, y]: Vec2): number => {
        const place = camera.screen(x, y);
        return Math.hypot(place.x - at.x, place.y - at.y);
      };
      const near = landmarks.filter((one) => one.first_s <= now.t && away(one.position) < 9)
        .sort((a, b) => away(a.position) - away(b.position))[0];
      return near ? { lines: linesOf(near) } : null;
    },
  };
}

function linesOf(one: Landmark): string[] {
  const { major, minor } = ellipseOf(one);
  const off = one.truth ? [`${fixed(Math.hypot(one.position[0] - one.truth[0], one.position[1] - one.truth[1]), 3)} m off its true place`] : [];
  return [`landmark ${one.id}, sighted ${one.sightings} times`, `2\u03c3: ${fixed(deviations * major, 3)} m by ${fixed(deviations * minor, 3)} m`, ...off];
}
