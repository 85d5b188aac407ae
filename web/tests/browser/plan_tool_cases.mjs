// The cases of the planning page about the whole map: a maze, nothing, metres and feet, two planners on a wide map.
import assert from "node:assert/strict";
import { rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { until } from "./browser.mjs";

/** A room of 8 by 4 m with walls 0.2 m thick, and across its middle a wall with a gap of 1 m, as cells of 5 cm, as polygons and as solids. */
function makeGap(folder) {
  const walls = [[0, 0, 8, 0.2], [0, 3.8, 8, 4], [0, 0, 0.2, 4], [7.8, 0, 8, 4], [3.9, 0.2, 4.1, 1.5], [3.9, 2.5, 4.1, 3.8]];
  const cells = Buffer.alloc(160 * 80, 254);
  for (const wall of walls) {
    const [x0, y0, x1, y1] = wall.map((value) => Math.round(20 * value));
    for (let y = y0; y < y1; ++y) cells.fill(0, (79 - y) * 160 + x0, (79 - y) * 160 + x1);
  }
  const outline = ([x0, y0, x1, y1]) => `(${x0},${y0}) (${x1},${y0}) (${x1},${y1}) (${x0},${y1})\n`;
  const box = ([x0, y0, x1, y1], i) => `<model name="wall_${i}"><static>true</static><pose>${(x0 + x1) / 2} ${(y0 + y1) / 2} 0.5 0 0 0</pose><link name="link"><collision name="body"><geometry><box><size>${x1 - x0} ${y1 - y0} 1</size></box></geometry></collision></link></model>`;
  const floor = '<model name="ground"><static>true</static><link name="link"><collision name="floor"><geometry><plane><normal>0 0 1</normal><size>20 20</size></plane></geometry></collision></link></model>';
  const files = { "gap.pgm": Buffer.concat([Buffer.from("P5\n160 80\n255\n"), cells]),
    "gap.yaml": "image: gap.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
    "gap.txt": `${outline([0.2, 0.2, 7.8, 3.8])}---\n${walls.slice(4).map(outline).join("")}---\n`,
    "gap.sdf": `<sdf version="1.9"><world name="gap">${floor}${walls.map(box).join("")}</world></sdf>` };
  for (const [name, content] of Object.entries(files)) writeFileSync(join(folder, "maps", name), content);
  return () => { for (const name of Object.keys(files)) rmSync(join(folder, "maps", name)); };
}

export const cases = ({ open, text, cell, answers, server, folder }) => ({
  async "clearance is the distance of the robot's middle to the nearest obstacle, on cells, polygons and solids alike"() {
    const removeGap = makeGap(folder);
    const page = await open("#live");
    /** Returns what is shown for the way between two places on one height, by the map and the planner. */
    const clearances = async (y, radius) => {
      const shown = {};
      for (const [map, planner] of [["gap.yaml", "theta_star"], ["gap.txt", "visibility_graph_implicit"], ["gap.sdf", "visibility_graph_implicit"]]) {
        await page.goto(`${server.url}#plan/maps/${map}?planner=${planner}&start=1.025,${y}&goal=6.975,${y}&radius=${radius}`);
        await until("the map", async () => (await page.title()).startsWith(map));
        await until("an answer", async () => await answers(page) > 0);
        assert.equal(await cell(page, "answer"), "path found", map);
        shown[map] = Number((await cell(page, "clearance")).match(/^([\d.]+) m$/)[1]);
      }
      return shown;
    };
    // Straight through the gap, 0.475 m from its nearer side whatever the radius; round its corner, as near as the radius lets it.
    for (const radius of [0.2, 0.3]) {
      assert.deepEqual(await clearances(2.025, radius), { "gap.yaml": 0.475, "gap.txt": 0.475, "gap.sdf": 0.475 });
      const { "gap.yaml": cells, ...exact } = await clearances(1.025, radius);
      assert.deepEqual(exact, { "gap.txt": radius, "gap.sdf": radius });
      assert.ok(cells >= radius && cells <= radius + Math.SQRT2 * 0.05, `${cells} m on cells of 0.05 m, with a radius of ${radius} m`);
    }
    assert.match(await page.locator('.result th[title]').getAttribute("title"), /^From the middle of the robot to the nearest obstacle/);
    removeGap();
  },

  async "two planners lie beside each other on a tall map, above each other on a wide one"() {
    writeFileSync(join(folder, "maps/tall.map"), `type octile\nheight 40\nwidth 20\nmap\n${`${".".repeat(20)}\n`.repeat(40)}`);
    const page = await open("#plan/maps/tall.map?planner=a_star&versus=dijkstra");
    const places = async () => {
      await until("both answers", async () => await page.locator('.result td[data-row="cost"]').count() === 2);
      return page.locator(".pane").evaluateAll((all) => all.map((one) => one.getBoundingClientRect()).map(({ left, top }) => [left, top]));
    };
    const [[left, top], [otherLeft, otherTop]] = await places();
    assert.ok(otherLeft > left && otherTop === top);
    await page.goto(`${server.url}#plan/maps/gallery.map?planner=a_star&versus=dijkstra`);
    await page.waitForSelector('.panes.stacked');
    const [[, above], [, below]] = await places();
    assert.ok(below > above);
    rmSync(join(folder, "maps/tall.map"));
  },

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
  },
});
