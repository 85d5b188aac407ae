// The cases of the page about looking closer: layers, plots that are zoomed and added, fields of messages, the ruler, the palette.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { until } from "./browser.mjs";
import { onScreen } from "./drag.mjs";

const box = [-10.06, -7.06, 10.06, 7.06];  // of the fence of the yard

export const cases = ({ open, text, frames, server, folder }) => ({
  async "the legend switches layers off and, opened, makes them faint, in plan and in space; the address keeps it; what is off cannot be selected"() {
    const page = await open("#watch/runs/yard/run.mcap?t=20");
    await page.waitForSelector(".targets tbody");
    await frames(page);
    const picture = (selector = ".plan-view canvas") => page.evaluate((one) => document.querySelector(one).toDataURL(), selector);
    const all = await picture();
    const row = (name) => page.locator(`.legend .layer[data-layer="${name}"]`);
    const layers = () => page.locator(".legend .layer").evaluateAll((all) => all.map((one) => one.dataset.layer));
    assert.deepEqual(await layers(), ["robot", "targets", "shots", "blocked flights", "path", "planned tour", "firing map", "obstacles"]);
    assert.match(await row("targets").locator(".signs").textContent(), /waiting.*reached.*unreachable/);
    assert.ok(await row("targets").locator("input[type=range]").isHidden(), "opacities are there once it is opened");
    await row("targets").locator("label").click();
    await frames(page);
    const without = await picture();
    assert.notEqual(without, all);
    await row("targets").locator("label").click();
    await frames(page);
    assert.equal(await picture(), all, "on again, it is as it was");
    await page.keyboard.press("y");
    assert.ok(!await row("firing map").locator("input[type=checkbox]").isChecked(), "what was planned is shown to who asks for it");
    await row("obstacles").locator("input[type=range]").fill("0.3");
    await row("shots").locator("input[type=checkbox]").click();
    await until("the address", () => page.evaluate(() => /layers=obstacles(:|%3A)0\.3,shots(:|%3A)0\b/.test(location.hash)));
    await page.keyboard.press("Escape");
    await page.locator(".plan-view canvas").focus();
    await page.keyboard.press("v");
    await page.waitForSelector(".space-view canvas");
    await frames(page);
    const named = await picture(".space-view canvas");
    await page.keyboard.press("y");
    await row("names").locator("input[type=checkbox]").click();
    await frames(page);
    assert.notEqual(await picture(".space-view canvas"), named, "names stand in space");
    assert.ok(Number(await page.locator(".space-view").getAttribute("data-names")) === 0);
    await row("names").locator("input[type=checkbox]").click();
    await frames(page);
    assert.ok(Number(await page.locator(".space-view").getAttribute("data-names")) >= 20, "nearly all have room");
    // Layers of the plan are drawn in space as well.
    for (const name of ["firing map", "planned tour"]) {
      const before = await picture(".space-view canvas");
      await row(name).locator("input[type=checkbox]").click();
      await frames(page);
      assert.notEqual(await picture(".space-view canvas"), before, name);
    }
  },

  async "plots: a drag shows a part of the time in all, lanes tell the states, any number of any channel is added and removed"() {
    const page = await open("#watch/runs/yard/run.mcap?t=20&tab=plots");
    await page.waitForSelector(".plots .u-over");
    await frames(page);
    const numbers = page.locator(".plots figure:not(.lane-plot)");
    const count = await numbers.count();
    const over = async (i) => numbers.nth(i).locator(".u-over").boundingBox();
    const { x, y, width, height } = await over(0);
    await page.mouse.move(x + 0.25 * width, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + 0.5 * width, y + height / 2, { steps: 4 });
    await page.mouse.up();
    await until("the part", () => page.locator(".plot-tools .button").isVisible());
    const at = async (share) => {
      await page.mouse.move(x + share * width, y + height / 2);
      return numbers.evaluateAll((all) => all.map((one) => Number.parseFloat(one.querySelector(".values b").textContent)));
    };
    const [from, to] = [await at(0.002), await at(0.998)];
    const whole = JSON.parse(readFileSync(join(folder, "runs/yard/run.json"))).metrics.mission_s;
    assert.ok(Math.abs(from[0] - 0.25 * whole) < 0.5 && Math.abs(to[0] - 0.5 * whole) < 0.5, `${from} to ${to}`);
    assert.ok(from.every((one) => one === from[0]), "the cursor is shared");
    await page.mouse.click(x + 0.5 * width, y + height / 2);
    await until("the clock", async () => Math.abs(Number((await text(page, ".transport .clock")).split(" / ")[0].split(":")[1]) - 0.375 * whole) < 0.5);
    await page.mouse.dblclick(x + 0.5 * width, y + height / 2);
    await until("the whole run", () => page.locator(".plot-tools .button").isHidden());
    const lanes = page.locator(".lane-plot", { hasText: "Status of targets" });
    await lanes.scrollIntoViewIfNeeded();
    await page.mouse.move(0, 0);
    await until("the states", async () => /^waiting\d+reached\d+unreachable1$/.test(await lanes.locator(".lane-words").textContent()));
    assert.equal(await text(page, ".lane-plot .lane-words"), "follows a path");
    const lane = await lanes.locator("canvas").boundingBox();
    await page.mouse.move(lane.x + lane.width - 25, lane.y + 3);
    await until("the state", async () => /^garfield: reached$/.test(await lanes.locator(".lane-words").textContent()));
    const picker = page.locator(".plot-tools select");
    await picker.focus();
    await picker.selectOption("/pose:pose.position.y");
    await until("one more", async () => await numbers.count() === count + 1);
    assert.match(await numbers.first().textContent(), /^pose position y \/pose/);
    await until("the address", () => page.evaluate(() => location.hash.includes("plots=")));
    await page.reload();
    await page.waitForSelector(".plots figure .quiet");
    await page.click(".plots figure .quiet");
    await until("one less", async () => await numbers.count() === count);
  },

  async "what is selected in plan or space shows the fields of its message, and so does any channel; the ruler measures"() {
    const page = await open("#watch/runs/yard/run.mcap?t=20");
    await page.waitForSelector(".targets tbody");
    await frames(page);
    const head = await page.evaluate(() => Math.max(50, document.querySelector(".stage-bar").offsetHeight + 20));
    const place = (at) => onScreen(page, box, at, ".plan-view canvas", head);
    await page.mouse.click(...await place([0.3, 1.5]));  // the house
    const name = await until("its fields", () => text(page, ".messages h2"));
    assert.ok((await text(page, ".messages .fields")).startsWith(`name${name}kind`));
    await page.selectOption(".messages select", "/pose");
    await until("the pose", async () => /PoseStamped, of (19|20)\.\d+ s/.test(await text(page, ".message-about")));
    const first = await text(page, ".fields");
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("Home");
    await until("another", async () => await text(page, ".fields") !== first);
    await page.keyboard.press("r");
    await page.mouse.move(...await place([-5, 0]));
    await page.mouse.down();
    await page.mouse.move(...await place([-2, 4]), { steps: 3 });
    await page.mouse.up();
    await frames(page);
    const measured = await page.locator(".plan-view").getAttribute("data-measured");
    assert.match(measured, /^(4\.9\d|5\.0\d) m, \u0394x (2\.9\d|3\.0\d) m, \u0394y (3\.9\d|4\.0\d) m, 5[23]\.\d\u00b0$/);
    await page.keyboard.press("v");
    await page.waitForSelector(".space-view canvas");
    await frames(page);
    const ruler = page.locator(".stage-tools button[aria-label^=Measure]");
    assert.ok(await ruler.isDisabled() && /in the plan view$/.test(await ruler.getAttribute("title")), "the ruler is of the plan, and says so");
    const space = await page.locator(".space-view canvas").boundingBox();
    await page.mouse.click(space.x + 0.51 * space.width, space.y + 0.45 * space.height);
    await until("the house again", async () => await text(page, ".messages h2") === name && (await text(page, ".fields")).startsWith(`name${name}kind`));
  },

  async "why: the stops of the tour with those that each serves, what the bound says, and where nobody could be hit from"() {
    const page = await open("#watch/runs/yard/run.mcap?t=20&tab=why");
    await page.waitForSelector(".why li");
    const { metrics } = JSON.parse(readFileSync(join(folder, "runs/yard/run.json")));
    const rows = await page.locator(".why li").allTextContents();
    const served = rows.filter((one) => one.includes("serves "));
    assert.ok(served.filter((one) => one.startsWith("Stop ")).length >= metrics.stops, rows.join("\n"));
    assert.equal(served.filter((one) => one.startsWith("On the way")).reduce((sum, one) => sum + one.split("serves ")[1].split(", ").length, 0), metrics.hits_in_passing);
    assert.equal(served.reduce((sum, one) => sum + one.split("serves ")[1].split(", ").length, 0), metrics.reached);
    assert.match(rows.at(-1), /^schroedi: unreachablenone of [\d,]+ flights/);
    assert.match(await text(page, ".why .about"), new RegExp(`^The plan takes ${metrics.planned_s.toFixed(1)} s\\. None takes less than ${metrics.lower_bound_s.toFixed(1)} s.* of all missions, standing or on the move`));
    await page.locator(".why li button").nth(1).click();
    await until("its time", () => page.locator(".why li").nth(1).evaluate((one) => one.hasAttribute("aria-current")));
  },

  async "the palette finds commands and files by a few letters"() {
    const page = await open("#watch/runs/yard/run.mcap?t=5");
    await page.waitForSelector(".targets tbody");
    await page.keyboard.press("Control+k");
    await page.keyboard.type("follow rob");
    await until("the command", async () => /^follow the robot/.test(await text(page, ".palette li")));
    await page.keyboard.press("Enter");
    await until("it is done", () => page.evaluate(() => location.hash.includes("follow=1")));
    await page.keyboard.press("Control+k");
    await page.keyboard.type("gallery");
    await until("the file", async () => /gallery\.map/.test(await text(page, ".palette li")));
    await page.keyboard.press("Enter");
    await page.waitForSelector(".plan-page .result td[data-row=answer]");
    assert.equal(page.url().split("?")[0], `${server.url}#plan/maps/gallery.map`);
  },
});
