// Plans while one drags, measured: how often a plan comes back, and how long after the pointer moved.
import { cpSync } from "node:fs";
import { join } from "node:path";
import { launch } from "./browser.mjs";
import { source } from "./server.mjs";

const margin = { left: 34, right: 54, top: 50, bottom: 40 };  // as Camera has it

/** Returns the place on the screen of a place in metres while the whole box is shown, below what lies over its head. */
export async function onScreen(page, [x0, y0, x1, y1], [x, y], selector = ".pane canvas", head = margin.top) {
  const { x: left, y: top, width, height } = await page.locator(selector).first().boundingBox();
  const [across, tall] = [width - margin.left - margin.right, height - head - margin.bottom];
  const scale = Math.min(across / (x1 - x0), tall / (y1 - y0));
  return [left + margin.left + across / 2 + scale * (x - (x0 + x1) / 2), top + head + tall / 2 - scale * (y - (y0 + y1) / 2)];
}

/** Makes a page that is opened after this note its questions: when they were sent and answered, in ms. */
export async function noteQuestions(context) {
  await context.addInitScript(() => {
    window.asked = [];
    const { send } = WebSocket.prototype;
    WebSocket.prototype.send = function (text) {
      const { type, id } = JSON.parse(text);
      if (type === "plan") {
        const note = { sent: performance.now(), answered: null };
        window.asked.push(note);
        const hear = (event) => {
          if (!event.data.startsWith(`{"type":"plan","id":${id},`)) return;
          this.removeEventListener("message", hear);
          requestAnimationFrame(() => { note.answered = performance.now(); });
        };
        this.addEventListener("message", hear);
      }
      send.call(this, text);
    };
  });
}

async function drag(page, from, to, seconds = 2) {
  const steps = 60 * seconds;
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.evaluate(() => { window.asked.length = 0; });
  const start = Date.now();
  for (let i = 1; i <= steps; ++i) {
    const s = 0.5 - 0.5 * Math.cos((4 * Math.PI * i) / steps);  // there and back, twice
    await page.mouse.move(from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1]));
    await new Promise((done) => setTimeout(done, Math.max(0, start + (1000 * i) / 60 - Date.now())));
  }
  const spent = (Date.now() - start) / 1000;
  const notes = await page.evaluate(() => window.asked.filter((one) => one.answered !== null));
  await page.mouse.up();
  const times = notes.map(({ sent, answered }) => answered - sent).sort((a, b) => a - b);
  const at = (share) => times[Math.floor(share * (times.length - 1))] ?? NaN;
  return { moves: steps / spent, answers: notes.length / spent, median: at(0.5), most: at(0.99) };
}

/** Says for each kind of ground how it goes. */
export async function measureDragging(server, folder) {
  const browser = await launch();
  cpSync(join(source, "scenarios/explore"), join(folder, "explore"), { recursive: true });
  for (const [what, path, planner, tool, from, to] of [
    ["the goal", "maps/gallery.map", "a_star", "", "goal", [0.5, 0.5]],
    ["the goal", "maps/gallery.map", "theta_star", "", "goal", [0.5, 0.5]],
    ["a wall, painted", "maps/gallery.map", "a_star", "w", [0.3, 0.3], [0.6, 0.7]],
    ["the goal", "explore/cave_map.yaml", "a_star", "", "goal", [0.5, 0.5]],
    ["a wall, painted", "explore/cave_map.yaml", "a_star", "w", [0.4, 0.3], [0.6, 0.7]],
    ["the goal", "yard/yard.sdf", "visibility_graph_implicit", "", "goal", [0.5, 0.5]],
    ["an obstacle, added", "yard/yard.sdf", "visibility_graph_implicit", "w", [0.35, 0.6], [0.6, 0.4]],
  ]) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, reducedMotion: "reduce" });
    await noteQuestions(context);
    const page = await context.newPage();
    const map = await (await fetch(`${server.url}api/v1/maps`, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ path }) })).json();
    const box = boxOf(map);
    const place = ([u, v]) => [box[0] + u * (box[2] - box[0]), box[1] + v * (box[3] - box[1])];
    const goal = place([0.8, 0.8]);
    await page.goto(`${server.url}#plan/${path}?planner=${planner}&goal=${goal}`);
    await page.waitForSelector(".result");
    if (tool) await page.keyboard.press(tool);
    const begin = from === "goal" ? goal : place(from);
    const { moves, answers, median, most } = await drag(page, await onScreen(page, box, begin), await onScreen(page, box, place(to)));
    console.log(`page: dragging ${what} on ${path} with ${planner}: the pointer moves ${moves.toFixed(0)} times a second, ${answers.toFixed(0)} plans are drawn a second, ${median.toFixed(1)} ms (median) after they are asked for, 99 % within ${most.toFixed(1)} ms`);
    await context.close();
  }
  await browser.close();
}

function boxOf({ grid, polygons }) {
  if (grid) {
    const { origin: [x, y], width, height, resolution_m: r } = grid;
    return [x, y, x + width * r, y + height * r];
  }
  const points = [...polygons.boundary, ...polygons.obstacles.flat()];
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}
