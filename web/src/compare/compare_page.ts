// Two runs or more beside each other: the same time in all, and where their numbers differ.
import { fileAt, getJson, type RunRow } from "../api";
import { h, icon } from "../base/dom";
import { keys } from "../base/keys";
import { clockText } from "../base/numbers";
import { formatAddress, keepInAddress } from "../base/url";
import { openLog } from "../log/file";
import { Run } from "../log/run";
import type { RunLog } from "../log/run_log";
import { stateWords } from "../live/states";
import { Clock } from "../watch/clock";
import { PlanView } from "../watch/plan_view";
import { ghostsOf } from "./ghost_layer";
import { differencesOf } from "./differences";
import "./compare.css";

interface Side { row: RunRow; log: RunLog; run: Run; view: PlanView; clock: HTMLElement }

export class ComparePage {
  readonly element: HTMLElement;
  readonly title = "Compare runs";
  private sides: Side[];
  private clock: Clock;
  private play = h("button", { type: "button", class: "play", "aria-label": "Play or pause", title: "Play or pause (space)", onclick: () => this.clock.toggle() });
  private slider = h("input", { type: "range", min: 0, step: "any", value: 0, "aria-label": "Time of all runs" });
  private time = h("output", { class: "clock" });
  private overlaid = false;
  private modes: HTMLElement;
  private views: HTMLElement;
  private frame = 0;
  private before = 0;

  /** Opens the runs with these ids; throws a sentence where there is none, or it left no log. */
  static async open(ids: string[], query: Record<string, string>): Promise<ComparePage> {
    const opened = await Promise.all(ids.map(async (id) => {
      const row = await getJson<RunRow>(`runs/${id}`);
      return { row, log: await openLog(await fileAt(`runs/${id}/log`)) };
    }));
    return new ComparePage(opened, query);
  }

  constructor(opened: { row: RunRow; log: RunLog }[], query: Record<string, string>) {
    this.sides = opened.map(({ row, log }) => {
      const run = new Run(log);
      const view: PlanView = new PlanView(run, { redraw: () => this.invalidate(), selectShot: () => undefined, selectTarget: () => undefined });
      return { row, log, run, view, clock: h("p", { class: "compare-at" }) };
    });
    this.clock = new Clock(Math.max(...this.sides.map(({ run }) => run.duration)), () => this.invalidate());
    this.slider.max = String(this.clock.duration);
    this.slider.addEventListener("input", () => this.clock.seek(Number(this.slider.value)));
    const bar = h("section", { class: "panel transport", "aria-label": "Playing" }, h("div", { class: "keys" }, this.play), h("div", { class: "timeline" }, this.slider), this.time);
    this.modes = h("div", { class: "segments", role: "group", "aria-label": "Layout" }, ...["Side by side", "Overlaid"].map((name, i) =>
      h("button", { type: "button", "aria-pressed": "false", onclick: () => this.overlay(i === 1) }, name)));
    this.views = h("div", { class: "compare-views" }, ...this.sides.map((side, i) => this.panel(side, i)));
    this.element = h("div", { class: "page compare" }, h("div", { class: "page-head" }, h("h1", {}, "Compare runs"), this.sides.length > 1 && this.modes), this.views, bar, this.table());
    this.overlay(query.layout === "over");
    this.bindKeys();
    this.clock.seek(Number(query.t) || 0);
  }

  close(): void {
    cancelAnimationFrame(this.frame);
    this.frame = -1;
    for (const { view, log } of this.sides) {
      view.close();
      log.changed = () => undefined;
    }
    keys.drop(this);
  }

  /** The other runs over the plan of the first, or beside it. */
  private overlay(on: boolean): void {
    this.overlaid = on;
    [...this.modes.children].forEach((one, i) => one.setAttribute("aria-pressed", String(on === (i === 1))));
    const [first, ...others] = this.sides;
    first?.view.lay(on && others.length > 0 ? ghostsOf(others.map(({ run }) => run)) : null);
    this.views.classList.toggle("overlaid", on);
    keepInAddress({ layout: on ? "over" : "" });
    this.invalidate();
  }

  private panel({ row, log, view, clock }: Side, i: number): HTMLElement {
    log.changed = () => this.invalidate();
    const address = formatAddress({ view: "live", path: row.id, query: {} });
    return h("section", { class: "panel", "aria-label": `Run ${i + 1}: ${nameOf(row)}` }, h("h2", {}, h("span", {}, h("i", { class: `line run-${i + 1}` }), h("a", { href: address }, nameOf(row))), h("span", { class: `run-state ${row.state}` }, stateWords(row.state))),
      h("div", { class: "stage" }, view.element), clock);
  }

  /** The metrics of all, those that differ marked. */
  private table(): HTMLElement {
    const rows = differencesOf(this.sides.map(({ log, row }) => log.summary?.metrics ?? row.summary?.metrics ?? {}));
    const count = rows.filter(({ differs }) => differs).length;
    return h("section", { class: "panel compare-numbers" }, h("h2", {}, count === 0 ? "All numbers are the same" : `${count} of ${rows.length} numbers differ`),
      h("table", {}, h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "metric"), ...this.sides.map(({ row }) => h("th", { scope: "col" }, nameOf(row))), h("th", { scope: "col" }, this.sides.length > 2 ? "last less first" : "difference"))),
        h("tbody", {}, ...rows.map(({ name, values, differs, change }) => h("tr", { class: differs ? "differs" : "" }, h("th", { scope: "row" }, name),
          ...values.map(({ value, unit }) => h("td", {}, value, unit && h("small", {}, ` ${unit}`))), h("td", {}, change))))));
  }

  private invalidate(): void {
    if (this.frame === 0) this.frame = requestAnimationFrame((now) => this.draw(now));
  }

  private draw(now: number): void {
    this.frame = 0;
    const { clock } = this;
    clock.advance((now - this.before) / 1000);
    this.before = now;
    for (const { view, run, clock: at } of this.sides) {
      const t = Math.min(clock.t, run.duration);
      if (!this.overlaid || view === this.sides[0]!.view) view.draw({ t: this.overlaid ? clock.t : t, shot: null, target: null, speed: 0 });
      at.textContent = [`${clockText(t, 1)}${t < clock.t ? ", ended" : ""}`, run.eventText(t)].filter(Boolean).join(" \u00b7 ");
    }
    this.slider.value = String(clock.t);
    this.slider.style.setProperty("--done", `${((100 * clock.t) / clock.duration).toFixed(2)}%`);
    this.time.textContent = `${clockText(clock.t, 1)} / ${clockText(clock.duration)}`;
    this.play.replaceChildren(icon(clock.playing ? "pause" : "play"));
    if (clock.playing) this.invalidate();
    else keepInAddress({ t: clock.t.toFixed(2) });
  }

  private bindKeys(): void {
    const { clock } = this;
    keys.set("Playing", [
      { key: " ", words: "play or pause", act: () => clock.toggle() },
      { key: "ArrowLeft", words: "a second back", act: () => clock.seek(clock.t - 1) },
      { key: "ArrowRight", words: "a second on", act: () => clock.seek(clock.t + 1) },
      { key: "o", words: "side by side or overlaid", act: () => this.overlay(!this.overlaid) },
      { key: "Home", words: "to the beginning", act: () => clock.seek(0) },
      { key: "End", words: "to the end", act: () => clock.seek(clock.duration) },
    ], this);
  }
}

const nameOf = ({ scenario, seed }: RunRow): string => `${scenario.split("/").at(-1)!.replace(/\.ya?ml$/, "")}${seed === null ? "" : `, seed ${seed}`}`;
