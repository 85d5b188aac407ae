// The costs of the page: bytes and time to its first frame, the time of a frame while one scrubs through recordings of
// 10 minutes at 20 Hz and a long exploration, what following the robot costs, what a running mission adds, and plans while one
// drags. The browser has no graphics card: it draws the plane by itself, and space by a card made of software.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/tests/browser/bench.mjs
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { loadavg } from "node:os";
import { join } from "node:path";
import { executable, launch } from "./browser.mjs";
import { measureDragging } from "./drag.mjs";
import { measureGrowth } from "./grow.mjs";
import { makeLongExploration } from "./runs.mjs";
import { makeFolder, serve, useBuiltPage } from "./server.mjs";
import { contentsOf, fileOf, longLog } from "./streams.mjs";

if (!executable) {
  console.log("page: skipped, Chromium is not installed");
  process.exit(77);
}
const { folder, remove } = makeFolder();
const yard = await contentsOf(readFileSync(join(folder, "runs/yard/run.mcap")));
const long = { guard: longLog(yard, false), drive: longLog(yard, true) };
for (const [name, contents] of Object.entries(long)) {
  mkdirSync(join(folder, "runs", name));
  writeFileSync(join(folder, "runs", name, "run.mcap"), await fileOf(contents));
}
const { metrics } = makeLongExploration(folder);
const explored = readFileSync(join(folder, "runs/building/run.mcap"));
const scans = (await contentsOf(explored)).messages.filter(({ topic }) => topic === "/scan").length;
console.log(`page: the exploration took ${(metrics.time_s / 3600).toFixed(2)} h, ${Math.floor(5 * metrics.time_s) + 1} scans at 5 Hz; its log has ${scans} in ${(explored.length / 1e6).toFixed(1)} MB`);

const server = await serve(folder);
const browser = await launch();
const kB = (bytes) => `${(bytes / 1000).toFixed(0)} kB`;
const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** Opens a view in a browser that knows nothing yet; returns the page, the time to its first frame, and what was moved. */
async function open(hash, selector) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, reducedMotion: "reduce" });
  const page = await context.newPage();
  await useBuiltPage(page);
  const session = await context.newCDPSession(page);
  await session.send("Network.enable");
  const urls = new Map();
  const moved = { page: 0, data: 0 };
  session.on("Network.responseReceived", ({ requestId, response }) => urls.set(requestId, response.url));
  session.on("Network.loadingFinished", ({ requestId, encodedDataLength }) => {
    moved[urls.get(requestId)?.includes("/api/") ? "data" : "page"] += encodedDataLength;
  });
  const start = Date.now();
  await page.goto(server.url + hash);
  await page.waitForSelector(selector);
  await drawn(page);
  return { page, moved, first_ms: Date.now() - start };
}

/** The value below which so many of sorted ones are. */
const quantile = (sorted, share) => sorted[Math.floor(share * (sorted.length - 1))];

// As many loads as fit in the time, at most 100: of the front page, which is what everybody sees first, the most.
for (const [name, hash, selector] of [["the front page", "", ".groups"], ["a run", "#watch/runs/yard/run.mcap?t=9", ".tabbed"],
  ["a run in space", "#watch/runs/yard/run.mcap?t=9&view=3d", ".space-view canvas"], ["a plan", "#plan/maps/gallery.map", ".result"],
  ["10 minutes at 20 Hz", "#watch/runs/guard/run.mcap?t=9", ".tabbed"], ["two hours of exploration", "#watch/runs/building/run.mcap?t=9", ".tabbed"]]) {
  const times = [];
  let moved;
  const end = Date.now() + (hash === "" ? 90_000 : 20_000);
  while (times.length < 5 || (times.length < 100 && Date.now() < end)) {
    const opened = await open(hash, selector);
    times.push(opened.first_ms);
    moved = opened.moved;
    await opened.page.context().close();
  }
  times.sort((a, b) => a - b);
  console.log(`page: ${name}: first frame after ${quantile(times, 0.5)} ms (median of ${times.length}), 99 % within ${quantile(times, 0.99)} ms, at most ${times.at(-1)} ms; ${kB(moved.page)} of page and ${kB(moved.data)} of data moved`);
}

/** Times of frames in which the slider jumps about, or goes on by 0.05 s where `plays`, in order of their size. */
const scrub = (page, count, plays = false) => page.evaluate(async ([frames, on]) => {
  const slider = document.querySelector(".transport input[type=range]");
  const spent = [];
  for (let i = 0; i < frames; ++i) {
    slider.value = String(on ? 10 + 0.05 * i : Number(slider.max) * (i * 0.618034 % 1));
    await new Promise((done) => requestAnimationFrame(done));
    slider.dispatchEvent(new Event("input"));
    const before = performance.now();
    await new Promise((done) => requestAnimationFrame(done));
    await new Promise((done) => { const { port1, port2 } = new MessageChannel(); port1.onmessage = done; port2.postMessage(0); });
    spent.push(performance.now() - before);
  }
  return spent.sort((a, b) => a - b);
}, [count, plays]);

/** Processor time of the page's thread so far, ms; unlike the time on the wall it does not depend on what else runs. */
async function processor_ms(session) {
  const { metrics } = await session.send("Performance.getMetrics");
  return 1000 * metrics.find((one) => one.name === "TaskDuration").value;
}

/** Waits until the page has nothing left to do, such as reading the rest of a large file. */
async function settled(page, session) {
  for (let last = -Infinity, now = await processor_ms(session); now - last > 25; now = await processor_ms(session)) {
    last = now;
    await page.waitForTimeout(500);
  }
}

async function measureFrames(page, session, what, plays = false) {
  const before = await processor_ms(session);
  const times = await scrub(page, 120, plays);
  const spent = (await processor_ms(session) - before) / times.length;
  const at = (share) => quantile(times, share).toFixed(1);
  console.log(`page: ${what}: a frame takes ${at(0.5)} ms (median), 99 % within ${at(0.99)} ms; ${spent.toFixed(1)} ms of processor time`);
  return quantile(times, 0.5);
}

for (const [name, hash, selector] of [["guard", "tab=targets", ".tabbed"], ["guard", "tab=plots", ".tabbed"], ["guard", "view=3d", ".space-view canvas"],
  ["drive", "tab=plots", ".tabbed"], ["drive", "view=3d", ".space-view canvas"], ["building", "tab=plots", ".tabbed"],
  ["building", "view=3d", ".space-view canvas"]]) {
  const { page } = await open(`#watch/runs/${name}/run.mcap?t=0&${hash}`, selector);
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  await scrub(page, 5);
  if (name === "building") await measureFrames(page, session, `scrubbing ${name}, ${hash}, while the rest of the file is read`);
  await settled(page, session);
  await measureFrames(page, session, `scrubbing ${name}, ${hash}`);
  await page.context().close();
}
const playing = {};
for (const [name, hash] of [["standing still", ""], ["following", "&follow=1"], ["standing still in 3D", "&view=3d"], ["standing still in 3D with what was planned", "&view=3d&layers=firing+map:1,planned+tour:1"], ["following in 3D", "&view=3d&follow=1"]]) {
  const { page } = await open(`#watch/runs/yard/run.mcap?t=10${hash}`, hash.includes("3d") ? ".space-view canvas" : ".tabbed");
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  await scrub(page, 5, true);
  playing[name] = await measureFrames(page, session, `playing the yard, ${name}`, true);
  await page.context().close();
}
for (const where of ["", " in 3D"]) console.log(`page: following${where} costs ${(playing[`following${where}`] / playing[`standing still${where}`]).toFixed(2)} times as much as standing still`);
for (const [name, hash] of [["guard", "tab=targets"], ["drive", "tab=plots"], ["drive", "tab=plots&view=3d"]]) {
  await measureGrowth(browser, server, long[name], hash);
}
await measureDragging(server, folder);
console.log(`page: the load of the machine was ${loadavg()[0].toFixed(1)}`);
await browser.close();
await server.stop();
remove();
