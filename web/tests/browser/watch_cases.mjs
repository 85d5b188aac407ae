// The cases of the page about runs that are watched: what is drawn of them, files of logs, the viewer, films.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { compareShot, saved, until } from "./browser.mjs";
import { difference, readPng, shrunk } from "./png.mjs";
import { makeMaps, makeRuns } from "./runs.mjs";
import { makeViewer } from "./server.mjs";

/** Compares what `g` saves with what `s` saves. */
async function svgIsAsTheView(page) {
  const view = readPng(await saved(page, () => page.keyboard.press("s")));
  const drawn = readPng(await page.evaluate(async (svg) => {
    const image = new Image();
    image.src = `data:image/svg+xml;base64,${svg}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    canvas.getContext("2d").drawImage(image, 0, 0);
    return canvas.toDataURL().split(",")[1];
  }, (await saved(page, () => page.keyboard.press("g"))).toString("base64")).then((text) => Buffer.from(text, "base64")));
  const off = difference(shrunk(view, 2), shrunk(drawn, 2));
  assert.ok(off < 0.01, `${(100 * off).toFixed(1)} % of the SVG differs from the view`);
}

export const cases = ({ open, text, frames, server, folder, output }) => ({
  async "a run: scrub to a shot, step, switch to space, reload at its address"() {
    const page = await open("#watch/runs/yard/run.mcap?t=0");
    await page.waitForSelector(".targets tbody");
    const shot = page.locator(".tick.hit").nth(9);
    const title = await shot.getAttribute("title");
    await shot.click();
    await until("the shot", async () => title.startsWith((await text(page, ".side h2")).split(" try")[0].trim()));
    await page.keyboard.press("ArrowRight");
    await frames(page);
    const clock = await text(page, ".clock");
    await compareShot(page, "watch", output);
    await page.keyboard.press("v");
    await page.waitForSelector(".space-view canvas");
    await until("the address", () => page.evaluate(() => location.hash.includes("view=3d") && location.hash.includes("shot=10")));
    await frames(page);
    await page.reload();
    await page.waitForSelector(".space-view canvas");
    await until("the same time", async () => await text(page, ".clock") === clock);
    await frames(page);
    await compareShot(page, "space", output);
  },

  async "a target that cannot be hit: the best flight at it, and what is in the way, from the side, in plan and in its reason"() {
    const page = await open("#watch/runs/yard/run.mcap?t=20");
    await page.locator(".targets tbody", { hasText: "schroedi" }).locator("button").click();
    await until("the flight", async () => /^No shot at schroedi the best flight is blocked by shed\//.test(await text(page, ".side h2")));
    const by = (await text(page, ".side h2")).match(/blocked by (\S+)$/)[1];
    assert.match(await text(page, ".side .caption"), new RegExp(`^[\\d.]+ m/s at .* from \\(.*It meets ${by} at \\(`));
    assert.match(await page.locator(".targets tbody", { hasText: "schroedi" }).locator(".reason").textContent(), new RegExp(`the best flight, from \\(.*${by}`));
    const picture = () => page.evaluate(() => document.querySelector(".plan-view canvas").toDataURL());
    await frames(page);
    const shown = await picture();
    await page.locator('.legend .layer[data-layer="blocked flights"] label').click();
    await frames(page);
    assert.notEqual(await picture(), shown, "it is drawn in plan");
  },

  async "what a robot senses and believes: a map that is turned is explored, a drive goes by tags"() {
    makeRuns(folder);
    const page = await open("#watch/runs/explore/run.mcap?t=3");
    await page.waitForSelector(".plots figure");
    assert.match(await text(page, ".legend"), /believed, 2\u03c3.*range finder.*path/);
    await page.locator(".tabs button", { hasText: "Why" }).click();
    await page.waitForSelector(".why li[aria-current] .candidates .chosen");
    assert.match(await text(page, ".why .candidates thead"), /place.*to get there.*to see.*of the round that begins there, least is best/);
    const columns = await page.locator(".why .candidates tr").evaluateAll((rows) => rows.slice(0, 2).map((row) => [...row.cells].map((one) => Math.round(one.getBoundingClientRect().left))));
    assert.deepEqual(columns[0], columns[1], "each value stands below its head");
    const values = (await page.locator(".why .candidates td:last-child").allTextContents()).map(Number.parseFloat).filter(Number.isFinite);
    assert.ok(values.length > 0 && values.every((value, i) => i === 0 || value >= values[i - 1]), `the best first: ${values}`);
    await page.locator(".tabs button", { hasText: "Plots" }).click();
    await page.waitForSelector(".plots figure");
    await frames(page);
    await compareShot(page, "explore", output);
    await page.keyboard.press("f");  // the robot is in the middle then
    await frames(page);
    const frame = await page.locator(".plan-view canvas").boundingBox();
    await page.mouse.move(frame.x + frame.width / 2, frame.y + frame.height / 2);
    assert.match(await text(page, ".plan-view .tip"), /^believed \d+ mm and .* off\n2\u03c3: \d+ mm by/);
    await page.keyboard.press("v");
    await page.waitForSelector(".space-view canvas");
    const space = () => page.evaluate(() => document.querySelector(".space-view canvas").toDataURL());
    await frames(page);
    const compared = await space();
    await page.locator('.legend .layer[data-layer="candidates"] label').click();
    await frames(page);
    assert.notEqual(await space(), compared, "the places that it compares stand in space");
    await page.goto(`${server.url}#watch/runs/drive/run.mcap?t=13&view=3d&follow=1`);
    await page.waitForSelector(".space-view canvas");
    await until("the drive", async () => (await text(page, ".job")) === "drive");
    await frames(page);
    await compareShot(page, "drive-space", output);
  },

  async "mapping from logs: the map, landmarks and their ellipses, in plan and in space"() {
    makeMaps(folder);
    const page = await open("#watch/runs/office/run.mcap?t=95&tab=plots");
    await page.waitForSelector(".plots figure");
    const legend = await text(page, ".legend");
    for (const name of ["way settled in the end", "believed then, 2\u03c3", "odometry alone", "reference", "range finder"]) assert.equal(legend.split(name).length, 2, `${name} once in: ${legend}`);
    assert.doesNotMatch(legend, /\btrue\b/);
    await frames(page);
    await compareShot(page, "slam", output);
    await page.goto(`${server.url}#watch/runs/posts/run.mcap?t=10&view=3d`);
    await page.waitForSelector(".space-view canvas");
    assert.match(await text(page, ".legend"), /landmark, 2\u03c3.*true place/);
    await frames(page);
    await compareShot(page, "slam-space", output);
    await page.keyboard.press("v");
    await page.keyboard.press("End");
    await page.keyboard.press("f");  // the robot is in the middle then
    await frames(page);
    const view = await page.locator(".plan-view canvas").boundingBox();
    await page.mouse.move(view.x + view.width / 2, view.y + view.height / 2);
    assert.match(await text(page, ".plan-view .tip"), /^believed .* off the way as settled/);
  },

  async "an area is covered live; the strip is the same whether one comes from before or after, and as SVG"() {
    const page = await open("#live?scenario=cover/cover_room.yaml");
    await page.waitForSelector(".start button:enabled");
    await page.click(".start button");
    await page.waitForSelector('.live-page[data-state="done"] .verdict');  // only then is its log to be had
    assert.match(await text(page, ".verdict"), /Done/);
    assert.match(await text(page, ".legend"), /covered.*lap.*lane.*move.*planned.*out of reach/);
    assert.equal((await saved(page, () => page.keyboard.press("j"))).subarray(1, 5).toString(), "MCAP", "a run that was live has its log");
    const at = async (seconds) => {
      await page.locator(".transport input[type=range]").evaluate((slider, t) => {
        slider.value = String(t);
        slider.dispatchEvent(new Event("input"));
      }, seconds);
      await frames(page);
    };
    const picture = () => saved(page, () => page.keyboard.press("s"));
    await page.evaluate(() => document.activeElement.blur());
    await at(0);
    await at(60);
    const first = await picture();
    await page.keyboard.press("n");
    await frames(page);
    assert.match(await text(page, ".action"), /^lap 1 of 1 begins/);
    await page.keyboard.press("End");
    await frames(page);
    assert.match(await text(page, ".action"), /% of the reach is covered/);
    await at(60);
    assert.ok(first.equals(await picture()), "the view at 60 s depends on what was shown before");
    await svgIsAsTheView(page);
    await compareShot(page, "cover", output);
    const frame = await page.locator(".plan-view canvas").boundingBox();
    await page.keyboard.press("f");
    await frames(page);
    await page.mouse.move(frame.x + frame.width / 2, frame.y + frame.height / 2);
    assert.match(await text(page, ".plan-view .tip"), /^covered at (0:5\d|1:00)/);
  },

  async "the viewer is one file that shows the same, dark, on a phone"() {
    const page = await open(`file://${makeViewer(folder, "runs/yard/run.mcap")}#?t=8&theme=dark`, { viewport: { width: 390, height: 844 }, colorScheme: "dark" });
    await page.waitForSelector(".targets tbody");
    assert.match(await text(page, ".verdict"), /targets reached/);
    await frames(page);
    await compareShot(page, "viewer-phone-dark", output);
  },

  async "frames of a film are the same twice, and the SVG looks as the view does"() {
    const page = await open(`file://${makeViewer(folder, "runs/yard/run.mcap")}#?t=20`);
    await page.waitForSelector(".targets tbody");
    await frames(page);
    const film = (from, to) => saved(page, async () => {
      await page.keyboard.press("m");
      await page.selectOption('.film [aria-label="Format"]', { label: "pictures (zip of PNG)" });
      for (const [name, value] of [["From", from], ["To", to], ["Frames a second", 10]]) await page.fill(`.film [aria-label="${name}"]`, String(value));
      await page.keyboard.press("Enter");
    });
    const first = await film(20, 20.2);
    assert.equal(first.readUInt16LE(first.length - 12), 3, "frames in the archive");
    await page.keyboard.press("End");
    await frames(page);
    assert.ok(first.equals(await film(20, 20.2)), "the view at 20 s depends on what was shown before");
    assert.ok(!first.equals(await film(21, 21.2)));
    await page.keyboard.press("m");
    await page.fill('.film [aria-label="To"]', "1e9");
    assert.match(await text(page, ".film .hint"), /^To: expected a time from/);
    await page.keyboard.press("Escape");
    await page.waitForSelector("dialog.film", { state: "detached" });
    await svgIsAsTheView(page);
  },

  async "a log that was cut short is shown up to there, and an old report is refused"() {
    const log = readFileSync(join(folder, "runs/yard/run.mcap"));
    const page = await open();
    await page.waitForSelector(".groups");
    const drop = (bytes, name) => page.evaluate(([text, file]) => {
      const dropped = new DataTransfer();
      dropped.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], file));
      dispatchEvent(new DragEvent("drop", { dataTransfer: dropped, cancelable: true }));
    }, [bytes.toString("base64"), name]);
    await drop(log.subarray(0, log.length - 3000), "cut.mcap");
    await page.waitForSelector(".targets tbody");
    assert.match(await text(page, ".verdict.cut"), /^Cut short The log is cut short at t = [\d.]+ s/);
    await drop(Buffer.from('{"outrider_report": 1}'), "guard.json");
    await page.waitForSelector(".notice-over:not([hidden])");
    assert.match(await text(page, ".notice-over"), /older version; run the job again with --out DIR/);
  },

  async "the keyboard does it all: open a run from the files, play, read the help"() {
    const page = await open();
    await page.waitForSelector(".groups");
    await page.evaluate(() => document.querySelector('li[data-path="runs/yard/run.mcap"] a').focus());
    await page.keyboard.press("Enter");
    await page.waitForSelector(".targets tbody");
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("End");
    await frames(page);
    const end = await text(page, ".clock");
    assert.equal(end.split(" / ")[0].split(".")[0], end.split(" / ")[1]);
    await page.keyboard.press("Home");
    await page.keyboard.press(" ");
    await until("time to pass", async () => !(await text(page, ".clock")).startsWith("0:00.0"));
    await page.keyboard.press("?");
    await page.waitForSelector("dialog.help[open]");
    assert.match(await text(page, "dialog.help"), /play or pause/);
    await page.keyboard.press("Escape");
    await page.waitForSelector("dialog.help", { state: "detached" });
    await page.keyboard.press("L");
    await page.waitForSelector(".start");
  },
});
