// Change a yard: its robot, targets and new obstacles are moved by hand, saved as a scenario, and guarded.
import { send, type RunRow, type ScenarioAnswer, type YardTarget } from "../api";
import { h, iconButton } from "../base/dom";
import { keys } from "../base/keys";
import { fixed } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import { saveCanvas } from "../base/save";
import { formatAddress } from "../base/url";
import { PolygonGround } from "./ground";
import { newName, suggestedName } from "./names";
import { Pane, type Scene } from "./pane";
import { SaveForm } from "./save_form";

type Yard = Extract<ScenarioAnswer, { job: "guard" }>;
type Tool = "move" | "target" | "obstacle" | "remove";
const words: Record<Tool, string> = {
  move: "Drag the robot, targets, new obstacles or the view", target: "Add a target", obstacle: "Add an obstacle, 1 m high", remove: "Remove a target or a new obstacle",
};
const cat: [number, number, number] = [0.5, 0.205, 0.372];

export class YardPage {
  readonly element: HTMLElement;
  private ground: PolygonGround;
  private targets: YardTarget[];
  private scene: Scene & { targets: YardTarget[] };
  private pane: Pane;
  private saving: SaveForm;
  private tool: Tool = "move";
  private tools: HTMLElement;
  private table = h("table", { class: "result" });
  private held: { what: "start" | "target" | "obstacle"; index: number; last: Vec2 } | null = null;
  private frame = 0;
  /** Obstacles of the world: they stay where they are. */
  private fixed: number;

  constructor(private yard: Yard) {
    this.ground = new PolygonGround(yard.map.polygons!);
    this.fixed = this.ground.obstacles.length;
    this.targets = structuredClone(yard.targets);
    this.scene = { ground: this.ground, start: yard.start, goal: null, radius_m: yard.map.radius_m ?? 0, selected: "start", targets: this.targets };
    this.pane = new Pane(this.scene, { redraw: () => this.invalidate(), grab: (at, reach) => this.grab(at, reach), drag: (at) => this.drag(at), drop: () => { this.held = null; } }, () => 0);
    const run = h("button", { type: "button", class: "button", title: "Save it, then run the mission (R)", onclick: () => void this.run() }, "Save and run");
    this.saving = new SaveForm(suggestedName(yard.path, "_changed"), yard.path, () => this.request(), run);
    this.tools = h("div", { class: "segments", role: "group", "aria-label": "Tool" }, ...(Object.keys(words) as Tool[]).map((name) =>
      h("button", { type: "button", "data-tool": name, title: words[name], "aria-pressed": String(name === this.tool), onclick: () => this.takeUp(name) },
        name === "move" ? "Drag" : name[0]!.toUpperCase() + name.slice(1))));
    const aside = h("section", { class: "panel aside" }, h("div", { class: "tabbed scrolls plan-aside" },
      h("h2", {}, yard.path), this.saving.element, this.table));
    this.element = h("div", { class: "watch plan-page yard-page" }, h("section", { class: "panel stage-panel", "aria-label": "The yard" },
      h("div", { class: "stage" }, h("div", { class: "panes" }, this.pane.element), h("div", { class: "stage-bar" }, this.tools),
        h("div", { class: "stage-tools" }, iconButton("save", "Save the view as PNG", () => this.savePicture(), "s")))), aside);
    this.bindKeys();
    this.changed();
  }

  close(): void {
    cancelAnimationFrame(this.frame);
    this.pane.close();
    keys.set("Yard", []);
  }

  private request(): { guard: { scenario: string; start: Vec2; targets: { name: string; position: Vec2 }[]; boxes: number[][] } } {
    const boxes = this.ground.obstacles.slice(this.fixed).filter((one) => one !== null).map((corners) => {
      const [xs, ys] = [corners.map(([x]) => x), corners.map(([, y]) => y)];
      return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
    });
    const targets = this.targets.map(({ name, position: [x, y] }) => ({ name, position: [x, y] as Vec2 }));
    return { guard: { scenario: this.yard.path, start: this.scene.start, targets, boxes } };
  }

  /** Saves under the name that stands there, and runs that. */
  private async run(): Promise<void> {
    const path = await this.saving.save();
    if (!path) return;
    try {
      const { id } = await send<RunRow>("POST", "runs", { scenario: path });
      location.hash = formatAddress({ view: "live", path: id, query: {} });
    } catch (error) {
      this.saving.say(error instanceof Error ? error.message : String(error), true);
    }
  }

  private changed(): void {
    const row = (name: string, [x, y]: readonly number[]): HTMLElement =>
      h("tr", { "data-name": name }, h("th", { scope: "row" }, name), h("td", {}, fixed(x!, 2)), h("td", {}, fixed(y!, 2)));
    this.table.replaceChildren(h("thead", {}, h("tr", {}, h("th"), h("th", { scope: "col" }, "x m"), h("th", { scope: "col" }, "y m"))),
      h("tbody", {}, row("robot", this.scene.start), ...this.targets.map(({ name, position }) => row(name, position))));
    this.invalidate();
  }

  // The hand.

  private takeUp(tool: Tool): void {
    this.tool = tool;
    for (const button of this.tools.children) button.setAttribute("aria-pressed", String(button.getAttribute("data-tool") === tool));
  }

  /** The target that is nearest within reach; -1 for none. */
  private targetAt([x, y]: Vec2, reach: number): number {
    const away = this.targets.map(({ position }) => Math.hypot(position[0] - x, position[1] - y));
    const least = Math.min(...away);
    return least <= reach ? away.indexOf(least) : -1;
  }

  private grab(at: Vec2, reach: number): boolean {
    const { ground, scene } = this;
    const target = this.targetAt(at, reach);
    const obstacle = ground.at(at) >= this.fixed ? ground.at(at) : -1;
    if (this.tool === "move") {
      const start = Math.hypot(scene.start[0] - at[0], scene.start[1] - at[1]) <= reach;
      if (!start && target < 0 && obstacle < 0) return false;
      this.held = start ? { what: "start", index: 0, last: at } : target >= 0 ? { what: "target", index: target, last: at } : { what: "obstacle", index: obstacle, last: at };
      if (this.held.what !== "obstacle") scene.selected = start ? "start" : target;
    } else if (this.tool === "target") {
      this.targets.push({ name: newName(this.targets), position: [...at, 0], size: cat, heading_rad: 0 });
      scene.selected = this.targets.length - 1;
      this.held = { what: "target", index: this.targets.length - 1, last: at };
    } else if (this.tool === "obstacle") {
      this.held = { what: "obstacle", index: ground.add(at, 0.5), last: at };
    } else if (target >= 0) {
      this.targets.splice(target, 1);
      scene.selected = "start";
    } else if (obstacle >= 0) ground.remove(obstacle);
    this.changed();
    return true;
  }

  private drag(at: Vec2): void {
    const { held } = this;
    if (!held) return;
    const by: Vec2 = [at[0] - held.last[0], at[1] - held.last[1]];
    if (held.what === "obstacle") this.ground.shift(held.index, by);
    else this.shift(held.what === "start" ? "start" : held.index, by);
    held.last = at;
    this.changed();
  }

  private shift(what: Scene["selected"], [dx, dy]: Vec2): void {
    if (typeof what === "number") {
      const [x, y, z] = this.targets[what]!.position;
      this.targets[what]!.position = [x + dx, y + dy, z];
    } else this.scene.start = [this.scene.start[0] + dx, this.scene.start[1] + dy];
  }

  private nudge(dx: number, dy: number): void {
    this.shift(this.scene.selected, [dx * 0.1, dy * 0.1]);
    this.changed();
  }

  private select(what: Scene["selected"]): void {
    this.scene.selected = what;
    this.invalidate();
  }

  private nextTarget(): void {
    if (this.targets.length === 0) return;
    const { selected } = this.scene;
    this.select(typeof selected === "number" ? (selected + 1) % this.targets.length : 0);
  }

  private invalidate(): void {
    if (this.frame !== 0) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.pane.draw();
    });
  }

  private savePicture(): void {
    saveCanvas(this.pane.canvas, `${this.yard.map.name}.png`);
  }

  private bindKeys(): void {
    keys.set("Yard", [
      { key: "1", words: "take the robot", act: () => this.select("start") },
      { key: "t", words: "take the next target", act: () => this.nextTarget() },
      { key: "h", words: "move it left", act: () => this.nudge(-1, 0) },
      { key: "j", words: "move it down", act: () => this.nudge(0, -1) },
      { key: "k", words: "move it up", act: () => this.nudge(0, 1) },
      { key: "l", words: "move it right", act: () => this.nudge(1, 0) },
      ...(Object.keys(words) as Tool[]).map((tool, i) => ({ key: "qwer"[i]!, words: words[tool].toLowerCase(), act: () => this.takeUp(tool) })),
      { key: "S", words: "save as a scenario", act: () => void this.saving.save() },
      { key: "R", words: "save it and run the mission", act: () => void this.run() },
      { key: "s", words: "save the view as PNG", act: () => this.savePicture() },
      { key: "+", words: "zoom in", act: () => this.pane.camera.zoom(1.5) },
      { key: "-", words: "zoom out", act: () => this.pane.camera.zoom(1 / 1.5) },
      { key: "0", words: "show everything", act: () => this.pane.camera.reset() },
    ]);
  }
}
