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
export const launch = () => chromium.launch({ executablePath: executable, args: [...plain, "--disable-gpu", "--enable-unsafe-swiftshader"] });

/** Waits until `ask` answers with something true, which is returned. */
export async function until(what, ask, seconds = 60) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (Date.now() > end) throw new Error(`${what}: not within ${seconds} s`);
    await new Promise((resolve) => setTimeout(resolve, 40));
  }
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
