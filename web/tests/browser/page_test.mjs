// The page in a real browser against a real server, one start of each for all cases of the files named, of which two run at a time.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/tests/browser/page_test.mjs OUTPUT NAME[,NAME] [CASE...]
// NAME is that of a file NAME_cases.mjs; a CASE is a part of the name of one.
import { AsyncLocalStorage } from "node:async_hooks";
import { join } from "node:path";
import { executable, launch, patience_s, until } from "./browser.mjs";
import { makeFolder, serve, useBuiltPage } from "./server.mjs";

const [output, names, ...only] = process.argv.slice(2);
if (!executable) {
  console.log("skipped: Chromium is not installed (apt-get install chromium)");
  process.exit(77);
}

const { folder, remove } = makeFolder();
const server = await serve(folder);
const browser = await launch();
const faults = [];
const reusable = new Set();
const present = new AsyncLocalStorage();  // the pages of the case that is running

/** Sets a page up as a case expects it, and notes what goes wrong on it. */
async function prepare(page, name, { viewport = { width: 1280, height: 720 }, ...media } = {}) {
  present.getStore().push(page);
  page.on("pageerror", (error) => faults.push(`${name}: ${error.message}`));
  page.on("console", (message) => {  // what the server refuses is listed there by the browser, and told by the page
    if (message.type() === "error" && !/Failed to load resource|WebSocket connection to/.test(message.text())) faults.push(`${name}: ${message.text()}`);
  });
  page.on("request", (request) => {
    if (!/^(http:\/\/127\.0\.0\.1|blob:|data:|file:)/.test(request.url())) faults.push(`${name}: the page asked for ${request.url()}`);
  });
  await page.setViewportSize(viewport);
  await page.emulateMedia({ reducedMotion: "reduce", colorScheme: "light", forcedColors: null, ...media });
  return page;
}

async function newPage() {
  const page = await browser.newPage();
  await useBuiltPage(page);
  page.setDefaultTimeout(1000 * patience_s);
  return page;
}

/** Returns an empty page that no other case gets: it may be given scripts and routes. */
const blank = async () => prepare(await newPage(), "a blank page");

const left = [];  // pages of earlier cases, empty: a new one costs a process, and compiles all scripts anew
/** Opens an address of the page, with nothing stored. */
async function open(hash = "", { at = server.url, ...options } = {}) {
  const page = await prepare(left.pop() ?? await newPage(), hash, options);
  reusable.add(page);
  await page.goto(hash.startsWith("file:") ? hash : at + hash);
  return page;
}

/** Empties a page of what a case left there. */
async function empty(page) {
  for (const event of ["pageerror", "console", "request", "response", "dialog", "download"]) page.removeAllListeners(event);
  await page.mouse.move(0, 0);
  await page.route(`${server.url}nothing`, (route) => route.fulfill({ contentType: "text/html", body: "" }));
  await page.goto(`${server.url}nothing`);  // of the same origin as the page
  await page.evaluate(() => { localStorage.clear(); sessionStorage.clear(); });
  await page.unroute(`${server.url}nothing`);
  await page.goto("about:blank");
  left.push(page);
}

const text = (page, selector) => page.locator(selector).first().textContent();
const frames = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const answers = async (page) => Number(await page.locator(".plan-page").getAttribute("data-answers") ?? 0);
/** Waits for answers after those that were there, and until the search that goes with them is drawn. */
async function nextAnswer(page, before) {
  await until("an answer", async () => await answers(page) > before);
  await frames(page);
}
const cell = (page, row, column = 0) => page.locator(`.result td[data-row="${row}"]`).nth(column).textContent();
/** Returns the place on the screen of a place of the plan's map: the map fills its view as the camera fits it. */
const onMap = (page, x, y) => page.evaluate(([px, py]) => {
  const canvas = document.querySelector(".pane canvas");
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const [w, h] = [64 * 0.25, 44 * 0.25];
  const scale = Math.min((width - 88) / w, (height - 90) / h);
  return [left + 34 + (width - 88) / 2 + scale * (px - w / 2), top + 50 + (height - 90) / 2 - scale * (py - h / 2)];
}, [x, y]);

const cases = {};
for (const name of names.split(",")) {
  const file = await import(`./${name}_cases.mjs`);
  Object.assign(cases, file.cases({ open, blank, text, frames, cell, answers, nextAnswer, onMap, server, folder, output }));
}

let failed = 0;
async function check([name, run]) {
  const start = Date.now();
  const pages = [];
  try {
    await present.run(pages, run);
    console.log(`ok      ${((Date.now() - start) / 1000).toFixed(1)} s  ${name}`);
  } catch (error) {
    const number = ++failed;
    console.log(`FAILED  ${name}\n${error.stack}`);
    for (const page of pages) await page.screenshot({ path: join(output, `failed-${names}-${number}.png`) }).catch(() => undefined);
    pages.forEach((page) => reusable.delete(page));
  }
  for (const page of pages) await (reusable.has(page) ? empty(page) : page.context().close());
}

/** The first case sees the folder as it was made. A page waits most of the time, so two cases share the machine. */
const waiting = Object.entries(cases).filter(([name]) => only.length === 0 || only.some((word) => name.includes(word)));
const workInTurn = async () => { while (waiting.length > 0) await check(waiting.shift()); };
if (waiting.length > 0) await check(waiting.shift());
await Promise.all([workInTurn(), workInTurn()]);
for (const fault of faults) console.log(`FAILED  ${fault}`);
await browser.close();
await server.stop();
remove();
process.exit(failed + faults.length > 0 ? 1 : 0);
