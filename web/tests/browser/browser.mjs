// A browser for tests: Debian's Chromium without a screen, and what the cases need of it.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { difference, readPng, shrunk, writePng } from "./png.mjs";

const shots = fileURLToPath(new URL("../shots/", import.meta.url));

export const executable = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);

/** A page that a test serves itself (useBuiltPage) has no address, and may not open a socket to this machine without the feature off. */
const plain = ["--disable-features=LocalNetworkAccessChecks", "--no-sandbox", "--disable-dev-shm-usage", "--disable-background-networking", "--force-color-profile=srgb", "--font-render-hinting=none"];
/** Chromium draws the plane by itself, which is fast, and the view in space by a graphics card made of software. */
export const launch = () => chromium.launch({ executablePath: executable, timeout: 1000 * patience_s, args: [...plain, "--disable-gpu", "--enable-unsafe-swiftshader"] });

/** However busy the machine is, nothing that is waited for takes longer; who waits, waits for an event. */
export const patience_s = 300;

/** Waits until `ask` answers with something true, which is returned. */
export async function until(what, ask) {
  const end = Date.now() + 1000 * patience_s;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (Date.now() > end) throw new Error(`${what} does not come`);
    await new Promise((resolve) => setTimeout(resolve, 40));
  }
}

const pictureOf = (page, selector) => page.evaluate((one) => new Promise((done) => {
  requestAnimationFrame(() => requestAnimationFrame(() => done(document.querySelector(one).toDataURL())));
}), selector);

/** The picture of a canvas, once ten frames of the page have not changed it. */
export async function rested(page, selector) {
  let picture = await pictureOf(page, selector);
  for (let same = 0; same < 5; ++same) {
    const now = await pictureOf(page, selector);
    if (now !== picture) same = -1;
    picture = now;
  }
  return picture;
}

/** The bytes of the file that the page gives after `act`. */
export async function saved(page, act) {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  return readFileSync(await download.path());
}

/**
 * Keeps a screenshot in the folder of the test's output and compares it, at a quarter of its size, with the stored
 * one: at most 4 % of the pixels may differ, since fonts are not the same everywhere. OUTRIDER_NEW_SHOTS=1 stores it.
 */
export async function compareShot(page, name, folder) {
  const shot = await page.screenshot();
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, `${name}.png`), shot);
  const small = shrunk(readPng(shot), 4);
  const stored = join(shots, `${name}.png`);
  if (process.env.OUTRIDER_NEW_SHOTS) {
    writeFileSync(stored, writePng(small));
    return;
  }
  const off = difference(small, readPng(readFileSync(stored)));
  if (off > 0.04) throw new Error(`${name}: ${(100 * off).toFixed(1)} % of the picture differs from tests/shots/${name}.png`);
}
