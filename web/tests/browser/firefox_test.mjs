// The page in Debian's Firefox, which playwright drives by WebDriver BiDi: the front page, a run in plan and in space, a live run, a plan, and no fault in its console.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/tests/browser/firefox_test.mjs
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { patience_s, until } from "./browser.mjs";
import { makeFolder, serve, useBuiltPage } from "./server.mjs";

const executablePath = ["/usr/bin/firefox-esr", "/usr/bin/firefox"].find(existsSync);
if (!executablePath) {
  console.log("skipped: Firefox is not installed (apt-get install firefox-esr)");
  process.exit(77);
}
const { _bidiFirefox: firefox } = createRequire(import.meta.url)("playwright-core");

const { folder, remove } = makeFolder();
const server = await serve(folder);
const browser = await firefox.launch({ executablePath, timeout: 1000 * patience_s });
const faults = [];
let page;  // of the case that is running

async function open(hash) {
  page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  await useBuiltPage(page);
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("console", (message) => { if (message.type() === "error") faults.push(message.text()); });
  page.setDefaultTimeout(1000 * patience_s);
  await page.goto(server.url + hash);
}

const text = (selector) => page.locator(selector).first().textContent();
/** How many colours a canvas shows; one, if nothing is drawn. */
const colours = (selector) => page.evaluate((one) => {
  const from = document.querySelector(one);
  const canvas = Object.assign(document.createElement("canvas"), { width: from.width, height: from.height });
  const ctx = canvas.getContext("2d");
  ctx.drawImage(from, 0, 0);
  return new Set(new Uint32Array(ctx.getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size;
}, selector);
const drawn = (selector) => until(`${selector} to be drawn`, async () => await colours(selector) > 20);

const cases = {
  async "the front page"() {
    await open("");
    await page.waitForSelector(".cards .card");
    assert.ok(await page.locator(".card").count() > 5);
    await until("the example", () => page.locator(".hero .play").isEnabled());
    await drawn(".hero canvas");
  },
  async "a run, in plan and in space"() {
    await open("#watch/runs/yard/run.mcap?t=20");
    await page.waitForSelector(".targets tbody");
    assert.match(await text(".verdict"), /^Done 23 of 24 targets reached/);
    await drawn(".plan-view canvas");
    await page.click(".segments button:has-text('3D')");  // without a screen Firefox has no WebGL; then the page says so
    await page.waitForSelector(".space-view canvas, .stage-note");
    if (await page.locator(".space-view").count() > 0) await drawn(".space-view canvas");
    else assert.ok(await page.locator(".plan-view canvas").isVisible());
    faults.splice(0, faults.length, ...faults.filter((one) => !/WebGL/.test(one)));
    await page.keyboard.press("ArrowRight");
    await until("a second more", async () => (await text(".clock")).startsWith("0:21.0"));
  },
  async "a live run"() {
    await open("#live?scenario=cover/cover_room.yaml");
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    await page.waitForSelector(".live-page .verdict");
    assert.match(await text(".verdict"), /^Done/);
    await drawn(".plan-view canvas");
  },
  async "a plan"() {
    await open("#plan/maps/gallery.map?planner=a_star");
    await page.waitForSelector(".result td[data-row=answer]");
    assert.equal(await text(".result td[data-row=answer]"), "path found");
    await drawn(".pane canvas");
  },
};

let failed = 0;
for (const [name, run] of Object.entries(cases)) {
  const start = Date.now();
  try {
    await run();
    await page.close();
    assert.deepEqual(faults, []);
    console.log(`ok      ${((Date.now() - start) / 1000).toFixed(1)} s  ${name}`);
  } catch (error) {
    ++failed;
    faults.length = 0;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
console.log(`Firefox ${browser.version()}`);
await browser.close();
await server.stop();
remove();
process.exit(failed > 0 ? 1 : 0);
