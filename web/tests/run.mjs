// run.mjs SCRIPT ARGUMENT...: runs a script that needs the packages of the page, in web/. Where npm has not
// installed them it says so, and its status is 77: skipped.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

const web = fileURLToPath(new URL("..", import.meta.url));
if (!existsSync(`${web}node_modules/.package-lock.json`)) {
  console.log("skipped: the packages of the page are not installed (npm ci in web/)");
  process.exit(77);
}
process.exit(spawnSync(process.execPath, process.argv.slice(2), { cwd: web, stdio: "inherit" }).status ?? 1);
