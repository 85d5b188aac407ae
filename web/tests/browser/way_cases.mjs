// The cases of the page about finding the way: titles, the keyboard after the mouse, files that are dropped, refusals.
import assert from "node:assert/strict";
import { join } from "node:path";
import { rmSync, writeFileSync } from "node:fs";
import { rested, until } from "./browser.mjs";
import { noteQuestions } from "./drag.mjs";

/** Drops texts as files, or drags them over the page. */
const drag = (page, event, files) => page.evaluate(([kind, all]) => {
  const dropped = new DataTransfer();
  for (const [name, text] of all) dropped.items.add(new File([text], name));
  dispatchEvent(new DragEvent(kind, { dataTransfer: dropped, cancelable: true }));
}, [event, files]);
const small = `type octile\nheight 20\nwidth 30\nmap\n${`${".".repeat(30)}\n`.repeat(20)}`;

export const cases = ({ open, blank, text, frames, cell, answers, onMap, server, folder }) => ({
  async "the window is called what it shows"() {
    const page = await open();
    await page.waitForSelector(".groups");
    assert.match(await page.title(), / \u2013 Outrider$/);
    for (const [hash, selector, title] of [["#watch/runs/yard/run.mcap", ".tabbed", /^yard.*, done \u2013 Outrider$/], ["#plan/maps/gallery.map", ".result", /^gallery\.map \u2013/],
      ["#live", ".start", /^Run a mission \u2013/]]) {
      await page.evaluate((to) => { location.hash = to; }, hash);
      await page.waitForSelector(selector);
      await until(`the title of ${hash}`, async () => title.test(await page.title()));
    }
  },

  async "space that follows the robot, then the plan: as large as before"() {
    const page = await open("#watch/runs/yard/run.mcap?t=9");
    await page.waitForSelector(".tabbed");
    const view = () => rested(page, ".plan-view canvas");
    const all = await view();
    await page.keyboard.press("f");
    const before = await until("the robot in the middle", async () => { const now = await view(); return now !== all && now; });
    for (const key of ["f", "0", "v"]) await page.keyboard.press(key);
    await page.waitForSelector(".space-view canvas");
    await page.keyboard.press("f");
    await frames(page);
    await page.keyboard.press("v");
    await page.waitForSelector(".plan-view canvas:visible");
    await until("the plan as it was", async () => await view() === before);
  },

  async "a browser without WebGL says so, and stays with the plan"() {
    const page = await blank();
    await page.addInitScript(() => {
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function (kind, ...more) { return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...more); };
      const { error } = console;
      console.error = (...words) => { if (!/WebGL/.test(words.join())) error(...words); };  // three.js tells of it
    });
    await page.goto(`${server.url}#watch/runs/yard/run.mcap?t=9&view=3d`);
    await page.waitForSelector(".stage-note");
    assert.match(await text(page, ".stage-note"), /needs WebGL 2/);
    assert.ok(await page.locator(".plan-view canvas").isVisible());
    assert.equal(await page.locator(".segments button[aria-pressed=true]").textContent(), "Plan");
    await until("the address", () => page.evaluate(() => !location.hash.includes("view=3d")));
  },

  async "the space key plays after a button was clicked, and presses it after the keyboard came to it"() {
    const page = await open("#watch/runs/yard/run.mcap?t=9");
    await page.waitForSelector(".tabbed");
    const following = page.locator("button[aria-label*='ollow']").first();
    await following.click();
    const pressed = await following.getAttribute("aria-pressed");
    const at = await text(page, ".clock");
    await page.keyboard.press(" ");
    await until("time to pass", async () => (await text(page, ".clock")) !== at);
    assert.equal(await following.getAttribute("aria-pressed"), pressed);
    await page.keyboard.press(" ");
    await following.focus();
    await page.keyboard.press(" ");
    await until("the button", async () => (await following.getAttribute("aria-pressed")) !== pressed);
  },

  async "what is dropped: the page shows where; two maps are refused by name; a reload says that the map is to be dropped again"() {
    const page = await open();
    await page.waitForSelector(".groups");
    await drag(page, "dragover", [["small.map", small]]);
    assert.equal(await page.locator("body.drop-here").count(), 1);
    await drag(page, "drop", [["small.map", small], ["other.map", small]]);
    await page.waitForSelector(".notice-over:not([hidden])");
    assert.match(await text(page, ".notice-over"), /small\.map and other\.map; drop one/);
    assert.equal(await page.locator("body.drop-here").count(), 0);
    await drag(page, "drop", [["small.map", small]]);
    await page.waitForSelector(".result");
    assert.equal(await cell(page, "answer"), "path found");
    await page.reload();
    await page.waitForSelector(".refusal");
    assert.match(await text(page, ".refusal"), /not kept when the page is loaded again; drop its file once more/);
  },

  async "what was drawn is there after a bad file, is undone step by step, and is left only by those who say so"() {
    const page = await blank();
    await noteQuestions(page);
    await page.goto(`${server.url}#draw?planner=a_star&start=2,5.5&goal=14,5.5&radius=0`);
    await page.waitForSelector(".result");
    const length = async () => Number.parseFloat(await cell(page, "length"));
    const asked = [];
    let leave = false;
    page.on("dialog", (dialog) => {
      asked.push(dialog.type());
      void (leave ? dialog.accept() : dialog.dismiss());
    });
    const free = await length();
    await page.keyboard.press("w");
    const wall = async (x) => {
      const before = await answers(page);
      await page.mouse.move(...await onMap(page, x, 2));
      await page.mouse.down();
      await page.mouse.move(...await onMap(page, x, 9.5), { steps: 8 });
      await page.mouse.up();
      await until("an answer", async () => await answers(page) > before);
    };
    await wall(6);
    await until("a longer path", async () => await length() > free + 1);
    await frames(page);
    await until("the last answer", () => page.evaluate(() => window.asked.every(({ answered }) => answered !== null)));
    const [once, view] = [await length(), await page.evaluateHandle(() => document.querySelector(".plan-page"))];
    const same = () => page.evaluate((one) => one === document.querySelector(".plan-page"), view);
    await drag(page, "drop", [["broken.map", "type octile\nheight 2\nwidth 3\nmap\n..\n"]]);
    await page.waitForSelector(".notice-over:not([hidden])");
    assert.match(await text(page, ".notice-over"), /broken\.map.*(line|row|width|cells)/);
    assert.ok(await same() && await length() === once);
    await page.click(".notice-over button");
    assert.ok(await page.locator(".notice-over").isHidden());
    // Undo and redo, by key and by button.
    await page.keyboard.press("q");
    await page.keyboard.press("2");
    await page.keyboard.press("k");
    await page.keyboard.press("Control+z");
    await until("the goal", () => page.evaluate(() => /goal=14,5\.5\b/.test(location.hash)));
    await page.keyboard.press("u");
    await until("the path of before", async () => await length() === free);
    await page.click('.stage-tools button[aria-label="Do it again"]');
    await until("the wall", async () => await length() === once);
    // A good file, a link, Back and a reload ask first.
    await drag(page, "drop", [["small.map", small]]);
    await until("the question", () => asked.length === 1);
    await page.evaluate(() => { location.hash = "live"; });
    await until("the question", () => asked.length === 2);
    assert.ok(await same());
    await until("the address", () => page.evaluate(() => location.hash.startsWith("#draw")));
    page.reload().catch(() => undefined);  // it does not end, since it is refused
    await until("the question", () => asked.length === 3);
    assert.deepEqual(asked, ["confirm", "confirm", "beforeunload"]);
    assert.ok(await same() && await length() === once);
    await page.fill("#save-name", "kept_wall.yaml");
    await page.click(".save button");
    await until("the sentence", async () => /^Saved /.test(await text(page, ".saved")));
    await page.evaluate(() => { location.hash = "live"; });
    await page.waitForSelector(".start");
    assert.equal(asked.length, 3, "what is saved can be left");
    leave = true;
    await page.evaluate(() => { location.hash = "change/kept_wall.yaml"; });
    await page.waitForSelector(".result");
    await page.keyboard.press("w");
    await wall(10);
    await drag(page, "drop", [["small.map", small]]);
    await until("the map", async () => /^small\.map \u2013/.test(await page.title()));
    assert.equal(asked.at(-1), "confirm");
    for (const name of ["kept_wall.yaml", "kept_wall_map.pgm", "kept_wall_map.yaml"]) rmSync(join(folder, name));
  },

  async "a yard that was changed is left only by those who say so"() {
    const page = await open("#change/yard/yard.yaml");
    await page.waitForSelector(".yard-page tbody");
    const asked = [];
    page.on("dialog", (dialog) => {
      asked.push(dialog.type());
      void dialog.dismiss();
    });
    await page.keyboard.press("l");
    await page.click('header a[href="#live"]');
    await until("the question", () => asked.length === 1);
    assert.ok(await page.locator(".yard-page").isVisible());
    await page.keyboard.press("u");
    await page.click('header a[href="#live"]');
    await page.waitForSelector(".start");
    assert.equal(asked.length, 1);
  },

  async "a run that is refused: which scenario, the whole sentence, and ways on"() {
    writeFileSync(join(folder, "yard/no_world.yaml"), "job: guard\n");
    const page = await open("#live?scenario=yard/no_world.yaml");
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    await page.waitForSelector(".live-page .refusal");
    assert.equal(await text(page, ".run-head h1"), "yard/no_world.yaml");
    assert.match(await text(page, ".live-page .refusal"), /^(world|targets): missing; give/);
    assert.match(await page.title(), /^yard\/no_world\.yaml, refused/);
    await page.click(".live-page .hint a:last-child");
    await page.waitForSelector(".start button:enabled");
  },
});
