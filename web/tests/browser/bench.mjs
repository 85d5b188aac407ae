// What the page costs: bytes and time to its first frame, and the time of a frame while one scrubs through a
// recording of 10 minutes at 20 Hz.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/tests/browser/bench.mjs
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { executable, launch } from "./browser.mjs";
import { makeFolder, serve } from "./server.mjs";

if (!executable) {
  console.log("page: skipped, Chromium is not installed");
  process.exit(0);
}
const { folder, remove } = makeFolder();
const report = JSON.parse(readFileSync(join(folder, "reports/yard.json"), "utf8"));
const round = (value) => Math.round(1e6 * value) / 1e6;
report.track = Array.from({ length: 12001 }, (_, i) => {
  const t = i / 20;
  return [t, 8 * Math.sin(t / 40), 5 * Math.sin(t / 23), t / 30, t / 10, 0.3].map(round);
});
report.events = Array.from({ length: 600 }, (_, i) => ({ time_s: i, kind: "wait", text: `waits for the ${i}th time` }));
writeFileSync(join(folder, "reports/long.json"), JSON.stringify(report));

const server = await serve(folder);
const browser = await launch();
const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, reducedMotion: "reduce" });
const session = await page.context().newCDPSession(page);
await session.send("Network.enable");
let bytes = 0;
session.on("Network.loadingFinished", (event) => { bytes += event.encodedDataLength; });

const start = Date.now();
await page.goto(`${server.url}#watch/reports/long.json?t=0`);
await page.waitForSelector(".targets tbody");
await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
console.log(`page: first frame after ${Date.now() - start} ms, ${(bytes / 1000).toFixed(0)} kB moved with a report of ${(JSON.stringify(report).length / 1000).toFixed(0)} kB`);

for (const tab of ["targets", "plots"]) {
  const times = await page.evaluate(async (name) => {
    [...document.querySelectorAll("[role=tab]")].find((one) => one.textContent.toLowerCase() === name).click();
    const slider = document.querySelector(".transport input[type=range]");
    const spent = [];
    for (let i = 0; i < 120; ++i) {
      slider.value = String(600 * (i * 0.618034 % 1));
      await new Promise((done) => requestAnimationFrame(done));
      slider.dispatchEvent(new Event("input"));
      const before = performance.now();
      await new Promise((done) => requestAnimationFrame(done));
      await new Promise((done) => { const { port1, port2 } = new MessageChannel(); port1.onmessage = done; port2.postMessage(0); });
      spent.push(performance.now() - before);
    }
    return spent.sort((a, b) => a - b);
  }, tab);
  const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(1);
  console.log(`page: a frame while scrubbing 10 minutes at 20 Hz, tab ${tab}: median ${at(0.5)} ms, 99 % within ${at(0.99)} ms`);
}
await browser.close();
await server.stop();
remove();
