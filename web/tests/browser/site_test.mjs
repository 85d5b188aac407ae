// site_test.mjs OUT: builds the docs site in OUT, and at the same time the sources of a second one without the Python package. It has no dead link, and
// those that are planted are found; every header is listed; the notebooks have outputs, and the second site says that they were not run.
// In a browser without a network its search finds "any-angle", and a result opens.
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join, resolve } from "node:path";
import { deadLinks } from "../../build/site_links.mjs";
import { executable, launch, patience_s } from "./browser.mjs";

const out = resolve(process.argv[2]);
const built = (args, env = {}) => new Promise((done) => {
  spawn(process.execPath, ["build/site.mjs", ...args], { stdio: "inherit", env: { ...process.env, ...env } }).on("exit", done);
});
const beside = `${out}-beside`, none = mkdtempSync(join(tmpdir(), "none-"));
writeFileSync(join(none, "outrider.py"), "raise ImportError\n");
const statuses = await Promise.all([built([out]), built([beside, "--sources"], { OUTRIDER_PYTHON: none })]);
rmSync(none, { recursive: true });
if (statuses.some((status) => status !== 0)) throw new Error(`the site is not built: ${statuses}`);
const pages = (folder, kind) => readdirSync(folder, { recursive: true, encoding: "utf8" }).filter((name) => name.endsWith(kind)).map((name) => name.slice(0, -kind.length));
if (pages(out, ".html").sort().join() !== [...pages(beside, ".md"), "404"].sort().join()) throw new Error("two builds at once differ");
const notebooks = readdirSync("../python/notebooks").filter((file) => file.endsWith(".ipynb"));
for (const name of notebooks) {
  if (!readFileSync(join(beside, `python/notebooks/${name}.md`), "utf8").includes("It was not run")) throw new Error(`${name} was run without the package`);
}
rmSync(beside, { recursive: true });

const planted = mkdtempSync(join(tmpdir(), "site-"));
writeFileSync(join(planted, "index.html"), '<h1 id="top">.</h1><a href="/page.html#there">.</a><a class="x" href="./none.html">.</a><a href="page#not-there">.</a><a href="#top">.</a><img src="/none.png">');
writeFileSync(join(planted, "page.html"), '<h2 id="there">.</h2><a href="https://example.org/any">.</a>');
const found = deadLinks(planted).sort().join("; ");
rmSync(planted, { recursive: true });
const expected = "index.html: ./none.html leads to no page; index.html: /none.png leads to no page; index.html: there is no #not-there on page.html";
if (found !== expected) throw new Error(`of planted links are found: ${found}`);

const web = resolve("."), html = (name) => readFileSync(join(out, name), "utf8");
const side = html("docs/index.html");
const listed = readdirSync(join(web, "../include/outrider"), { withFileTypes: true })
  .map((entry) => `/include/outrider/${entry.name}${entry.isDirectory() ? "/" : ""}`).filter((address) => !side.includes(`href="${address}`));
if (listed.length > 0) throw new Error(`no list has ${listed}`);
const ran = spawnSync("/usr/bin/python3", ["-c", "import ipykernel, matplotlib, nbclient, outrider"],
  { env: { ...process.env, PYTHONPATH: process.env.OUTRIDER_PYTHON ?? join(web, "../build/python") } }).status === 0;
for (const name of notebooks) {
  const page = html(`python/notebooks/${name}.html`);
  if (!side.includes(`/python/notebooks/${name}.html`)) throw new Error(`no list has ${name}`);
  if (ran ? !/<img [^>]*src="[^"]+[.]png"/.test(page) || !page.includes("language-text") : !page.includes("It was not run")) {
    throw new Error(`${name} has no outputs`);
  }
}
if (!/processor|cores/.test(html("benchmarks.html"))) throw new Error("the benchmarks have no machine");
if (!executable) {
  console.log("skipped: no Chromium");
  process.exit(77);
}

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };
const browser = await launch();
try {
  const page = await browser.newPage();
  page.setDefaultTimeout(1000 * patience_s);
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
  await page.locator(".vp-doc").filter({ hasText: /any.angle/i }).waitFor();
  if (wrong.length > 0) throw new Error(wrong.join("\n"));
  console.log(`found ${address}`);
} finally {
  await browser.close();
}
