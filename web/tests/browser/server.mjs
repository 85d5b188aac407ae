// `outrider serve` on a folder of its own, at a port that is free.
import { execFileSync, spawn } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const tool = process.env.OUTRIDER;
export const source = process.env.OUTRIDER_SOURCE;
const builtPage = process.env.OUTRIDER_PAGE;

/** The scenarios the cases use, and the log of a mission in the yard. */
export function makeFolder() {
  const home = mkdtempSync(join(tmpdir(), "outrider-page-"));
  const folder = join(home, "ground");
  for (const name of ["cover", "maps", "pursuit", "waypoints", "yard"]) cpSync(join(source, "scenarios", name), join(folder, name), { recursive: true });
  mkdirSync(join(folder, "runs"));
  execFileSync(tool, ["run", join(source, "scenarios/yard/yard.yaml"), "--out", join(folder, "runs/yard")], { stdio: "ignore" });
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

/** The viewer as one file, of a log. */
export function makeViewer(folder, log) {
  const page = join(folder, "viewer.html");
  if (!builtPage) {
    execFileSync(tool, ["replay", join(folder, log), "--html", page], { stdio: "ignore" });
    return page;
  }
  const [head, rest] = readFileSync(join(builtPage, "viewer/viewer.html"), "utf8").split("@TITLE@");
  writeFileSync(page, head + "a run" + rest.replace("@LOG@", readFileSync(join(folder, log)).toString("base64")));
  return page;
}

/** Serves the page that `npm run build` made last, in place of the one in the tool, where OUTRIDER_PAGE names its folder. */
export async function useBuiltPage(context) {
  if (!builtPage) return;
  await context.route((url) => url.protocol === "http:" && !url.pathname.startsWith("/api/"), (route) => {
    const name = new URL(route.request().url()).pathname.slice(1);
    return route.fulfill({ path: join(builtPage, "app", name || "index.html") });
  });
}
