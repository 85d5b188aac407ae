// The cases of the page about missions that run.
import assert from "node:assert/strict";
import { copyFileSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { rested, until } from "./browser.mjs";
import { onScreen } from "./drag.mjs";
import { contentsOf } from "./streams.mjs";
import { tellRun } from "./told.mjs";

/** A copy of a scenario, beside it, whose missions are held. */
function heldCopy(server, folder, path, name) {
  const copy = path.replace(/[^/]*$/, name);
  copyFileSync(join(folder, path), join(folder, copy));
  server.hold(copy);
  return copy;
}

/** Poses that have come so far. A mission that plans is not held: by then it may have told where it starts, at time 0. */
const samples = (page) => page.evaluate(() => Number(document.querySelector(".live-page").dataset.samples ?? 0));
const atTheStart = 2;

export const cases = ({ open, blank, text, server, folder }) => ({
  async "a mission is drawn while it runs; who comes in the middle sees it from the start; it is cancelled, another is run"() {
    const held = heldCopy(server, folder, "waypoints/closed_loop.yaml", "held.yaml");
    const page = await open(`#live?scenario=${held}`);
    const grows = (one, from) => until("more of the mission", async () => (await samples(one)) > from);
    await page.waitForSelector(".start button:enabled");
    assert.equal(await page.inputValue("#scenario"), held);
    await page.click(".start button");
    server.passOn(held, { time: 1 });
    await page.waitForSelector('.live-page[data-state="running"] .plan-view canvas');
    await grows(page, 0);
    for (const time of [2, 3]) {
      const before = await samples(page);
      server.passOn(held, { time });
      await grows(page, before);
    }
    const seen = await samples(page);
    const late = await open(await page.evaluate(() => location.hash));
    await late.waitForSelector('.live-page[data-state="running"] .plan-view canvas');
    await grows(late, 0);
    server.passOn(held, { time: 4 });
    await grows(late, seen);
    await page.click(".run-head .button");
    for (const one of [page, late]) await one.waitForSelector('.live-page[data-state="cancelled"]');
    rmSync(join(folder, held));
    await page.goto(`${server.url}#live?scenario=pursuit/park.yaml`);
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    await page.waitForSelector(".live-page .verdict");
    assert.match(await text(page, ".verdict"), /Done/);
    assert.ok(await page.locator(".live").isHidden());
    await page.locator(".tabs button", { hasText: "Why" }).click();
    await until("the bounds", async () => /^The bound closes in/.test(await text(page, ".why")));
    const bounds = (await page.locator(".why li span").allTextContents()).map((one) => Number(one.match(/none costs less than ([\d.]+)/)[1]));
    assert.ok(bounds.length > 1 && bounds.every((one, i) => i === 0 || one >= bounds[i - 1]) && bounds.at(-1) > bounds[0], `they rise: ${bounds}`);
    assert.match((await page.locator(".why li span").allTextContents()).at(-1), /it is the best$/);
  },

  async "a yard is drawn at once, with its start and its targets, while its tour is planned"() {
    const held = heldCopy(server, folder, "yard/yard.yaml", "surveyed.yaml");
    const page = await open(`#live?scenario=${held}`);
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    server.passOn(held, { time: 0, step: 2 });
    await page.waitForSelector('.live-page[data-state="running"] .plan-view canvas');
    /** How much of the colour of a robot is where it starts, and of that of a target that waits where one stands. */
    const inked = (colour, at) => page.evaluate(([name, x, y]) => {
      const canvas = document.querySelector(".plan-view canvas");
      const probe = document.createElement("canvas").getContext("2d");
      probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(name);
      probe.fillRect(0, 0, 1, 1);
      const wanted = probe.getImageData(0, 0, 1, 1).data;
      const { data } = canvas.getContext("2d").getImageData(x - 12, y - 12, 24, 24);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) if ([0, 1, 2].every((k) => Math.abs(data[i + k] - wanted[k]) < 40)) ++count;
      return count;
    }, [colour, ...at]);
    const box = [-10.06, -7.06, 10.06, 7.06];
    const place = async (x, y) => {
      const { x: left, y: top } = await page.locator(".plan-view canvas").boundingBox();
      const head = await page.evaluate(() => Math.max(50, document.querySelector(".stage-bar").offsetHeight + 20));
      const [u, v] = await onScreen(page, box, [x, y], ".plan-view canvas", head);
      return [Math.round(u - left), Math.round(v - top)];
    };
    const { targets, start } = JSON.parse(await page.evaluate(async () => (await fetch("api/v1/scenes/yard/yard.yaml")).text()));
    await until("the start", async () => await inked("--robot", await place(...start)) > 20);
    let seen = 0;
    for (const target of targets) if (await inked("--waiting", await place(...target)) > 8) ++seen;
    assert.ok(seen >= 20, `${seen} of ${targets.length} targets`);
    assert.match(await text(page, ".run-words"), /surveying|planning/);
    assert.ok(await samples(page) <= atTheStart, "nothing has moved yet");
    await page.click(".run-head .button");
    await page.waitForSelector('.live-page[data-state="cancelled"]');
    rmSync(join(folder, held));
  },

  async "while a yard is planned it shows from where targets can be hit, then the tour as it becomes faster"() {
    const held = heldCopy(server, folder, "yard/yard.yaml", "planned.yaml");
    const page = await open(`#live?scenario=${held}`);
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    server.passOn(held, { time: 0 });
    await page.waitForSelector('.live-page[data-state="running"] .plan-view canvas');
    await page.locator(".tabs button", { hasText: "Why" }).click();
    await until("a tour", async () => /^The tour so far/.test(await text(page, ".why")));
    const takes = async () => Number((await text(page, ".why .about")).match(/takes ([\d.]+) s/)[1]);
    assert.match(await text(page, ".why li"), /^Stop 1 at \(.*serves \w+/);
    assert.ok(await takes() < 200);
    assert.ok(await samples(page) <= atTheStart, "nothing has moved yet");
    const tip = page.locator(".plan-view .tip");
    const frame = await page.locator(".plan-view canvas").boundingBox();
    const share = async () => await tip.isVisible() && /% of the targets can be hit from here/.test(await tip.textContent());
    for (let i = 1; i < 200 && !await share(); ++i) await page.mouse.move(frame.x + frame.width * (i * 0.618 % 1), frame.y + frame.height * (i * 0.382 % 1));
    assert.ok(await share(), "the firing map is under the pointer");
    await page.click('.stage-tools button[aria-label="Export"]');
    assert.match(await text(page, '.menu [aria-disabled="true"]'), /^JSONwhen the run is over/);
    await page.keyboard.press("Escape");
    await page.click(".run-head .button");
    await page.waitForSelector('.live-page[data-state="cancelled"]');
    rmSync(join(folder, held));
  },

  async "in space, too, planning shows the firing map, then each faster tour; both are layers, which end with the planning"() {
    const page = await blank();
    const yard = await contentsOf(readFileSync(join(folder, "runs/yard/run.mcap")));
    let later = 0;
    const messages = yard.messages.map((one) => (one.topic === "/firing_map" ? { ...one, t: 0.001 } : one.topic === "/tours" ? { ...one, t: 0.002 + 0.001 * later++ } : one.topic.match(/^.(run|solids|scene)$/) ? one : { ...one, t: one.t + 1 }));
    assert.ok(later >= 2, `${later} tours`);
    const run = await tellRun(page, { ...yard, messages });
    run.upTo(0);
    await page.goto(`${server.url}#live/told?view=3d`);
    await page.waitForSelector(".space-view canvas");
    const picture = () => rested(page, ".space-view canvas");
    /** The picture once it is another than before, and rests. */
    const next = (what, before) => until(what, async () => { const drawn = await picture(); return drawn !== before && drawn; });
    const box = (name) => page.locator(`.legend .layer[data-layer="${name}"] input[type=checkbox]`);
    let shown = await next("the world", "");
    assert.equal(await box("firing map").count(), 0);
    run.upTo(0.001);
    shown = await next("the firing map", shown);
    assert.ok(await box("firing map").isChecked());
    let takes = Infinity;
    const tours = new Set([shown]);
    for (let k = 0; k < later; ++k) {
      run.upTo(0.002 + 0.001 * k + 1e-9);
      if (k === 0) await page.locator(".tabs button", { hasText: "Why" }).click();  // its tab is there with the first
      takes = await until("a faster tour", async () => {
        const told = Number(/takes ([\d.]+) s/.exec(await text(page, ".why"))?.[1]);
        return told < takes && told;
      });
      // The first is drawn; a later one may go the same way with other shots.
      shown = k === 0 ? await next("the first tour", shown) : await picture();
      tours.add(shown);
    }
    assert.ok(tours.size > 2, `${tours.size - 1} pictures of ${later} tours`);
    for (const name of ["firing map", "planned tour"]) {
      await page.locator(`.legend .layer[data-layer="${name}"] label`).click();
      shown = await next(`no ${name}`, shown);
      await page.locator(`.legend .layer[data-layer="${name}"] label`).click();
      shown = await next(name, shown);
    }
    run.upTo(5);  // it drives
    await until("the end of planning", async () => !await box("firing map").isChecked() && !await box("planned tour").isChecked());
    run.upTo(1e9);
    run.end();
    await page.waitForSelector(".live-page .verdict");
  },

  async "a running mission is watched with everything, left and come back to; its end keeps the time, the tab and the view"() {
    const page = await blank();
    const run = await tellRun(page, await contentsOf(readFileSync(join(folder, "runs/yard/run.mcap"))));
    run.upTo(10);
    await page.goto(`${server.url}#live/told`);
    const clock = async () => (await text(page, ".transport .clock")).split(" / ").map((time) => time.split(":").reduce((sum, part) => 60 * sum + Number(part), 0));
    const stands = (at, after) => until(`the clock at ${at} of more than ${after} s`, async () => {
      const [now, end] = await clock();
      return Math.abs(now - (at === "head" ? end : at)) <= (at === "head" ? 0.5 : 0) && end > after;
    });
    const live = () => page.locator(".live").getAttribute("aria-pressed");
    await page.waitForSelector(".targets tbody");
    await stands("head", 5);
    assert.equal(await live(), "true");
    await until("the last shot", async () => /^Shot \d+ at /.test(await text(page, ".side h2")));
    await page.locator(".tabs button", { hasText: "Plots" }).click();
    await page.waitForSelector(".plots canvas");
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("v");
    await page.waitForSelector(".space-view canvas");
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    await stands(1, 5);
    assert.equal(await live(), "false");
    const ticks = await page.locator(".tick").count();
    run.upTo(20);
    await stands(1, 15);
    assert.ok(await page.locator(".tick").count() > ticks);
    await page.keyboard.press("l");
    await stands("head", 15);
    assert.equal(await live(), "true");
    run.drop();
    await until("the break", async () => /^Connection lost/.test(await text(page, ".run-state")));
    run.upTo(30);
    await stands("head", 25);
    assert.equal(run.asked.length, 2);
    assert.equal(await text(page, ".run-state"), "Running");
    await page.keyboard.press("Home");
    for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowRight");
    await stands(3, 25);
    const watched = await page.evaluateHandle(() => document.querySelector(".live-page .watch"));
    run.upTo(1e9);
    run.end();
    await page.waitForSelector(".live-page .verdict");
    await stands(3, 30);
    assert.ok(await page.locator(".live").isHidden());
    assert.ok(await page.evaluate((one) => one === document.querySelector(".live-page .watch"), watched), "the view was made anew");
    assert.ok(await page.locator(".space-view canvas").isVisible() && await page.locator(".plots canvas").first().isVisible());
    await until("the address", async () => /#live\/told\?.*t=3\.00/.test(await page.evaluate(() => location.hash)));
    assert.match(await page.evaluate(() => location.hash), /tab=plots.*view=3d|view=3d.*tab=plots/);
  },

  async "a plan that was run is shown with its search, not the log that it leaves; what cannot run is not offered"() {
    writeFileSync(join(folder, "maps/gallery.yaml"), "job: plan\nmap: gallery.map\nfrom: 2,2\nto: 29,12\nradius: 0\nplanner: a_star\n");
    const answer = await fetch(`${server.url}api/v1/runs`, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ scenario: "maps/gallery.yaml" }) });
    const { id } = await answer.json();
    const page = await open(`#live/${id}`);
    await page.waitForSelector(".plan-page .result");
    assert.match(await page.evaluate(() => location.hash), /^#change\/maps\/gallery\.yaml/);
    writeFileSync(join(folder, "dance.yaml"), "job: dance\n");
    await page.goto("about:blank");
    await page.goto(`${server.url}#live`);
    await page.waitForSelector(".start button:enabled");
    const offered = await page.locator("#scenario option").allTextContents();
    assert.ok(offered.includes("pursuit/park.yaml"));
    for (const name of ["dance.yaml", "maps/gallery.yaml", "waypoints/calibration.yaml"]) assert.ok(!offered.includes(name), name);
    for (const name of ["dance.yaml", "maps/gallery.yaml"]) rmSync(join(folder, name));
  },
});
