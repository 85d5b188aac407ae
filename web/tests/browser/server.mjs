// `outrider serve` on a folder of its own, at a port that is free.
import { execFileSync, spawn } from "node:child_process";
import { copyFileSync, cpSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const tool = process.env.OUTRIDER;
export const source = process.env.OUTRIDER_SOURCE;

/** The scenarios the cases use, and the report of a quick mission in the yard. */
export function makeFolder() {
  const home = mkdtempSync(join(tmpdir(), "outrider-page-"));
  const folder = join(home, "ground");
  for (const name of ["cover", "maps", "pursuit", "waypoints", "yard"]) cpSync(join(source, "scenarios", name), join(folder, name), { recursive: true });
  mkdirSync(join(folder, "reports"));
  copyFileSync(join(source, "web/tests/browser/yard.json"), join(folder, "reports/yard.json"));
  return { folder, remove: () => rmSync(home, { recursive: true, force: true }) };
}

/** Resolves with the address that it prints. */
export async function serve(folder) {
  const child = spawn(tool, ["serve", folder, "--port", "0"], { stdio: ["ignore", "pipe", "pipe"] });
  let text = "";
  const url = await new Promise((resolve, reject) => {
    const hear = (chunk) => {
      text += chunk;
      const found = text.match(/http:\/\/127\.0\.0\.1:\d+\//);
      if (found) resolve(found[0]);
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("exit", () => reject(new Error(`outrider serve ended: ${text}`)));
  });
  return { url, stop: () => new Promise((resolve) => { child.on("exit", resolve); child.kill("SIGTERM"); }) };
}

/** The viewer as one file, of a run of the yard. */
export function makeViewer(folder) {
  const page = join(folder, "viewer.html");
  execFileSync(tool, ["run", join(folder, "yard/yard.yaml"), "--out", join(folder, "yard-run")], { stdio: "ignore" });
  execFileSync(tool, ["replay", join(folder, "yard-run"), "--html", page], { stdio: "ignore" });
  return page;
}
