// Logs of short runs, made by the tool: a robot explores two rooms on a map with a heading, another drives by tags, logs are mapped.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { source, tool } from "./server.mjs";

/** Rooms of 4.2 by 3.2 m as an image: what lies in one of the boxes (columns and rows of 5 cm, from the upper left) is wall. */
function rooms() {
  const [width, height] = [84, 64];
  const boxes = [[0, 0, 84, 3], [0, 61, 84, 64], [0, 0, 3, 64], [81, 0, 84, 64], [40, 0, 43, 38], [16, 44, 22, 50]];
  const cells = Buffer.alloc(width * height, 254);
  for (const [x0, y0, x1, y1] of boxes) for (let y = y0; y < y1; ++y) cells.fill(0, y * width + x0, y * width + x1);
  return Buffer.concat([Buffer.from(`P5\n${width} ${height}\n255\n`), cells]);
}

export function makeRuns(folder) {
  const run = (...words) => execFileSync(tool, words, { stdio: "ignore" });
  writeFileSync(join(folder, "maps/rooms.pgm"), rooms());
  writeFileSync(join(folder, "maps/rooms.yaml"),
    "image: rooms.pgm\nresolution: 0.05\norigin: [1, 0.5, 0.4]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  run("explore", "--world", join(folder, "maps/rooms.yaml"), "--start", "0.70,2.76,-60", "--seed", "1", "--out", join(folder, "runs/explore"));
  const drive = join(folder, "waypoints/modelled.yaml");
  writeFileSync(drive, readFileSync(join(folder, "waypoints/closed_loop.yaml"), "utf8").replace("sight: rendered", "sight: modelled"));
  run("run", drive, "--out", join(folder, "runs/drive"));
}

export function makeMaps(folder) {
  for (const name of ["office", "posts"])
    execFileSync(tool, ["run", join(source, `scenarios/slam/${name}.yaml`), "--out", join(folder, `runs/${name}`)], { stdio: "ignore" });
}
