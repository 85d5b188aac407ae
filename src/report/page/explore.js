// The page of exploring: one instant, the map as it was known then with the robot on it, and the charts.
// The address may say where to begin: #t=123

const report = JSON.parse(document.getElementById("report").textContent);
const { explore, metrics, track } = report;
const colours = { truth: "#0a6cc4", belief: "#d55e00", wall: "#e0457b", refused: "#7c4d9e", home: "#00785a" };
const largest = explore.beliefs.reduce((most, b) => Math.max(most, b.sigma_x_m, b.sigma_y_m), 1e-6);
const extent = Math.max(explore.map.columns, explore.map.rows) * explore.map.cell_m;
const enlarged = Math.max(1, Math.min(10, Math.floor(0.02 * extent / largest)));  // of the ellipses
const end = Math.max(1e-3, track.at(-1)?.[0] ?? 0, explore.beliefs.at(-1)?.time_s ?? 0);
const byId = (id) => document.getElementById(id);
const make = (tag, text) => Object.assign(document.createElement(tag), { textContent: text });
let time = Math.min(end, Number(new URLSearchParams(location.hash.slice(1)).get("t")) || 0);
let playing = false;
let before = 0;

const { columns, rows, cell_m: cellSize, origin } = explore.map;
const discovery = new Discovery(explore.map, { unknown: 0xffdad6cf, free: 0xfffbfdfd, occupied: 0xff332d26 });

const map = document.querySelector("#map canvas");
const corners = [...track.map((row) => [row[1], row[2]]), origin,
  [origin[0] + columns * cellSize, origin[1] + rows * cellSize]];
const box = [0, 1].map((axis) => corners.reduce(([low, high], p) => [Math.min(low, p[axis]), Math.max(high, p[axis])], [Infinity, -Infinity]));
let view = { x: 0, y: 0, scale: 1 };
const onMap = ([x, y]) => [view.x + view.scale * x, view.y - view.scale * y];

function fitView() {
  const ratio = devicePixelRatio || 1;
  map.width = map.clientWidth * ratio;
  map.height = map.clientHeight * ratio;
  const [width, height] = box.map(([low, high]) => high - low + 0.6);
  const scale = Math.min(map.width / width, map.height / height);
  view = { scale, x: map.width / 2 - scale * (box[0][0] + box[0][1]) / 2, y: map.height / 2 + scale * (box[1][0] + box[1][1]) / 2 };
}

/** Index of the last entry that is not later. */
function lastUntil(entries, timeOf, t) {
  let [low, high] = [0, entries.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (timeOf(entries[middle]) <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

function robotAt(t) {
  const i = lastUntil(track, (row) => row[0], t);
  if (i < 0) return report.robot.start;
  const [a, b] = [track[i], track[Math.min(i + 1, track.length - 1)]];
  const share = b[0] > a[0] ? Math.min(1, (t - a[0]) / (b[0] - a[0])) : 0;
  const turn = Math.atan2(Math.sin(b[3] - a[3]), Math.cos(b[3] - a[3]));
  return [a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2]), a[3] + share * turn];
}

function line(pen, points, colour, width) {
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.beginPath();
  points.forEach((p) => pen.lineTo(...onMap(p)));
  pen.stroke();
}

function drawEllipse(pen, belief) {
  const [xx, yy] = [belief.sigma_x_m ** 2, belief.sigma_y_m ** 2];
  const xy = belief.correlation * belief.sigma_x_m * belief.sigma_y_m;
  const [mean, half] = [(xx + yy) / 2, Math.hypot((xx - yy) / 2, xy)];
  const radius = (variance) => 2 * enlarged * view.scale * Math.sqrt(Math.max(0, variance));
  pen.beginPath();
  pen.ellipse(...onMap(belief.pose), radius(mean + half), radius(mean - half), -Math.atan2(2 * xy, xx - yy) / 2, 0, 7);
  pen.stroke();
}

function drawWalls(pen) {
  pen.strokeStyle = colours.wall;
  pen.lineWidth = 1;
  pen.beginPath();
  for (const wall of explore.walls) {
    wall.forEach((p, i) => (i === 0 ? pen.moveTo(...onMap(p)) : pen.lineTo(...onMap(p))));
    pen.closePath();
  }
  pen.stroke();
}

function drawMarks(pen) {
  for (const { position } of explore.refused) {
    const [x, y] = onMap(position);
    pen.strokeStyle = colours.refused;
    pen.lineWidth = 3;
    pen.beginPath();
    pen.moveTo(x - 5, y - 5);
    pen.lineTo(x + 5, y + 5);
    pen.moveTo(x - 5, y + 5);
    pen.lineTo(x + 5, y - 5);
    pen.stroke();
  }
  const [x, y] = onMap(report.robot.start);
  pen.fillStyle = colours.home;
  pen.fillRect(x - 6, y - 6, 12, 12);
}

function drawRobot(pen) {
  const [x, y, heading] = robotAt(time);
  const radius = Math.max(6, view.scale * report.robot.radius_m);
  pen.fillStyle = colours.truth;
  pen.strokeStyle = "#fff";
  pen.lineWidth = 2;
  pen.beginPath();
  pen.arc(...onMap([x, y]), radius, 0, 7);
  pen.fill();
  pen.stroke();
  const [px, py] = onMap([x, y]);
  pen.beginPath();
  pen.moveTo(px, py);
  pen.lineTo(px + radius * Math.cos(heading), py - radius * Math.sin(heading));
  pen.stroke();
}

function drawMap() {
  const pen = map.getContext("2d");
  pen.fillStyle = "#cfd6da";
  pen.fillRect(0, 0, map.width, map.height);
  pen.imageSmoothingEnabled = false;
  pen.drawImage(discovery.at(time), ...onMap([origin[0], origin[1] + rows * cellSize]), view.scale * columns * cellSize, view.scale * rows * cellSize);
  drawWalls(pen);
  const decision = explore.decisions[lastUntil(explore.decisions, (d) => d.time_s, time)];
  pen.setLineDash([6, 5]);
  if (decision) line(pen, decision.waypoints, colours.home, 2);
  pen.setLineDash([]);
  line(pen, track.slice(0, lastUntil(track, (row) => row[0], time) + 1).map((row) => [row[1], row[2]]), colours.truth, 2.5);
  const known = explore.beliefs.slice(0, lastUntil(explore.beliefs, (b) => b.time_s, time) + 1);
  line(pen, known.map((b) => b.pose), colours.belief, 1.5);
  const every = Math.max(1, Math.ceil(explore.beliefs.length / 60));
  pen.strokeStyle = colours.belief;
  known.forEach((belief, i) => { if (i % every === 0 || i === known.length - 1) drawEllipse(pen, belief); });
  drawMarks(pen);
  drawRobot(pen);
}

/** Lines over time from 0; those that are `filled` are, down to 0. */
function drawChart(canvas, lines, format) {
  const ratio = devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, 130];
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = "11px sans-serif";
  const most = Math.max(1e-9, ...lines.map(({ points }) => points.reduce((high, p) => Math.max(high, p[1]), 0)));
  const [top, bottom] = [16, height - 18];
  const at = ([x, y]) => [x / end * (width - 2) + 1, bottom - (bottom - top) * y / most];
  for (const { points, colour, filled } of lines) {
    pen.beginPath();
    points.forEach((p) => pen.lineTo(...at(p)));
    pen.strokeStyle = pen.fillStyle = colour;
    pen.lineWidth = 1.5;
    if (filled) {
      pen.lineTo(...at([points.at(-1)?.[0] ?? 0, 0]));
      pen.lineTo(...at([0, 0]));
      pen.globalAlpha = 0.2;
      pen.fill();
      pen.globalAlpha = 1;
    } else {
      pen.stroke();
    }
  }
  pen.fillStyle = getComputedStyle(canvas).color;
  pen.fillText(format(most), 2, 10);
  pen.fillText("0 s", 2, height - 4);
  pen.textAlign = "right";
  pen.fillText(`${Math.round(end)} s`, width - 2, height - 4);
  pen.globalAlpha = 0.5;
  pen.fillRect(at([time, 0])[0] - 0.5, top, 1, bottom - top);
}

const known = Array.from({ length: 201 }, (_, i) => [end * i / 200, discovery.area(end * i / 200)]);
const errors = explore.beliefs.map((b) => {
  const [x, y] = robotAt(b.time_s);
  return [b.time_s, Math.hypot(b.pose[0] - x, b.pose[1] - y)];
});
const bands = explore.beliefs.map((b) => [b.time_s, 2 * Math.hypot(b.sigma_x_m, b.sigma_y_m)]);

function drawCharts() {
  const [area, error] = document.querySelectorAll("#charts canvas");
  drawChart(area, [{ points: known, colour: colours.truth, filled: true }], (m2) => `${m2.toFixed(1)} m²`);
  drawChart(error, [{ points: bands, colour: colours.belief, filled: true }, { points: errors, colour: colours.truth }],
    (m) => `${(1000 * m).toFixed(0)} mm`);
}

function show() {
  drawMap();
  drawCharts();
  byId("slider").value = time;
  byId("run").textContent = playing ? "Pause" : "Play";
  byId("words").textContent = `${time.toFixed(0)} of ${end.toFixed(0)} s, ${discovery.area(time).toFixed(1)} m² known`;
  byId("event").textContent = report.events[lastUntil(report.events, (event) => event.time_s, time)]?.text ?? "";
}

function frame(now) {
  if (!playing) return;
  time = Math.min(end, time + (now - before) / 1000 * Math.max(1, end / 30));
  before = now;
  playing = time < end;
  show();
  requestAnimationFrame(frame);
}

function toggle() {
  playing = !playing;
  if (playing && time >= end) time = 0;
  before = performance.now();
  show();
  requestAnimationFrame(frame);
}

function seek(to) {
  time = Math.max(0, Math.min(end, to));
  show();
}

function fillPage() {
  byId("title").textContent = report.world.name;
  byId("verdict").textContent = report.reason || report.status;
  byId("seed").textContent = `seed ${report.seed}`;
  for (const [name, value] of Object.entries(metrics)) {
    const entry = document.createElement("div");
    entry.append(make("dt", name.replaceAll("_", " ")), make("dd", value === null ? "–" : value.toLocaleString("en")));
    byId("figures").append(entry);
  }
  for (const [name, value] of Object.entries(report.settings)) {
    document.querySelector("#settings dl").append(make("dt", name), make("dd", value));
  }
  for (const [text, colour] of [["true way, area, distance", colours.truth],
    [`believed way; ellipses of 2 standard deviations${enlarged > 1 ? `, ${enlarged} times as large` : ""}`, colours.belief],
    ["true walls", colours.wall], ["home; the way chosen", colours.home], ["frontier refused", colours.refused]]) {
    byId("keys").append(Object.assign(make("li", `■ ${text}`), { style: `color: ${colour}` }));
  }
  for (const { position, reason } of explore.refused) {
    byId("refused").append(make("li", `${position.map((x) => x.toFixed(2)).join(", ")}: ${reason}`));
  }
  if (explore.refused.length === 0) byId("refused").append(make("li", "none"));
}

fillPage();
byId("slider").max = end;
byId("slider").addEventListener("input", (event) => seek(Number(event.target.value)));
byId("run").addEventListener("click", toggle);
addEventListener("resize", () => { fitView(); show(); });
addEventListener("keydown", (event) => {
  if (event.target.closest("input, button") && event.key !== " ") return;
  const stride = event.shiftKey ? 10 : 1;
  if (event.key === " ") toggle();
  else if (event.key === "ArrowLeft") seek(time - stride);
  else if (event.key === "ArrowRight") seek(time + stride);
  else return;
  event.preventDefault();
});
fitView();
show();
