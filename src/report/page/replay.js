// The page: one time, one selected shot and target, and the views that show them.
// The address may say where to begin: #t=123&shot=4&theme=dark

const wanted = new URLSearchParams(location.hash.slice(1));
const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
const nightly = matchMedia("(prefers-color-scheme: dark)");
const selected = { shot: null, target: null };
let queued = false;
let before = 0;

function invalidate() {
  if (queued) return;
  queued = true;
  requestAnimationFrame(frame);
}

function frame(now) {
  queued = false;
  transport.advance((now - before) / 1000);
  before = now;
  follow();
  plan.draw({ t: transport.t, ...selected, speed: transport.playing && !calm ? transport.speed : 0 });
  side.draw(transport.t);
  levels.draw(transport.t);
  table.show(transport.t, selected.target);
  transport.show(selected.shot);
  if (transport.playing) invalidate();
}

/** While playing, the side view shows the shot that was fired last. */
function follow() {
  if (!transport.playing) return;
  const last = shots.findLast((shot) => shot.time_s <= transport.t);
  if (last && last !== follow.last) choose(last, targets.find((target) => target.name === last.target));
  follow.last = last;
}

function choose(shot, target) {
  selected.shot = shot ?? null;
  selected.target = target ?? null;
  side.select(selected.shot, selected.target);
  if (target) table.reveal(target);
  invalidate();
}

function selectShot(shot) {
  choose(shot, targets.find((target) => target.name === shot.target));
  follow.last = shot;
  transport.seek(shot.time_s);
}

/** Again and again: the target's shots in turn, the last one first. */
function selectTarget(target) {
  const { fired } = target;
  if (fired.length === 0) { choose(null, target); return; }
  const shown = fired.indexOf(selected.shot);
  selectShot(fired[shown < 0 ? fired.length - 1 : (shown + 1) % fired.length]);
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  readTheme();
}

function fillHeader() {
  document.getElementById("title").textContent = `${report.job}: ${world.name}`;
  const done = report.status === "done";
  const verdict = element("b", done ? "Done." : "Not done.", done ? {} : { class: "not" });
  document.getElementById("verdict").append(verdict, " ", report.reason);
  document.getElementById("verdict").title = report.reason;
  document.getElementById("seed").textContent = `seed ${seed}`;
  const place = document.getElementById("figures");
  for (const [name, number] of Object.entries(report.metrics)) {
    const { label, value, unit: symbol } = metric(name, number);
    const row = element("div");
    const figure = element("dd", value);
    if (symbol) figure.append(element("small", symbol));
    row.append(element("dt", label), figure);
    place.append(row);
  }
}

function fillFooter() {
  const warnings = document.getElementById("warnings");
  const count = report.warnings.length;
  warnings.hidden = count === 0;
  warnings.querySelector("summary").textContent = count === 1 ? "1 warning" : `${count} warnings`;
  warnings.querySelector("ul").append(...report.warnings.map((text) => element("li", text)));
  const settings = document.getElementById("settings");
  const entries = Object.entries(report.settings);
  settings.hidden = entries.length === 0;
  settings.querySelector("summary").textContent = `${entries.length} settings`;
  settings.querySelector("dl").append(...entries.map(([name, value]) => {
    const row = element("div");
    row.append(element("dt", name.replaceAll("_", " ")), element("dd", value));
    return row;
  }));
}

setTheme(wanted.get("theme") ?? (nightly.matches ? "dark" : "light"));
nightly.addEventListener("change", () => { setTheme(nightly.matches ? "dark" : "light"); invalidate(); });
document.getElementById("theme").addEventListener("click", () => {
  setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
  invalidate();
});
fillHeader();
fillFooter();
const plan = new PlanView(document.getElementById("plan"), { redraw: invalidate, selectShot, selectTarget });
const side = new SideView(document.getElementById("side"), { redraw: invalidate });
const table = new TargetTable(document.getElementById("targets"), { selectTarget });
const levels = new Levels(document.getElementById("levels"));
const transport = new Transport(document.getElementById("transport"), { change: invalidate, selectShot });

const first = shots[Number(wanted.get("shot") ?? 1) - 1] ?? shots[0];
choose(first, targets.find((target) => target.name === first?.target) ?? targets[0]);
if (wanted.has("t")) transport.seek(Number(wanted.get("t")) || 0);
else if (wanted.has("shot") && first) transport.seek(first.time_s);
else if (!calm) transport.toggle(true);
