// The report, and what it says about any instant of the run.

const reportText = document.getElementById("report").textContent;
const report = JSON.parse(reportText);
const seed = reportText.match(/"seed": ?(\d+)/)?.[1] ?? "unknown";  // as text: it may exceed 2^53
const { world, robot, shots, targets, events } = report;

const finite = (value, otherwise = 0) => (Number.isFinite(value) ? value : otherwise);
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
const mix = (a, b, share) => a + (b - a) * share;

// Columns of the track; angles run on past pi, so that they interpolate the shorter way.
const track = (() => {
  const rows = report.track.length
    ? report.track
    : [[0, ...robot.start.map((value) => finite(value)), finite(robot.start[2]), 0]];
  const columns = Array.from({ length: 6 }, (_, k) => Float64Array.from(rows, (row) => finite(row[k])));
  for (const angle of [columns[3], columns[4]]) {
    for (let i = 1; i < angle.length; ++i) {
      angle[i] -= 2 * Math.PI * Math.round((angle[i] - angle[i - 1]) / (2 * Math.PI));
    }
  }
  const [time, x, y, heading, yaw, pitch] = columns;
  return { time, x, y, heading, yaw, pitch, length: rows.length };
})();

/** The last index whose time is not after t, and the share of the way to the next. */
function placeInTrack(t) {
  let low = 0;
  let high = track.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (track.time[middle] <= t) low = middle;
    else high = middle - 1;
  }
  const next = Math.min(low + 1, track.length - 1);
  const span = track.time[next] - track.time[low];
  return { index: low, next, share: span > 0 ? clamp((t - track.time[low]) / span, 0, 1) : 0 };
}

function robotAt(t) {
  const { index, next, share } = placeInTrack(t);
  const at = (column) => mix(column[index], column[next], share);
  return { x: at(track.x), y: at(track.y), heading: at(track.heading), yaw: at(track.yaw), pitch: at(track.pitch) };
}

shots.forEach((shot, index) => {
  shot.index = index;
  shot.time_s = finite(shot.time_s);
  shot.end_s = shot.time_s + finite(shot.flight_s);
  const [vx, vy, vz] = shot.velocity_mps.map((value) => finite(value));
  shot.across = Math.hypot(vx, vy);  // m/s along the ground
  shot.up = vz;
  shot.from = shot.muzzle.map((value) => finite(value));
  shot.to = shot.contact_point.map((value, k) => finite(value, shot.from[k]));
  shot.path = shot.path?.map((point) => point.map((value) => finite(value)));
  shot.along = Math.hypot(shot.to[0] - shot.from[0], shot.to[1] - shot.from[1]);
});

/** Centre of the ball `tau` seconds after the muzzle: on the path of a shot in air, else on the line to the
 *  contact, at the parabola's height. */
function ballAt(shot, tau) {
  const share = shot.end_s > shot.time_s ? tau / (shot.end_s - shot.time_s) : 1;
  if (shot.path?.length > 1) {
    const steps = shot.path.length - 1;
    const step = clamp(Math.floor(share * steps), 0, steps - 1);
    const [x, y, z] = [0, 1, 2].map((k) => mix(shot.path[step][k], shot.path[step + 1][k], share * steps - step));
    const [dx, dy] = [shot.to[0] - shot.from[0], shot.to[1] - shot.from[1]];
    return { x, y, z, s: ((x - shot.from[0]) * dx + (y - shot.from[1]) * dy) / (shot.along || 1) };
  }
  return {
    x: mix(shot.from[0], shot.to[0], share),
    y: mix(shot.from[1], shot.to[1], share),
    z: shot.from[2] + shot.up * tau - 0.5 * world.gravity_mps2 * tau * tau,
    s: shot.across * tau,
  };
}

const duration = Math.max(
  1e-3,
  track.time[track.length - 1],
  ...shots.map((shot) => shot.end_s),
  ...events.map((event) => finite(event.time_s)),
);

targets.forEach((target) => {
  target.end_s = finite(target.done_s, duration);
  target.fired = shots.filter((shot) => shot.target === target.name);
});
function statusAt(target, t) {
  if (t >= target.end_s - 1e-9) return target.status;
  return t < finite(target.visit?.enters_s) ? "outside" : "waiting";
}

/** How far from its place a target is at t; null when it is not in the yard: intruders come and go. */
function offsetAt(target, t) {
  const { visit } = target;
  const gone = target.status === "reached" && t > target.end_s + 4;
  if (visit && (t < visit.enters_s || gone)) return null;
  const at = placeAt(target, t);
  return [0, 1].map((k) => at[k] - finite(target.centre[k]));
}

/** Where a target is at t: on its way in, in its place, or moving about. */
function placeAt(target, t) {
  const { visit, moves, centre } = target;
  const knots = (moves ?? []).map((move) => ({ t: finite(move.time_s), at: move.position }));
  const first = knots[0]?.at ?? centre.map((value) => finite(value));
  if (visit) knots.unshift({ t: visit.enters_s, at: visit.from }, { t: visit.settles_s, at: first });
  return alongAt(knots, t) ?? first;
}

/** Where the robot takes a target that walks about to be at t; null when it is right. */
function beliefAt(target, t) {
  const moves = target.moves ?? [];
  if (t > target.end_s || !moves.some((m) => m.believed.some((value, k) => value !== m.position[k]))) return null;
  return alongAt(moves.map((move) => ({ t: finite(move.time_s), at: move.believed })), t);
}

/** The place at t between knots in the order of time; null when there are none. */
function alongAt(knots, t) {
  if (!knots.length) return null;
  const next = knots.findIndex((knot) => knot.t > t);
  if (next < 0) return knots[knots.length - 1].at;
  if (next === 0) return knots[0].at;
  const [a, b] = [knots[next - 1], knots[next]];
  const share = b.t > a.t ? (t - a.t) / (b.t - a.t) : 1;
  return [0, 1].map((k) => a.at[k] + share * (b.at[k] - a.at[k]));
}

/** The last event that has happened at t. */
function eventAt(t) {
  let found = null;
  for (const event of events) {
    if (finite(event.time_s) <= t + 1e-9) found = event;
  }
  return found;
}

// Numbers for people.

const minus = (text) => text.replace("-", "\u2212");
const fixed = (value, digits) => (Number.isFinite(value) ? minus(value.toFixed(digits)) : "\u2013");
const figures = (value) => fixed(value, Math.abs(value) >= 100 ? 0 : Math.abs(value) >= 10 ? 1 : 2);
const degrees = (radians, digits = 1) => fixed((radians * 180) / Math.PI, digits) + "\u00b0";

function clockText(seconds, digits = 0) {
  if (!Number.isFinite(seconds)) return "\u2013";
  const whole = Number(seconds.toFixed(digits));
  const rest = (whole % 60).toFixed(digits).padStart(digits ? digits + 3 : 2, "0");
  return `${Math.floor(whole / 60)}:${rest}`;
}

/** A metric's label, value and unit from its name: mission_s, driven_m, turned_rad, ... */
function metric(name, value) {
  const [, stem, unit] = name.match(/^(.*?)(?:_(s|m|rad|mps))?$/);
  const label = stem.replaceAll("_", " ");
  if (!Number.isFinite(value)) return { label, value: "\u2013", unit: "" };
  if (unit === "s" && value >= 100) return { label, value: clockText(value), unit: "min" };
  if (unit === "s") return { label, value: figures(value), unit: "s" };
  if (unit === "m") return { label, value: figures(value), unit: "m" };
  if (unit === "mps") return { label, value: figures(value), unit: "m/s" };
  if (unit === "rad") return { label, value: figures(value / (2 * Math.PI)), unit: "turns" };
  return { label, value: Number.isInteger(value) ? minus(String(value)) : figures(value), unit: "" };
}

/** An element with text; what a report says never becomes markup. */
function element(tag, text = "", attributes = {}) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

// Colours and signs shared by all views.

const theme = {};
function readTheme() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ground", "panel", "yard", "ink", "soft", "line", "grid", "solid-low", "solid-high",
    "inflated", "robot", "water", "waiting", "reached", "failed", "unreachable", "on-mark", "sans", "mono"]) {
    theme[name] = style.getPropertyValue("--" + name).trim();
  }
}

/** Signs of radius 1, y down: an outline to fill and a stroke inside it. Shape tells what colour tells. */
const signs = {
  waiting: { outline: "M-.8 0a.8 .8 0 1 0 1.6 0a.8 .8 0 1 0-1.6 0z", stroke: "", hollow: true },
  reached: { outline: "M-1 0a1 1 0 1 0 2 0a1 1 0 1 0-2 0z", stroke: "M-.45 .02L-.1 .38L.48-.36" },
  failed: { outline: "M0-1.28L1.28 0L0 1.28L-1.28 0z", stroke: "M-.38-.38L.38 .38M-.38 .38L.38-.38" },
  unreachable: { outline: "M-.95-.95H.95V.95H-.95z", stroke: "M-.5 0H.5" },
};
const known = (status) => (Object.hasOwn(signs, status) ? status : "waiting");
const signOf = (status) => signs[known(status)];
const statusColour = (status) => theme[known(status)];

function drawSign(ctx, status, x, y, radius) {
  const sign = signOf(status);
  ctx.save();
  ctx.translate(x, y);
  ctx.scale(radius, radius);
  ctx.lineCap = ctx.lineJoin = "round";
  const outline = new Path2D(sign.outline);
  ctx.strokeStyle = theme.yard;
  ctx.lineWidth = sign.hollow ? 0.9 : 0.5;
  ctx.stroke(outline);
  ctx.fillStyle = sign.hollow ? theme.yard : statusColour(status);
  ctx.fill(outline);
  ctx.strokeStyle = sign.hollow ? statusColour(status) : theme["on-mark"];
  ctx.lineWidth = 0.32;
  ctx.stroke(sign.hollow ? outline : new Path2D(sign.stroke));
  ctx.restore();
}

function signElement(status) {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("class", "mark");
  svg.setAttribute("viewBox", "-1.1 -1.1 2.2 2.2");
  svg.setAttribute("aria-hidden", "true");
  const sign = signOf(status);
  for (const [d, style] of [
    [sign.outline, sign.hollow ? `fill:none;stroke:var(--waiting);stroke-width:.32` : `fill:var(--${known(status)})`],
    [sign.stroke, "fill:none;stroke:var(--on-mark);stroke-width:.32"],
  ]) {
    if (!d) continue;
    const path = document.createElementNS(space, "path");
    path.setAttribute("d", d);
    path.setAttribute("style", style);
    svg.append(path);
  }
  return svg;
}

