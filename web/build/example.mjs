// Makes src/front/example.mcap anew: the log of the mission that the front page shows.
//   OUTRIDER=build/outrider OUTRIDER_SOURCE=. node web/build/example.mjs
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const example = fileURLToPath(new URL("../src/front/example.mcap", import.meta.url));
const out = mkdtempSync(join(tmpdir(), "outrider-example-"));
execFileSync(process.env.OUTRIDER, ["run", join(process.env.OUTRIDER_SOURCE, "scenarios/yard/yard.yaml"), "--out", out], { stdio: "ignore" });
copyFileSync(join(out, "run.mcap"), example);
rmSync(out, { recursive: true });
console.log(`web/src/front/example.mcap: ${Math.round(statSync(example).size / 1000)} kB`);
