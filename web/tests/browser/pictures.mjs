// Makes the pictures of docs/ from the page as it is now, the same each time.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/tests/browser/pictures.mjs [NAME...]
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { executable, launch, saved, until } from "./browser.mjs";
import { makeFolder, serve, source, tool, useBuiltPage } from "./server.mjs";

if (!executable) {
  console.error("pictures: Chromium makes them, and it is not installed (apt-get install chromium)");
  process.exit(2);
}
const only = process.argv.slice(2);
const { folder, remove } = makeFolder();
const server = await serve(folder);
const browser = await launch();

async function open(hash, width, height) {
  const page = await browser.newPage({ viewport: { width, height }, reducedMotion: "reduce" });
  await useBuiltPage(page);
  page.on("pageerror", (error) => console.error(`${hash}: ${error.message}`));
  await page.goto(server.url + hash);
  return page;
}
/** The log of a run; one that is not done, such as an exploration that leaves something over, leaves one, too. */
function makeRun(scenario, name) {
  const { status } = spawnSync(tool, ["run", join(source, scenario), "--out", join(folder, name)], { stdio: "ignore" });
  if (status !== 0 && status !== 1) throw new Error(`${scenario}: status ${status}`);
}
const frames = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const docs = (name) => join(source, "docs", name);

/** The page as it is once `selector` is there. */
async function still(name, hash, selector, act = async () => {}) {
  const page = await open(hash, 1000, 600);
  await page.waitForSelector(selector);
  await act(page);
  await frames(page);
  await page.screenshot({ path: docs(name) });
  await page.close();
}

/** The files of an archive whose files are not compressed. */
function* filesOf(archive) {
  for (let at = 0; archive.readUInt32LE(at) === 0x04034b50;) {
    const start = at + 30 + archive.readUInt16LE(at + 26);
    const end = start + archive.readUInt32LE(at + 18);
    yield [archive.toString("latin1", at + 30, start), archive.subarray(start, end)];
    at = end;
  }
}

/** The frames that the page gives of a range of time, as a moving picture. */
async function film(name, hash, from, to, rate) {
  const page = await open(hash, 1180, 680);
  page.setDefaultTimeout(600000);
  await page.waitForSelector(".space-view canvas");
  await frames(page);
  await page.keyboard.press("m");
  await page.selectOption('.film [aria-label="Format"]', { label: "pictures (zip of PNG)" });
  for (const [field, value] of [["From", from], ["To", to], ["Frames a second", rate]]) await page.fill(`.film [aria-label="${field}"]`, String(value));
  const archive = await saved(page, () => page.keyboard.press("Enter"));
  await page.close();
  const home = mkdtempSync(join(tmpdir(), "outrider-film-"));
  const paths = [...filesOf(archive)].map(([file, bytes]) => {
    writeFileSync(join(home, file), bytes);
    return join(home, file);
  });
  execFileSync("img2webp", ["-loop", "0", "-lossy", "-q", "55", "-m", "6", "-d", String(1000 / rate), ...paths, "-o", docs(name)]);
  rmSync(home, { recursive: true });
}

const pictures = {
  "page-watch.png": (name) => still(name, "#watch/runs/yard/run.mcap?shot=9&t=28.26&theme=light", ".targets tbody"),
  "page-space.png": (name) => still(name, "#watch/runs/yard/run.mcap?view=3d&shot=6&t=20.2&theme=dark", ".space-view canvas"),
  "page-explore.png": (name) => {
    makeRun("scenarios/explore/office.yaml", "office");
    return still(name, "#watch/office/run.mcap?view=3d&follow=1&t=36&theme=dark&tab=plots", ".space-view canvas");
  },
  "page-slam.png": (name) => {
    makeRun("scenarios/slam/office.yaml", "slam");
    return still(name, "#watch/slam/run.mcap?t=95&theme=light&tab=plots", ".plots figure");
  },
  "page-cover.png": (name) => {
    makeRun("scenarios/cover/cover_field.yaml", "field");
    return still(name, "#watch/field/run.mcap?view=3d&t=4985&theme=light&tab=plots", ".space-view canvas");
  },
  "page-search.png": (name) => still(name, "#plan/maps/gallery.map?planner=a_star&radius=0&theme=dark&step=70", ".result", async (page) => {
    await until("the trace", async () => (await page.locator(".transport .clock").textContent()).startsWith("70 /"));
    const view = await page.locator(".pane canvas").boundingBox();
    await page.mouse.move(view.x + 258, view.y + 249);
    await page.waitForSelector(".pane .tip:not([hidden])");
  }),
  "yard.webp": (name) => film(name, "#watch/runs/yard/run.mcap?view=3d&t=19&theme=light", 17, 33, 12.5),
};

for (const [name, make] of Object.entries(pictures)) {
  if (only.length > 0 && !only.includes(name)) continue;
  await make(name);
  console.log(`docs/${name}: ${Math.round(statSync(docs(name)).size / 1000)} kB`);
}
await browser.close();
await server.stop();
remove();
