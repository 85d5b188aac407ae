// A mission that runs, measured: what it costs to show 0.2 s more of it once it has gone on for 10 minutes at 20 Hz.
import { useBuiltPage } from "./server.mjs";
import { tellRun } from "./told.mjs";

const steps = 25;

/** Says how long the page's thread is busy with one step, and how many of its tasks took longer than 50 ms. */
export async function measureGrowth(browser, server, contents, hash) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, reducedMotion: "reduce" });
  const page = await context.newPage();
  await useBuiltPage(page);
  const run = await tellRun(page, contents);
  run.upTo(590);
  await page.goto(`${server.url}#live/told?${hash}`);
  await page.waitForSelector(hash.includes("3d") ? ".space-view canvas" : ".tabbed");
  await new Promise((done) => setTimeout(done, 2000));
  await page.evaluate(() => {
    window.long = [];
    new PerformanceObserver((list) => window.long.push(...list.getEntries().map(({ duration }) => duration))).observe({ entryTypes: ["longtask"] });
  });
  const session = await context.newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const spent = async () => 1000 * (await session.send("Performance.getMetrics")).metrics.find((one) => one.name === "TaskDuration").value;
  const before = await spent();
  for (let i = 1; i <= steps; ++i) {
    run.upTo(590 + 0.2 * i);
    await new Promise((done) => setTimeout(done, 250));
  }
  const each = (await spent() - before) / steps;
  const long = await page.evaluate(() => window.long.map(Math.round));
  console.log(`page: 0.2 s more of a run of 10 minutes at 20 Hz, ${hash}: ${each.toFixed(1)} ms of processor time until it is shown; ${long.length} of ${steps} took longer than 50 ms${long.length > 0 ? ` (${long.join(", ")})` : ""}`);
  await context.close();
}
