// The planning page: the ground, one or two planners on the same question, their answers and their searches. It replans
// during a drag.
import { send, type MapAnswer, type PlannerRow, type PlanRequest } from "../api";
import { announce } from "../base/announce";
import { h, iconButton } from "../base/dom";
import { keys } from "../base/keys";
import { MenuButton, perform, type MenuItem } from "../base/menu";
import type { Vec2 } from "../base/outline";
import { onUnits } from "../base/units";
import { keepInAddress } from "../base/url";
import { aboutSearch } from "./about_search";
import { Asker } from "./asker";
import { Choice } from "./choice";
import { History } from "./history";
import { free, occupied, groundOf, type Ground } from "./ground";
import { onKnob } from "./handle";
import type { Values } from "./form";
import { legend } from "./legend";
import { mapTools, radiusField } from "./map_tools";
import { suggestedName } from "./names";
import { Pane, type Scene } from "./pane";
import { answerWords, resultTable } from "./results";
import { SaveForm } from "./save_form";
import { cameraKeys, endKeys, searchKeys, undoKeys } from "./plan_keys";
import type { Shown } from "./shown";
import { Steps } from "./steps";
import { pointOf } from "./names";
import { planExports } from "./plan_exports";
import { headingTo, turned } from "./turning";

type Tool = "move" | "block" | "free" | "add" | "remove";
const words: Record<Tool, string> = {
  move: "Drag start, goal, obstacles or the view", block: "Paint walls", free: "Erase walls", add: "Add an obstacle", remove: "Remove an obstacle",
};
const most = 50000;

interface PlanScene extends Scene { goal: Vec2; selected: "start" | "goal" | null }
/** Holds the settings of a scenario besides its map, start and goal. */
export interface Opened { path: string; planner: string; options: Values; model: string; resolution_m: number }
interface Seat { pane: Pane; asker: Asker; choice: Choice }

export class PlanPage {
  readonly element: HTMLElement;
  private scene: PlanScene;
  private ground: Ground;
  private seats: Seat[] = [];
  private panes = h("div", { class: "panes" });
  private choices = h("div", { class: "choices" });
  private results = h("div", { class: "results" });
  private mapTools = h("div");
  private offUnits = onUnits(() => this.unitsChanged());
  private mazes = 0;
  private radius = h("div");
  private menu = new MenuButton("save", "Export", () => this.exports());
  private notice = h("p", { class: "notice", role: "status" });
  private sentence = h("p", { class: "action" });
  private steps = new Steps(() => this.invalidate(), this.sentence);
  private tools: HTMLElement;
  private compare = h("button", { type: "button", class: "button", onclick: () => this.setVersus(this.seats.length > 1 ? null : this.planners[0]!.name) });
  private bar = h("div", { class: "stage-bar" });
  private barWatcher = new ResizeObserver(() => this.makeRoom());
  private tool: Tool = "move";
  private held: { what: "start" | "goal" | "heading" | "paint" | number; last: Vec2; changed?: boolean } | null = null;
  private legend = h("ul", { class: "legend", "aria-label": "Legend" });
  private frame = 0;
  private firstStep: number | null;
  private planners: PlannerRow[];
  private saving: SaveForm;
  private history = new History(() => {
    const [{ start, goal }, ground] = [this.scene, this.ground.snapshot()];
    return () => {
      this.scene.start = start;
      this.scene.goal = goal;
      ground();
    };
  });
  /** The changes to the map that were saved last. */
  private kept = "[]";

  constructor(private map: MapAnswer, ground: Ground, planners: PlannerRow[], query: Record<string, string>, path: string, private opened: Opened | null) {
    this.ground = ground;
    this.planners = planners.filter(({ grounds }) => (ground.kind === "polygons" ? grounds.includes("polygons") : grounds.some((kind) => kind !== "polygons")));
    const radius_m = Number(query.radius ?? map.radius_m);
    const [start, goal] = ground.ends(radius_m);
    this.scene = { ground, start: pointOf(query.start) ?? start, goal: pointOf(query.goal) ?? goal, radius_m, selected: "goal", heading_rad: null };
    this.firstStep = query.step === undefined ? null : Number(query.step);
    this.tools = this.madeTools();
    this.saving = new SaveForm(opened?.path ?? suggestedName(path || map.name, "_plan"), opened?.path ?? "", () => ({ plan: this.request(this.seats[0]!.choice) }), () => { this.kept = JSON.stringify(this.ground.edits()); });
    this.bar.append(this.tools, this.legend);
    this.barWatcher.observe(this.bar);
    const aside = h("section", { class: "panel aside" }, h("div", { class: "tabbed scrolls plan-aside" }, h("div", {}, h("h1", {}, this.title), this.mapTools), this.choices,
      h("div", { class: "row" }, this.compare, this.radius), this.notice, this.results, this.saving.element));
    this.element = h("div", { class: "watch plan-page" }, h("section", { class: "panel stage-panel", "aria-label": "The map" },
      h("div", { class: "stage" }, this.panes, this.bar,
        h("div", { class: "stage-tools" }, iconButton("undo", "Undo", () => this.undo(false), "u"), iconButton("redo", "Do it again", () => this.undo(true), "U"),
          this.menu.element))),
    this.steps.element, aside);
    for (const text of map.warnings) this.notice.append(h("span", {}, text));
    this.sit(query.planner ?? opened?.planner ?? (ground.kind === "grid" ? "a_star" : "visibility_graph_implicit"));
    if (query.versus) this.sit(query.versus);
    this.unitsChanged();
    this.rebuilt();
    this.bindKeys();
    this.planSoon(true);
  }

  get title(): string { return this.opened?.path.split("/").at(-1) ?? this.map.name; }

  /** The map was changed since it was opened or saved; start and goal are in the address. */
  unsaved(): boolean { return JSON.stringify(this.ground.edits()) !== this.kept; }

  close(): void {
    cancelAnimationFrame(this.frame);
    this.barWatcher.disconnect();
    this.menu.close();
    this.offUnits();
    this.steps.close();
    for (const seat of this.seats) this.leave(seat);
    keys.drop(this);
  }

  // The planners.

  private sit(name: string): void {
    const pane: Pane = new Pane(this.scene, { redraw: () => this.invalidate(), grab: (at, reach) => this.grab(at, reach), drag: (at) => this.drag(at), drop: () => this.drop() },
      (): number => Math.min(this.steps.step, pane.trace?.length ?? 0));
    const asker = new Asker((answer, request) => this.take(pane, answer, request));
    const choice = new Choice(this.planners, name, (refusal) => {
      this.notice.textContent = refusal;
      if (refusal) return;
      this.rebuilt();
      this.planSoon(true);
    }, name === this.opened?.planner && this.seats.length === 0 ? { ...this.opened.options } : {});
    this.seats.push({ pane, asker, choice });
  }

  private leave({ pane, asker }: Seat): void {
    asker.close();
    pane.close();
  }

  private setVersus(name: string | null): void {
    for (const seat of this.seats.splice(1)) this.leave(seat);
    if (name) this.sit(name);
    this.rebuilt();
    this.planSoon(true);
  }

  private rebuilt(): void {
    this.panes.replaceChildren(...this.seats.map(({ pane }) => pane.element));
    const [x0, y0, x1, y1] = this.ground.box;
    this.panes.classList.toggle("stacked", x1 - x0 > 1.5 * (y1 - y0));
    this.choices.replaceChildren(...this.seats.map(({ choice }) => choice.element));
    this.compare.textContent = this.seats.length > 1 ? "Only one planner" : "Compare with another";
    keepInAddress({ planner: this.seats[0]!.choice.name, versus: this.seats[1]?.choice.name ?? "" });
    this.legend.replaceChildren(...legend(this.ground, this.seats.map(({ choice }) => choice.planner)));
    this.makeRoom();
    this.showHeading();
  }

  /** Shows the start heading if a planner has an option for it; it is idle if that planner ignores it. */
  private showHeading(): void {
    const seat = this.seats.find(({ choice }) => choice.value("heading") !== undefined);
    this.scene.heading_rad = seat ? Number(seat.choice.value("heading")) * Math.PI / 180 : null;
    this.scene.idleHeading = seat?.choice.value("first_turn") === false;
  }

  private turnStart(angle: number, traced: boolean): void {
    const degrees = +(angle * 180 / Math.PI).toFixed(3);
    for (const { choice } of this.seats) choice.set({ heading: degrees, first_turn: true });
    this.showHeading();
    this.planSoon(traced);
  }

  /** Keeps room for the bar, which lies over the first map; a second map below it needs no room. */
  private makeRoom(): void {
    const [first, second] = this.seats.map(({ pane }) => pane);
    if (!first) return;
    const below = Math.max(50, this.bar.offsetTop + this.bar.offsetHeight + 8);
    const stacked = second !== undefined && second.element.offsetTop > first.element.offsetTop;
    first.element.style.flexBasis = stacked ? `${below - 16}px` : "";  // so both maps are of one size
    first.camera.headroom(below);
    second?.camera.headroom(stacked ? 16 : below);
  }

  private unitsChanged(): void {
    this.mapTools.replaceChildren(mapTools(this.ground, { maze: () => this.fill(true), clear: () => this.fill(false) }));
    this.radius.replaceChildren(radiusField(this.scene.radius_m, (radius_m) => this.setRadius(radius_m)));
    this.results.replaceChildren(resultTable(this.seats.map((seat) => seat.pane.answer)));
  }

  /** Draws a maze in whose ways the robot fits, another one each time, or nothing. */
  private fill(withMaze: boolean): void {
    const { ground, scene } = this;
    if (ground.kind !== "grid") return;
    this.history.remember();
    [scene.start, scene.goal] = withMaze ? ground.drawMaze(scene.radius_m, ++this.mazes) : ground.clear(scene.radius_m);
    this.keepEnds();
    this.planSoon(true);
  }

  private setRadius(radius_m: number): void {
    this.scene.radius_m = radius_m;
    keepInAddress({ radius: String(radius_m) });
    this.planSoon(true);
  }

  private request(choice: Choice, edits = this.ground.edits()): PlanRequest {
    const { start, goal, radius_m } = this.scene;
    const request: PlanRequest = { map: this.map.id, edits, start, goal, planner: choice.name, options: choice.values, radius_m };
    const { model, resolution_m } = this.opened ?? {};
    if (model && choice.planner.grounds.some((kind) => kind === model)) request.model = model;
    if (resolution_m) request.resolution_m = resolution_m;
    return request;
  }

  /** Asks for plans. `traced` requests the trace too, only once the drag ends, because it is large. */
  private planSoon(traced: boolean): void {
    const edits = this.ground.edits();
    for (const { asker, choice } of this.seats) {
      const request = this.request(choice, edits);
      if (traced) request.trace = most;
      if (traced && this.ground.kind === "grid") request.blocked = true;
      if (traced && this.ground.kind === "polygons") request.legs = true;
      asker.ask(request);
    }
    this.invalidate();
  }

  private take(pane: Pane, answer: Shown, request: PlanRequest): void {
    if (answer.where === "map" && !answer.trace) {
      void this.postAgain();
      return;
    }
    pane.take(answer);
    const longest = Math.max(0, ...this.seats.map((seat) => seat.pane.trace?.length ?? 0));
    if (request.trace || longest !== this.steps.end) {
      this.steps.take(longest, this.firstStep ?? longest);
      if (this.seats.every((seat) => seat.pane.answer)) this.firstStep = null;
    }
    this.results.replaceChildren(resultTable(this.seats.map((seat) => seat.pane.answer)));
    const failed = this.seats.map((seat) => seat.pane.answer).find((one) => one && one.status !== "done");
    this.sentence.textContent = failed?.reason ?? aboutSearch(this.seats.map(({ choice, pane }) => ({ ...choice.planner, answer: pane.answer, shown: pane.trace?.length ?? 0 })));
    this.sentence.classList.toggle("refused", failed !== undefined);
    if (request.trace) announce(failed?.reason ?? answerWords(this.seats.map((seat) => seat.pane.answer)));
    this.element.dataset.answers = String(Number(this.element.dataset.answers ?? 0) + 1);
  }

  /** Sends the map again, because the server keeps few maps and forgot this one. */
  private async postAgain(): Promise<void> {
    const { grid, polygons } = this.map;
    try {
      const { id } = await send<MapAnswer>("POST", "maps", grid ? { grid } : { polygons });
      this.map = { ...this.map, id };
      this.planSoon(true);
    } catch (error) {
      this.notice.textContent = String(error instanceof Error ? error.message : error);
    }
  }

  // The pointer.

  private madeTools(): HTMLElement {
    const tools: Tool[] = this.ground.kind === "grid" ? ["move", "block", "free"] : ["move", "add", "remove"];
    return h("div", { class: "segments", role: "group", "aria-label": "Tool" }, ...tools.map((name) =>
      h("button", { type: "button", "data-tool": name, title: words[name], "aria-pressed": String(name === this.tool), onclick: () => this.takeUp(name) },
        name === "move" ? "Drag" : name[0]!.toUpperCase() + name.slice(1))));
  }

  private takeUp(tool: Tool): void {
    this.tool = tool;
    for (const button of this.tools.children) button.setAttribute("aria-pressed", String(button.getAttribute("data-tool") === tool));
  }

  private grab(at: Vec2, reach: number): boolean {
    const { scene, ground } = this;
    const near = ([x, y]: Vec2): boolean => Math.hypot(x - at[0], y - at[1]) <= reach;
    if (this.tool === "move") {
      if (scene.heading_rad !== null && onKnob(this.seats[0]!.pane.camera, at, scene.start, scene.heading_rad)) {
        this.held = { what: "heading", last: at };
        return true;
      }
      const what = near(scene.goal) ? "goal" : near(scene.start) ? "start" : ground.kind === "polygons" ? ground.at(at) : -1;
      if (what === -1) return false;
      if (typeof what === "string") scene.selected = what;
      this.held = { what, last: at };
      return true;
    }
    if (ground.kind === "grid") {
      this.held = { what: "paint", last: at };
      this.drag(at);
      return true;
    }
    const [x0, , x1] = ground.box;
    if (this.tool === "remove" && ground.at(at) < 0) return false;
    this.history.remember();
    if (this.tool === "add") this.held = { what: ground.add(at, 0.03 * (x1 - x0)), last: at, changed: true };
    else ground.remove(ground.at(at));
    this.planSoon(false);
    return true;
  }

  private drag(at: Vec2): void {
    const { held, ground, scene } = this;
    if (!held) return;
    if (held.what === "heading") {
      this.turnStart(headingTo(at, scene.start), false);
      return;
    }
    if (!held.changed) this.history.remember();
    held.changed = true;
    if (held.what === "start" || held.what === "goal") scene[held.what] = at;
    else if (held.what === "paint" && ground.kind === "grid") {
      const reach = Math.floor(Math.max(ground.grid.width, ground.grid.height) / 120);
      ground.paint(ground.cellAt(held.last), ground.cellAt(at), this.tool === "free" ? free : occupied, reach);
    } else if (typeof held.what === "number" && ground.kind === "polygons") {
      ground.shift(held.what, [at[0] - held.last[0], at[1] - held.last[1]]);
    }
    held.last = at;
    this.planSoon(false);
  }

  private drop(): void {
    this.held = null;
    this.keepEnds();
    this.planSoon(true);
  }

  private keepEnds(): void {
    const text = (p: Vec2): string => p.map((value) => String(+value.toFixed(3))).join(",");
    keepInAddress({ start: text(this.scene.start), goal: text(this.scene.goal) });
  }

  /** Moves the selected end by this many cells, or hundredths of the width. */
  private nudge(dx: number, dy: number): void {
    const { scene, ground } = this;
    const [x0, , x1] = ground.box;
    const stride = ground.kind === "grid" ? ground.grid.resolution_m : (x1 - x0) / 100;
    const end = scene.selected ?? "goal";
    this.history.remember();
    scene[end] = [scene[end][0] + dx * stride, scene[end][1] + dy * stride];
    this.keepEnds();
    this.planSoon(true);
  }

  private undo(again: boolean): void {
    if (this.held || !this.history.undo(again)) return;
    this.keepEnds();
    this.planSoon(true);
  }

  private turnBy(side: number): void {
    if (this.scene.heading_rad !== null) this.turnStart(turned(this.scene.heading_rad, side), true);
  }

  private select(end: "start" | "goal"): void {
    this.scene.selected = end;
    this.invalidate();
  }

  private invalidate(): void {
    if (this.frame !== 0) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      for (const { pane } of this.seats) pane.draw();
      const { step, end } = this.steps;
      keepInAddress({ step: step < end ? String(step) : "" });
    });
  }

  private exports(): MenuItem[] {
    return planExports(this.map.name, this.scene, this.seats.map(({ pane }) => pane));
  }

  private bindKeys(): void {
    const tools = [...this.tools.children].map((one) => one.getAttribute("data-tool") as Tool);
    keys.set("Search", searchKeys(this.steps), this);
    keys.set("Map", [
      ...endKeys({ select: (end) => this.select(end), nudge: (dx, dy) => this.nudge(dx, dy), turn: (side) => this.turnBy(side) }),
      ...tools.map((tool, i) => ({ key: "qwe"[i]!, words: words[tool].toLowerCase(), act: () => this.takeUp(tool) })),
      ...undoKeys((again) => this.undo(again)),
      { key: "c", words: "compare two planners", act: () => this.compare.click() },
      ...cameraKeys(() => this.seats.map(({ pane }) => pane.camera)),
      ...(this.ground.kind === "grid" ? [{ key: "M", words: "draw a maze over the whole map", act: () => this.fill(true) }] : []),
      { key: "S", words: "save as a scenario", act: () => void this.saving.save() },
      ...["s", "g", "J"].map((key, i) => ({ key, words: `save ${this.exports()[i]!.about}`, act: () => perform(this.exports()[i]) })),
    ], this);
  }
}

/**
 * Opens a map, with the question of a scenario or its own, or returns a sentence that says why it cannot. `path` is
 * that of the map.
 */
export function openPlan(map: MapAnswer, planners: PlannerRow[], query: Record<string, string>, path: string, opened: Opened | null = null): PlanPage | string {
  const ground = groundOf(map);
  return typeof ground === "string" ? ground : new PlanPage(map, ground, planners, query, path, opened);
}

