// The cases of the front page: its example, its cards, its files.
import assert from "node:assert/strict";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { compareShot, until } from "./browser.mjs";
import { contentsOf } from "./streams.mjs";

const example = fileURLToPath(new URL("../../src/front/example.mcap", import.meta.url));
const time = (page) => page.evaluate(() => Number(document.querySelector(".hero").dataset.t));
const playing = (page) => page.locator(".hero").getAttribute("data-playing");
/** Waits until the cards in sight have their pictures. */
const drawn = (page) => until("the pictures", () => page.evaluate(() => [...document.querySelectorAll(".card")]
  .filter((one) => one.getBoundingClientRect().top < innerHeight).every((one) => one.querySelector(".card-picture").matches(".drawn, .bare"))));

export const cases = ({ open, text, frames, server, folder, output }) => ({
  async "the front page, before other cases add their files"() {
    const page = await open();
    const plain = [];  // long answers that came as they are
    let packed = 0;
    page.on("response", async (response) => {
      const headers = await response.allHeaders().catch(() => ({}));
      const ours = !process.env.OUTRIDER_PAGE || response.url().includes("/api/");
      if (headers["content-encoding"] === "gzip") ++packed;
      if (ours && Number(headers["content-length"]) >= 1000 && !headers["content-encoding"] && !/\.(mcap|png|woff2)$/.test(response.url())) plain.push(`${response.url()} (${headers["content-length"]} bytes)`);
    });
    await page.reload();
    await until("the example", () => page.locator(".hero .play").isEnabled());
    assert.match(await text(page, "h1"), /^[^.]+\.$/, "one sentence");
    await drawn(page);
    assert.deepEqual(plain, [], "what is long is compressed");
    assert.ok(packed >= 3, `${packed} answers were compressed`);
    await frames(page);
    assert.equal(await playing(page), "false", "the system asks for no motion");
    await compareShot(page, "front", output);
    await page.setViewportSize({ width: 390, height: 844 });
    await page.keyboard.press("d");
    await drawn(page);
    await frames(page);
    await compareShot(page, "front-phone-dark", output);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "the page is wider than the window");
  },

  async "the example moves, pauses, and rests out of sight; where no motion is wanted it waits for the button"() {
    const page = await open("", { reducedMotion: "no-preference" });
    await until("the example", async () => await playing(page) === "true" && await time(page) > 0);
    const start = await time(page);
    await until("time to pass", async () => await time(page) > start + 0.1);
    await page.click(".hero .play");
    assert.equal(await playing(page), "false");
    assert.equal(await page.locator(".hero .play").getAttribute("aria-label"), "Play the example");
    const rests = async () => {
      await frames(page);
      const before = await time(page);
      await page.waitForTimeout(300);
      return await time(page) === before;
    };
    assert.ok(await rests());
    await page.click(".hero .play");
    await page.setViewportSize({ width: 900, height: 300 });
    await page.evaluate(() => document.querySelector(".groups").scrollIntoView());
    await until("rest out of sight", rests);
    assert.equal(await playing(page), "true");
    const out = await time(page);
    await page.evaluate(() => document.querySelector(".hero").scrollIntoView());
    await until("more of it", async () => await time(page) !== out);
    await page.emulateMedia({ reducedMotion: "reduce" });
    await page.reload();
    await until("the example", () => page.locator(".hero .play").isEnabled());
    await frames(page);
    const still = await time(page);
    await page.waitForTimeout(300);
    assert.equal(await time(page), still);
    await page.focus(".hero .play");
    await page.keyboard.press("Enter");
    await until("time to pass", async () => await time(page) !== still);
  },

  async "a card for each scenario says what its file says, and has the picture of its ground; one click runs it"() {
    writeFileSync(join(folder, "broken.yaml"), "# Nobody can run this.\njob: guard\nworld: absent.sdf\n");
    const page = await open();
    await page.waitForSelector(".cards .card");
    const { files } = JSON.parse(await page.evaluate(async () => (await fetch("api/v1/files")).text()));
    const scenarios = files.filter(({ kind }) => kind === "scenario").map(({ path }) => path);
    assert.deepEqual((await page.locator(".card").evaluateAll((all) => all.map((one) => one.dataset.path))).sort(), scenarios.sort());
    const card = page.locator('.card[data-path="yard/yard.yaml"]');
    assert.match(await card.locator("h3").textContent(), /^Yard/);
    assert.equal(await card.locator(".card-about").textContent(), readFileSync(join(folder, "yard/yard.yaml"), "utf8").match(/^# (.*)/)[1]);
    assert.equal(await page.locator('.card[data-path="broken.yaml"] .card-about').textContent(), "Nobody can run this.");
    assert.ok(await card.locator(".change").isVisible());
    for (const path of scenarios) {
      const picture = page.locator(`.card[data-path="${path}"] .card-picture`);
      await picture.scrollIntoViewIfNeeded();
      await until(`the picture of ${path}`, () => picture.evaluate((one) => one.matches(".drawn, .bare")));
      const hasGround = /world|area|map/.test(readFileSync(join(folder, path), "utf8").replace(/#.*/g, "")) && path !== "broken.yaml";
      assert.equal(await picture.evaluate((one) => one.matches(".drawn")), hasGround, path);
      if (!hasGround) assert.ok(await picture.locator(".emblem").isVisible(), path);
    }
    await page.fill("#filter", "cats");
    assert.ok(await card.isVisible() && await page.locator('.card[data-path="cover/cover_room.yaml"]').isHidden());
    await page.fill("#filter", "");
    await page.locator('.card[data-path="cover/cover_room.yaml"] button').click();
    await page.waitForSelector('.live-page[data-state="done"], .live-page .verdict');
    const run = await page.evaluate(() => location.hash);
    await page.goto(`${server.url}#`);
    await page.locator('.card[data-path="cover/cover_room.yaml"] a.button').click();
    await page.waitForSelector(".live-page .verdict");
    assert.equal((await page.evaluate(() => location.hash)).split("?")[0], run.split("?")[0]);
    rmSync(join(folder, "broken.yaml"));
  },

  async "the example can be watched from the first start, and is what the tool writes today"() {
    const page = await open();
    await page.click('.front-acts a[href="#example"]');
    await page.waitForSelector(".targets tbody");
    assert.match(await text(page, ".verdict"), /^Done/);
    assert.match(await page.title(), /^yard.*, done \u2013/);
    const types = async (file) => [...(await contentsOf(readFileSync(file))).channels.values()]
      .map(({ topic, schema }) => `${topic} ${schema.name} ${schema.encoding} ${new TextDecoder().decode(schema.data)}`).sort();
    assert.deepEqual(await types(example), await types(join(folder, "runs/yard/run.mcap")), "make it anew: make pictures, or web/build/example.mjs");
    assert.doesNotMatch(readFileSync(example, "latin1"), /world"?: "[/]/, "it names no path of the machine that made it");
  },

  async "files that are no missions are listed with their kinds in words"() {
    const page = await open();
    await page.waitForSelector(".groups");
    const row = async (path) => page.locator(`.groups li[data-path="${path}"] .kind`).textContent();
    assert.equal(await row("runs/yard/run.mcap"), "log of a run");
    assert.equal(await row("maps/gallery.map"), "grid map (MovingAI)");
    assert.equal(await row("yard/yard.sdf"), "world (SDF)");
    assert.doesNotMatch(await page.locator(".groups").textContent(), /\d (B|kB|MB)\b/);
  },
});
