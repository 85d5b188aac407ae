// The yard page: moves and turns the robot, targets and things of a yard by hand, saves them as a scenario, and runs
// the mission.
import { startRun } from "../api";
import { h, iconButton } from "../base/dom";
import { keys } from "../base/keys";
import { fixed } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import { saveCanvas } from "../base/save";
import { PolygonGround } from "./ground";
import { onKnob } from "./handle";
import { suggestedName } from "./names";
import { Pane, type Scene } from "./pane";
import { SaveForm } from "./save_form";
import { headingTo, turned } from "./turning";
import { Yard, type Item, type YardScenario } from "./yard";
import { beyond, drawYard } from "./yard_layer";

type Tool = "move" | "target" | "obstacle" | "remove";
const words: Record<Tool, string> = {
  move: "Drag the robot, targets, obstacles or the view; turn what is selected by its handle", target: "Add a target", obstacle: "Add an obstacle, 1 m high", remove: "Remove a target or an obstacle; one of the world comes back by the same",
};
const stride_m = 0.1;

export class YardPage {
  readonly element: HTMLElement;
  private yard: Yard;
  private scene: Scene;
  private pane: Pane;
  private saving: SaveForm;
  private selected: Item | null = { what: "robot", index: 0 };
  private tool: Tool = "move";
  private tools: HTMLElement;
  private table = h("table", { class: "result places" });
  private said = h("p", { class: "hint", role: "status" });
  /** The item that the pointer holds, by a point of it or by its handle. */
  private held: { item: Item; turns: boolean; off: Vec2; moved: boolean } | null = null;
  private frame = 0;
  /** The yard as it was opened or saved last. */
  private kept: string;

  constructor(private scenario: YardScenario) {
    this.yard = new Yard(scenario);
    const ground = new PolygonGround({ ...scenario.map.polygons!, obstacles: scenario.fixed });
    this.scene = { ground, start: this.yard.start, goal: null, heading_rad: this.yard.heading_rad, radius_m: scenario.map.radius_m, selected: "start",
      layer: (ctx, camera) => drawYard(ctx, camera, this.yard, this.selected) };
    this.pane = new Pane(this.scene, { redraw: () => this.invalidate(), grab: (at, reach) => this.grab(at, reach), drag: (at) => this.drag(at), drop: () => { this.held = null; } }, () => 0);
    const run = h("button", { type: "button", class: "button", title: "Save it, then run the mission (R)", onclick: () => void this.run() }, "Save and run");
    this.saving = new SaveForm(suggestedName(scenario.path, "_changed"), scenario.path, () => ({ guard: this.yard.request }), () => { this.kept = this.state; }, run);
    this.kept = this.state;
    this.tools = h("div", { class: "segments", role: "group", "aria-label": "Tool" }, ...(Object.keys(words) as Tool[]).map((name) =>
      h("button", { type: "button", "data-tool": name, title: words[name], "aria-pressed": String(name === this.tool), onclick: () => this.takeUp(name) },
        name === "move" ? "Drag" : name[0]!.toUpperCase() + name.slice(1))));
    const aside = h("section", { class: "panel aside" }, h("div", { class: "tabbed scrolls plan-aside" },
      h("h1", {}, scenario.path), this.saving.element, this.said, this.table));
    this.element = h("div", { class: "watch plan-page yard-page" }, h("section", { class: "panel stage-panel", "aria-label": "The yard" },
      h("div", { class: "stage" }, h("div", { class: "panes" }, this.pane.element), h("div", { class: "stage-bar" }, this.tools),
        h("div", { class: "stage-tools" }, iconButton("undo", "Undo", () => this.undo(false), "u"), iconButton("redo", "Do it again", () => this.undo(true), "U"), iconButton("save", "Save the view as PNG", () => this.savePicture(), "s")))), aside);
    this.bindKeys();
    this.changed();
  }

  private get state(): string { return JSON.stringify(this.yard.request); }
  unsaved(): boolean { return this.state !== this.kept; }

  close(): void {
    cancelAnimationFrame(this.frame);
    this.pane.close();
    keys.drop(this);
  }

  /** Saves under the name in the form, and runs that scenario. */
  private async run(): Promise<void> {
    const path = await this.saving.save();
    if (!path) return;
    try {
      await startRun(path);
    } catch (error) {
      this.saving.print(error instanceof Error ? error.message : String(error), true);
    }
  }

  private changed(): void {
    const { yard, selected } = this;
    this.scene.start = yard.start;
    this.scene.heading_rad = yard.heading_rad;
    this.scene.selected = selected?.what === "robot" ? "start" : null;
    const row = (item: Item): HTMLElement => {
      const [x, y] = yard.middle(item);
      const is = item.what === selected?.what && item.index === selected.index;
      const gone = yard.isRemoved(item);
      return h("tr", { "data-name": yard.name(item), "data-what": item.what, "data-selected": is ? "true" : null, class: gone ? "gone" : "", onclick: () => this.select(item) },
        h("th", { scope: "row" }, yard.name(item)), ...(gone ? [h("td", { colspan: 3 }, "removed")]
          : [h("td", {}, fixed(x, 2)), h("td", {}, fixed(y, 2)), h("td", {}, fixed(yard.turn(item) * 180 / Math.PI, 0))]));
    };
    const changed = yard.obstacles.filter((item) => item.what === "box" || yard.isMoved(item) || yard.isRemoved(item) || item === selected
      || (item.what === selected?.what && item.index === selected.index));
    this.table.replaceChildren(h("thead", {}, h("tr", {}, h("td"), ...["x m", "y m", "turn \u00b0"].map((name) => h("th", { scope: "col" }, name)))),
      h("tbody", {}, row({ what: "robot", index: 0 }), ...yard.targets.map((_, index) => row({ what: "target", index })), ...changed.map(row)));
    this.said.textContent = selected ? sentenceOf(yard, selected) : "Click on something to select it.";
    this.invalidate();
  }

  // The pointer.

  private takeUp(tool: Tool): void {
    this.tool = tool;
    for (const button of this.tools.children) button.setAttribute("aria-pressed", String(button.getAttribute("data-tool") === tool));
  }

  private grab(at: Vec2, reach: number): boolean {
    const { yard, selected } = this;
    const take = (item: Item, turns = false): boolean => {
      const [x, y] = yard.middle(item);
      this.held = { item, turns, off: [x - at[0], y - at[1]], moved: false };
      this.select(item);
      return true;
    };
    if (this.tool === "target" || this.tool === "obstacle") {
      yard.remember();
      take(this.tool === "target" ? yard.addTarget(at) : yard.addBox(at));
      this.held!.moved = true;  // one undo removes it, wherever it was dragged to
      return true;
    }
    if (this.tool === "move" && selected && !yard.isRemoved(selected) && onKnob(this.pane.camera, at, yard.middle(selected), yard.turn(selected), beyond(yard, selected))) return take(selected, true);
    if (this.tool === "move" && onKnob(this.pane.camera, at, yard.start, yard.heading_rad)) return take({ what: "robot", index: 0 }, true);
    const item = yard.at(at, reach);
    if (item && this.tool === "move") return take(item);
    if (item) {
      this.selected = item;
      this.remove();
    }
    return item !== null;
  }

  private drag(at: Vec2): void {
    const { held, yard } = this;
    if (!held || (yard.isRemoved(held.item) && !held.turns)) return;
    if (!held.moved) yard.remember();
    held.moved = true;
    if (held.turns) yard.turnTo(held.item, headingTo(at, yard.middle(held.item)));
    else yard.moveTo(held.item, [at[0] + held.off[0], at[1] + held.off[1]]);
    this.changed();
  }

  // The keyboard.

  /** Changes the selected item, in a step that can be undone. */
  private change(act: (item: Item) => void): void {
    if (!this.selected || this.yard.isRemoved(this.selected)) return;
    this.yard.remember();
    act(this.selected);
    this.changed();
  }

  private nudge(dx: number, dy: number): void {
    this.change((item) => {
      const [x, y] = this.yard.middle(item);
      this.yard.moveTo(item, [x + dx * stride_m, y + dy * stride_m]);
    });
  }

  private turn(side: number): void {
    this.change((item) => this.yard.turnTo(item, turned(this.yard.turn(item), side)));
  }

  private remove(): void {
    if (!this.selected || this.selected.what === "robot") return;
    this.yard.remember();
    this.selected = this.yard.remove(this.selected);
    this.changed();
  }

  private putBack(): void {
    if (this.selected?.what !== "thing") return;
    this.yard.remember();
    this.yard.putBack(this.selected);
    this.changed();
  }

  private undo(again: boolean): void {
    if (!this.yard.undo(again)) return;
    const { selected, yard } = this;
    const there = selected === null || selected.what === "robot" || selected.what === "thing" || selected.index < (selected.what === "target" ? yard.targets : yard.boxes).length;
    if (!there) this.selected = null;
    this.changed();
  }

  private select(item: Item | null): void {
    if (item) this.selected = item;
    this.changed();
  }

  private invalidate(): void {
    if (this.frame !== 0) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.pane.draw();
    });
  }

  private savePicture(): void {
    saveCanvas(this.pane.canvas, `${this.scenario.map.name}.png`);
  }

  private bindKeys(): void {
    keys.set("Yard", [
      { key: "1", words: "take the robot", act: () => this.select({ what: "robot", index: 0 }) },
      { key: "t", words: "take the next target", act: () => this.select(this.yard.nextTarget(this.selected)) },
      { key: "o", words: "take the next obstacle", act: () => this.select(this.yard.nextObstacle(this.selected)) },
      { key: "h", words: "move it left", act: () => this.nudge(-1, 0) },
      { key: "j", words: "move it down", act: () => this.nudge(0, -1) },
      { key: "k", words: "move it up", act: () => this.nudge(0, 1) },
      { key: "l", words: "move it right", act: () => this.nudge(1, 0) },
      { key: ",", words: "turn it left by 5\u00b0", act: () => this.turn(1) },
      { key: ".", words: "turn it right by 5\u00b0", act: () => this.turn(-1) },
      { key: "Delete", words: "remove it; what is of the world comes back by the same", act: () => this.remove() },
      { key: "x", words: "the same", act: () => this.remove() },
      { key: "b", words: "put an obstacle back to where the world has it", act: () => this.putBack() },
      { key: "Ctrl+z", words: "undo", act: () => this.undo(false) },
      { key: "u", words: "undo", act: () => this.undo(false) },
      { key: "Ctrl+y", words: "do it again", act: () => this.undo(true) },
      { key: "U", words: "do it again", act: () => this.undo(true) },
      ...(Object.keys(words) as Tool[]).map((tool, i) => ({ key: "qwer"[i]!, words: words[tool].toLowerCase(), act: () => this.takeUp(tool) })),
      { key: "S", words: "save as a scenario", act: () => void this.saving.save() },
      { key: "R", words: "save it and run the mission", act: () => void this.run() },
      { key: "s", words: "save the view as PNG", act: () => this.savePicture() },
      { key: "+", words: "zoom in", act: () => this.pane.camera.zoom(1.5) },
      { key: "-", words: "zoom out", act: () => this.pane.camera.zoom(1 / 1.5) },
      { key: "0", words: "show everything", act: () => this.pane.camera.reset() },
    ], this);
  }
}

/** Describes the selected item and what can be done with it. */
function sentenceOf(yard: Yard, item: Item): string {
  const name = yard.name(item);
  if (yard.isRemoved(item)) return `${name} is removed; x brings it back.`;
  if (item.what === "thing" && yard.isMoved(item)) return `${name}: moved; b puts it back, x removes it.`;
  return item.what === "robot" ? `${name}: drag it, or turn it by its handle.` : `${name}: drag it, turn it by its handle, or remove it with x.`;
}
