// Logs of short runs, made by the tool: a robot explores two rooms on a map with a heading, another drives by tags, logs are mapped.
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { source, tool } from "./server.mjs";

const yaml = (image) => `image: ${image}\nresolution: 0.05\norigin: [1, 0.5, 0.4]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n`;

/** A map image: what lies in one of the boxes (columns and rows of 5 cm, from the upper left) is wall. */
function imageOf(width, height, boxes) {
  const cells = Buffer.alloc(width * height, 254);
  for (const [x0, y0, x1, y1] of boxes) for (let y = y0; y < y1; ++y) cells.fill(0, y * width + x0, y * width + x1);
  return Buffer.concat([Buffer.from(`P5\n${width} ${height}\n255\n`), cells]);
}

/** Rooms of 4.2 by 3.2 m. */
const rooms = () => imageOf(84, 64, [[0, 0, 84, 3], [0, 61, 84, 64], [0, 0, 3, 64], [81, 0, 84, 64], [40, 0, 43, 38], [16, 44, 22, 50]]);

/** A building of 10 by 6 rooms of 5 m side, each with a table, and with doors of 1 m to its neighbours. */
function building() {
  const [across, down, side, wall, door] = [10, 6, 100, 3, 20];
  const [width, height] = [across * side + wall, down * side + wall];
  const boxes = [[0, 0, width, wall], [0, height - wall, width, height], [0, 0, wall, height], [width - wall, 0, width, height]];
  for (let column = 0; column < across; ++column) {
    for (let row = 0; row < down; ++row) {
      const [x, y] = [column * side, row * side];
      boxes.push([x + 60, y + 55, x + 76, y + 63]);
      if (column > 0) boxes.push([x, y, x + wall, y + 40], [x, y + 40 + door, x + wall, y + side]);
      if (row > 0) boxes.push([x, y, x + 25, y + wall], [x + 25 + door, y, x + side, y + wall]);
    }
  }
  return imageOf(width, height, boxes);
}

/** Explores a building of 60 rooms slowly, which takes two hours of the robot's time; returns what run.json says. */
export function makeLongExploration(folder) {
  writeFileSync(join(folder, "maps/building.pgm"), building());
  writeFileSync(join(folder, "maps/building.yaml"), yaml("building.pgm"));
  execFileSync(tool, ["explore", "--world", join(folder, "maps/building.yaml"), "--start", "2,2,0", "--seed", "1", "--robot-speed", "0.15",
    "--out", join(folder, "runs/building")], { stdio: "ignore" });
  return JSON.parse(readFileSync(join(folder, "runs/building/run.json"), "utf8"));
}

export function makeRuns(folder) {
  const run = (...words) => execFileSync(tool, words, { stdio: "ignore" });
  writeFileSync(join(folder, "maps/rooms.pgm"), rooms());
  writeFileSync(join(folder, "maps/rooms.yaml"), yaml("rooms.pgm"));
  run("explore", "--world", join(folder, "maps/rooms.yaml"), "--start", "0.70,2.76,-60", "--seed", "1", "--out", join(folder, "runs/explore"));
  const drive = join(folder, "waypoints/modelled.yaml");
  writeFileSync(drive, readFileSync(join(folder, "waypoints/closed_loop.yaml"), "utf8").replace("sight: rendered", "sight: modelled"));
  run("run", drive, "--out", join(folder, "runs/drive"));
}

export function makeMaps(folder) {
  for (const name of ["office", "posts"]) {  // a map that is in doubt is drawn as well
    const { status } = spawnSync(tool, ["run", join(source, `scenarios/slam/${name}.yaml`), "--out", join(folder, `runs/${name}`)], { stdio: "ignore" });
    if (status !== 0 && status !== 1) throw new Error(`${name} was not mapped`);
  }
}
