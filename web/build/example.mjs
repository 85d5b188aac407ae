// Makes src/front/example.mcap anew: the log of the mission that the front page shows.
//   OUTRIDER=$PWD/build/outrider OUTRIDER_SOURCE=. node web/build/example.mjs
// It runs beside the scenario, so that the log names no path of this machine.
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const example = fileURLToPath(new URL("../src/front/example.mcap", import.meta.url));
const out = mkdtempSync(join(tmpdir(), "outrider-example-"));
const yard = join(process.env.OUTRIDER_SOURCE, "scenarios/yard");
execFileSync(process.env.OUTRIDER, ["run", "yard.yaml", "--out", out], { cwd: yard, stdio: "ignore" });
copyFileSync(join(out, "run.mcap"), example);
rmSync(out, { recursive: true });
console.log(`web/src/front/example.mcap: ${Math.round(statSync(example).size / 1000)} kB`);
