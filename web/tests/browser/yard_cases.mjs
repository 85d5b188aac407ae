// The case of the page about a yard that is changed, saved and guarded.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { compareShot, until } from "./browser.mjs";
import { onScreen } from "./drag.mjs";

export const cases = ({ open, text, frames, server, folder, output }) => ({
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
    server.hold("yard/yard_changed.yaml");
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
  },
});
