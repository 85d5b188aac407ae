// The cases of the planning page about the whole map: a maze, nothing, metres and feet, two planners on a wide map.
import assert from "node:assert/strict";
import { until } from "./browser.mjs";

export const planToolCases = ({ open, text, cell, answers }) => ({
  async "a maze and an empty map are one click each, and undone; lengths are in feet where somebody asks for that"() {
    const page = await open("#draw?planner=a_star&radius=0.2&start=2,5.5&goal=14,5.5");
    await page.waitForSelector(".result td[data-row=answer]");
    assert.match(await text(page, ".map-tools .about"), /^16 by 11 m, cells of 0\.25 m/);
    assert.match(await text(page, ".choice select option:checked"), /^A\*$/);
    const after = async (act) => {
      const before = await answers(page);
      await act();
      await until("an answer", async () => await answers(page) > before);
    };
    const length = async () => Number.parseFloat(await cell(page, "length"));
    const free = await length();
    await after(() => page.click(".map-tools button:text('Maze')"));
    await until("a way through the maze", async () => await cell(page, "answer") === "path found" && await length() > 1.5 * free);
    const once = await length();
    assert.ok(Number.parseFloat(await cell(page, "clearance")) >= 0.2, await cell(page, "clearance"));
    await page.keyboard.press("M");
    await until("another", async () => Math.abs(await length() - once) > 0.01);
    await page.keyboard.press("u");
    await until("the first", async () => await length() === once);
    await page.click(".link");
    await until("feet", async () => /ft$/.test(await cell(page, "length")));
    assert.ok(Math.abs(await length() - once / 0.3048) < 0.01);
    assert.equal(await page.inputValue("#radius"), "0.6562");
    await page.click(".link");
    await after(() => page.click(".map-tools button:text('Clear')"));
    await until("no walls", async () => await length() < once);
    await page.goto(page.url().replace(/#.*/, "#plan/maps/gallery.map?planner=a_star&versus=dijkstra"));
    await until("the less work", async () => await page.locator('.result td.least[data-row="expansions"]').count() === 1);
    assert.equal(await page.locator('.result td[data-row="expansions"]').first().getAttribute("class"), "least");
    assert.equal(await page.locator('.result td.least[data-row="cost"]').count(), 0, "the costs are the same");
    const [above, below] = await page.locator(".pane").evaluateAll((all) => all.map((one) => one.getBoundingClientRect().top));
    assert.ok(below > above, "a wide map lies above the other");
    const rooms = await page.locator(".pane").evaluateAll((all) => all.map((one) => one.offsetHeight));
    const bar = await page.evaluate(() => document.querySelector(".stage-bar").offsetTop + document.querySelector(".stage-bar").offsetHeight + 8);
    assert.ok(Math.abs(rooms[0] - rooms[1] - (Math.max(50, bar) - 16)) <= 2, `both maps are of one size: ${rooms}, below a bar of ${bar}`);
    const [buttons, canvas] = await page.evaluate(() => [".pane .camera", ".pane canvas"].map((one) => document.querySelector(one).getBoundingClientRect()).map(({ left, right }) => ({ left, right })));
    assert.ok(buttons.left >= canvas.right - 54, "the buttons lie beside the map");
    await page.close();
  },
});
