// site_links.mjs OUT: follows every link of the pages in OUT to a page, a file and a place on a page; its status is 1 where one
// leads nowhere. A link to another site is not followed.
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { join, posix, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const text = (attribute) => attribute.replace(/&amp;/g, "&").replace(/&quot;/g, '"').replace(/&#39;/g, "'").replace(/&lt;/g, "<");

/** The file that a path of the site is served from, or undefined. */
function fileAt(out, path) {
  for (const file of [path, `${path}.html`, posix.join(path, "index.html")]) {
    const full = join(out, file);
    if (existsSync(full) && statSync(full).isFile()) return file;
  }
  return undefined;
}

/** Sentences about links that lead nowhere, each once. */
export function deadLinks(out) {
  const pages = new Map(readdirSync(out, { recursive: true, encoding: "utf8" }).filter((name) => name.endsWith(".html"))
    .map((name) => [name, readFileSync(join(out, name), "utf8")]));
  const places = new Map([...pages].map(([name, html]) => [name, new Set([...html.matchAll(/\s(?:id|name)="([^"]+)"/g)].map(([, id]) => text(id)))]));
  const dead = new Set(), files = new Map();
  for (const [name, html] of pages) {
    for (const [, attribute] of html.matchAll(/<(?:a|img|source|iframe|link|script)\s[^>]*?(?:href|src)="([^"]*)"/g)) {
      const link = text(attribute);
      if (/^([a-z]+:|\/\/)/i.test(link)) continue;
      const [, path, place] = /^([^#?]*)[^#]*(?:#(.*))?$/.exec(link);
      const full = decodeURI(path === "" ? name : path.startsWith("/") ? path.slice(1) : posix.join(posix.dirname(name), path));
      if (!files.has(full)) files.set(full, fileAt(out, full === "" ? "index.html" : full));
      const file = files.get(full);
      if (!file) dead.add(`${name}: ${link} leads to no page`);
      else if (place && places.has(file) && file !== "plan.html" && !places.get(file).has(decodeURIComponent(place))) {
        dead.add(`${name}: there is no #${place} on ${file}`);
      }
    }
  }
  return [...dead];
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const dead = deadLinks(resolve(process.argv[2]));
  for (const sentence of dead) console.error(sentence);
  process.exit(dead.length > 0 ? 1 : 0);
}
