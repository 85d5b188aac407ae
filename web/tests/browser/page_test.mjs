// The page in a real browser against a real server, one start of each for all cases, of which two run at a time.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/tests/browser/page_test.mjs OUTPUT [CASE...]
import assert from "node:assert/strict";
import { AsyncLocalStorage } from "node:async_hooks";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { compareShot, executable, launch, saved, until } from "./browser.mjs";
import { difference, readPng, shrunk } from "./png.mjs";
import { onScreen } from "./drag.mjs";
import { accessCases } from "./access_cases.mjs";
import { exportCases } from "./export_cases.mjs";
import { frontCases } from "./front_cases.mjs";
import { liveCases } from "./live_cases.mjs";
import { lookCases } from "./look_cases.mjs";
import { makeMaps, makeRuns } from "./runs.mjs";
import { planToolCases } from "./plan_tool_cases.mjs";
import { runsCases } from "./runs_cases.mjs";
import { truthCases } from "./truth_cases.mjs";
import { wayCases } from "./way_cases.mjs";
import { makeFolder, makeViewer, serve, tool, useBuiltPage } from "./server.mjs";

const [output, ...only] = process.argv.slice(2);
if (!executable) {
  console.log("skipped: Chromium is not installed (apt-get install chromium)");
  process.exit(77);
}

const { folder, remove } = makeFolder();
const server = await serve(folder);
const browser = await launch();
const faults = [];
const present = new AsyncLocalStorage();  // the pages of the case that is running

async function open(hash = "", { at = server.url, ...options } = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, reducedMotion: "reduce", colorScheme: "light", ...options });
  present.getStore().push(page);
  await useBuiltPage(page);
  page.setDefaultTimeout(100_000);  // a machine that is busy with other tests may hold a browser up
  page.on("pageerror", (error) => faults.push(`${hash}: ${error.message}`));
  page.on("console", (message) => {  // what the server refuses is listed there by the browser, and told by the page
    if (message.type() === "error" && !/Failed to load resource|WebSocket connection to/.test(message.text())) faults.push(`${hash}: ${message.text()}`);
  });
  page.on("request", (request) => {
    if (!/^(http:\/\/127\.0\.0\.1|blob:|data:|file:)/.test(request.url())) faults.push(`${hash}: the page asked for ${request.url()}`);
  });
  await page.goto(hash.startsWith("file:") ? hash : at + hash);
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
  const scale = Math.min((width - 88) / w, (height - 90) / h);
  return [left + 34 + (width - 88) / 2 + scale * (px - w / 2), top + 50 + (height - 90) / 2 - scale * (py - h / 2)];
}, [x, y]);

/** Compares what `g` saves with what `s` saves. */
async function svgIsAsTheView(page) {
  const view = readPng(await saved(page, () => page.keyboard.press("s")));
  const drawn = readPng(await page.evaluate(async (svg) => {
    const image = new Image();
    image.src = `data:image/svg+xml;base64,${svg}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    canvas.getContext("2d").drawImage(image, 0, 0);
    return canvas.toDataURL().split(",")[1];
  }, (await saved(page, () => page.keyboard.press("g"))).toString("base64")).then((text) => Buffer.from(text, "base64")));
  const off = difference(shrunk(view, 2), shrunk(drawn, 2));
  assert.ok(off < 0.01, `${(100 * off).toFixed(1)} % of the SVG differs from the view`);
}

const cases = {
  ...frontCases({ open, text, frames, server, folder, output }),

  async "a run: scrub to a shot, step, switch to space, reload at its address"() {
    const page = await open("#watch/runs/yard/run.mcap?t=0");
    await page.waitForSelector(".targets tbody");
    const shot = page.locator(".tick.hit").nth(9);
    const title = await shot.getAttribute("title");
    await shot.click();
    await until("the shot", async () => title.startsWith((await text(page, ".side h2")).split(" try")[0].trim()));
    await page.keyboard.press("ArrowRight");
    await frames(page);
    const clock = await text(page, ".clock");
    await compareShot(page, "watch", output);
    await page.keyboard.press("v");
    await page.waitForSelector(".space-view canvas");
    await until("the address", () => page.evaluate(() => location.hash.includes("view=3d") && location.hash.includes("shot=10")));
    await frames(page);
    await page.reload();
    await page.waitForSelector(".space-view canvas");
    await until("the same time", async () => await text(page, ".clock") === clock);
    await frames(page);
    await compareShot(page, "space", output);
    await page.close();
  },

  async "a target that cannot be hit: the best flight at it, and what is in the way, from the side, in plan and in its reason"() {
    const page = await open("#watch/runs/yard/run.mcap?t=20");
    await page.locator(".targets tbody", { hasText: "schroedi" }).locator("button").click();
    await until("the flight", async () => /^No shot at schroedi the best flight is blocked by shed\//.test(await text(page, ".side h2")));
    const by = (await text(page, ".side h2")).match(/blocked by (\S+)$/)[1];
    assert.match(await text(page, ".side .caption"), new RegExp(`^[\\d.]+ m/s at .* from \\(.*It meets ${by} at \\(`));
    assert.match(await page.locator(".targets tbody", { hasText: "schroedi" }).locator(".reason").textContent(), new RegExp(`the best flight, from \\(.*${by}`));
    const picture = () => page.evaluate(() => document.querySelector(".plan-view canvas").toDataURL());
    await frames(page);
    const shown = await picture();
    await page.locator('.legend .layer[data-layer="blocked flights"] label').click();
    await frames(page);
    assert.notEqual(await picture(), shown, "it is drawn in plan");
    await page.close();
  },

  async "what a robot senses and believes: a map that is turned is explored, a drive goes by tags"() {
    makeRuns(folder);
    const page = await open("#watch/runs/explore/run.mcap?t=3");
    await page.waitForSelector(".plots figure");
    assert.match(await text(page, ".legend"), /believed, 2\u03c3.*range finder.*path/);
    await page.locator(".tabs button", { hasText: "Why" }).click();
    await page.waitForSelector(".why li[aria-current] .candidates .chosen");
    assert.match(await text(page, ".why .candidates thead"), /place.*to get there.*to see.*of the round that begins there, least is best/);
    const columns = await page.locator(".why .candidates tr").evaluateAll((rows) => rows.slice(0, 2).map((row) => [...row.cells].map((one) => Math.round(one.getBoundingClientRect().left))));
    assert.deepEqual(columns[0], columns[1], "each value stands below its head");
    const values = (await page.locator(".why .candidates td:last-child").allTextContents()).map(Number.parseFloat).filter(Number.isFinite);
    assert.ok(values.length > 0 && values.every((value, i) => i === 0 || value >= values[i - 1]), `the best first: ${values}`);
    await page.locator(".tabs button", { hasText: "Plots" }).click();
    await page.waitForSelector(".plots figure");
    await frames(page);
    await compareShot(page, "explore", output);
    await page.keyboard.press("f");  // the robot is in the middle then
    await frames(page);
    const frame = await page.locator(".plan-view canvas").boundingBox();
    await page.mouse.move(frame.x + frame.width / 2, frame.y + frame.height / 2);
    assert.match(await text(page, ".plan-view .tip"), /^believed \d+ mm and .* off\n2\u03c3: \d+ mm by/);
    await page.keyboard.press("v");
    await page.waitForSelector(".space-view canvas");
    const space = () => page.evaluate(() => document.querySelector(".space-view canvas").toDataURL());
    await frames(page);
    const compared = await space();
    await page.locator('.legend .layer[data-layer="candidates"] label').click();
    await frames(page);
    assert.notEqual(await space(), compared, "the places that it compares stand in space");
    await page.goto(`${server.url}#watch/runs/drive/run.mcap?t=13&view=3d&follow=1`);
    await page.waitForSelector(".space-view canvas");
    await until("the drive", async () => (await text(page, ".job")) === "drive");
    await frames(page);
    await compareShot(page, "drive-space", output);
    await page.close();
  },

  async "mapping from logs: the map, landmarks and their ellipses, in plan and in space"() {
    makeMaps(folder);
    const rooms = await open("#watch/runs/office/run.mcap?t=95&tab=plots");
    await rooms.waitForSelector(".plots figure");
    const legend = await text(rooms, ".legend");
    for (const name of ["way settled in the end", "believed then, 2\u03c3", "odometry alone", "reference", "range finder"]) assert.equal(legend.split(name).length, 2, `${name} once in: ${legend}`);
    assert.doesNotMatch(legend, /\btrue\b/);
    await frames(rooms);
    await compareShot(rooms, "slam", output);
    await rooms.close();
    const page = await open("#watch/runs/posts/run.mcap?t=10&view=3d");
    await page.waitForSelector(".space-view canvas");
    assert.match(await text(page, ".legend"), /landmark, 2\u03c3.*true place/);
    await frames(page);
    await compareShot(page, "slam-space", output);
    await page.keyboard.press("v");
    await page.keyboard.press("End");
    await page.keyboard.press("f");  // the robot is in the middle then
    await frames(page);
    const view = await page.locator(".plan-view canvas").boundingBox();
    await page.mouse.move(view.x + view.width / 2, view.y + view.height / 2);
    assert.match(await text(page, ".plan-view .tip"), /^believed .* off the way as settled/);
    await page.close();
  },

  async "an area is covered live; the strip is the same whether one comes from before or after, and as SVG"() {
    const page = await open("#live?scenario=cover/cover_room.yaml");
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    await page.waitForSelector(".live-page .verdict");
    assert.match(await text(page, ".verdict"), /Done/);
    assert.match(await text(page, ".legend"), /covered.*lap.*lane.*move.*planned.*out of reach/);
    assert.equal((await saved(page, () => page.keyboard.press("j"))).subarray(1, 5).toString(), "MCAP", "a run that was live has its log");
    const at = async (seconds) => {
      await page.locator(".transport input[type=range]").evaluate((slider, t) => {
        slider.value = String(t);
        slider.dispatchEvent(new Event("input"));
      }, seconds);
      await frames(page);
    };
    const picture = () => saved(page, () => page.keyboard.press("s"));
    await page.evaluate(() => document.activeElement.blur());
    await at(0);
    await at(60);
    const first = await picture();
    await page.keyboard.press("n");
    await frames(page);
    assert.match(await text(page, ".action"), /^lap 1 of 1 begins/);
    await page.keyboard.press("End");
    await frames(page);
    assert.match(await text(page, ".action"), /% of the reach is covered/);
    await at(60);
    assert.ok(first.equals(await picture()), "the view at 60 s depends on what was shown before");
    await svgIsAsTheView(page);
    await compareShot(page, "cover", output);
    const frame = await page.locator(".plan-view canvas").boundingBox();
    await page.keyboard.press("f");
    await frames(page);
    await page.mouse.move(frame.x + frame.width / 2, frame.y + frame.height / 2);
    assert.match(await text(page, ".plan-view .tip"), /^covered at (0:5\d|1:00)/);
    await page.close();
  },

  async "the viewer is one file that shows the same, dark, on a phone"() {
    const page = await open(`file://${makeViewer(folder, "runs/yard/run.mcap")}#?t=8&theme=dark`, { viewport: { width: 390, height: 844 }, colorScheme: "dark" });
    await page.waitForSelector(".targets tbody");
    assert.match(await text(page, ".verdict"), /targets reached/);
    await frames(page);
    await compareShot(page, "viewer-phone-dark", output);
    await page.close();
  },

  async "frames of a film are the same twice, and the SVG looks as the view does"() {
    const page = await open(`file://${makeViewer(folder, "runs/yard/run.mcap")}#?t=20`);
    await page.waitForSelector(".targets tbody");
    await frames(page);
    const film = (from, to) => saved(page, async () => {
      await page.keyboard.press("m");
      await page.selectOption('.film [aria-label="Format"]', { label: "pictures (zip of PNG)" });
      for (const [name, value] of [["From", from], ["To", to], ["Frames a second", 10]]) await page.fill(`.film [aria-label="${name}"]`, String(value));
      await page.keyboard.press("Enter");
    });
    const first = await film(20, 20.2);
    assert.equal(first.readUInt16LE(first.length - 12), 3, "frames in the archive");
    await page.keyboard.press("End");
    await frames(page);
    assert.ok(first.equals(await film(20, 20.2)), "the view at 20 s depends on what was shown before");
    assert.ok(!first.equals(await film(21, 21.2)));
    await page.keyboard.press("m");
    await page.fill('.film [aria-label="To"]', "1e9");
    assert.match(await text(page, ".film .hint"), /^To: expected a time from/);
    await page.keyboard.press("Escape");
    await page.waitForSelector("dialog.film", { state: "detached" });
    await svgIsAsTheView(page);
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
    const expanded = async () => await tip.isVisible() && /g /.test(await tip.textContent());
    for (let i = 1; i < 200 && !await expanded(); ++i) {
      await page.mouse.move(frame.x + frame.width * (i * 0.618 % 1), frame.y + frame.height * (i * 0.382 % 1));
    }
    const words = await tip.textContent();
    const [, g, h, f] = words.match(/g ([\d.]+) +h ([\d.]+) +f ([\d.]+)/).map(Number);
    assert.ok(Math.abs(g + h - f) < 0.002, words);
    assert.match(words, /parent \(\d+, \d+\)|the start/);
    await page.close();
  },

  async "a search on polygons is stepped through by its legs; the heading is turned; a lookup says that it is none"() {
    const page = await open("#plan/yard/yard.sdf?planner=visibility_graph_implicit&start=-6,-5&goal=0,4.4");
    await page.waitForSelector(".result");
    const clock = () => text(page, ".transport .clock");
    await until("the trace", async () => (await clock()).includes("/"));
    const all = Number((await clock()).split("/")[1].replaceAll(",", ""));
    assert.equal(await cell(page, "expansions"), all.toLocaleString("en"));
    await page.keyboard.press("Home");
    for (let i = 0; i < 12; ++i) await page.keyboard.press("ArrowRight");
    await frames(page);
    const box = [-10.06, -7.06, 10.06, 7.06];
    await page.mouse.move(...await onScreen(page, box, [-6, -5]));
    assert.match(await text(page, ".pane .tip"), /^\(\u22126\.00, \u22125\.00\) m expanded as number 1\ng 0\.000/);
    await compareShot(page, "search-polygons", output);
    const choose = async (name) => {
      const seen = await answers(page);
      await page.selectOption(".choice select", name);
      await nextAnswer(page, seen);
    };
    await choose("least_time");
    const free = Number.parseFloat(await cell(page, "cost"));
    const seen = await answers(page);
    await page.evaluate(() => document.activeElement.blur());
    for (let i = 0; i < 18; ++i) await page.keyboard.press(".");  // to 90 degrees to the right of the goal's side
    await until("a dearer way", async () => await answers(page) > seen && Number.parseFloat(await cell(page, "cost")) > free + 0.5);
    assert.equal(await page.inputValue("#option-heading"), "-90");
    assert.ok(await page.isChecked("#option-first_turn"));
    await page.goto(`${server.url}#plan/maps/gallery.map?planner=hub_labels`);
    await page.waitForSelector(".result");
    await until("the sentence", async () => /^Hub labels looks its answer up in an index/.test(await text(page, ".action")));
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
    assert.match(await text(page, ".notice"), /'-999999' is not valid; expected/);
    await field.fill("1");
    await field.press("Tab");
    // Names to choose from: the cost stays, the work does not.
    assert.deepEqual(await page.locator("#option-heuristic option").allTextContents(), ["Octile", "Euclidean", "Chebyshev"]);
    assert.deepEqual(await page.locator("#option-ties option").allTextContents(), ["Largest g", "Smallest g"]);
    await until("an answer", async () => /\d/.test(await cell(page, "expansions")));
    const [cost, work] = [await cell(page, "cost"), await cell(page, "expansions")];
    for (const [option, name] of [["heuristic", "chebyshev"], ["ties", "smallest_g"]]) {
      const seen = await answers(page);
      await page.selectOption(`#option-${option}`, name);
      await nextAnswer(page, seen);
      assert.equal(await cell(page, "cost"), cost);
    }
    assert.ok(Number((await cell(page, "expansions")).replaceAll(",", "")) > Number(work.replaceAll(",", "")), "a poorer estimate, and ties that go back");
    await page.close();
  },

  async "what was drawn is saved as a scenario, which the tool answers with the same plan"() {
    const page = await open("#draw?planner=theta_star&start=2,5.5&goal=14,5.5&radius=0.2");
    await page.waitForSelector(".result");
    await page.keyboard.press("w");
    const seen = await answers(page);
    await page.mouse.move(...await onMap(page, 8, 2));
    await page.mouse.down();
    await page.mouse.move(...await onMap(page, 8, 9), { steps: 8 });
    await page.mouse.up();
    await nextAnswer(page, seen);
    await until("a longer path", async () => Number.parseFloat(await cell(page, "cost")) > 12.5);
    await page.fill("#save-name", "wall.yaml");
    await page.click(".save button");
    await until("the sentence", async () => /^Saved .*wall\.yaml/.test(await text(page, ".saved")));
    const { metrics } = JSON.parse(execFileSync(tool, ["run", "wall.yaml", "--json"], { cwd: folder }));
    const cost = `${metrics.cost.toFixed(3)} m`;  // on a slow machine the page may still show a shorter wall
    await until("the plan of the tool", async () => await cell(page, "cost") === cost);
    await page.goto("about:blank");  // or what was there would do for what is to come
    await page.goto(`${server.url}#change/wall.yaml`);
    await page.waitForSelector(".result");
    await until("the same plan", async () => await cell(page, "cost") === cost);
    assert.equal(await page.inputValue("#save-name"), "wall.yaml");
    await page.fill("#save-name", "yard/yard.yaml");
    await page.click(".save button");
    await until("the refusal", async () => /there is a file of that name/.test(await text(page, ".saved")));
    await page.close();
  },

  async "a yard: targets and things of the world are dragged, turned, removed and restored, all is saved and guarded"() {
    const page = await open("#change/yard/yard.yaml");
    await page.waitForSelector(".yard-page tbody");
    const box = [-10.06, -7.06, 10.06, 7.06];  // of its fence
    const places = () => page.locator(".result tbody tr").evaluateAll((rows) => rows.map((one) => one.textContent));
    const before = await places();
    await page.keyboard.press("t");
    for (const key of "hhhhh") await page.keyboard.press(key);
    const [, moved] = await places();
    assert.notEqual(moved, before[1]);
    const name = await page.locator(".result tbody tr").nth(2).getAttribute("data-name");
    const position = async () => (await page.locator(`.result tr[data-name="${name}"] td`).allTextContents()).map((one) => Number(one.replace("\u2212", "-")));
    const [x, y] = await position();
    await page.mouse.move(...await onScreen(page, box, [x, y]));
    await page.mouse.down();
    await page.mouse.move(...await onScreen(page, box, [x + 0.5, y]), { steps: 4 });
    await page.mouse.up();
    await until("the target", async () => Math.abs((await position())[0] - x - 0.5) < 0.1);
    await page.keyboard.press("e");
    await page.mouse.click(...await onScreen(page, box, [-7, -2]));
    // A thing of the world: dragged, turned by its handle, and again by the keyboard.
    await page.keyboard.press("q");
    const row = async (of) => (await page.locator(`.result tr[data-name="${of}"] td`).allTextContents()).map((one) => Number(one.replace("\u2212", "-")));
    const dragBy = async (from, to) => {
      await page.mouse.move(...from);
      await page.mouse.down();
      await page.mouse.move(...to, { steps: 4 });
      await page.mouse.up();
      await frames(page);
    };
    const things = JSON.parse(await page.evaluate(async () => (await fetch("api/v1/scenarios/yard/yard.yaml")).text())).things;
    const oak = things.find((one) => one.name === "oak");
    const [wx, wy] = oak.middle;
    await dragBy(await onScreen(page, box, [wx, wy]), await onScreen(page, box, [wx + 1, wy - 0.5]));
    assert.ok(Math.hypot((await row("oak"))[0] - wx - 1, (await row("oak"))[1] - wy + 0.5) < 0.05, String(await row("oak")));
    const reach = Math.max(...oak.polygons.flat().map(([u, v]) => Math.hypot(u - wx, v - wy)));
    const [hx, hy] = await onScreen(page, box, [wx + 1 + reach, wy - 0.5]);
    await dragBy([hx + 34, hy], await onScreen(page, box, [wx + 1, wy + 2]));
    assert.equal((await row("oak"))[2], 90);
    await page.keyboard.press(",");
    assert.equal((await row("oak"))[2], 95);
    // Taken away, brought back by a step back, taken away again.
    await page.locator('.result tr[data-name="oak"]').click();
    for (let i = 0; i < things.length; ++i) {
      await page.keyboard.press("o");
      if (await page.locator('.result tr[data-name="bench"]').count() > 0) break;
    }
    await page.keyboard.press("Delete");
    assert.match(await text(page, '.result tr[data-name="bench"]'), /removed/);
    await page.keyboard.press("Control+z");
    assert.doesNotMatch(await text(page, '.result tr[data-name="bench"]'), /removed/);
    await page.keyboard.press("x");
    assert.match(await text(page, ".yard-page .hint"), /bench is removed; x brings it back/);
    await page.locator('.result tr[data-name="oak"]').click();
    await frames(page);
    await compareShot(page, "yard", output);
    await page.click('.save button[type="button"]');
    await page.waitForSelector(".live-page");
    const list = readFileSync(join(folder, "yard/yard_changed_targets.txt"), "utf8");
    assert.match(list, /Saved by the page/);
    assert.equal(list.trim().split("\n").length, before.length, "a line each, and the mark in place of the robot");
    assert.match(readFileSync(join(folder, "yard/yard_changed_world.sdf"), "utf8"), /<model name="box_/);
    const scenario = readFileSync(join(folder, "yard/yard_changed.yaml"), "utf8");
    assert.match(scenario, /moved: .?oak=[-\d.]+,[-\d.]+,95\b/);
    assert.match(scenario, /removed: .?bench\b/);
    await page.click(".run-head .button");
    await page.goto(`${server.url}#change/yard/yard_changed.yaml`);
    await page.waitForSelector('.result tr[data-name="oak"]');
    assert.equal((await row("oak"))[2], 95);
    assert.match(await text(page, '.result tr[data-name="bench"]'), /removed/);
    await page.setViewportSize({ width: 390, height: 844 });
    await page.keyboard.press("d");
    await frames(page);
    await compareShot(page, "yard-phone-dark", output);
    await page.close();
  },

  ...liveCases({ open, text, server, folder }),
  ...runsCases({ open, text, output }),
  ...truthCases({ open, text, frames, cell, answers, server, folder }),
  ...wayCases({ open, text, frames, cell, answers, onMap, server, folder }),
  ...lookCases({ open, text, frames, server, folder }),
  ...planToolCases({ open, text, cell, answers, server, folder }),
  ...exportCases({ open, text, frames }),
  ...accessCases({ open, text, frames, server, folder }),

  async "a log that was cut short is shown up to there, and an old report is refused"() {
    const log = readFileSync(join(folder, "runs/yard/run.mcap"));
    const page = await open();
    await page.waitForSelector(".groups");
    const drop = (bytes, name) => page.evaluate(([text, file]) => {
      const dropped = new DataTransfer();
      dropped.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], file));
      dispatchEvent(new DragEvent("drop", { dataTransfer: dropped, cancelable: true }));
    }, [bytes.toString("base64"), name]);
    await drop(log.subarray(0, log.length - 3000), "cut.mcap");
    await page.waitForSelector(".targets tbody");
    assert.match(await text(page, ".verdict.cut"), /^Cut short The log is cut short at t = [\d.]+ s/);
    await drop(Buffer.from('{"outrider_report": 1}'), "guard.json");
    await page.waitForSelector(".notice-over:not([hidden])");
    assert.match(await text(page, ".notice-over"), /older version; run the job again with --out DIR/);
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
    await page.waitForSelector(".notice-over:not([hidden])");
    assert.match(await text(page, ".notice-over"), /broken\.map.*(line|row|width|cells)/);
    await page.setInputFiles("input[type=file]", join(folder, "good.map"));
    await page.waitForSelector(".result");
    assert.equal(await cell(page, "answer"), "path found");
    await page.close();
  },

  async "the keyboard does it all: open a run from the files, play, read the help"() {
    const page = await open();
    await page.waitForSelector(".groups");
    await page.evaluate(() => document.querySelector('li[data-path="runs/yard/run.mcap"] a').focus());
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
async function check([name, run]) {
  const start = Date.now();
  const pages = [];
  try {
    await present.run(pages, run);
    console.log(`ok      ${((Date.now() - start) / 1000).toFixed(1)} s  ${name}`);
  } catch (error) {
    const number = ++failed;
    console.log(`FAILED  ${name}\n${error.stack}`);
    for (const page of pages) await page.screenshot({ path: join(output, `failed-${number}.png`) }).catch(() => undefined);
  }
  for (const page of pages) await page.context().close();
}

/** The first case sees the folder as it was made. A page waits most of the time, so two cases share the machine. */
const waiting = Object.entries(cases).filter(([name]) => only.length === 0 || only.some((word) => name.includes(word)));
const workInTurn = async () => { while (waiting.length > 0) await check(waiting.shift()); };
if (waiting.length > 0) await check(waiting.shift());
await Promise.all([workInTurn(), workInTurn()]);
for (const fault of faults) console.log(`FAILED  ${fault}`);
await browser.close();
await server.stop();
remove();
process.exit(failed + faults.length > 0 ? 1 : 0);
