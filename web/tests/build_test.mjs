// build_test.mjs OUT BUILT: `npm run build` makes in OUT the same files that CMake made in BUILT.
import { spawnSync } from "node:child_process";
import { readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { join } from "node:path";

const [out, built] = process.argv.slice(2);

const filesBelow = (folder, prefix = "") =>
  readdirSync(join(folder, prefix)).flatMap((name) =>
    statSync(join(folder, prefix, name)).isDirectory() ? filesBelow(folder, `${prefix}${name}/`) : [prefix + name],
  );
const filesOf = (folder) => ["app", "viewer"].flatMap((page) => filesBelow(folder, `${page}/`)).sort();

rmSync(out, { recursive: true, force: true });
const { status, error } = spawnSync("npm", ["run", "--silent", "build", "--", out], { stdio: "inherit" });
if (error?.code === "ENOENT") {
  console.log("skipped: npm is not installed");
  process.exit(77);
}
if (status !== 0) throw new Error(`npm run build ends with ${status}`);
const expected = filesOf(built);
if (filesOf(out).join() !== expected.join()) throw new Error(`npm made ${filesOf(out)}, CMake ${expected}`);
for (const name of expected) {
  if (!readFileSync(join(out, name)).equals(readFileSync(join(built, name)))) throw new Error(`${name} differs`);
}
console.log(`the same ${expected.length} files`);
