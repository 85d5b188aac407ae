// The page of a pursuit: one second, the map with everybody on it, and the charts that show it.
// The address may say where to begin: #t=123

const report = JSON.parse(document.getElementById("report").textContent);
const { chase, metrics } = report;
const colours = { target: "#c2185b", bound: "#00a07a", wall: [63, 69, 75] };
const robotColours = ["#0a6cc4", "#d55e00", "#009e73", "#7c4d9e", "#56b4e9", "#333333"];
const end = Math.max(0, ...chase.robots.map((way) => way.length - 1));
const byId = (id) => document.getElementById(id);
let time = Math.min(end, Number(new URLSearchParams(location.hash.slice(1)).get("t")) || 0);
let playing = false;
let before = 0;

function paintMap() {
  const image = new ImageData(chase.columns, chase.rows);
  const runs = chase.cost_runs;
  let [least, most] = [Infinity, 0];
  for (let i = 0; i < runs.length; i += 2) {
    if (runs[i] < 0) continue;
    least = Math.min(least, runs[i]);
    most = Math.max(most, runs[i]);
  }
  const span = Math.log1p(most) - Math.log1p(least) || 1;
  let at = 0;
  for (let i = 0; i < runs.length; i += 2) {
    const share = (Math.log1p(runs[i]) - Math.log1p(least)) / span;
    const colour = runs[i] < 0 ? colours.wall : [251 - 126 * share, 250 - 158 * share, 245 - 205 * share];
    for (let n = 0; n < runs[i + 1]; n += 1, at += 1) {
      const row = chase.rows - 1 - Math.floor(at / chase.columns);
      image.data.set([...colour, 255], 4 * (row * chase.columns + (at % chase.columns)));
    }
  }
  const canvas = document.createElement("canvas");
  canvas.width = chase.columns;
  canvas.height = chase.rows;
  canvas.getContext("2d").putImageData(image, 0, 0);
  return canvas;
}

const ground = paintMap();
const map = document.querySelector("#map canvas");
const scale = Math.max(1, Math.round(1000 / Math.max(chase.columns, chase.rows)));
map.width = scale * chase.columns;
map.height = scale * chase.rows;
map.style.setProperty("--shape", `${chase.columns} / ${chase.rows}`);

const low = report.world.bounds[0];
const onMap = ([x, y]) => [(x - low[0]) / chase.cell_m * scale, map.height - (y - low[1]) / chase.cell_m * scale];

/** Where someone is between two seconds. */
function position(way, t) {
  const s = Math.min(Math.floor(t), way.length - 1);
  const next = way[Math.min(s + 1, way.length - 1)];
  const share = Math.min(1, t - s);
  return way[s].map((value, axis) => value + share * (next[axis] - value));
}

function drawWay(pen, way, colour, until, faint) {
  const line = (points) => {
    pen.beginPath();
    points.forEach((point) => pen.lineTo(...onMap(point)));
    pen.stroke();
  };
  pen.strokeStyle = colour;
  pen.lineWidth = 3;
  if (faint) {
    pen.globalAlpha = 0.3;
    line(way);
    pen.globalAlpha = 1;
  }
  line([...way.slice(0, Math.floor(until) + 1), position(way, until)]);
  pen.fillStyle = colour;
  pen.strokeStyle = "#fff";
  pen.lineWidth = 2;
  pen.beginPath();
  pen.arc(...onMap(position(way, until)), 8, 0, 7);
  pen.fill();
  pen.stroke();
}

function drawMap() {
  const pen = map.getContext("2d");
  pen.imageSmoothingEnabled = false;
  pen.drawImage(ground, 0, 0, map.width, map.height);
  drawWay(pen, chase.target, colours.target, time, true);
  chase.robots.forEach((way, i) => drawWay(pen, way, robotColours[i % robotColours.length], time, true));
}

/** Lines from 0; `now` marks a place on the axis. */
function drawChart(canvas, lines, unit, now) {
  const ratio = devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, 150];
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = "11px sans-serif";
  const points = lines.flatMap((line) => line.points);
  const mostX = Math.max(1e-9, ...points.map((p) => p[0]));
  const mostY = Math.max(1e-9, ...points.map((p) => p[1]));
  const [top, bottom] = [16, height - 18];
  const at = ([x, y]) => [x / mostX * (width - 2) + 1, bottom - (bottom - top) * y / mostY];
  for (const { points: corners, colour } of lines) {
    pen.strokeStyle = colour;
    pen.lineWidth = 2;
    pen.beginPath();
    corners.forEach((corner) => pen.lineTo(...at(corner)));
    pen.stroke();
    if (corners.length !== 1) continue;
    pen.fillStyle = colour;
    pen.fillRect(at(corners[0])[0] - 6, at(corners[0])[1] - 3, 6, 6);
  }
  pen.fillStyle = getComputedStyle(canvas).color;
  pen.fillText(Math.round(mostY).toLocaleString("en"), 2, 10);
  pen.fillText(`0 ${unit}`, 2, height - 4);
  pen.textAlign = "right";
  pen.fillText(`${Math.round(mostX).toLocaleString("en")} ${unit}`, width - 2, height - 4);
  if (now === undefined) return;
  pen.globalAlpha = 0.5;
  pen.fillRect(at([now, 0])[0] - 0.5, top, 1, bottom - top);
}

/** A staircase: each value holds until the next. */
function steps(column, value, last) {
  const corners = [];
  for (const bound of chase.bounds) {
    if (bound[column] === null || bound[value] === null) continue;
    const before = corners.at(-1);
    if (before && before[0] === bound[column] && before[1] === bound[value]) continue;
    if (before) corners.push([bound[column], before[1]]);
    corners.push([bound[column], bound[value]]);
  }
  if (last !== undefined && corners.length > 0) corners.push([last, corners.at(-1)[1]]);
  return corners;
}

function drawCharts() {
  const [mission, planning] = document.querySelectorAll("#charts canvas");
  drawChart(mission, [
    { colour: robotColours[0], points: chase.paid.map((paid, s) => [s, paid]) },
    { colour: colours.target, points: steps(0, 2, end) },
    { colour: colours.bound, points: steps(0, 3, end) },
  ], "s", time);
  drawChart(planning, [
    { colour: colours.target, points: steps(1, 2) },
    { colour: colours.bound, points: steps(1, 3) },
  ], "expansions");
}

function show() {
  drawMap();
  drawCharts();
  byId("slider").value = time;
  byId("run").textContent = playing ? "Pause" : "Play";
  const paid = chase.paid[Math.min(Math.floor(time), chase.paid.length - 1)] ?? 0;
  byId("words").textContent = `${time.toFixed(0)} of ${end} s, paid ${paid.toLocaleString("en")}`;
}

function frame(now) {
  if (!playing) return;
  time = Math.min(end, time + (now - before) / 1000 * Math.max(1, end / 20));
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

byId("title").textContent = report.world.name;
byId("verdict").textContent = report.status === "done" ? `caught in second ${metrics.catch_time_s}` : report.reason;
byId("seed").textContent = `seed ${report.seed}`;
for (const [name, value] of Object.entries(metrics)) {
  const entry = document.createElement("div");
  for (const [tag, text] of [["dt", name.replaceAll("_", " ")], ["dd", value === null ? "–" : value.toLocaleString("en")]]) {
    entry.append(Object.assign(document.createElement(tag), { textContent: text }));
  }
  byId("figures").append(entry);
}
for (const [name, value] of Object.entries(report.settings)) {
  for (const [tag, text] of [["dt", name], ["dd", value]]) {
    document.querySelector("#settings dl").append(Object.assign(document.createElement(tag), { textContent: text }));
  }
}
for (const [text, colour] of [["target, best catch known", colours.target], ["robot, paid", robotColours[0]],
  ["lower bound", colours.bound]]) {
  byId("keys").append(Object.assign(document.createElement("li"), { textContent: `■ ${text}`, style: `color: ${colour}` }));
}
byId("slider").max = end;
byId("slider").addEventListener("input", (event) => seek(Number(event.target.value)));
byId("run").addEventListener("click", toggle);
addEventListener("resize", show);
addEventListener("keydown", (event) => {
  if (event.target.closest("input, button") && event.key !== " ") return;
  if (event.key === " ") toggle();
  else if (event.key === "ArrowLeft") seek(time - 1);
  else if (event.key === "ArrowRight") seek(time + 1);
  else return;
  event.preventDefault();
});
show();
