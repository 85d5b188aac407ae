// site.mjs [OUT [--sources]]: builds the docs site in OUT, ../out/site unless given; with --sources OUT gets the Markdown of its
// pages instead. Its sources are the Markdown of the repository and the pages that the tool wrote to build/docs: links and
// pictures are followed from docs/index.md and README.md, and what they name becomes a page.
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { dirname, join, posix, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "vitepress";
import { load } from "../../wasm/planner.mjs";
import { benchmarkPage } from "./site_benchmarks.mjs";
import { deadLinks } from "./site_links.mjs";
import { examplePage, filePage, headerPage, listPage, notebookPage, planFrame } from "./site_pages.mjs";

const web = fileURLToPath(new URL("..", import.meta.url));
const root = join(web, "..");
const staged = mkdtempSync(join(web, ".site-"));  // below the packages of npm, and for this build alone
process.on("exit", () => rmSync(staged, { recursive: true, force: true }));
const out = resolve(process.argv[2] ?? join(root, "out/site"));
const done = new Set(), pictures = new Set();

// The page that plans without a server, where `make wasm` has made it: each planner's page shows it.
const wasm = join(root, "build-wasm");
const inBrowser = existsSync(join(wasm, "plan.html")) ? (await load(readFileSync(join(wasm, "planner.wasm")))).catalogue() : [];
const frames = new Map(inBrowser.filter(({ models }) => models.length > 0)
  .map(({ name }) => [`docs/planners/${name}.md`, planFrame(name)]));

const written = process.env.OUTRIDER_DOCS ?? join(root, "build/docs");

/** Returns the place of a file of the repository, or in its place a page of the tool. */
function at(path) {
  const own = join(root, path), page = join(written, posix.basename(path));
  return !existsSync(own) && posix.dirname(path) === "docs" && existsSync(page) ? page : own;
}
if (!existsSync(at("docs/options-guard.md"))) throw new Error("the pages of options are missing: `make docs` writes them");
const read = (path) => readFileSync(at(path), "utf8");
const below = (folder, pattern) => readdirSync(join(root, folder), { recursive: true, encoding: "utf8" })
  .filter((name) => pattern.test(name)).sort().map((name) => `${folder}/${name}`);
function write(path, text) {
  mkdirSync(dirname(join(staged, path)), { recursive: true });
  writeFileSync(join(staged, path), text);
}

const titleOf = (path) => (path.endsWith(".md") ? /^# (.*)$/m.exec(read(path))?.[1]
  : path.endsWith(".ipynb") ? JSON.parse(read(path)).cells[0].source[0].slice(2).trim() : undefined) ?? posix.basename(path);
const pageOf = (path) => path.endsWith(".md") ? path.replace(/README[.]md$/, "index.md") : `${path}.md`;

/** Stages what a link names, a path in the repository, and returns the path of its page. */
function stage(path) {
  const folder = statSync(at(path)).isDirectory();
  if (folder && existsSync(join(root, path, "README.md"))) return stage(`${path}/README.md`);
  const page = folder ? `${path}/index.md` : pageOf(path);
  if (done.has(page)) return page;
  done.add(page);
  if (folder) {
    const files = below(path, /[.](md|hpp|cpp|py)$/);
    write(page, listPage(path, files.map((file) => ({ text: titleOf(file), link: posix.relative(path, stage(file)) }))));
  } else if (path.endsWith(".md")) write(page, followLinks(path, page) + (frames.get(path) ?? ""));
  else if (path.endsWith(".ipynb")) write(page, ran ? readFileSync(join(staged, path.replace(/[.]ipynb$/, ".md")), "utf8") : notebookPage(read(path)));
  else if (path.endsWith(".hpp")) write(page, headerPage(path, read(path)));
  else if (/examples\//.test(path)) write(page, examplePage(path, read(path)));
  else write(page, filePage(path, read(path)));
  return page;
}

/** Runs the notebooks, where there is what they need, and stages what they print and draw. */
function runNotebooks(notebooks) {
  const env = { ...process.env, PYTHONPATH: process.env.OUTRIDER_PYTHON ?? join(root, "build/python"), PYTHONDONTWRITEBYTECODE: "1" };
  const python = (...args) => spawnSync("/usr/bin/python3", args, { cwd: root, env, encoding: "utf8" });
  if (python("-c", "import ipykernel, matplotlib, nbclient, outrider").status !== 0) {
    console.warn("the notebooks are shown without outputs: they need python3-nbclient, python3-ipykernel and the Python package");
    return false;
  }
  const { status, stderr } = python("python/execute_notebooks.py", join(staged, "python/notebooks"), ...notebooks);
  if (status !== 0) throw new Error(`a notebook fails: ${stderr}`);
  return true;
}

/** The text of a page of Markdown whose links lead to pages of the site; code is left alone. */
function followLinks(path, page) {
  const from = posix.dirname(path);
  const target = (link) => {
    const [, name, anchor] = /^([^#]*)(#.*)?$/.exec(link);
    const file = posix.join(from, decodeURI(name)).replace(/\/$/, "");
    if (/^[a-z]+:/.test(link) || name === "" || !existsSync(at(file))) return link;
    if (/[.](png|svg|webp|jpg)$/.test(file)) {
      mkdirSync(join(staged, dirname(file)), { recursive: true });
      cpSync(join(root, file), join(staged, file));
      pictures.add(file);
      return `./${name}`;
    }
    return posix.relative(posix.dirname(page), stage(file)) + (anchor ?? "");
  };
  return read(path).split(/(^```[^]*?^```|`[^`\n]+`)/m).map((part, i) => i % 2 === 1 ? part : part
    .replace(/\]\(([^)\s]+)\)/g, (_, link) => `](${target(link)})`)
    .replace(/(src|srcset|href)="([^"]+)"/g, (_, key, link) => `${key}="${target(link)}"`)).join("");
}

/** An entry for each item of docs/index.md, with the other links of the item below it; headers are grouped by layer. */
function sidebar() {
  const items = read("docs/index.md").split(/^- /m).slice(1).map((item) =>
    [...item.matchAll(/\[([^\]]+)\]\(([^)]+)\)/g)].map(([, text, link]) => ({ text, path: posix.join("docs", link).replace(/\/$/, "") })));
  const links = items.filter((item) => item.length > 0).map(([{ text, path }, ...more]) => ({ text, link: `/${stage(path)}`,
    ...(more.length > 0 && { collapsed: true, items: more.map((one) => ({ text: titleOf(one.path), link: `/${stage(one.path)}` })) }) }));
  const layers = readdirSync(join(root, "include/outrider"), { withFileTypes: true })
    .sort((a, b) => a.isDirectory() - b.isDirectory() || (a.name < b.name ? -1 : 1)).map((entry) => ({ text: entry.name, link: `/${stage(`include/outrider/${entry.name}`)}` }));
  const examples = ["examples", "python/examples"].flatMap((folder) => below(folder, /^\d.*[.](cpp|py)$/))
    .map((file) => ({ text: posix.basename(file), link: `/${stage(file)}` }));
  const shown = notebooks.map((file) => ({ text: titleOf(file), link: `/${stage(file)}` }));
  const measured = process.env.OUTRIDER_BENCH ?? join(root, "out/bench");
  const own = existsSync(measured);
  write("benchmarks.md", benchmarkPage(own ? measured : join(root, "docs/benchmarks/results"), own));
  return [{ text: "Documents", items: [...links, { text: "Benchmarks", link: "/benchmarks.md" }] },
    { text: "Notebooks", collapsed: true, items: shown },
    { text: "Examples", collapsed: true, items: examples }, { text: "Headers by layer", collapsed: true, items: layers }];
}

cpSync(join(web, "site/.vitepress"), join(staged, ".vitepress"), { recursive: true });
const notebooks = below("python/notebooks", /[.]ipynb$/);
const ran = runNotebooks(notebooks);
stage("README.md");
stage("docs/index.md");
for (const file of below("docs", /[.]md$/)) stage(file);
write("sidebar.json", JSON.stringify(sidebar()));
for (const file of notebooks) rmSync(join(staged, file.replace(/[.]ipynb$/, ".md")), { force: true });  // its page has its text
if (process.argv[3] === "--sources") {
  rmSync(out, { recursive: true, force: true });
  cpSync(staged, out, { recursive: true });
  process.exit(0);
}
await build(staged, { outDir: out, emptyOutDir: true });
if (frames.size > 0) cpSync(join(wasm, "plan.html"), join(out, "plan.html"));
for (const file of pictures) cpSync(join(root, file), join(out, file));  // pages show copies, but links lead to these
const dead = deadLinks(out);
if (dead.length > 0) throw new Error(`dead links:\n${dead.join("\n")}`);
