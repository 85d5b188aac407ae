// The cases of the page about who cannot see it, or sees it otherwise: axe-core in each view and in each of its colours, headings, what is announced, keys,
// a window at twice the zoom and one of a phone.
import assert from "node:assert/strict";
import { copyFileSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { until } from "./browser.mjs";
import { makeViewer } from "./server.mjs";
import { contentsOf } from "./streams.mjs";
import { tellRun } from "./told.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Returns what axe-core finds in a part of the page, one line each. Colours alone are looked at where the parts are known already. */
async function findings(page, part, colours = false) {
  if (!await page.evaluate(() => "axe" in window)) await page.evaluate(axe);
  return page.evaluate(async ([within, only]) => {
    const { violations } = await window.axe.run(within, { resultTypes: ["violations"], preload: false, iframes: false, ...(only ? { runOnly: ["color-contrast"] } : {}) });
    return violations.flatMap(({ id, nodes }) => nodes.map(({ target, any, all }) => `${id} at ${target}: ${[...any, ...all].map(({ message }) => message).join("; ").slice(0, 160)}`));
  }, [part, colours]);
}

/** Each view, by its address, with what is there when it is shown. */
const views = [
  ["", ".cards .card"],
  ["#live", ".run-row"],
  ["#watch/runs/yard/run.mcap?t=9", ".targets tbody"],
  ["#watch/runs/yard/run.mcap?t=9&tab=plots", ".plots figure", ".aside"],
  ["#watch/runs/yard/run.mcap?t=9&tab=events", ".events li", ".aside"],
  ["#watch/runs/yard/run.mcap?t=9&tab=numbers", ".metrics", ".aside"],
  ["#watch/runs/yard/run.mcap?t=9&view=3d", ".space-view canvas", ".stage"],
  ["#plan/maps/gallery.map?planner=a_star&versus=dijkstra", ".result td[data-row=answer]"],
  ["#plan/yard/yard.sdf", ".result tbody"],
  ["#change/yard/yard.yaml", ".yard-page tbody"],
  ["#watch/absent/run.mcap", ".refusal"],
];

/** Returns the faults of a view in a small window; runs in the page. */
function hidden() {
  const wrong = [];
  for (const one of document.querySelectorAll(".targets, .compare-numbers, .why, .facts, .result")) {
    if (one.checkVisibility() && one.scrollWidth > one.clientWidth + 1) wrong.push(`${one.className} is ${one.scrollWidth} wide, in ${one.clientWidth}`);
  }
  if (document.documentElement.scrollWidth > innerWidth) wrong.push(`the page is ${document.documentElement.scrollWidth} wide`);
  for (const one of document.querySelectorAll("button, a[href], input, select, summary")) {
    if (one.disabled || !one.checkVisibility() || one.matches('[type="range"]')) continue;
    one.scrollIntoView({ block: "center", behavior: "instant" });
    const { left, right, top, bottom } = one.getBoundingClientRect();
    const name = one.getAttribute("aria-label") || one.textContent || one.id;
    if (left < -1 || right > innerWidth + 1) wrong.push(`${name} from ${left.toFixed()} to ${right.toFixed()}`);
    const above = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
    if (!above || !(one.contains(above) || above.contains(one) || above.closest("label")?.contains(one))) wrong.push(`${name} is below ${above?.className || above?.tagName}`);
  }
  return wrong;
}

/** A run that is over; returns its id. */
async function coveredRoom({ url }) {
  const { id } = await (await fetch(`${url}api/v1/runs`, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ scenario: "cover/cover_room.yaml" }) })).json();
  await until("its end", async () => (await (await fetch(`${url}api/v1/runs/${id}`)).json()).state === "done");
  return id;
}

export const cases = ({ open, blank, text, frames, server, folder }) => ({
  async "axe-core finds nothing in any view, on a live run or in an open menu, light, dark or in forced colours; each has one heading of its own"() {
    const id = await coveredRoom(server);
    const page = await blank();
    const found = [];
    const audit = async (name, part = "html", colours = false) => { for (const one of await findings(page, part, colours)) found.push(`${name}: ${one}`); };
    const inAllColours = async (name, part) => {
      const headings = await page.locator("h1").allTextContents();
      if (headings.length !== 1 || !headings[0]) found.push(`${name}: the headings are ${JSON.stringify(headings)}`);
      await audit(name, part);
      await page.evaluate(() => { document.documentElement.dataset.theme = "dark"; });
      await audit(`${name}, dark`, part, true);
      await page.emulateMedia({ forcedColors: "active" });
      await audit(`${name}, forced colours`, part, true);
      found.push(...await page.locator(".button.primary:not(:disabled)").evaluateAll((all) => all.filter((one) => {
        const { forcedColorAdjust, color, backgroundColor } = getComputedStyle(one);
        return forcedColorAdjust !== "none" || color === backgroundColor;
      }).map((one) => `${one.textContent} cannot be read in forced colours`)));
      await page.emulateMedia({ forcedColors: null });
      await page.evaluate(() => { document.documentElement.dataset.theme = "light"; });
    };
    for (const [hash, selector, part] of [...views, [`#live/${id}`, ".live-page .verdict"], [`#compare?runs=${id},${id}`, ".compare-numbers tbody"]]) {
      await page.goto(`${server.url}${hash}`);
      await page.waitForSelector(selector);
      await inAllColours(hash || "front", part);
    }
    await page.keyboard.press("?");
    await audit("help");
    await page.goto("about:blank");
    await page.goto(`${server.url}#watch/runs/yard/run.mcap?t=9&tab=why`);
    await page.waitForSelector(".why li");
    await inAllColours("why", ".aside");
    for (const [name, open, shown] of [["legend", "y", ".legend.open"], ["palette", "Control+k", "dialog[open]"]]) {
      await page.keyboard.press(open);
      await page.waitForSelector(shown);
      await inAllColours(name, name === "legend" ? ".stage" : "html");
      await page.keyboard.press("Escape");
    }
    await page.click('button[aria-label="Export"]');
    await inAllColours("export", ".stage-tools");
    copyFileSync(join(folder, "yard/yard.yaml"), join(folder, "yard/axe.yaml"));
    server.hold("yard/axe.yaml");
    await page.goto(`${server.url}#live?scenario=yard/axe.yaml`);
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    server.passOn("yard/axe.yaml", { time: 0 });
    await page.waitForSelector('.live-page[data-state="running"] .why li', { state: "attached" });
    await inAllColours("a live run");
    await page.click(".run-head .button");
    await page.waitForSelector('.live-page[data-state="cancelled"]');
    rmSync(join(folder, "yard/axe.yaml"));
    await page.goto(`file://${makeViewer(folder, "runs/yard/run.mcap")}#?t=8`);
    await page.waitForSelector(".targets tbody");
    await inAllColours("viewer");
    await page.keyboard.press("m");
    await audit("film");
    assert.equal(found.length, 0, `${found.length} findings\n${found.slice(0, 20).join("\n")}`);
  },

  async "at twice the zoom and on a phone no view is wider than the window, and every control can be reached and is covered by nothing"() {
    const page = await blank();
    const found = [];
    const id = await coveredRoom(server);
    const narrow = views.filter(([, , part]) => !part || part === ".stage");
    for (const [hash, selector] of [...narrow, ["#watch/runs/yard/run.mcap?t=9&tab=why", ".why li"], [`#compare?runs=${id},${id}`, ".compare-numbers tbody"]]) {
      await page.goto(`${server.url}${hash}`);
      await page.waitForSelector(selector);
      for (const [width, height] of [[640, 360], [390, 844]]) {
        await page.setViewportSize({ width, height });
        await frames(page);
        found.push(...(await page.evaluate(hidden)).map((one) => `${hash || "front"} at ${width} x ${height}: ${one}`));
      }
    }
    assert.equal(found.length, 0, `${found.length} findings\n${found.slice(0, 30).join("\n")}`);
  },

  async "keys of a single character are switched off and on; what changes by itself is announced"() {
    const page = await open("#watch/runs/yard/run.mcap?t=9");
    await page.waitForSelector(".targets tbody");
    const dark = () => page.evaluate(() => document.documentElement.dataset.theme === "dark");
    const flip = async () => {
      await page.click('button[aria-label="Keys"]');
      await page.locator(".letters input").click();
      await page.keyboard.press("Escape");
      await page.waitForSelector("dialog.help", { state: "detached" });
    };
    await flip();
    await page.keyboard.press("d");
    assert.equal(await dark(), false);
    await page.keyboard.press("ArrowRight");
    await until("a second more", async () => (await text(page, ".clock")).startsWith("0:10.0"));
    await page.reload();
    await page.waitForSelector(".targets tbody");
    await page.keyboard.press("d");
    assert.equal(await dark(), false, "it is kept");
    await flip();
    await page.keyboard.press("d");
    assert.equal(await dark(), true);
    await page.goto(`${server.url}#plan/maps/gallery.map?planner=a_star`);
    await until("the answer", async () => (await text(page, ".announced")).startsWith("A*: path found, cost "));
    const other = await blank();
    const run = await tellRun(other, await contentsOf(readFileSync(join(folder, "runs/yard/run.mcap"))));
    run.upTo(5);
    await other.goto(`${server.url}#live/told`);
    const told = (words) => until(words, async () => (await text(other, ".announced")).startsWith(words));
    await other.waitForSelector(".targets tbody");
    await told("Running");
    run.drop();
    await told("Connection lost");
    await until("the connection", () => run.asked.length === 2);
    run.upTo(1e9);
    run.end();
    await told("Done");
  },
});
