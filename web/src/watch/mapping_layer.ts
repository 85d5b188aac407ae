// Mapping: landmarks and loops as they were known then, and where odometry alone, a reference and other robots went.
import { fixed } from "../base/numbers";
import { theme } from "../base/theme";
import { beliefsOf } from "../log/beliefs";
import { vec2, type Vec2 } from "../log/geometry";
import { landmarksAt, loopsAt, odometryOf, referenceOf, robotWays, truePlaces, type TimedWay } from "../log/mapping";
import type { Landmark, Loop } from "../log/messages";
import { once } from "../log/once";
import type { Run } from "../log/run";
import { hasSenses } from "../log/sensed";
import { topic } from "../log/topics";
import { lastNotAfter } from "../log/track";
import { deviations, ellipseOf } from "./ellipse";
import { disk, label, type Layer, type Pen } from "./layer";

const mostNamed = 60;

/** Index of the place that is reached at t; -1 before the first. */
export const reachedOn = ({ times }: TimedWay, t: number): number => (times.length === 0 || times[0]! > t ? -1 : lastNotAfter(times, t));

/** The path was settled in the end, elsewhere than it was believed on the way. */
export const wasMoved = once((run: Run): boolean => beliefsOf(run).all.some(({ t, pose: [x, y] }) => {
  const at = run.track.at(t);
  return Math.hypot(x - at.x, y - at.y) > 1e-6;
}));

/** The name and the style of each line of a mapping, whose true path is not known. */
export function mappingLegend(run: Run): [string, string][] {
  const { log } = run;
  if (run.hasTruth || (!log.has(topic.belief) && !log.has(topic.trajectory))) return [];
  const settled = log.has(topic.trajectory);
  const lines: [string, string, boolean][] = [
    [settled ? "way settled in the end" : "way believed so far", "border-color:var(--robot)", true],
    [settled && wasMoved(run) ? "believed then, 2\u03c3" : "pose, 2\u03c3", "border-color:var(--belief);border-top-style:dashed", true],
    ["odometry alone", "border-color:var(--soft);border-top-width:1px", log.has(topic.odometry)],
    ["reference", "border-color:var(--reached);border-top-style:dotted", log.has(topic.reference)],
    ["loop closed", "border-color:var(--open);border-top-width:1.5px", loopsAt(run, Infinity).length > 0],
    ["landmark, 2\u03c3", "border-color:var(--reached)", landmarksAt(run, Infinity).length > 0],
    ["true place \u00d7", "border-color:var(--ink)", truePlaces(run).size > 0],
    [log.has(topic.scan) ? "range finder" : "sightings", "border-color:var(--failed);border-top-width:1.5px", hasSenses(run)],
    ["other robots", "border-color:var(--unreachable)", robotWays(run).length > 0]];
  return lines.filter(([, , shown]) => shown).map(([name, style]) => [name, style]);
}

function drawLine({ ctx, camera, now }: Pen, way: TimedWay): void {
  const least = camera.px(1.5);
  const until = reachedOn(way, now.t);
  let [lx, ly] = [Infinity, Infinity];
  ctx.beginPath();
  for (let i = 0; i <= until; ++i) {
    const [x, y] = way.places[i]!;
    if (i < until && Math.abs(x - lx) < least && Math.abs(y - ly) < least) continue;
    ctx.lineTo(x, y);
    [lx, ly] = [x, y];
  }
  ctx.stroke();
}

function drawLandmark({ ctx, camera }: Pen, one: Landmark): void {
  const { x, y } = one.position;
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

/** Draws the loops; those closed a moment ago stand out. */
function drawLoops(pen: Pen, run: Run, loops: Loop[]): void {
  const { ctx, camera, now } = pen;
  const moment = 0.02 * run.duration;
  ctx.strokeStyle = theme.open;
  for (const fresh of [false, true]) {
    ctx.beginPath();
    for (const { closed, from, to } of loops) {
      if ((now.t - closed < moment && now.t < run.duration) !== fresh) continue;
      ctx.moveTo(from.x, from.y);
      ctx.lineTo(to.x, to.y);
    }
    ctx.lineWidth = camera.px(fresh ? 2.6 : 1.2);
    ctx.globalAlpha = fresh || loops.length < 200 ? 0.9 : 0.45;
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
  if (loops.length > 100) return;
  ctx.lineWidth = camera.px(1.4);
  for (const { to } of loops) {
    disk(ctx, to.x, to.y, camera.px(5));
    ctx.stroke();
  }
}

function drawOthers(pen: Pen, ways: TimedWay[]): void {
  const { ctx, camera, now } = pen;
  ctx.strokeStyle = ctx.fillStyle = theme.unreachable;
  ctx.lineWidth = camera.px(1.4);
  for (const way of ways) {
    ctx.globalAlpha = 0.75;
    drawLine(pen, way);
    ctx.globalAlpha = 1;
    const at = way.places[reachedOn(way, now.t)];
    if (!at) continue;
    disk(ctx, ...at, camera.px(4));
    ctx.fill();
  }
}

function drawLandmarks(pen: Pen, run: Run, known: Landmark[]): void {
  const { ctx, camera } = pen;
  ctx.strokeStyle = theme.ink;
  ctx.lineWidth = camera.px(1.6);
  for (const { id } of known) {
    const truth = truePlaces(run).get(id);
    if (truth) drawTruth(pen, truth);
  }
  ctx.strokeStyle = ctx.fillStyle = theme.reached;
  for (const one of known) drawLandmark(pen, one);
  if (known.length > mostNamed) return;
  camera.toScreen(ctx);
  ctx.font = `11px ${theme.sans}`;
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  for (const { id, position } of known) {
    const { x, y } = camera.screen(position.x, position.y);
    label(ctx, String(id), x + 7, y - 8, theme.ink, theme.yard);
  }
}

function linesOf(run: Run, one: Landmark): string[] {
  const { major, minor } = ellipseOf(one);
  const truth = truePlaces(run).get(one.id);
  const off = truth ? [`${fixed(Math.hypot(one.position.x - truth[0], one.position.y - truth[1]), 3)} m off its true place`] : [];
  return [`landmark ${one.id}, sighted ${one.sightings} times`, `2\u03c3: ${fixed(deviations * major, 3)} m by ${fixed(deviations * minor, 3)} m`, ...off];
}

export function mapping(run: Run): Layer | null {
  if (run.hasTruth || !run.log.has(topic.belief)) return null;
  return {
    moving(pen) {
      const { ctx, camera, now } = pen;
      ctx.lineJoin = "round";
      ctx.strokeStyle = theme.soft;
      ctx.lineWidth = camera.px(0.9);
      ctx.globalAlpha = 0.75;
      drawLine(pen, odometryOf(run));
      ctx.globalAlpha = 1;
      ctx.strokeStyle = theme.reached;
      ctx.lineWidth = camera.px(1.8);
      ctx.setLineDash([camera.px(1.5), camera.px(3.5)]);
      drawLine(pen, referenceOf(run));
      ctx.setLineDash([]);
      drawOthers(pen, robotWays(run));
      drawLoops(pen, run, loopsAt(run, now.t));
      drawLandmarks(pen, run, landmarksAt(run, now.t));
    },
    find(at, { camera, now }) {
      const away = ([x, y]: Vec2): number => {
        const place = camera.screen(x, y);
        return Math.hypot(place.x - at.x, place.y - at.y);
      };
      const near = landmarksAt(run, now.t).filter((one) => away(vec2(one.position)) < 9)
        .sort((a, b) => away(vec2(a.position)) - away(vec2(b.position)))[0];
      return near ? { told: { topic: topic.landmarks, name: `landmark ${near.id}`, at: (t) => landmarksAt(run, t).find(({ id }) => id === near.id) }, lines: linesOf(run, near) } : null;
    },
  };
}
