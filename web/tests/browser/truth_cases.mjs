// The cases of the page about what its panels say: the same thing, about the present time, and only what is so.
import assert from "node:assert/strict";
import { cpSync, existsSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { until } from "./browser.mjs";
import { makeRuns } from "./runs.mjs";
import { serve, source } from "./server.mjs";
import { contentsOf } from "./streams.mjs";
import { tellRun } from "./told.mjs";

export const cases = ({ open, blank, text, frames, cell, answers, server, folder }) => ({
  async "a plot tells nothing that comes later, and its dots are on the cursor; so does the table"() {
    const page = await open("#watch/runs/yard/run.mcap?t=0");
    await page.waitForSelector(".targets tbody");
    for (const t of [2, 5, 7.7, 20]) {
      await page.locator(".tabs button", { hasText: "Targets" }).click();
      await page.locator(".transport input[type=range]").evaluate((slider, time) => {
        slider.value = String(time);
        slider.dispatchEvent(new Event("input"));
      }, t);
      await frames(page);
      const rows = await page.locator(".targets tbody").evaluateAll((all) => all.map((one) => [...one.rows[0].cells].map((one) => one.textContent)));
      const reached = rows.filter(([, status]) => status === "reached").length;
      for (const [name, status, shots, done, clearance] of rows) {
        if (status === "waiting") assert.deepEqual([Number(shots) <= 1, done, clearance], [true, "\u2013", "\u2013"], `${name} at ${t} s`);
        if (status === "reached") assert.ok(done.split(":").reduce((sum, part) => 60 * sum + Number(part), 0) <= t + 0.5, `${name} at ${t} s`);
      }
      await page.locator(".tabs button", { hasText: "Plots" }).click();
      await page.waitForSelector(".plots figure .dot");
      await frames(page);
      const plot = page.locator(".plots figure:not(.lane-plot)", { hasText: "Targets" });
      assert.match(await plot.locator(".values").textContent(), new RegExp(`^time${t.toFixed(1)} sreached${reached}waiting\\d`));
      const [dot, line] = await plot.evaluate((one) => [".dot", ".u-cursor-x"].map((what) => {
        const { left, width } = one.querySelector(what).getBoundingClientRect();
        return left + (what === ".dot" ? width / 2 : 0);
      }));
      assert.ok(Math.abs(dot - line) < 1.5, `the dot is at ${dot}, the cursor at ${line}`);
    }
  },

  async "the card of a shot: of a target that was hit since, in the end too"() {
    const page = await blank();
    const run = await tellRun(page, await contentsOf(readFileSync(join(folder, "runs/yard/run.mcap"))));
    run.upTo(1);  // before the first shot
    await page.goto(`${server.url}#live/told`);
    await page.waitForSelector(".targets tbody");
    await page.keyboard.press("Home");
    await until("no shot", async () => /^No shot at /.test(await text(page, ".side h2")));
    run.upTo(1e9);
    run.end();
    await page.waitForSelector(".live-page .verdict");
    const [, target] = await until("its shot", async () => (await text(page, ".side h2")).match(/^Shot 1 at (\S+)/));
    assert.equal(await page.locator(".targets tbody.selected button span").textContent(), target);
  },

  async "a server that is gone is told of; the path of before goes"() {
    const other = await serve(folder);
    const page = await open("#plan/maps/gallery.map", { at: other.url });
    await page.waitForSelector(".result");
    assert.equal(await cell(page, "answer"), "path found");
    await other.stop();
    await until("the break", async () => await cell(page, "answer") === "not answered" || (await page.keyboard.press("l"), false));
    assert.match(await text(page, ".action"), /The server does not answer/);
    assert.equal(await cell(page, "length"), "\u2013");
  },

  async "a mission whose scenario is not there is not another one"() {
    const page = await open("#live?scenario=yard/yrad.yaml");
    await page.waitForSelector(".start button:enabled");
    assert.match(await text(page, ".refused"), /^yard\/yrad\.yaml: there is no such scenario/);
    assert.equal(await page.inputValue("#scenario"), "");
    const sent = [];
    page.on("request", (request) => sent.push(request.method()));
    await page.click(".start button");
    await frames(page);
    assert.match(await page.evaluate(() => location.hash), /^#live\?/);
    assert.ok(!sent.includes("POST"), `${sent}`);
    await page.selectOption("#scenario", "pursuit/park.yaml");
    await page.click(".start button");
    await page.waitForSelector(".live-page .verdict");
    assert.ok(sent.includes("POST"), "this one is started so");
  },

  async "a search that is too long to be sent whole says how much of it is shown"() {
    writeFileSync(join(folder, "maps/wide.map"), `type octile\nheight 300\nwidth 300\nmap\n${`${".".repeat(300)}\n`.repeat(300)}`);
    const page = await open("#plan/maps/wide.map?planner=dijkstra");
    await page.waitForSelector(".result");
    await until("the sentence", async () => /^Dijkstra: the steps show the first 50,000 of \d\d,\d{3} expansions\.$/.test(await text(page, ".action")));
    rmSync(join(folder, "maps/wide.map"));
  },

  async "numbers, units and sentences are for people, and name no path of the machine"() {
    const page = await blank();
    /** Returns what can be read of a view, but for settings, which are as somebody wrote them. */
    const words = async (hash, selector) => {
      await page.goto(`${server.url}${hash}`);
      await page.waitForSelector(selector);
      await frames(page);
      const all = await page.evaluate(() => {
        for (const one of document.querySelectorAll(".settings")) one.remove();
        return document.body.innerText;
      });
      assert.doesNotMatch(all, /\d\.\d{5,}/, `${hash}: a number with too many figures`);
      assert.doesNotMatch(all, /\b(m2|m3|m\/s2)\b/, `${hash}: a unit that is not typeset`);
      assert.doesNotMatch(all, /\b\d{3,}:\d\d/, `${hash}: minutes that are hours`);
      assert.doesNotMatch(all, /\/(tmp|home|work|var|build)\//, `${hash}: a path of the machine`);
      return all;
    };
    const { id } = await (await fetch(`${server.url}api/v1/runs`, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ scenario: "pursuit/park.yaml" }) })).json();
    await until("its end", async () => (await (await fetch(`${server.url}api/v1/runs/${id}`)).json()).state === "done");
    const run = "#watch/runs/yard/run.mcap?t=20";
    for (const [hash, selector] of [["", ".groups"], ["#live", ".run-row"], [`#live/${id}`, ".live-page .verdict"], [run, ".targets tbody"], [`${run}&tab=events`, ".events li"], [`${run}&tab=why`, ".why li"],
      ["#example", ".targets tbody"], ["#plan/yard/yard.sdf", ".result tbody"], ["#change/yard/yard.yaml", ".yard-page tbody"]]) await words(hash, selector);
    const numbers = await words(`${run}&tab=numbers`, ".metrics");
    assert.match(numbers, /tour proven\s+no/);
    const { mission_s } = JSON.parse(readFileSync(join(folder, "runs/yard/run.json"))).metrics;
    assert.ok(/mission time\s+([\d.]+)\s*s/.exec(numbers)?.[1] === mission_s.toFixed(1), numbers);
  },

  async "a map opens with a question that has an answer"() {
    cpSync(join(source, "scenarios/explore"), join(folder, "explore"), { recursive: true });
    if (!existsSync(join(folder, "runs/explore/map.yaml"))) makeRuns(folder);
    const page = await open("#live");
    for (const map of ["explore/cave_map.yaml", "yard/yard.sdf", "explore/office.sdf", "runs/explore/map.yaml", "runs/explore/map.pgm", "maps/gallery.map"]) {
      await page.goto(`${server.url}#plan/${map}`);
      await until("the map", async () => (await page.title()).startsWith(map.split("/").at(-1)));
      await until("an answer", async () => await answers(page) > 0);
      assert.equal(await cell(page, "answer"), "path found", map);
    }
  },
});
