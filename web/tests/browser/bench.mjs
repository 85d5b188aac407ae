// What the page costs: bytes and time to its first frame, the time of a frame while one scrubs through recordings of
// 10 minutes at 20 Hz, what a running mission adds, and plans while one drags. The plane is measured in a browser as it
// is without a graphics card, space in one whose card is software, since there it is drawn on no other.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/tests/browser/bench.mjs
import { readFileSync, writeFileSync } from "node:fs";
import { loadavg } from "node:os";
import { join } from "node:path";
import { executable, launch, launchPlain } from "./browser.mjs";
import { measureDragging } from "./drag.mjs";
import { measureGrowth } from "./grow.mjs";
import { makeFolder, serve } from "./server.mjs";

if (!executable) {
  console.log("page: skipped, Chromium is not installed");
  process.exit(77);
}
const { folder, remove } = makeFolder();
const yard = JSON.parse(readFileSync(join(folder, "reports/yard.json"), "utf8"));
const round = (value) => Math.round(1e6 * value) / 1e6;
const row = (i) => [i / 20, 8 * Math.sin(i / 800), 5 * Math.sin(i / 460), i / 600, i / 200, 0.3].map(round);
const rows = Array.from({ length: 12001 }, (_, i) => row(i));
const events = Array.from({ length: 600 }, (_, i) => ({ time_s: i, kind: "wait", text: `waits for the ${i}th time` }));
const beliefs = rows.map(([time_s, x, y, heading], i) => ({ time_s, pose: [x + 0.02 * Math.sin(i / 90), y, heading].map(round),
  sigma_x_m: 0.03, sigma_y_m: 0.02, correlation: 0.2, sigma_rad: 0.01, corrected: i % 40 < 20 }));
const tags = Array.from({ length: 8 }, (_, id) => ({ id, position: [2.2 * id - 8, 6.5], facing_rad: -1.5708, size_m: 0.2, height_m: 0.4 }));
const write = (name, report) => writeFileSync(join(folder, `reports/${name}.json`), JSON.stringify(report));
const long = { guard: { ...yard, track: rows, events },
  drive: { ...yard, job: "drive", targets: [], shots: [], track: rows, events, drive: { loop: "closed", tags, stops: [], beliefs } } };
for (const [name, report] of Object.entries(long)) write(name, report);

const server = await serve(folder);
const browsers = { plane: await launchPlain(), space: await launch() };
const browserFor = (hash) => (hash.includes("view=3d") ? browsers.space : browsers.plane);
const kB = (bytes) => `${(bytes / 1000).toFixed(0)} kB`;
const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** Opens a view in a browser that knows nothing yet; returns the page, the time to its first frame, and what was moved. */
async function open(hash, selector) {
  const context = await browserFor(hash).newContext({ viewport: { width: 1280, height: 720 }, reducedMotion: "reduce" });
  const page = await context.newPage();
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

for (const [name, hash, selector] of [["files", "", ".groups"], ["a report", "#watch/reports/yard.json?t=9", ".tabbed"],
  ["a report in space", "#watch/reports/yard.json?t=9&view=3d", ".space-view canvas"], ["a plan", "#plan/maps/gallery.map", ".result"],
  ["10 minutes at 20 Hz", "#watch/reports/guard.json?t=9", ".tabbed"]]) {
  const times = [];
  let moved;
  for (let i = 0; i < 3; ++i) {
    const opened = await open(hash, selector);
    times.push(opened.first_ms);
    moved = opened.moved;
    await opened.page.context().close();
  }
  console.log(`page: ${name}: first frame after ${times.sort((a, b) => a - b)[1]} ms (median of 3), ${kB(moved.page)} of page and ${kB(moved.data)} of data moved`);
}

/** Times of frames in which the slider jumps about, in order of their size. */
const scrub = (page, count) => page.evaluate(async (frames) => {
  const slider = document.querySelector(".transport input[type=range]");
  const spent = [];
  for (let i = 0; i < frames; ++i) {
    slider.value = String(600 * (i * 0.618034 % 1));
    await new Promise((done) => requestAnimationFrame(done));
    slider.dispatchEvent(new Event("input"));
    const before = performance.now();
    await new Promise((done) => requestAnimationFrame(done));
    await new Promise((done) => { const { port1, port2 } = new MessageChannel(); port1.onmessage = done; port2.postMessage(0); });
    spent.push(performance.now() - before);
  }
  return spent.sort((a, b) => a - b);
}, count);

/** Processor time of the page's thread so far, ms; unlike the time on the wall it does not depend on what else runs. */
async function processor_ms(session) {
  const { metrics } = await session.send("Performance.getMetrics");
  return 1000 * metrics.find((one) => one.name === "TaskDuration").value;
}

for (const [name, hash, selector] of [["guard", "tab=targets", ".tabbed"], ["guard", "tab=plots", ".tabbed"], ["guard", "view=3d", ".space-view canvas"],
  ["drive", "tab=plots", ".tabbed"], ["drive", "view=3d", ".space-view canvas"]]) {
  const { page } = await open(`#watch/reports/${name}.json?t=0&${hash}`, selector);
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  await scrub(page, 5);
  const before = await processor_ms(session);
  const times = await scrub(page, 120);
  const spent = (await processor_ms(session) - before) / times.length;
  const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(1);
  console.log(`page: scrubbing 10 minutes at 20 Hz, ${name}, ${hash}: a frame takes ${at(0.5)} ms (median), 99 % within ${at(0.99)} ms; ${spent.toFixed(1)} ms of processor time`);
  await page.context().close();
}
for (const [name, hash] of [["guard", "tab=targets"], ["drive", "tab=plots"], ["drive", "tab=plots&view=3d"]]) {
  await measureGrowth(browserFor(hash), server, long[name], hash);
}
await measureDragging(server, folder);
console.log(`page: the load of the machine was ${loadavg()[0].toFixed(1)}`);
for (const browser of Object.values(browsers)) await browser.close();
await server.stop();
remove();
