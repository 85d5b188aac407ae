// The cases of the page about runs that are over: their list, kept over a restart of the server, and run again.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { compareShot, until } from "./browser.mjs";
import { serve, source } from "./server.mjs";

export const cases = ({ open, text, output }) => ({
  async "the list of runs tells seed, verdict, duration and age; it is there after a restart, and so are the logs; a run is run again"() {
    const folder = mkdtempSync(join(tmpdir(), "outrider-runs-"));
    cpSync(join(source, "scenarios/cover"), join(folder, "cover"), { recursive: true });
    const rows = (page) => page.locator(".run-row").evaluateAll((all) => all.map((one) => one.textContent));
    let server = await serve(folder);
    const run = async () => (await (await fetch(`${server.url}api/v1/runs`, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ scenario: "cover/cover_room.yaml" }) })).json()).id;
    const id = await run();
    await until("its end", async () => (await (await fetch(`${server.url}api/v1/runs/${id}`)).json()).state === "done");
    await server.stop();
    server = await serve(folder);
    const page = await open("#live", { at: server.url });
    await page.waitForSelector(".run-row");
    assert.match((await rows(page))[0], /^cover\/cover_room\.yaml.*cover.*Done.*seed 1 \u00b7 \d+(\.\d)? s.*(just now|minutes? ago).*Run again$/);
    await page.click(".run-row a");
    await page.waitForSelector(".live-page .verdict");
    assert.match(await text(page, ".verdict"), /^Done/);
    assert.equal(await page.evaluate(() => location.hash.split("?")[0]), `#live/${id}`);
    await page.goto(`${server.url}#live`);
    await page.click(".run-row .button");
    await page.waitForSelector(".live-page .verdict");
    await page.goto(`${server.url}#live`);
    await until("both", async () => (await rows(page)).length === 2);
    assert.ok(await page.locator(".page-head .button").isDisabled());
    await server.stop();
    rmSync(join(folder, ".outrider"), { recursive: true });
    writeFileSync(join(folder, ".outrider"), "");
    server = await serve(folder);
    await run();
    await page.goto(`${server.url}#live`);
    await until("the sentence", async () => /^Runs are kept only until the server ends, since \.outrider cannot be written/.test(await text(page, ".page > .hint")));
    await page.goto("about:blank");  // or it would miss its server
    await server.stop();
    rmSync(folder, { recursive: true });
  },

  async "two runs are compared: the same time in both, and the numbers that differ are marked"() {
    const folder = mkdtempSync(join(tmpdir(), "outrider-runs-"));
    cpSync(join(source, "scenarios/cover"), join(folder, "cover"), { recursive: true });
    const server = await serve(folder);
    for (const seed of [1, 2]) {
      const { id } = await (await fetch(`${server.url}api/v1/runs`, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ scenario: "cover/cover_room.yaml", seed }) })).json();
      await until("its end", async () => (await (await fetch(`${server.url}api/v1/runs/${id}`)).json()).state === "done");
    }
    const page = await open("#live", { at: server.url });
    await page.waitForSelector(".run-row");
    for (const box of await page.locator(".run-row input").all()) await box.check();
    await page.click(".page-head .button");
    await page.waitForSelector(".compare-numbers tbody tr");
    assert.deepEqual(await page.locator(".compare-views h2 a").allTextContents(), ["cover_room, seed 1", "cover_room, seed 2"], "the older first");
    const { runs: [second, first] } = await (await fetch(`${server.url}api/v1/runs`)).json();
    const numbers = await page.locator(".compare-numbers tbody tr").evaluateAll((all) => all.map((one) => [one.firstChild.textContent, one.classList.contains("differs"), one.lastChild.textContent]));
    const row = (name) => numbers.find(([label]) => label === name);
    const more = second.summary.metrics.time_s - first.summary.metrics.time_s;
    assert.deepEqual(row("time").slice(1), [true, `${more > 0 ? "+" : "\u2212"}${Math.abs(more).toFixed(2)} s`], String(numbers));
    assert.deepEqual(row("area").slice(1), [false, "same"]);
    assert.equal(new Set(numbers.map(([label]) => label)).size, numbers.length, "each number has a name of its own");
    for (const name of ["covered share", "covered area", "planned share", "planned time", "planned length"]) assert.ok(row(name), name);
    await page.locator(".compare input[type=range]").evaluate((slider) => {
      slider.value = "60";
      slider.dispatchEvent(new Event("input"));
    });
    await until("the same time", async () => (await page.locator(".compare-at").allTextContents()).every((one) => one.startsWith("1:00.0")));
    await until("the address", () => page.evaluate(() => /t=60\.00/.test(location.hash)));
    await compareShot(page, "compare-runs", output);
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("End");
    await until("the end", async () => (await page.locator(".compare-at").allTextContents()).some((one) => one.includes(", ended")));
    await page.keyboard.press("o");
    await until("one plan", () => page.locator(".compare-views .stage").nth(1).isHidden());
    await until("the layout", () => page.evaluate(() => /layout=over/.test(location.hash)));
    await page.keyboard.press("o");
    await page.setViewportSize({ width: 390, height: 844 });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "the page is wider than the window");
    // More than two: a third run, over the plan of the first as well.
    const { id: third } = await (await fetch(`${server.url}api/v1/runs`, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ scenario: "cover/cover_room.yaml", seed: 3 }) })).json();
    await until("its end", async () => (await (await fetch(`${server.url}api/v1/runs/${third}`)).json()).state === "done");
    await page.goto(`${server.url}#live`);
    await until("three runs", async () => await page.locator(".run-row input").count() === 3);
    for (const box of await page.locator(".run-row input").all()) await box.check();
    await page.click(".page-head .button");
    await until("three names", async () => (await page.locator(".compare-views h2 a").allTextContents()).join() === "cover_room, seed 1,cover_room, seed 2,cover_room, seed 3");
    assert.equal(await page.locator(".compare-numbers thead th").count(), 5);
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("End");
    const ink = () => page.evaluate(() => document.querySelector(".compare-views canvas").toDataURL());
    await until("the end", async () => (await page.locator(".compare-at").allTextContents()).some((one) => one.includes(", ended")));
    const alone = await ink();
    await page.keyboard.press("o");
    await until("one plan", () => page.locator(".compare-views .stage").nth(2).isHidden());
    await until("the others in it", async () => await ink() !== alone);
    await page.goto(`${server.url}#compare?runs=absent,${first.id}`);
    await page.waitForSelector(".refusal");
    assert.match(await text(page, ".refusal"), /there is no such run/);
    await page.goto("about:blank");  // or it would miss its server
    await server.stop();
    rmSync(folder, { recursive: true });
  },
});
