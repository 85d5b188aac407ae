// The cases of the page about runs that are over: their list, kept over a restart of the server, and run again.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { until } from "./browser.mjs";
import { serve, source } from "./server.mjs";

export const runsCases = ({ open, text }) => ({
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
    await server.stop();
    rmSync(join(folder, ".outrider"), { recursive: true });
    writeFileSync(join(folder, ".outrider"), "");
    server = await serve(folder);
    await run();
    const poor = await open("#live", { at: server.url });
    await until("the sentence", async () => /^Runs are kept only until the server ends, since \.outrider cannot be written/.test(await text(poor, ".page > .hint")));
    await page.close();
    await poor.close();
    await server.stop();
    rmSync(folder, { recursive: true });
  },
});
