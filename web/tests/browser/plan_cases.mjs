// The cases of the planning page: searches that are stepped through, obstacles that are drawn, options, files.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { compareShot, until } from "./browser.mjs";
import { onScreen } from "./drag.mjs";
import { tool } from "./server.mjs";

export const cases = ({ open, text, frames, cell, answers, nextAnswer, onMap, server, folder, output }) => ({
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
  },
});
