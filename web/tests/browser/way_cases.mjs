// The cases of the page about finding the way: titles, the keyboard after the mouse, files that are dropped, refusals.
import assert from "node:assert/strict";
import { join } from "node:path";
import { writeFileSync } from "node:fs";
import { until } from "./browser.mjs";

/** Drops texts as files, or drags them over the page. */
const drag = (page, event, files) => page.evaluate(([kind, all]) => {
  const dropped = new DataTransfer();
  for (const [name, text] of all) dropped.items.add(new File([text], name));
  dispatchEvent(new DragEvent(kind, { dataTransfer: dropped, cancelable: true }));
}, [event, files]);
const small = `type octile\nheight 20\nwidth 30\nmap\n${`${".".repeat(30)}\n`.repeat(20)}`;

export const wayCases = ({ open, text, frames, cell, folder }) => ({
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
    await page.close();
  },

  async "space that follows the robot, then the plan: as large as before"() {
    const page = await open("#watch/runs/yard/run.mcap?t=9");
    await page.waitForSelector(".tabbed");
    /** The view once nothing in it changes any more. */
    const rested = async () => {
      let [before, now] = ["", await view()];
      while (now !== before) {
        await page.waitForTimeout(300);
        [before, now] = [now, await view()];
      }
      return now;
    };
    const view = () => page.evaluate(() => document.querySelector(".plan-view canvas").toDataURL());
    const all = await rested();
    await page.keyboard.press("f");
    const before = await rested();
    assert.notEqual(before, all);
    for (const key of ["f", "0", "v"]) await page.keyboard.press(key);
    await page.waitForSelector(".space-view canvas");
    await page.keyboard.press("f");
    await frames(page);
    await page.keyboard.press("v");
    await page.waitForSelector(".plan-view canvas:visible");
    assert.equal(await rested() === before, true, "the plan is as it was");
    await page.close();
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
    await page.close();
  },

  async "what is dropped: the page shows where; two maps are refused by name; a reload says that the map is to be dropped again"() {
    const page = await open();
    await page.waitForSelector(".groups");
    await drag(page, "dragover", [["small.map", small]]);
    assert.equal(await page.locator("body.drop-here").count(), 1);
    await drag(page, "drop", [["small.map", small], ["other.map", small]]);
    await page.waitForSelector(".refusal");
    assert.match(await text(page, ".refusal"), /small\.map and other\.map; drop one/);
    assert.equal(await page.locator("body.drop-here").count(), 0);
    await drag(page, "drop", [["small.map", small]]);
    await page.waitForSelector(".result");
    assert.equal(await cell(page, "answer"), "path found");
    await page.reload();
    await page.waitForSelector(".refusal");
    assert.match(await text(page, ".refusal"), /not kept when the page is loaded again; drop its file once more/);
    await page.close();
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
    await page.close();
  },
});
