// site_test.mjs OUT: builds the docs site in OUT, which fails on a dead link, and opens it in a browser without a network:
// its search finds "any-angle", and a result opens.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { extname, join, resolve } from "node:path";
import { executable, launch } from "./browser.mjs";

const out = resolve(process.argv[2]);
const { status } = spawnSync(process.execPath, ["build/site.mjs", out], { stdio: "inherit" });
if (status !== 0) throw new Error(`the site is not built: ${status}`);
if (!executable) {
  console.log("skipped: no Chromium");
  process.exit(77);
}

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };
const browser = await launch();
try {
  const page = await browser.newPage();
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(String(error)));
  await page.route("**/*", (route) => {
    const url = new URL(route.request().url());
    const path = decodeURI(url.pathname).replace(/\/$/, "/index.html");
    const file = join(out, path);
    if (url.host === "site.test" && existsSync(file)) {
      return route.fulfill({ body: readFileSync(file), contentType: types[extname(file)] ?? "application/octet-stream" });
    }
    if (path !== "/favicon.ico") wrong.push(`asks for ${url}`);
    return route.abort();
  });
  for (const [name, width, height, colorScheme] of [["light", 1280, 800, "light"], ["dark", 1280, 800, "dark"], ["phone", 390, 800, "light"]]) {
    await page.setViewportSize({ width, height });
    await page.emulateMedia({ colorScheme });
    await page.goto("http://site.test/docs/index.html", { waitUntil: "load" });
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    if (wide > width) wrong.push(`${name}: ${wide} px wide`);
    await page.screenshot({ path: join(out, `../site-${name}.png`) });
  }
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.click(".VPNavBarSearch button");
  await page.fill(".search-input", "any-angle");
  const result = page.locator(".VPLocalSearchBox .result").first();
  await result.waitFor();
  const address = await result.getAttribute("href");
  await result.click();
  await page.waitForURL((url) => url.pathname === new URL(address, "http://site.test").pathname);
  await page.locator(".vp-doc").filter({ hasText: /any.angle/i }).waitFor({ timeout: 5000 });
  if (wrong.length > 0) throw new Error(wrong.join("\n"));
  console.log(`found ${address}`);
} finally {
  await browser.close();
}
