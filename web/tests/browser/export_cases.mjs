// The cases of the page about what can be saved: one menu, by the pointer and by the keyboard, and what it saves.
import assert from "node:assert/strict";
import { saved } from "./browser.mjs";
import { readPng } from "./png.mjs";

/** Returns what a file shows when the browser plays it: its size, its length, and the colour in the middle at two times. */
const played = (page, bytes) => page.evaluate(async (text) => {
  const video = Object.assign(document.createElement("video"), { muted: true, src: URL.createObjectURL(new Blob([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], { type: "video/webm" })) });
  await new Promise((done, fail) => { video.onloadeddata = done; video.onerror = () => fail(new Error(video.error.message)); });
  video.currentTime = video.duration - 0.05;
  await new Promise((done) => { video.onseeked = done; });
  return { width: video.videoWidth, height: video.videoHeight, duration: video.duration };
}, bytes.toString("base64"));

export const cases = ({ open, blank, text, frames }) => ({
  async "one menu saves the view as PNG and SVG, a film by the encoder of the browser, the numbers and the log"() {
    const page = await open("#watch/runs/yard/run.mcap?t=20");
    await page.waitForSelector(".targets tbody");
    await frames(page);
    const menu = page.locator('.stage-tools button[aria-label="Export"]');
    await menu.click();
    assert.deepEqual(await page.locator(".menu [role=menuitem] b").allTextContents(), ["PNG", "SVG", "WebM", "JSON", "MCAP"]);
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Escape");
    assert.equal(await menu.getAttribute("aria-expanded"), "false");
    const choose = async (name) => {
      await menu.click();
      await page.locator(".menu [role=menuitem]", { hasText: name }).click();
    };
    const { width, height } = readPng(await saved(page, () => choose("PNG")));
    assert.match((await saved(page, () => choose("SVG"))).toString(), /^<svg/);
    assert.equal(JSON.parse(await saved(page, () => choose("JSON"))).status, "done");
    assert.equal((await saved(page, () => choose("MCAP"))).subarray(1, 5).toString(), "MCAP");
    const film = await saved(page, async () => {
      await choose("WebM");
      for (const [name, value] of [["From", 20], ["To", 20.9], ["Frames a second", 10]]) await page.fill(`.film [aria-label="${name}"]`, String(value));
      assert.match(await text(page, ".film .hint"), /^10 frames/);
      await page.locator(".film button[type=submit]").click();
    });
    const other = await blank();
    const shown = await played(other, film);  // the page itself plays nothing, and its policy says so
    assert.deepEqual([shown.width, shown.height], [width & ~1, height & ~1]);
    assert.ok(Math.abs(shown.duration - 1) < 0.11, `${shown.duration} s`);
    await page.goto(page.url().replace(/#.*/, "#plan/maps/gallery.map?planner=a_star"));
    await page.waitForSelector(".result td[data-row=answer]");
    const [answer] = JSON.parse(await saved(page, () => choose("JSON")));
    assert.equal(answer.status, "done");
    assert.ok(answer.waypoints.length >= 2);
    // Before an answer, and while a run goes on, there is nothing to save yet: the menu says when there will be.
    await other.routeWebSocket("**/api/v1/live", () => undefined);
    await other.goto(page.url());
    await other.waitForSelector(".plan-page");
    await other.click('.stage-tools button[aria-label="Export"]');
    const json = other.locator(".menu [role=menuitem]", { hasText: "JSON" });
    assert.equal(await json.getAttribute("aria-disabled"), "true");
    assert.match(await json.textContent(), /when the answer is there/);
    let files = 0;
    other.on("download", () => { ++files; });
    await json.click({ force: true });  // as somebody would who tries
    await other.keyboard.press("Escape");
    await other.keyboard.press("J");
    assert.match(await text(other, ".announced"), /^JSON: when the answer is there/);
    await frames(other);
    assert.equal(files, 0);
  },
});
