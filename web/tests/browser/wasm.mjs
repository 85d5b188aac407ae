// wasm.mjs PAGE.html QUERIES.json: the page that plans without a server, offline in Chromium. It answers random queries
// at the costs that the library gives (wasm/native_costs.py), and plans anew while the goal is dragged.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { executable, launch, until } from "./browser.mjs";

if (!executable) {
  console.log("skipped: Chromium is not installed");
  process.exit(77);
}
const [file, queries] = process.argv.slice(2);
const cases = JSON.parse(readFileSync(queries, "utf8"));
assert.ok(gzipSync(readFileSync(file)).length < 600_000, `${statSync(file).size} bytes`);

const browser = await launch();
const context = await browser.newContext({ offline: true, viewport: { width: 1000, height: 900 } });
const page = await context.newPage();
const errors = [];
page.on("pageerror", (error) => errors.push(String(error)));
await page.goto(pathToFileURL(file).href);
await until("a path", () => page.evaluate(() => /m with \d+ turn/.test(document.getElementById("said").textContent)));

const worst = await page.evaluate((all) => {
  let worst = 0, asked = 0, none = 0;
  for (const one of all) {
    window.outrider.setGrid(one.cells, one);
    window.outrider.setPlanner(one.planner);
    one.costs.forEach((cost, i) => {
      let found = null;
      try {
        found = window.outrider.plan(one.starts[i], one.goals[i]).cost;
      } catch (fault) {
        if (fault.code !== "no_path") throw fault;
      }
      asked++;
      if (cost === null || found === null) {
        none++;
        worst = cost === found ? worst : Infinity;
      } else {
        worst = Math.max(worst, Math.abs(found - cost) / Math.max(1, cost));
      }
    });
  }
  return { worst, asked, none };
}, cases);
assert.ok(worst.asked >= 1000 && worst.none > 0 && worst.none < worst.asked / 2, JSON.stringify(worst));
assert.ok(worst.worst <= 1e-9, JSON.stringify(worst));
console.log(`${worst.asked} queries, ${worst.none} of them without a path: the same costs, to ${worst.worst.toExponential(0)}`);

await page.reload();
const said = page.locator("#said");
await until("a path", async () => /m with/.test(await said.textContent()));
const map = page.locator("#map");
const box = await map.boundingBox();
const spot = (x, y) => [box.x + (x / 15) * box.width, box.y + (1 - y / 10) * box.height];
const texts = new Set();
await page.mouse.move(...spot(12.9, 2.4));
await page.mouse.down();
for (let i = 1; i <= 8; i++) {
  await page.mouse.move(...spot(12.9, 2.4 + 0.7 * i));
  texts.add((await said.textContent()).split(" m with")[0]);
}
await page.mouse.up();
assert.ok(texts.size >= 7, `it plans while one drags: ${[...texts]}`);
assert.deepEqual(errors, []);
await browser.close();
