// `outrider serve` on a folder of its own, at a port that is free.
import { execFileSync, spawn } from "node:child_process";
import { closeSync, copyFileSync, cpSync, mkdirSync, mkdtempSync, openSync, readFileSync, renameSync, rmSync, writeFileSync, writeSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const tool = process.env.OUTRIDER;
export const source = process.env.OUTRIDER_SOURCE;
const builtPage = process.env.OUTRIDER_PAGE;

/** The scenarios the cases use, and the log of a mission in the yard: that in OUTRIDER_YARD, where a test before has made it. */
export function makeFolder() {
  const home = mkdtempSync(join(tmpdir(), "outrider-page-"));
  const folder = join(home, "ground");
  for (const name of ["cover", "maps", "pursuit", "waypoints", "yard"]) cpSync(join(source, "scenarios", name), join(folder, name), { recursive: true });
  mkdirSync(join(folder, "runs"));
  const yard = join(folder, "runs/yard");
  if (process.env.OUTRIDER_YARD) cpSync(process.env.OUTRIDER_YARD, yard, { recursive: true });
  else execFileSync(tool, ["run", join(source, "scenarios/yard/yard.yaml"), "--out", yard], { stdio: "ignore" });
  return { folder, remove: () => rmSync(home, { recursive: true, force: true }) };
}

/** Resolves with the server: the address that it prints, and what holds its missions. */
export async function serve(folder) {
  const home = mkdtempSync(join(tmpdir(), "outrider-held-"));
  const own = join(home, "outrider");
  copyFileSync(tool, own);
  const child = spawn(own, ["serve", folder, "--port", "0"], { stdio: ["ignore", "pipe", "pipe"] });
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
  // From now on each program that it starts comes by this.
  writeFileSync(join(home, "between"), `#!/bin/sh\nexec python3 -ESB ${join(source, "tests/support/held_mission.py")} ${home} ${tool} "$@"\n`, { mode: 0o700 });
  renameSync(join(home, "between"), own);
  const holds = {};
  return {
    url,
    /** From now on missions of this scenario wait for passOn(). */
    hold(scenario) {
      const pipe = join(home, scenario.replaceAll("/", "+"));
      execFileSync("mkfifo", [pipe]);
      holds[scenario] = openSync(pipe, "r+");
    },
    /** Lets a mission that is held tell what happens up to a `time` and a `step`; all of it, if they are not given. */
    passOn(scenario, most = {}) { writeSync(holds[scenario], `${JSON.stringify(most)}\n`); },
    async stop() {
      await new Promise((resolve) => { child.on("exit", resolve); child.kill("SIGTERM"); });
      for (const pipe of Object.values(holds)) closeSync(pipe);
      rmSync(home, { recursive: true });
    },
  };
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
