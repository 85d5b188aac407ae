// The page in a real browser against a real server, one start of each for all cases.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/tests/browser/page_test.mjs OUTPUT [CASE...]
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { compareShot, executable, launch, until } from "./browser.mjs";
import { makeFolder, makeViewer, serve } from "./server.mjs";

const [output, ...only] = process.argv.slice(2);
if (!executable) {
  console.log("skipped: Chromium is not installed (apt-get install chromium)");
  process.exit(77);
}

const { folder, remove } = makeFolder();
const server = await serve(folder);
const browser = await launch();
const faults = [];

async function open(hash = "", options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, reducedMotion: "reduce", colorScheme: "light", ...options });
  page.on("pageerror", (error) => faults.push(`${hash}: ${error.message}`));
  page.on("request", (request) => {
    if (!/^(http:\/\/127\.0\.0\.1|blob:|data:|file:)/.test(request.url())) faults.push(`${hash}: the page asked for ${request.url()}`);
  });
  await page.goto(hash.startsWith("file:") ? hash : server.url + hash);
  return page;
}

const text = (page, selector) => page.locator(selector).first().textContent();
const frames = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const answers = async (page) => Number(await page.locator(".plan-page").getAttribute("data-answers") ?? 0);
/** Waits for answers after those that were there, and until the search that goes with them is drawn. */
async function nextAnswer(page, before) {
  await until("an answer", async () => await answers(page) > before);
  await frames(page);
}
const cell = (page, row, column = 0) => page.locator(`.result td[data-row="${row}"]`).nth(column).textContent();
/** Where a place of the plan's map is on the screen: the map fills its view as the camera fits it. */
const onMap = (page, x, y) => page.evaluate(([px, py]) => {
  const canvas = document.querySelector(".pane canvas");
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const [w, h] = [64 * 0.25, 44 * 0.25];
  const scale = Math.min((width - 54) / w, (height - 90) / h);
  return [left + 34 + (width - 54) / 2 + scale * (px - w / 2), top + 50 + (height - 90) / 2 - scale * (py - h / 2)];
}, [x, y]);

const cases = {
  async "a report: scrub to a shot, step, switch to space, reload at its address"() {
    const page = await open("#watch/reports/yard.json?t=0");
    await page.waitForSelector(".targets tbody");
    const shot = page.locator(".tick.hit").nth(3);
    const title = await shot.getAttribute("title");
    await shot.click();
    await until("the shot", async () => title.startsWith((await text(page, ".side h2")).split(" try")[0].trim()));
    await page.keyboard.press("ArrowRight");
    await frames(page);
    const clock = await text(page, ".clock");
    await compareShot(page, "watch", output);
    await page.keyboard.press("v");
    await page.waitForSelector(".space-view canvas");
    await until("the address", () => page.evaluate(() => location.hash.includes("view=3d") && location.hash.includes("shot=4")));
    await frames(page);
    await page.reload();
    await page.waitForSelector(".space-view canvas");
    await until("the same time", async () => await text(page, ".clock") === clock);
    await frames(page);
    await compareShot(page, "space", output);
    await page.close();
  },

  async "the viewer is one file that shows the same, dark, on a phone"() {
    const page = await open(`file://${makeViewer(folder, "reports/yard.json")}#?t=8&theme=dark`, { viewport: { width: 390, height: 844 }, colorScheme: "dark" });
    await page.waitForSelector(".targets tbody");
    assert.match(await text(page, ".verdict"), /targets reached/);
    await frames(page);
    await compareShot(page, "viewer-phone-dark", output);
    await page.close();
  },

  async "a search: step through it, read g, h and f of a vertex and its parent"() {
    const page = await open("#plan/maps/gallery.map?planner=a_star");
    await page.waitForSelector(".result");
    await until("the trace", async () => (await text(page, ".transport .clock")).includes("/"));
    const all = Number((await text(page, ".transport .clock")).split("/")[1].replaceAll(",", ""));
    assert.equal(await cell(page, "expansions"), all.toLocaleString("en"));
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    assert.match(await text(page, ".transport .clock"), /^2 \//);
    await page.keyboard.press("End");
    const frame = await page.locator(".pane canvas").boundingBox();
    const tip = page.locator(".pane .tip");
    for (let i = 1; i < 200 && !await tip.isVisible(); ++i) {
      await page.mouse.move(frame.x + frame.width * (i * 0.618 % 1), frame.y + frame.height * (i * 0.382 % 1));
    }
    const words = await tip.textContent();
    const [, g, h, f] = words.match(/g ([\d.]+) +h ([\d.]+) +f ([\d.]+)/).map(Number);
    assert.ok(Math.abs(g + h - f) < 0.002, words);
    assert.match(words, /parent \(\d+, \d+\)|the start/);
    await page.close();
  },

  async "two planners side by side on the same question"() {
    const page = await open("#plan/maps/gallery.map?planner=a_star&versus=dijkstra");
    await until("both answers", async () => await page.locator('.result td[data-row="cost"]').count() === 2);
    assert.match(await cell(page, "cost", 0), /\d m$/);
    assert.equal(await cell(page, "cost", 0), await cell(page, "cost", 1));
    const [informed, blind] = [await cell(page, "expansions", 0), await cell(page, "expansions", 1)].map((one) => Number(one.replaceAll(",", "")));
    assert.ok(informed < blind, `${informed} and ${blind} expansions`);
    await until("the pictures", async () => await answers(page) >= 2);
    await frames(page);
    await compareShot(page, "compare", output);
    await page.close();
  },

  async "an obstacle drawn across the way changes the plan, one across the map leaves none"() {
    const page = await open("#draw?planner=a_star&start=2,5.5&goal=14,5.5&radius=0");
    await page.waitForSelector(".result");
    const before = Number.parseFloat(await cell(page, "length"));
    assert.ok(Math.abs(before - 12) < 0.6, `${before} m`);
    await page.keyboard.press("w");
    const drag = async (from, to) => {
      const seen = await answers(page);
      await page.mouse.move(...await onMap(page, ...from));
      await page.mouse.down();
      for (let i = 1; i <= 8; ++i) {
        await page.mouse.move(...await onMap(page, from[0] + (to[0] - from[0]) * i / 8, from[1] + (to[1] - from[1]) * i / 8));
      }
      await page.mouse.up();
      await nextAnswer(page, seen);
    };
    await drag([8, 2], [8, 9]);
    await until("a longer path", async () => Number.parseFloat(await cell(page, "length")) > before + 1);
    await drag([8, -0.5], [8, 11.5]);
    await until("no path", async () => await cell(page, "answer") === "no path");
    assert.ok((await text(page, ".action")).length > 10);
    await frames(page);
    await compareShot(page, "no-path", output);
    await page.close();
  },

  async "options come from their descriptions, and wrong ones are refused with a sentence"() {
    const page = await open("#draw?planner=a_star");
    await page.waitForSelector(".result");
    await page.locator(".choice summary").click();
    const field = page.locator('.options input[type="number"]').first();
    await field.fill("-999999");
    await field.press("Tab");
    assert.match(await text(page, ".notice"), /'-999999' is no good; it takes/);
    await page.close();
  },

  async "a mission runs live, is cancelled, another is run; two viewers see it"() {
    const page = await open("#live?scenario=yard/yard.yaml");
    await page.waitForSelector(".start button:enabled");
    assert.equal(await page.inputValue("#scenario"), "yard/yard.yaml");
    await page.click(".start button");
    await page.waitForSelector('.live-page[data-state="running"]');
    const other = await open(await page.evaluate(() => location.hash));
    await other.waitForSelector('.live-page[data-state="running"]');
    await page.click(".run-head .button");
    await page.waitForSelector('.live-page[data-state="cancelled"]');
    await other.waitForSelector('.live-page[data-state="cancelled"]');
    await other.close();
    await page.goto(`${server.url}#live?scenario=pursuit/park.yaml`);
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    await page.waitForSelector(".live-page .watch", { timeout: 30000 });
    assert.match(await text(page, ".verdict"), /Done/);
    await page.close();
  },

  async "a broken file is refused with a sentence, a good one opens"() {
    const page = await open();
    await page.waitForSelector(".groups");
    writeFileSync(join(folder, "good.map"), `type octile\nheight 20\nwidth 30\nmap\n${`${".".repeat(30)}\n`.repeat(20)}`);
    await page.evaluate(() => {
      const dropped = new DataTransfer();
      dropped.items.add(new File(["type octile\nheight 2\nwidth 3\nmap\n..\n"], "broken.map"));
      dispatchEvent(new DragEvent("drop", { dataTransfer: dropped, cancelable: true }));
    });
    await page.waitForSelector("[role=alert]");
    assert.match(await text(page, "[role=alert]"), /broken\.map.*(line|row|width|cells)/);
    await page.click(".hint a");
    await page.waitForSelector(".groups");
    await page.setInputFiles("input[type=file]", join(folder, "good.map"));
    await page.waitForSelector(".result");
    assert.equal(await cell(page, "answer"), "path found");
    await page.close();
  },

  async "the keyboard does it all: open a report from the files, play, read the help"() {
    const page = await open();
    await page.waitForSelector(".groups");
    await page.evaluate(() => document.querySelector('li[data-path="reports/yard.json"] a').focus());
    await compareShot(page, "files", output);
    await page.keyboard.press("Enter");
    await page.waitForSelector(".targets tbody");
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("End");
    await frames(page);
    const end = await text(page, ".clock");
    assert.equal(end.split(" / ")[0].split(".")[0], end.split(" / ")[1]);
    await page.keyboard.press("Home");
    await page.keyboard.press(" ");
    await until("time to pass", async () => !(await text(page, ".clock")).startsWith("0:00.0"));
    await page.keyboard.press("?");
    await page.waitForSelector("dialog.help[open]");
    assert.match(await text(page, "dialog.help"), /play or pause/);
    await page.keyboard.press("Escape");
    await page.waitForSelector("dialog.help", { state: "detached" });
    await page.keyboard.press("L");
    await page.waitForSelector(".start");
    await page.close();
  },
};

let failed = 0;
for (const [name, run] of Object.entries(cases)) {
  if (only.length > 0 && !only.some((word) => name.includes(word))) continue;
  const start = Date.now();
  try {
    await run();
    console.log(`ok      ${((Date.now() - start) / 1000).toFixed(1)} s  ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED  ${name}\n${error.stack}`);
    for (const context of browser.contexts()) for (const page of context.pages()) await page.screenshot({ path: join(output, `failed-${failed}.png`) });
  }
  for (const context of browser.contexts()) await context.close();
}
for (const fault of faults) console.log(`FAILED  ${fault}`);
await browser.close();
await server.stop();
remove();
process.exit(failed + faults.length > 0 ? 1 : 0);
