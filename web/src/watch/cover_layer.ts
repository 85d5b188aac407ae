// Covering: the area, what of it is out of reach, the track as it was planned, the strip covered so far, what was missed.
import { Path, type Ink } from "../base/ink";
import { clockText } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import { theme, type Colour } from "../base/theme";
import { barComesOver } from "../log/bar";
import { coverOf, type Cover, type Pass } from "../log/cover";
import type { Outlines } from "../log/geometry";
import type { Run } from "../log/run";
import { lastNotAfter } from "../log/track";
import { comesOver, Way } from "../log/way";
import { areaOf } from "./area";
import { BarStrip } from "./bar_strip";
import { drawUnion } from "./ground_layer";
import { label, type Layer, type Pen } from "./layer";
import { Strip, type LinePen, type Painter } from "./strip";

export type Role = Pass["role"];
export const roleColours: Record<Role, Colour> = { lap: "belief", lane: "water", move: "robot" };
export const coveredAlpha = 0.3;

/** m2, by the orientation of the outlines: those of holes count less than nothing. */
export function areaOfOutlines(outlines: Outlines): number {
  const doubled = (ring: Vec2[]): number => ring.reduce((sum, [x, y], i) => {
    const [u, v] = ring[(i + 1) % ring.length]!;
    return sum + x * v - u * y;
  }, 0);
  return outlines.reduce((sum, ring) => sum + doubled(ring) / 2, 0);
}

/** Outlines as a path; filled together with others, those of the other orientation take away. */
export function pathOf(...all: Outlines[]): Path {
  const path = new Path();
  for (const ring of all.flat()) {
    ring.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
    path.closePath();
  }
  return path;
}

export const turnedRound = (outlines: Outlines): Outlines => outlines.map((ring) => [...ring].reverse());

/** Returns true if a relevant part of the area is out of reach. */
const reachesLess = ({ area, reach }: Cover): boolean => areaOfOutlines(area) - areaOfOutlines(reach) > 1e-4 * areaOfOutlines(area);

export const outOfReach = (cover: Cover): Path | null => (reachesLess(cover) ? pathOf(cover.area, turnedRound(cover.reach)) : null);

/** The pass that goes on at t; none in the end. */
export function passAt({ passes }: Cover, t: number): Pass | undefined {
  return passes.find((one) => one.start <= t && t < one.end);
}

/** Returns true if a place is in an area, by the even-odd rule. */
export function within(outlines: Outlines, x: number, y: number): boolean {
  let inside = false;
  for (const ring of outlines) {
    ring.forEach(([ax, ay], i) => {
      const [bx, by] = ring[(i + 1) % ring.length]!;
      if (ay > y !== by > y && x < ax + ((bx - ax) * (y - ay)) / (by - ay)) inside = !inside;
    });
  }
  return inside;
}

/** Returns what happened to a place of the area. */
export function storyOf(run: Run, cover: Cover, x: number, y: number): string | null {
  if (!within(cover.area, x, y)) return null;
  const times = cover.bar ? barComesOver(cover.bar, run.track, x, y) : comesOver(run.track, x, y, cover.width / 2);
  if (times.length === 0) return within(cover.reach, x, y) ? "missed" : "out of reach";
  const more = times.length > 3 ? `, and ${times.length - 3} times more` : "";
  return `covered at ${times.slice(0, 3).map((t) => clockText(t)).join(", ")}${more}`;
}

const roles = Object.keys(roleColours) as Role[];

/** The way, with a corner wherever a pass begins. */
export const wayOf = (run: Run, { passes }: Cover): Way => new Way(run.track, passes.map((one) => one.start));

/** Returns a painter of the covered strip. */
export const stripOf = (run: Run, way: Way, { bar, width }: Cover): Painter => (bar ? new BarStrip(run.track, bar) : new Strip(way, [(ctx) => {
  ctx.strokeStyle = theme.reached;
  ctx.lineWidth = width;
}]));

/** The way in the colours of its roles. */
function rolesOf(way: Way, { passes, width }: Cover): Strip {
  const starts = passes.map((one) => one.start);
  const kinds = way.time.map((t, i) => {
    const middle = (t + (way.time[i + 1] ?? t)) / 2;
    return roles.indexOf(passes[lastNotAfter(starts, middle)]?.role ?? "move");
  });
  return new Strip(way, roles.map((role): LinePen => (ctx, px) => {
    ctx.strokeStyle = theme[roleColours[role]];
    ctx.lineWidth = Math.min(1.8 * px, width / 5);
    ctx.setLineDash(role === "move" ? [2 * px, 4 * px] : []);
  }), (leg) => kinds[leg]!);
}

function drawRole({ ctx, camera, now }: Pen, run: Run, role: Role): void {
  const at = run.track.at(now.t);
  const { x, y } = camera.screen(at.x, at.y);
  const above = Math.max(9, camera.scale * run.radius);
  camera.toScreen(ctx);
  ctx.font = `600 11.5px ${theme.sans}`;
  ctx.textAlign = "center";
  ctx.textBaseline = "bottom";
  label(ctx, role, x, y - above - 3, theme[roleColours[role]], theme.yard);
}

export function cover(run: Run): Layer | null {
  const found = coverOf(run);
  if (!found) return null;
  const way = wayOf(run, found);
  const [strip, line] = [stripOf(run, way, found), rolesOf(way, found)];
  const [x0, y0, x1, y1] = areaOf(run);
  const around = pathOf([[[x0, y0], [x1, y0], [x1, y1], [x0, y1]]], turnedRound(found.area));
  const [border, missed, overlap] = [pathOf(found.area), pathOf(found.missed), pathOf(found.overlap)];
  const out = outOfReach(found);
  const planned = new Path();
  for (const [x, y] of found.planned) planned.lineTo(x, y);

  /** Until now: painted where there is a canvas to keep, else drawn as lines. */
  function show(what: Painter, { ctx, camera, now }: Pen): void {
    ctx.save();
    if (ctx === camera.ctx) {
      const { width, height } = ctx.canvas;
      const view = { size: [width, height] as Vec2, name: String(camera.version), px: camera.px(1), toPlane: (one: Ink) => camera.toPlane(one) };
      const picture = what.paint(now.t, view, theme.reached);
      ctx.setTransform(1, 0, 0, 1, 0, 0);
      ctx.drawImage(picture, 0, 0);
    } else what.draw(ctx, camera.px(1), now.t);
    ctx.restore();
  }

  return {
    still(pen) {
      const { ctx, camera } = pen;
      ctx.fillStyle = theme["solid-low"];
      ctx.fill(around);
      if (out) drawUnion(pen, out);
      ctx.lineJoin = "round";
      ctx.strokeStyle = theme.soft;
      ctx.lineWidth = camera.px(0.6);
      ctx.stroke(planned);
      ctx.strokeStyle = theme["solid-high"];
      ctx.lineWidth = camera.px(1.6);
      ctx.stroke(border);
    },
    moving(pen) {
      const { ctx, camera, now } = pen;
      ctx.globalAlpha = coveredAlpha;
      show(strip, pen);
      const pass = passAt(found, now.t);
      if (!pass) {
        ctx.fillStyle = theme.reached;
        ctx.fill(overlap);
        ctx.fillStyle = ctx.strokeStyle = theme.failed;
        ctx.globalAlpha = 1;
        ctx.lineWidth = camera.px(0.8);  // so that slivers are seen
        ctx.fill(missed);
        ctx.stroke(missed);
      }
      ctx.globalAlpha = 1;
      show(line, pen);
      if (pass) drawRole(pen, run, pass.role);
    },
    find(at, { camera }) {
      const { x, y } = camera.plane(at);
      const story = storyOf(run, found, x, y);
      return story ? { lines: [story] } : null;
    },
  };
}

/** Names of what is drawn, with the style of a line or of a swatch. */
export function coverLegend(run: Run): { name: string; style: string; swatch?: boolean }[] {
  const found = coverOf(run);
  if (!found) return [];
  const lines = roles.filter((role) => found.passes.some((one) => one.role === role))
    .map((role) => ({ name: role, style: `border-color:var(--${roleColours[role]})${role === "move" ? ";border-top-style:dotted" : ""}` }));
  const swatch = (name: string, colour: Colour, opacity = 1) => ({ name, style: `background:var(--${colour});opacity:${opacity}`, swatch: true });
  return [swatch("covered", "reached", coveredAlpha + 0.1),
    ...(found.overlap.length > 0 ? [swatch("overlap, in the end", "reached", 2 * coveredAlpha)] : []),
    ...lines, { name: "planned", style: "border-color:var(--soft);border-top-width:1px" },
    ...(found.missed.length > 0 ? [swatch("missed, in the end", "failed")] : []),
    ...(reachesLess(found) ? [{ name: "out of reach", style: "background:repeating-linear-gradient(135deg,var(--inflated) 0 1.5px,transparent 1.5px 4px)", swatch: true }] : [])];
}
